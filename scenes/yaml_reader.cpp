#include "scenes/yaml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <seam/error.hpp>

namespace seam {

YamlEntry::YamlEntry(YAML::Node node, std::string file, std::string key)
    : node_(std::move(node)), file_(std::move(file)), key_(std::move(key)) {}

YamlEntry YamlEntry::read(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw Error(path, "is a folder, must be a YAML file");
  std::ifstream file(path);
  if (!file) throw Error(path, "cannot be read");
  try {
    return {YAML::Load(file), path, ""};
  } catch (const YAML::Exception& error) {
    throw Error(path + ":" + std::to_string(error.mark.line + 1), "not YAML: " + error.msg);
  }
}

void YamlEntry::fail(const std::string& what) const {
  const int line = node_.Mark().line;
  throw Error(line < 0 ? file_ : file_ + ":" + std::to_string(line + 1),
              (key_.empty() ? "" : "key \"" + key_ + "\": ") + what);
}

const YamlEntry& YamlEntry::only(std::initializer_list<const char*> keys) const {
  std::string known;
  for (const char* key : keys) known += (known.empty() ? "" : ", ") + std::string(key);
  if (!node_.IsMap()) fail("must be a map with keys " + known);
  for (const auto& [key, entry] : entries())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      entry.fail("not known here, must be one of " + known);
  return *this;
}

std::optional<YamlEntry> YamlEntry::find(const std::string& key) const {
  if (!node_.IsMap()) fail("must be a map");
  const YAML::Node child = node_[key];
  if (!child.IsDefined()) return std::nullopt;
  return YamlEntry(child, file_, key);
}

YamlEntry YamlEntry::at(const std::string& key) const {
  const auto entry = find(key);
  if (!entry) fail("needs the key \"" + key + "\"");
  return *entry;
}

std::vector<YamlEntry> YamlEntry::items() const {
  if (!node_.IsSequence() || node_.size() == 0) fail("must be a list with at least one entry");
  std::vector<YamlEntry> list;
  for (const auto& child : node_) list.push_back({child, file_, key_});
  return list;
}

std::vector<std::pair<std::string, YamlEntry>> YamlEntry::entries() const {
  if (!node_.IsMap() || node_.size() == 0) fail("must be a map with at least one key");
  std::vector<std::pair<std::string, YamlEntry>> map;
  for (const auto& child : node_) {
    const auto key = child.first.Scalar();
    for (const auto& other : map)
      if (other.first == key) YamlEntry(child.first, file_, key).fail("appears twice");
    map.emplace_back(key, YamlEntry(child.second, file_, key));
  }
  return map;
}

std::string YamlEntry::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("must be a text");
  return node_.Scalar();
}

double YamlEntry::number() const {
  double value = 0.0;
  if (!node_.IsScalar() || !YAML::convert<double>::decode(node_, value) || !std::isfinite(value))
    fail((node_.IsScalar() ? "\"" + node_.Scalar() + "\", " : "") + "must be a finite number");
  return value;
}

double YamlEntry::positive() const {
  const double value = number();
  if (!(value > 0.0)) fail(node_.Scalar() + ", must be > 0");
  return value;
}

double YamlEntry::not_negative() const {
  const double value = number();
  if (!(value >= 0.0)) fail(node_.Scalar() + ", must be >= 0");
  return value;
}

int YamlEntry::count(int least) const {
  int value = 0;
  if (!node_.IsScalar() || !YAML::convert<int>::decode(node_, value) || value < least)
    fail((node_.IsScalar() ? "\"" + node_.Scalar() + "\", " : "") +
         "must be a whole number >= " + std::to_string(least));
  return value;
}

std::string YamlEntry::path() const {
  return (std::filesystem::path(file_).parent_path() / text()).lexically_normal().string();
}

}  // namespace seam
