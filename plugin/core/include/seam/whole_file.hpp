#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include <seam/export.hpp>

namespace SEAM_API seam {

/// The content of a file.
/// @param kind  what it must be, for messages: "CSV file"
/// @param most  [B] beyond which it is refused, a device that never ends among them
/// @throws Error  cannot be read (names the reason), is a folder, is too large
std::string read_whole(const std::string& path, const std::string& kind, std::uintmax_t most);

/// Writes a file so that it appears whole or not at all, and what was there before stays until then, whenever the process
/// is killed or the machine loses power. See PartFile. A device or a pipe (/dev/stdout) is written to
/// as it is, a link's target is replaced and not the link. One writer at a time for a path.
/// @throws Error  cannot be written (names the reason, e.g. no space left on device)
void write_whole(const std::string& path, const std::string& content);
/// The same where the content is too long to be held in memory.
void write_whole(const std::string& path, const std::function<void(std::ostream&)>& write);

/// A file on its way: PATH.part, empty at first, which takes the place of PATH when it is finished and is removed when it
/// is not. One that a killed process has left gives way to the next.
class PartFile {
 public:
  /// @throws Error  cannot be made
  explicit PartFile(const std::string& path);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  /// Removes it unless it was finished.
  ~PartFile();

  /// PATH.part, to write to. It must not be made anew.
  const std::string& name() const { return name_; }
  /// Has it written to the disk, renames it to PATH, and has that written to the disk.
  /// @throws Error  it cannot be written or renamed
  void finish();

  /// Removes all that there are, for a program that is about to end on a signal: no other will begin or finish. To be called
  /// from a thread, not from a signal's handler.
  static void discard_all();

 private:
  std::string path_, name_;
};

}  // namespace seam
