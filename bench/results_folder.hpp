#pragma once

#include <string>

namespace seam {

/// An open file or folder, closed with it.
struct Descriptor {
  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  int number = -1;
};

/// Takes what is open for this process alone, until it is closed or the process ends, however that comes about.
/// @return  false where another has it; a file system that knows no locks never says so
bool take_alone(const Descriptor& descriptor);

/// Makes a folder, and those that it is in, unless it is there.
/// @throws Error  cannot be made
void make_folder(const std::string& path);

/// A folder that one process fills with results: taken while this lives, from the beginning if it is there then.
class ResultsFolder {
 public:
  /// @throws Error  another process fills it, `path` is empty
  explicit ResultsFolder(const std::string& path);
  /// Makes it if it is not there, and takes it.
  /// @throws Error  cannot be made, or another process fills it
  void make();

 private:
  void take();

  std::string path_;
  Descriptor folder_;
};

}  // namespace seam
