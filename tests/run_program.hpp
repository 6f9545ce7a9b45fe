#pragma once

#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace seam::test {

struct Outcome {
  int status;
  std::string output;  // and errors
};

/// Runs the program with these arguments, and with an environment as a shell sets it.
inline Outcome run(const std::string& arguments, const std::string& environment = "") {
  FILE* pipe =
      popen((environment + " " + SEAM_PROGRAM + " " + arguments + " 2>&1 </dev/null").c_str(), "r");
  Outcome outcome{-1, {}};
  char part[4096];
  for (std::size_t n = 0; (n = fread(part, 1, sizeof part, pipe)) > 0;)
    outcome.output.append(part, n);
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

}  // namespace seam::test
