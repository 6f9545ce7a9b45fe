#include "scenes/view/movie.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <seam/error.hpp>

extern char** environ;

namespace seam {

namespace {

using Words = std::vector<std::string>;

Words encoder(const std::string& ending) {
  const Words even{"-vf",         "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709",
                   "-colorspace", "bt709",
                   "-pix_fmt",    "yuv420p"};
  Words words;
  if (ending == ".mp4") {
    words = {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"};
  } else if (ending == ".webm") {
    words = {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-f", "webm"};
  } else if (ending == ".webp") {
    return {"-c:v", "libwebp_anim", "-quality", "72", "-compression_level",
            "6",    "-loop",        "0",        "-f", "webp"};
  } else {
    return {};
  }
  words.insert(words.begin(), even.begin(), even.end());
  return words;
}

std::string ending_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

}  // namespace

bool Movie::is_movie(const std::string& path) {
  return !encoder(ending_of(path)).empty();
}

Movie::Movie(std::string path, int width, int height, double rate) : path_(std::move(path)) {
  if (!is_movie(path_)) throw Error(path_, "must end with .mp4, .webm or .webp");
  part_.emplace(path_);
  log_ = std::tmpfile();
  if (!log_) throw Error(path_, std::string("no temporary file: ") + std::strerror(errno));
  std::signal(SIGPIPE, SIG_IGN);
  start(width, height, rate);
}

void Movie::start(int width, int height, double rate) {
  Words words{"ffmpeg",   "-v",
              "error",    "-y",
              "-f",       "rawvideo",
              "-pix_fmt", "rgb24",
              "-s",       std::to_string(width) + "x" + std::to_string(height),
              "-r",       std::to_string(rate),
              "-i",       "-",
              "-an"};
  for (const std::string& word : encoder(ending_of(path_))) words.push_back(word);
  words.push_back("file:/dev/stdout");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // The part's open file, so that ffmpeg leaves none where it goes on alone.
  const int output = open(part_->name().c_str(), O_RDWR | O_CLOEXEC);
  std::array<int, 2> ends{};
  if (output < 0 || pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(path_, std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(log_), STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  const int status =
      posix_spawnp(&process_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(output);
  close(ends[0]);
  pipe_ = fdopen(ends[1], "wb");
  if (status == 0) return;
  process_ = 0;
  end();
  throw Error("ffmpeg", "cannot be run, it is needed for movies (Debian: ffmpeg)");
}

Movie::~Movie() {
  end();
}

void Movie::add(const Image& frame) {
  if (std::fwrite(frame.rgb.data(), 1, frame.rgb.size(), pipe_) != frame.rgb.size()) fail();
}

void Movie::finish() {
  const bool flushed = std::fflush(pipe_) == 0;
  std::fclose(std::exchange(pipe_, nullptr));
  int status = 0;
  waitpid(std::exchange(process_, 0), &status, 0);
  if (!flushed || status != 0) fail();
  part_->finish();
}

// Ends the program, if it still runs, and clears up.
int Movie::end() {
  int status = 0;
  if (pipe_) std::fclose(std::exchange(pipe_, nullptr));
  if (process_) waitpid(std::exchange(process_, 0), &status, 0);
  if (log_) std::fclose(std::exchange(log_, nullptr));
  part_.reset();
  return status;
}

void Movie::fail() {
  if (pipe_) std::fclose(std::exchange(pipe_, nullptr));
  if (process_) waitpid(std::exchange(process_, 0), nullptr, 0);
  std::array<char, 300> line{};
  std::rewind(log_);
  if (!std::fgets(line.data(), static_cast<int>(line.size()), log_)) line[0] = '\0';
  line[std::strcspn(line.data(), "\n")] = '\0';
  throw Error(path_, std::string("cannot be written: ffmpeg: ") + line.data());
}

}  // namespace seam
