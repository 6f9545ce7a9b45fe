#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace seam {

/// A place in a YAML file: a node that knows the file and key it came from, so that whatever is
/// wrong with it is refused as `line.yaml:12: key "dt": "fast", must be a number > 0`.
class YamlEntry {
 public:
  /// The root of a file.
  /// @throws Error  cannot be read, or is not YAML (names the line)
  static YamlEntry read(const std::string& path);

  /// Refuses every key of this map but these, and whatever is not a map.
  const YamlEntry& only(std::initializer_list<const char*> keys) const;
  /// The entry under a key. @throws Error  there is none
  YamlEntry at(const std::string& key) const;
  std::optional<YamlEntry> find(const std::string& key) const;
  /// Entries of a list, or of a map with their keys. @throws Error  it is not one, or it is empty
  std::vector<YamlEntry> items() const;
  std::vector<std::pair<std::string, YamlEntry>> entries() const;

  std::string text() const;
  double number() const;        // finite
  double positive() const;      // finite and > 0
  double not_negative() const;  // finite and ≥ 0
  int count(int least) const;   // whole and ≥ least
  /// A path, relative to the file's folder unless absolute.
  std::string path() const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  YamlEntry(YAML::Node node, std::string file, std::string key);

  YAML::Node node_;
  std::string file_;
  std::string key_;
};

}  // namespace seam
