#include "bench/results_folder.hpp"

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <seam/error.hpp>

namespace seam {

Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

bool take_alone(const Descriptor& descriptor) {
  return flock(descriptor.number, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void make_folder(const std::string& path) {
  std::error_code status;
  std::filesystem::create_directories(path, status);
  if (status) throw Error(path, "cannot be made: " + status.message());
}

ResultsFolder::ResultsFolder(const std::string& path) : path_(path) {
  if (path.empty()) throw Error("--out", "is empty, must be a folder");
  take();
}

void ResultsFolder::make() {
  make_folder(path_);
  take();
}

void ResultsFolder::take() {
  if (folder_.number >= 0) return;
  folder_.number = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_.number >= 0 && !take_alone(folder_))
    throw Error(path_, "is being filled by another seam, needs another folder (--out)");
}

}  // namespace seam
