#include "bench/progress.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace seam {

void show_progress(int done, int total, const std::string& what) {
  if (!isatty(STDERR_FILENO)) return;
  fmt::print(stderr, "\r\033[K{}/{} {}{}", done, total, what, done == total ? "\r\033[K" : "");
  std::fflush(stderr);
}

}  // namespace seam
