#include "bench/gnuplot.hpp"

#include <filesystem>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/method_style.hpp"
#include <seam/error.hpp>
#include <seam/table.hpp>

namespace seam {

namespace {

// Runs a program in a folder, its output in a log there; its exit status, 127 where it is not there.
int run_in(const std::string& folder, std::vector<std::string> arguments, const std::string& log) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error(folder, "no process for " + arguments[0]);
  if (child == 0) {
    const int output =
        chdir(folder.c_str()) == 0 ? open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644) : -1;
    if (output < 0) _exit(126);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    close(STDIN_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string first_line_with_text(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  return "it left no picture";
}

bool is_whole_png(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  return bytes.size() > 100 && bytes.substr(bytes.size() - 8, 4) == "IEND";
}

}  // namespace

void require_gnuplot() {
  const std::string log = "/dev/null";
  if (run_in(".", {"gnuplot", "--version"}, log) != 0)
    throw Error("gnuplot", "cannot be run, it is needed for the pictures (Debian: gnuplot-nox)");
}

std::string quoted(const std::string& text) {
  std::string doubled;
  for (const char c : text) doubled += c == '\'' ? "''" : std::string(1, c);
  return "'" + doubled + "'";
}

std::string style(Join method) {
  const auto [colour, dash] = style_of(method);
  const bool whole = dash[0] == 0;
  return fmt::format("lc rgb '{}' lw 2.5 dt {}", colour,
                     whole ? "1" : fmt::format("({},{})", dash[0], dash[1]));
}

std::string preamble(int width, int height) {
  return fmt::format(
      "# gnuplot -c THIS PICTURE.png\n"
      "set terminal pngcairo size {},{} noenhanced font 'DejaVu Sans,17' background rgb 'white'\n"
      "set output ARG1\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set grid back lt 1 lw 1 lc rgb '#e4e4e4'\n"
      "set border 3\nset tics nomirror\n"
      "set lmargin 11\nset rmargin 3\nset key tmargin right horizontal maxrows 1 samplen 2\n",
      width, height);
}

void draw(const std::string& folder, const std::string& name, const std::string& script) {
  write_whole(folder + "/" + name + ".gnuplot", script);
  const std::string part = name + ".png.part";
  const int status = run_in(folder, {"gnuplot", "-c", name + ".gnuplot", part}, "gnuplot.log");
  const std::string picture = folder + "/" + name + ".png";
  if (status == 0 && is_whole_png(folder + "/" + part)) {
    std::filesystem::rename(folder + "/" + part, picture);
    std::filesystem::remove(folder + "/gnuplot.log");
    return;
  }
  const std::string reason = first_line_with_text(folder + "/gnuplot.log");
  std::filesystem::remove(folder + "/" + part);
  std::filesystem::remove(folder + "/gnuplot.log");
  throw Error(picture, "gnuplot cannot draw it: " + reason);
}

}  // namespace seam
