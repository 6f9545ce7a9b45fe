#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace seam {

/// A line on a terminal that says how far long work is and when it will be done, ten times a second at most; it goes when the work is
/// done. Elsewhere nothing is printed.
class ProgressLine {
 public:
  /// @param before  what was done already when the work began
  explicit ProgressLine(std::int64_t before = 0) : before_(before) {}

  void show(std::int64_t done, std::int64_t total, const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_;
  std::int64_t before_;
};

}  // namespace seam
