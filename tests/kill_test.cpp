#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <random>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/refusals.hpp"

namespace seam {
namespace {

using Clock = std::chrono::steady_clock;
using Files = std::map<std::string, std::string>;
namespace fs = std::filesystem;

constexpr unsigned seed = 7;
const std::string old = "what was there before";

/// The program, silent and on its own.
class Process {
 public:
  explicit Process(const std::string& arguments) {
    std::string command = "exec " SEAM_PROGRAM " " + arguments + " >/dev/null 2>&1 </dev/null";
    std::string shell = "sh", option = "-c";
    char* const words[] = {shell.data(), option.data(), command.data(), nullptr};
    EXPECT_EQ(posix_spawnp(&process_, "sh", nullptr, nullptr, words, environ), 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (process_ > 0) end(SIGKILL);
  }

  bool runs() {
    if (process_ > 0 && waitpid(process_, &status_, WNOHANG) == process_) process_ = 0;
    return process_ > 0;
  }
  /// The signal that it died of, 0 where it was through before.
  int end(int signal) {
    if (!runs()) return 0;
    kill(process_, signal);
    waitpid(process_, &status_, 0);
    process_ = 0;
    return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
  }
  int status() const { return status_; }

 private:
  pid_t process_ = 0;
  int status_ = 0;
};

bool is_part(const fs::path& path) {
  return path.extension() == ".part";
}

Files contents(const std::string& folder) {
  Files files;
  std::error_code gone;
  for (const auto& entry : fs::recursive_directory_iterator(folder, gone))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = test::read_file(entry.path().string());
  return files;
}

bool has_part(const std::string& folder) {
  std::error_code gone;
  for (auto entry = fs::recursive_directory_iterator(folder, gone);
       !gone && entry != fs::recursive_directory_iterator(); entry.increment(gone))
    if (is_part(entry->path())) return true;
  return false;
}

/// A command that writes into the folder `out`, and is given `@`, a folder with demonstrations, a sequence and results.
struct Command {
  const char* name;
  const char* arguments;
};

class Kill : public testing::TestWithParam<Command> {
 protected:
  static const TempFolder& inputs() {
    static const TempFolder folder;
    if (fs::is_empty(folder.path(""))) {
      std::string rows = "time,a\n";
      for (int i = 0; i < 20000; ++i) rows += std::to_string(0.001 * i) + ",0\n";
      folder.write("long.csv", rows);
      fs::copy(SEAM_ASSETS "/demos/ramp_up.csv", folder.path("ramp.csv"));
      folder.write("task.yaml",
                   "format: seam-sequence 1\nprimitives: {a: {demonstration: ramp.csv}}\n"
                   "steps: [{play: a}, {play: a}]\n");
      EXPECT_EQ(test::run("run line --method dmp3 --dt 0.01 --out " + folder.path("r")).status, 0);
    }
    return folder;
  }
  std::string arguments() const {
    return test::replaced_all(
        test::replaced_all(GetParam().arguments, "out/", folder_.path("out/")), "@",
        inputs().path(""));
  }
  void begin_with(const Files& files) const {
    fs::remove_all(folder_.path("out"));
    fs::create_directories(folder_.path("out"));
    for (const auto& [name, text] : files) folder_.write("out/" + name, text);
  }
  // What a whole run leaves, and how long it takes [s].
  std::pair<Files, double> whole_run() const {
    begin_with({});
    const auto begin = Clock::now();
    Process process(arguments());
    process.end(0);
    EXPECT_EQ(process.status(), 0);
    const double duration = std::chrono::duration<double>(Clock::now() - begin).count();
    return {contents(folder_.path("out")), duration};
  }
  // At a time, or as soon as something is being written.
  int kill_after(double seconds, bool in_the_act, int signal) const {
    const auto begin = Clock::now();
    Process process(arguments());
    while (process.runs() && std::chrono::duration<double>(Clock::now() - begin).count() < seconds)
      if (in_the_act && has_part(folder_.path("out")))
        break;
      else
        std::this_thread::sleep_for(std::chrono::microseconds(in_the_act ? 20 : 500));
    return process.end(signal);
  }

  TempFolder folder_;
};

bool comes_last(const std::string& name) {
  return name == "summary.json" || name == "report.html";
}

TEST_P(Kill, LeavesEachFileWholeOrAsItWas) {
  const auto [whole, duration] = whole_run();
  ASSERT_FALSE(whole.empty());
  Files before;
  for (const auto& [name, text] : whole) before[name] = old;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.1);
  const int signals[] = {SIGKILL, SIGTERM, SIGKILL, SIGINT};
  int killed = 0;
  for (int i = 0; i < 6; ++i) {
    const int signal = signals[i % 4];
    const bool in_the_act = i % 3 < 2;
    begin_with(before);
    const double at = (in_the_act ? 3.0 : share(random)) * duration;
    const int died_of = kill_after(at, in_the_act, signal);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", kill " << i << " with " << signal
                                    << " after " << at << " s" << (in_the_act ? " or a part" : ""));
    if (died_of != 0) {
      EXPECT_EQ(died_of, signal);
    }
    killed += died_of == signal;
    const Files left = contents(folder_.path("out"));
    for (const auto& [name, text] : left) {
      if (is_part(name)) {
        EXPECT_EQ(signal, SIGKILL) << name << " is left behind";
        continue;
      }
      ASSERT_TRUE(whole.count(name)) << name << " is left behind";
      EXPECT_TRUE(text == old || text == whole.at(name)) << name << " is broken";
    }
    for (const auto& [name, text] : before)
      EXPECT_TRUE(left.count(name) || comes_last(name)) << name << " is lost";
    const auto summary = left.find("summary.json");
    if (summary != left.end() && summary->second == old) {
      EXPECT_EQ(left, before) << "an old summary stands beside new results";
    }
  }
  EXPECT_GE(killed, 1) << "of 6";
}

INSTANTIATE_TEST_SUITE_P(
    Commands, Kill,
    testing::Values(Command{"Learn", "learn @long.csv --kernels 100 -o out/a.yaml"},
                    Command{"Rollout",
                            "rollout @task.yaml --method dmp3 --dt 1e-4 --duration 5 -o out/a.csv"},
                    Command{"Run", "run line --method dmp3 --dt 0.01 --out out/"},
                    Command{"Report", "report @r -o out/a.html"},
                    Command{"Picture", "render @r/line/dmp3 --size 320x180 -o out/a.png"},
                    Command{"Movie", "render @r/line/dmp3 --size 160x90 --to 0.3 -o out/a.mp4"}),
    test::by_name);

}  // namespace
}  // namespace seam
