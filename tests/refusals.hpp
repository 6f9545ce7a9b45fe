#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "tests/run_program.hpp"
#include "tests/support.hpp"

namespace seam::test {

/// A file in which one text is replaced by another, and what is said of it.
struct BadFile {
  const char* name;
  const char* from;
  const char* to;
  const char* message;  // what the error begins with, behind the file's path
};

/// A call of the program, and what is said of it.
struct BadCall {
  const char* name;
  const char* arguments;  // @ stands for the folder
  const char* message;    // a part of it
};

/// Names the cases of a test suite.
inline constexpr auto by_name = [](const auto& bad) { return std::string(bad.param.name); };

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The text of a scene, one of the project's own or of the tests', that can be read from any folder.
inline std::string scene_text(const std::string& name) {
  const std::string own = SEAM_SCENES "/" + name + ".yaml";
  const std::string path = std::filesystem::exists(own) ? own : SEAM_TEST_DATA "/" + name + ".yaml";
  return replaced_all(read_file(path), "../assets", SEAM_ASSETS);
}

/// A good file, spoiled, is refused with its path and the case's message.
template <typename Reader>
void expect_refused(const BadFile& bad, const std::string& good, const TempFolder& folder,
                    Reader read) {
  const std::string path = folder.write("bad.yaml", replaced(good, bad.from, bad.to));
  EXPECT_THAT(refusal([&] { read(path); }), testing::StartsWith(path + bad.message));
}

/// A call fails with exit code 2 and one line.
inline void expect_refused(const BadCall& bad, const TempFolder& folder) {
  const Outcome outcome = run(replaced_all(bad.arguments, "@", folder.path("")));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output,
              testing::AllOf(testing::StartsWith("seam: "), testing::HasSubstr(bad.message)));
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
}

}  // namespace seam::test
