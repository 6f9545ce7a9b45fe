#include "bench/progress.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace seam {

void ProgressLine::show(std::int64_t done, std::int64_t total, const std::string& what) {
  const auto now = Clock::now();
  if (!isatty(STDERR_FILENO) || (done < total && now - shown_ < std::chrono::milliseconds(100)))
    return;
  shown_ = now;
  const double rate =
      static_cast<double>(done - before_) / std::chrono::duration<double>(now - begin_).count();
  fmt::print(stderr, "\r\033[K");
  if (done < total)
    fmt::print(stderr, "{}/{} {}, {:.3g} a second, {:.0f} s left", done, total, what, rate,
               static_cast<double>(total - done) / rate);
  std::fflush(stderr);
}

}  // namespace seam
