#include "yaml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

#include <seam/orientation.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

// The version behind `<name> `, or 0.
int version_of(const std::string& format, const std::string& name) {
  int version = 0;
  if (format.rfind(name + " ", 0) == 0) {
    const char* const end = format.data() + format.size();
    const auto [last, status] = std::from_chars(format.data() + name.size() + 1, end, version);
    if (status != std::errc{} || last != end) return 0;
  }
  return version;
}

std::string listed(std::initializer_list<const char*> texts) {
  std::string list;
  for (const char* text : texts) list += (list.empty() ? "" : ", ") + std::string(text);
  return list;
}

constexpr std::uintmax_t most_bytes = std::uintmax_t{4} << 20;
constexpr std::size_t most_values = 200'000;
constexpr std::size_t most_levels = 32;

// Hears a file before it is loaded: where documents begin, how deep they are and how long if no alias were short for what it
// repeats.
class Survey : public YAML::EventHandler {
 public:
  explicit Survey(const std::string& path) : path_(path) {}

  int last_line = 0;  // on which a document began

  void OnDocumentStart(const YAML::Mark& mark) override { last_line = mark.line; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { value(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto repeated = sizes_.find(anchor);
    if (repeated == sizes_.end()) fail(mark, "an alias repeats what it is a part of");
    add(repeated->second, mark);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    value(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(mark, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    begin(mark, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw Error(path_ + ":" + std::to_string(mark.line + 1), what);
  }
  void add(std::size_t size, const YAML::Mark& mark) {
    values_ += size;
    if (values_ > most_values) fail(mark, "more than " + std::to_string(most_values) + " values");
  }
  void value(const YAML::Mark& mark, YAML::anchor_t anchor) {
    add(1, mark);
    if (anchor) sizes_[anchor] = 1;
  }
  void begin(const YAML::Mark& mark, YAML::anchor_t anchor) {
    add(1, mark);
    levels_.push_back({anchor, values_});
    if (levels_.size() > most_levels)
      fail(mark, "more than " + std::to_string(most_levels) + " levels");
  }
  void end() {
    const auto [anchor, before] = levels_.back();
    levels_.pop_back();
    if (anchor) sizes_[anchor] = values_ - before + 1;
  }

  const std::string& path_;
  std::size_t values_ = 0;
  std::map<YAML::anchor_t, std::size_t> sizes_;
  std::vector<std::pair<YAML::anchor_t, std::size_t>> levels_;  // and the values before
};

// YAML::Load drops what follows the first document (a stray bracket ends it, too), and YAML::LoadAll
// may never return from it.
YAML::Node only_document(const std::string& path, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Survey survey(path);
  if (parser.HandleNextDocument(survey) && parser.HandleNextDocument(survey))
    throw Error(path + ":" + std::to_string(survey.last_line + 1),
                "not part of the document, which ends before this");
  return YAML::Load(text);
}

namespace fs = std::filesystem;

// Where a path leads when links are followed, as far as it is there; nothing where it leads nowhere.
std::optional<fs::path> followed(const fs::path& path) {
  std::error_code status;
  const fs::path absolute = fs::absolute(path, status);
  if (status || absolute.native().find('\0') != std::string::npos) return std::nullopt;
  fs::path canonical = fs::weakly_canonical(absolute, status);
  if (status) return std::nullopt;
  return canonical;
}

bool is_in(const fs::path& path, const fs::path& folder) {
  const auto inner = followed(path);
  const auto outer = followed(folder.empty() ? "." : folder);
  return inner && outer &&
         std::mismatch(outer->begin(), outer->end(), inner->begin(), inner->end()).first ==
             outer->end();
}

// The entry of a list or map; a new one where a map, or nothing, has none.
YAML::Node entry_of(YAML::Node node, const std::string& key, const std::string& change) {
  const bool is_number = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos;
  if (node.IsSequence()) {
    if (!is_number || key.size() > 9 || std::stoul(key) >= node.size())
      throw Error(change, "\"" + key + "\" is none of the list's entries, must be 0 to " +
                              std::to_string(node.size() - 1));
    return node[std::stoul(key)];
  }
  if (node.IsScalar())
    throw Error(change, "\"" + key + "\" is an entry of \"" + node.Scalar() +
                            "\", which is a value and has none");
  return node[key];
}

// Sets `key=value` in a document.
void set(YAML::Node node, const std::string& change) {
  const std::size_t equals = change.find('=');
  const std::string path = change.substr(0, equals);
  if (equals == std::string::npos || ("." + path + ".").find("..") != std::string::npos)
    throw Error(change, "must be key=value, as in actuator.lag=0.002");
  std::istringstream keys(path);
  for (std::string key; std::getline(keys, key, '.');) node.reset(entry_of(node, key, change));
  try {
    node = YAML::Load(change.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw Error(change, "the value is not YAML: " + error.msg);
  }
}

}  // namespace

YamlEntry::YamlEntry(YAML::Node node, std::shared_ptr<const Source> source, std::string key,
                     int line)
    : node_(std::move(node)), source_(std::move(source)), key_(std::move(key)), line_(line) {}

YamlEntry YamlEntry::read(const std::string& path, const std::vector<std::string>& overrides,
                          std::vector<std::string> allowed) {
  const auto source = std::make_shared<const Source>(
      Source{path, read_whole(path, "YAML file", most_bytes), std::move(allowed)});
  try {
    const YAML::Node root = only_document(path, source->text);
    for (const std::string& change : overrides) set(root, change);
    return {root, source, "", root.Mark().line};
  } catch (const YAML::Exception& error) {
    throw Error(path + ":" + std::to_string(error.mark.line + 1), "not YAML: " + error.msg);
  }
}

void YamlEntry::fail(const std::string& what) const {
  throw Error(line_ < 0 ? source_->path : source_->path + ":" + std::to_string(line_ + 1),
              (key_.empty() ? "" : "key \"" + key_ + "\": ") + what);
}

const YamlEntry& YamlEntry::require_format(const std::string& name, int newest) const {
  const YamlEntry entry = at("format");
  const int found = version_of(entry.text(), name);
  if (found >= 1 && found <= newest) return *this;
  entry.fail("\"" + entry.text() + "\", must be " + name + " 1" +
             (newest > 1 ? " to " + std::to_string(newest) : "") +
             (found > newest ? " (a newer seam has written this file)" : ""));
}

const YamlEntry& YamlEntry::only(std::initializer_list<const char*> keys) const {
  if (!node_.IsMap()) fail("must be a map with keys " + listed(keys));
  for (const auto& [key, entry] : entries())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      entry.fail("not known here, must be one of " + listed(keys));
  return *this;
}

std::optional<YamlEntry> YamlEntry::find(const std::string& key) const {
  if (!node_.IsMap()) fail("must be a map");
  for (const auto& child : node_)
    if (child.first.Scalar() == key)
      return YamlEntry(child.second, source_, key, child.first.Mark().line);
  return std::nullopt;
}

YamlEntry YamlEntry::at(const std::string& key) const {
  const auto entry = find(key);
  if (!entry) fail("needs the key \"" + key + "\"");
  return *entry;
}

std::vector<YamlEntry> YamlEntry::items() const {
  if (!node_.IsSequence() || node_.size() == 0) fail("must be a list with at least one entry");
  std::vector<YamlEntry> list;
  for (const auto& child : node_) list.push_back({child, source_, key_, child.Mark().line});
  return list;
}

std::vector<std::pair<std::string, YamlEntry>> YamlEntry::entries() const {
  if (!node_.IsMap() || node_.size() == 0) fail("must be a map with at least one key");
  std::vector<std::pair<std::string, YamlEntry>> map;
  std::set<std::string> seen;
  for (const auto& child : node_) {
    const std::string& key = child.first.Scalar();
    YamlEntry entry(child.second, source_, key, child.first.Mark().line);
    if (!seen.insert(key).second) entry.fail("appears twice");
    map.emplace_back(key, std::move(entry));
  }
  return map;
}

std::string YamlEntry::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("must be a text");
  return node_.Scalar();
}

std::size_t YamlEntry::choice(std::initializer_list<const char*> texts) const {
  const auto found = std::find(texts.begin(), texts.end(), text());
  if (found == texts.end()) fail("\"" + text() + "\", must be one of " + listed(texts));
  return static_cast<std::size_t>(found - texts.begin());
}

double YamlEntry::number() const {
  if (!node_.IsScalar()) fail("must be a finite number");
  const std::string& text = node_.Scalar();
  const bool plus = text.rfind('+', 0) == 0 && text.rfind("+-", 0) != 0;
  const char* const begin = text.data() + (plus ? 1 : 0);
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [last, status] = std::from_chars(begin, end, value);
  if (status != std::errc{} || last != end || !std::isfinite(value))
    fail("\"" + text + "\", must be a finite number");
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

int YamlEntry::count(int least, int most) const {
  const int value = count(least);
  if (value > most) fail(node_.Scalar() + ", must be <= " + std::to_string(most));
  return value;
}

Eigen::VectorXd YamlEntry::numbers() const {
  const std::vector<YamlEntry> list = items();
  Eigen::VectorXd values(static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const YamlEntry& item : list) values(i++) = item.number();
  return values;
}

Eigen::VectorXd YamlEntry::numbers(Eigen::Index size, const char* per) const {
  const Eigen::VectorXd values = numbers();
  if (values.size() != size)
    fail(std::to_string(values.size()) + " numbers, must be " + std::to_string(size) +
         " (one per " + per + ")");
  return values;
}

Eigen::Quaterniond YamlEntry::orientation() const {
  const Eigen::Quaterniond q(Eigen::Vector4d{numbers(4, "part x y z w")});
  if (!(std::abs(q.norm() - 1.0) <= 1e-3))
    fail("quaternion of norm " + std::to_string(q.norm()) + ", must be 1 within 0.001");
  return std::abs(q.norm() - 1.0) <= unit_tolerance ? q : q.normalized();
}

std::string YamlEntry::path() const {
  const fs::path folder = fs::path(source_->path).parent_path();
  const fs::path path = (folder / text()).lexically_normal();
  const auto is_inside = [&](const fs::path& allowed) { return is_in(path, allowed); };
  if (!is_inside(folder) &&
      std::none_of(source_->allowed.begin(), source_->allowed.end(), is_inside))
    fail("\"" + text() +
         "\" leads out of the file's folder, must be in it or below, or in a folder that is "
         "allowed (seam --allow DIR)");
  return path.string();
}

}  // namespace seam
