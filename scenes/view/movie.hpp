#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "scenes/view/image.hpp"
#include <seam/whole_file.hpp>

namespace seam {

/// A movie made by the program ffmpeg from frames as they come: H.264 in `.mp4`, VP9 in `.webm`, an animated picture in
/// `.webp`. It appears whole when it is finished, or not at all.
class Movie {
 public:
  /// Whether a path ends like one.
  static bool is_movie(const std::string& path);

  /// @param rate  [Hz] frames shown a second
  /// @throws Error  no ffmpeg (says what to install), the path cannot be written, its ending is none of those above
  Movie(std::string path, int width, int height, double rate);
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;
  ~Movie();

  /// @throws Error  cannot be written, and why
  void add(const Image& frame);
  void finish();

 private:
  void start(int width, int height, double rate);
  int end();
  [[noreturn]] void fail();

  std::string path_;
  std::optional<PartFile> part_;
  std::FILE* log_ = nullptr;
  std::FILE* pipe_ = nullptr;
  int process_ = 0;
};

}  // namespace seam
