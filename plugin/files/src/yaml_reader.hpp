#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <yaml-cpp/yaml.h>

#include <seam/error.hpp>

namespace seam {

/// A place in a YAML file: a node that knows the file and key it came from, so that whatever is
/// wrong with it is refused as `line.yaml:12: key "dt": "fast", must be a number > 0`.
class YamlEntry {
 public:
  /// The root of a file, in which some entries are set anew: `key=value` texts, the key a path of keys and of
  /// numbers of list entries (from 0), the value YAML, e.g. `steps.0.until={after: 0.6}`. A key that is not there
  /// is added.
  /// @param allowed  folders of which the file may name files, beside its own: see `path`
  /// @throws Error  cannot be read, is not YAML (names the line), goes on behind its first document, or is beyond what a
  ///                person writes: more than 4 MiB, 200 000 values (with those that aliases repeat) or 32 levels;
  ///                an override that is no key=value, or leads through something that has no entries
  static YamlEntry read(const std::string& path, const std::vector<std::string>& overrides = {},
                        std::vector<std::string> allowed = {});

  /// Refuses a file whose key `format` is not `<name> <version>` of a version from 1 to the newest;
  /// to be asked before all else, so that a file of a newer format is refused for that and not for
  /// its first new key.
  const YamlEntry& require_format(const std::string& name, int newest) const;
  /// Refuses every key of this map but these, and whatever is not a map.
  const YamlEntry& only(std::initializer_list<const char*> keys) const;
  /// The entry under a key. @throws Error  there is none
  YamlEntry at(const std::string& key) const;
  std::optional<YamlEntry> find(const std::string& key) const;
  /// Entries of a list, or of a map with their keys. @throws Error  it is not one, or it is empty
  std::vector<YamlEntry> items() const;
  std::vector<std::pair<std::string, YamlEntry>> entries() const;

  bool is_text() const { return node_.IsScalar(); }
  bool is_list() const { return node_.IsSequence(); }
  std::string text() const;
  /// One of these texts. @return  its index
  std::size_t choice(std::initializer_list<const char*> texts) const;
  double number() const;        // finite
  double positive() const;      // finite and > 0
  double not_negative() const;  // finite and ≥ 0
  int count(int least) const;   // whole and ≥ least
  int count(int least, int most) const;
  /// A list of finite numbers. @throws Error  names the line of the first that is not
  Eigen::VectorXd numbers() const;
  /// As many as this. @param per  what there must be one of them for, e.g. `coordinate`
  Eigen::VectorXd numbers(Eigen::Index size, const char* per) const;
  /// Four numbers x y z w of norm 1 within 1e-3; normalised, but kept to the bit where they will do
  /// as they are (see unit_tolerance).
  Eigen::Quaterniond orientation() const;
  /// The text of the file, as it was read.
  const std::string& file_text() const { return source_->text; }
  /// A path, relative to the file's folder unless absolute.
  /// @throws Error  it leads, links followed, out of that folder and of those that are allowed
  std::string path() const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Source {
    std::string path, text;
    std::vector<std::string> allowed;
  };

  YamlEntry(YAML::Node node, std::shared_ptr<const Source> source, std::string key, int line);

  YAML::Node node_;
  std::shared_ptr<const Source> source_;
  std::string key_;
  int line_;  // of the key, from 0
};

/// Does what an entry asks for; what the library refuses of it is refused at the entry's place.
template <typename Action>
auto at_key(const YamlEntry& entry, Action action) {
  try {
    return action();
  } catch (const Error& error) {
    entry.fail(error.what());
  }
}

}  // namespace seam
