#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>

#include <fcntl.h>
#include <unistd.h>

#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

// Those that are on their way. Names come and go under its lock.
struct Unfinished {
  std::mutex mutex;
  std::set<std::string> names;
};

Unfinished& unfinished() {
  static auto& instance = *new Unfinished;  // outlives the threads that write
  return instance;
}

std::string reason() {
  return std::strerror(errno);
}

// To the disk, so that a loss of power finds it there. File systems that know no such thing do without.
void sync(const std::string& path, int how) {
  const int descriptor = open(path.c_str(), how | O_CLOEXEC);
  if (descriptor < 0) return;
  const bool lost = fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP;
  const int error = errno;
  close(descriptor);
  errno = error;
  if (lost) throw Error(path, "cannot be written: " + reason());
}

void write_in_place(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream file(path, std::ios::binary);
  write(file);
  file.close();
  if (!file) throw Error(path, "cannot be written: " + reason());
}

// A device, a pipe, or a descriptor of this process, whatever that leads to (/dev/stdout).
bool is_stream(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_character_file(path, none) || std::filesystem::is_fifo(path, none) ||
         std::filesystem::read_symlink(path, none).string().rfind("/proc/", 0) == 0;
}

std::string behind_links(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_symlink(path, none)) return path;
  const auto target = std::filesystem::weakly_canonical(path, none);
  return target.empty() ? path : target.string();
}

}  // namespace

std::string read_whole(const std::string& path, const std::string& kind, std::uintmax_t most) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(path, "is a folder, must be a " + kind);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path, "cannot be read: " + reason());
  std::string content;
  char block[1 << 14];
  do {
    file.read(block, sizeof block);
    content.append(block, static_cast<std::size_t>(file.gcount()));
    if (content.size() > most)
      throw Error(path, "is larger than " + std::to_string(most >> 20) + " MiB");
  } while (file);
  if (file.bad()) throw Error(path, "cannot be read: " + reason());
  return content;
}

void write_whole(const std::string& path, const std::string& content) {
  write_whole(path, [&](std::ostream& file) { file << content; });
}

void write_whole(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (is_stream(path)) return write_in_place(path, write);
  PartFile part(path);
  std::ofstream file(part.name(), std::ios::binary | std::ios::in);  // does not make it anew
  write(file);
  file.close();
  if (!file) throw Error(path, "cannot be written: " + reason());
  part.finish();
}

PartFile::PartFile(const std::string& path) : path_(behind_links(path)), name_(path_ + ".part") {
  const std::lock_guard<std::mutex> lock(unfinished().mutex);
  std::remove(name_.c_str());  // another process may still write to it
  if (!std::ofstream(name_)) throw Error(path_, "cannot be written: " + reason());
  unfinished().names.insert(name_);
}

PartFile::~PartFile() {
  const std::lock_guard<std::mutex> lock(unfinished().mutex);
  if (unfinished().names.erase(name_) > 0) std::remove(name_.c_str());
}

void PartFile::finish() {
  sync(name_, O_WRONLY);
  {
    const std::lock_guard<std::mutex> lock(unfinished().mutex);
    if (std::rename(name_.c_str(), path_.c_str()) != 0)
      throw Error(path_, "cannot be written: " + reason());
    unfinished().names.erase(name_);
  }
  const auto folder = std::filesystem::path(path_).parent_path();
  sync(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

void PartFile::discard_all() {
  unfinished().mutex.lock();  // and never unlocked
  for (const std::string& name : unfinished().names) std::remove(name.c_str());
}

}  // namespace seam
