#include <csignal>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tests/support.hpp"
#include <seam/whole_file.hpp>

namespace {

// What was asked of the disk, in its order.
std::vector<std::string>& asked() {
  static std::vector<std::string> calls;
  return calls;
}

}  // namespace

// In the place of the C library's.
extern "C" int fsync(int descriptor) {
  const auto link = "/proc/self/fd/" + std::to_string(descriptor);
  asked().push_back("sync " + std::filesystem::read_symlink(link).filename().string());
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  asked().push_back("rename " + std::filesystem::path(to).filename().string());
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace seam {
namespace {

using test::refusal;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// As on a disk that is full.
class ShortFiles {
 public:
  explicit ShortFiles(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ShortFiles(const ShortFiles&) = delete;
  ShortFiles& operator=(const ShortFiles&) = delete;
  ~ShortFiles() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(WriteWhole, IsOnTheDiskBeforeItTakesThePlaceOfWhatWasThereAndSoIsThat) {
  const TempFolder folder;
  const std::string name = std::filesystem::path(folder.path("")).parent_path().filename().string();
  asked().clear();
  write_whole(folder.path("a.txt"), [](std::ostream& file) {
    for (int row = 0; row < 1000; ++row) file << row << std::endl;
  });
  EXPECT_THAT(asked(), testing::ElementsAre("sync a.txt.part", "rename a.txt", "sync " + name));
}

TEST(WriteWhole, ReplacesWhatALinkLeadsToAndNotTheLink) {
  const TempFolder folder;
  const std::string target = folder.write("target.txt", "before");
  const std::string link = folder.path("link.txt");
  std::filesystem::create_symlink("target.txt", link);
  write_whole(link, "after");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(test::read_file(target), "after");
}

// As /dev/stdout does where output goes to a file: what else is written there stays.
TEST(WriteWhole, WritesToADescriptorAsItIs) {
  const TempFolder folder;
  const std::string target = folder.write("target.txt", "");
  const std::string link = folder.path("stdout");
  std::FILE* const file = std::fopen(target.c_str(), "a");
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(fileno(file)), link);
  write_whole(link, "content\n");
  std::fputs("more\n", file);
  std::fclose(file);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(test::read_file(target), "content\nmore\n");
}

TEST(ReadWhole, RefusesWhatIsTooLargeOrNoFile) {
  const TempFolder folder;
  const std::string path = folder.write("a.txt", std::string((2 << 20) + 1, 'x'));
  EXPECT_EQ(read_whole(path, "text", 3 << 20).size(), (2U << 20) + 1);
  EXPECT_EQ(refusal([&] { read_whole(path, "text", 2 << 20); }), path + ": is larger than 2 MiB");
  EXPECT_EQ(refusal([] { read_whole("/dev/zero", "text", 1 << 20); }),
            "/dev/zero: is larger than 1 MiB");
  EXPECT_THAT(refusal([&] { read_whole(folder.path(""), "text", 1); }),
              EndsWith(": is a folder, must be a text"));
  EXPECT_THAT(refusal([] { read_whole(std::string(5000, 'x'), "text", 1); }),
              EndsWith(": cannot be read: File name too long"));
}

TEST(WriteWhole, WritesToADeviceAndLeavesItThere) {
  write_whole("/dev/null", "text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THAT(refusal([] { write_whole("/dev/full", std::string(1 << 16, 'x')); }),
              HasSubstr("/dev/full: cannot be written: No space left"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(WriteWhole, LeavesWhatWasThereWhenTheDiskTakesNoMore) {
  EXPECT_THAT(refusal([] { write_whole("/dev/full/x", "text"); }),
              StartsWith("/dev/full/x: cannot be written"));
  const TempFolder folder;
  const std::string path = folder.write("kept.csv", "old");
  {
    const ShortFiles disk(1000);
    EXPECT_EQ(refusal([&] { write_whole(path, std::string(100000, 'x')); }),
              path + ": cannot be written: File too large");
  }
  EXPECT_EQ(test::read_file(path), "old");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(PartFile, GivesWayToTheNextOne) {
  const TempFolder folder;
  const std::string path = folder.path("a.txt");
  folder.write("a.txt.part",
               "left by a process that was killed, which a child of it still writes to");
  std::ofstream orphan(path + ".part", std::ios::in);
  write_whole(path, "new");
  orphan << "old" << std::flush;
  EXPECT_EQ(test::read_file(path), "new");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(PartFile, IsRemovedUnlessItIsFinished) {
  const TempFolder folder;
  { const PartFile part(folder.path("a.txt")); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

}  // namespace
}  // namespace seam
