#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temp_folder.hpp"
#include <seam/error.hpp>

namespace seam::fuzz {

/// Where inputs become files, one after the other under the same name, beside the files of tests/fuzz/beside and the
/// PA-10, which they may name.
class Inputs {
 public:
  explicit Inputs(const std::string& name) : path_(folder_.path(name)) {
    namespace fs = std::filesystem;
    fs::copy(SEAM_FUZZ_BESIDE, folder_.path(""));
    fs::copy(SEAM_ASSETS "/pa10/meshes", folder_.path("meshes"));
    fs::copy(SEAM_ASSETS "/pa10/pa10.urdf", folder_.path("pa10.urdf"));
  }

  // A new file each time: to write one anew can mean to wait for the disk.
  const std::string& put(const std::uint8_t* data, std::size_t size) const {
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path_;
  }

 private:
  TempFolder folder_;
  std::string path_;
};

/// What is read is read, or refused by an Error of one line; all else ends the process.
template <typename Action>
void read_or_refuse(Action action) {
  try {
    action();
  } catch (const Error& error) {
    if (std::strchr(error.what(), '\n')) std::abort();
  }
}

}  // namespace seam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
