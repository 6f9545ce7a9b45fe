#include "bench/gnuplot.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/method_style.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

// A file that is open, until the end of its life.
class OpenFile {
 public:
  OpenFile(std::FILE* file, const std::string& path) : file_(file) {
    if (!file_) throw Error(path, std::string("cannot be opened: ") + std::strerror(errno));
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { std::fclose(file_); }
  std::FILE* get() const { return file_; }

 private:
  std::FILE* file_;
};

// Runs a program in a folder; its exit status, 127 where it is not there.
int run_in(const std::string& folder, std::vector<std::string> arguments, const OpenFile& output,
           const OpenFile& errors) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  sigset_t none;
  sigemptyset(&none);
  const pid_t child = fork();
  if (child < 0) throw Error(folder, "no process for " + arguments[0]);
  if (child == 0) {
    dup2(fileno(output.get()), STDOUT_FILENO);
    dup2(fileno(errors.get()), STDERR_FILENO);
    close(STDIN_FILENO);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    if (chdir(folder.c_str()) != 0) _exit(126);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string first_line_with_text(const OpenFile& file) {
  std::rewind(file.get());
  char line[300];
  while (std::fgets(line, sizeof line, file.get())) {
    line[std::strcspn(line, "\n")] = '\0';
    if (line[std::strspn(line, " \t^")] != '\0') return line;
  }
  return "it left no picture";
}

bool is_whole_png(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  return bytes.size() > 100 && bytes.substr(bytes.size() - 8, 4) == "IEND";
}

}  // namespace

void require_gnuplot() {
  const OpenFile nowhere(std::fopen("/dev/null", "w"), "/dev/null");
  if (run_in(".", {"gnuplot", "--version"}, nowhere, nowhere) != 0)
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

// gnuplot is given the picture's open file, so that it leaves none where it goes on alone.
void draw(const std::string& folder, const std::string& name, const std::string& script) {
  write_whole(folder + "/" + name + ".gnuplot", script);
  const std::string picture = folder + "/" + name + ".png";
  PartFile part(picture);
  const OpenFile output(std::fopen(part.name().c_str(), "r+e"), picture);
  const OpenFile errors(std::tmpfile(), "temporary file");
  const int status =
      run_in(folder, {"gnuplot", "-c", name + ".gnuplot", "/dev/stdout"}, output, errors);
  if (status != 0 || !is_whole_png(part.name()))
    throw Error(picture, "gnuplot cannot draw it: " + first_line_with_text(errors));
  part.finish();
}

}  // namespace seam
