#include "bench/sweep_file.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;
constexpr int format = 1;

std::string beside(const std::string& path) {
  return path + ".json";
}

// What differs between two sweeps, or nothing; shards and numbers of draws may.
std::string difference(Json was, Json is) {
  for (const char* key : {"shard", "samples"}) was.erase(key), is.erase(key);
  for (const auto& [key, value] : is.items()) {
    const Json before = was.value(key, Json());
    if (before == value) continue;
    if (key != "files") return fmt::format("{} was {}, is {}", key, before.dump(), value.dump());
    for (const auto& [file, sum] : value.items())
      if (before.value(file, Json()) != sum) return fmt::format("{} has changed", file);
  }
  return was.size() == is.size() ? "" : "its description has other entries";
}

// That a file holds this sweep, or nothing yet.
void claim(const std::string& path, const SweepContents& contents) {
  namespace fs = std::filesystem;
  const Json now = contents.to_json();
  if (fs::exists(path) && !fs::is_regular_file(path))
    throw Error(path, "is not a file, which a sweep needs to be taken up again");
  if (!fs::exists(beside(path))) {
    if (fs::exists(path) || fs::exists(path + ".rows"))
      throw Error(path, "is there, but not " + beside(path) +
                            " that says what it holds; name another --out");
    return write_whole(beside(path), now.dump(2) + "\n");
  }
  const SweepContents was = SweepContents::read(beside(path));
  std::string differs = difference(was.to_json(), now);
  if (was.shard.index != contents.shard.index || was.shard.count != contents.shard.count)
    differs = fmt::format("shard was {}/{}, is {}/{}", was.shard.index, was.shard.count,
                          contents.shard.index, contents.shard.count);
  if (was.plan.draws > contents.plan.draws)
    differs = fmt::format("samples were {}, are {}", was.plan.draws, contents.plan.draws);
  if (!differs.empty())
    throw Error(path, "holds another sweep: " + differs + "; name another --out");
  if (was.plan.draws != contents.plan.draws) write_whole(beside(path), now.dump(2) + "\n");
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string SweepContents::header() const {
  std::string line = "index,method,";
  for (const Variation& variation : plan.variations) line += csv_field(variation.key) + ",";
  for (const std::string& metric : metrics) line += metric + ",";
  return line + "status\n";
}

std::string SweepContents::row_begin(std::int64_t sample, Join method) const {
  std::string begin = fmt::format("{},{},", sample, to_string(method));
  for (const std::string& value : plan.values(sample)) begin += csv_field(value) + ",";
  return begin;
}

Json SweepContents::to_json() const {
  Json json{{"format", format}};
  json.update(subject);
  for (const Variation& variation : plan.variations) json["vary"].push_back(variation.text);
  json["seed"] = plan.seed;
  json["samples"] = plan.draws;
  for (const Join method : plan.methods) json["methods"].push_back(to_string(method));
  json["metrics"] = metrics;
  json["shard"] = {shard.index, shard.count};
  return json;
}

SweepContents SweepContents::read(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
  try {
    Json json = Json::parse(file);
    if (json.at("format") != format)
      throw Error(path, "format " + json.at("format").dump() + ", must be 1");
    SweepContents contents;
    for (const auto& text : json.at("vary").get<std::vector<std::string>>())
      contents.plan.variations.push_back(Variation::read(text));
    contents.plan.seed = json.at("seed");
    contents.plan.draws = json.at("samples");
    for (const auto& name : json.at("methods").get<std::vector<std::string>>())
      contents.plan.methods.push_back(join_from_name(name));
    contents.metrics = json.at("metrics").get<std::vector<std::string>>();
    contents.shard = Shard::read(
        fmt::format("{}/{}", json.at("shard").at(0).dump(), json.at("shard").at(1).dump()));
    contents.plan.check();
    for (const char* key : {"format", "vary", "seed", "samples", "methods", "metrics", "shard"})
      json.erase(key);
    contents.subject = json;
    return contents;
  } catch (const Json::exception& error) {
    throw Error(path, std::string("does not describe a sweep: ") + error.what());
  }
}

SweepRows::SweepRows(std::int64_t samples) : places_(static_cast<std::size_t>(samples)) {}

bool SweepRows::has(std::int64_t sample) const {
  return places_[static_cast<std::size_t>(sample)].begin >= 0;
}

void SweepRows::add(std::int64_t sample, std::int64_t begin, const std::string& rows) {
  places_[static_cast<std::size_t>(sample)] = {begin, static_cast<std::uint32_t>(rows.size()),
                                               static_cast<std::uint32_t>(files_.size() - 1)};
  ++count_;
  if (rows.find(",ok\n") == std::string::npos) ++refused_;
}

std::int64_t SweepRows::add(const std::string& path, const SweepContents& contents,
                            const std::function<void(std::int64_t)>& again) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
  files_.push_back(path);
  std::string line;
  std::int64_t number = 1;
  const auto whole_line = [&] {
    const bool read = std::getline(file, line) && !file.eof();
    if (file.bad()) throw Error(path, std::string("cannot be read: ") + std::strerror(errno));
    return read;
  };
  const auto fail = [&](const std::string& what) {
    throw Error(fmt::format("{}:{}", path, number), what);
  };
  if (!whole_line()) {
    if (contents.header().rfind(line, 0) != 0) fail("is not the header of this sweep");
    return 0;
  }
  if (line + "\n" != contents.header()) fail("is not the header of this sweep");

  const auto sample_of = [&] {
    std::int64_t sample = -1;
    std::from_chars(line.data(), line.data() + line.size(), sample);
    if (sample < 0 || sample >= static_cast<std::int64_t>(places_.size()) ||
        !contents.shard.holds(sample))
      fail("is not a row of this sweep");
    return sample;
  };
  std::int64_t end = file.tellg();
  while (true) {
    std::int64_t sample = -1;
    std::string rows;
    for (const Join method : contents.plan.methods) {
      ++number;
      if (!whole_line()) return end;
      if (rows.empty()) sample = sample_of();
      if (line.rfind(contents.row_begin(sample, method), 0) != 0)
        fail("is not a row of this sweep");
      rows += line + "\n";
    }
    if (!has(sample))
      add(sample, end, rows);
    else if (again)
      again(sample);
    end += static_cast<std::int64_t>(rows.size());
  }
}

void SweepRows::copy(std::ostream& out) const {
  std::ifstream file;
  std::uint32_t opened = 0;
  std::string rows;
  for (const Place& place : places_) {
    if (place.begin < 0) continue;
    if (!file.is_open() || opened != place.file)
      file = std::ifstream(files_[opened = place.file], std::ios::binary);
    rows.resize(place.length);
    file.seekg(place.begin);
    if (!file.read(rows.data(), place.length))
      throw Error(files_[opened], "cannot be read any more");
    out << rows;
  }
}

SweepFile::SweepFile(const std::string& path, SweepContents contents)
    : path_(path), contents_(std::move(contents)), rows_(contents_.plan.samples()) {
  claim(path_, contents_);
  open_journal();
  if (std::filesystem::exists(path_)) {
    if (rows_.add(path_, contents_) != static_cast<std::int64_t>(std::filesystem::file_size(path_)))
      throw Error(path_, "ends within a sample");
    whole_ = done() == contents_.size();
    if (whole_) return;
  }
  end_ = rows_.add(journal(), contents_);
  if (ftruncate(descriptor_.number, end_) != 0)
    throw Error(journal(), std::string("cannot be cut: ") + std::strerror(errno));
  if (end_ == 0) write(contents_.header());
}

// The lock goes with the process. Who had it may have finished, and removed the file, since it was opened.
void SweepFile::open_journal() {
  for (struct stat status{}; status.st_nlink == 0;) {
    if (descriptor_.number >= 0) close(descriptor_.number);
    descriptor_.number = open(journal().c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_.number < 0 || fstat(descriptor_.number, &status) != 0)
      throw Error(journal(), std::string("cannot be written: ") + std::strerror(errno));
    if (!take_alone(descriptor_)) throw Error(path_, "is being filled by another seam sweep");
    fstat(descriptor_.number, &status);
  }
}

void SweepFile::write(const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = ::write(descriptor_.number, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n > 0) {
      written += static_cast<std::size_t>(n);
      continue;
    }
    const std::string reason = std::strerror(errno);
    // Else it is cut when the sweep is taken up again.
    [[maybe_unused]] const int cut = ftruncate(descriptor_.number, end_);
    throw Error(path_, "cannot be written: " + reason + "; what is done is in " + journal());
  }
  end_ += static_cast<std::int64_t>(text.size());
}

void SweepFile::append(std::int64_t sample, const std::string& rows) {
  const std::int64_t begin = end_;
  write(rows);
  rows_.add(sample, begin, rows);
}

void SweepFile::finish() {
  if (!whole_)
    write_whole(path_, [&](std::ostream& out) {
      out << contents_.header();
      rows_.copy(out);
    });
  whole_ = true;
  std::remove(journal().c_str());
}

SweepContents merge_sweeps(const std::vector<std::string>& parts, const std::string& path) {
  SweepContents whole = SweepContents::read(beside(parts.at(0)));
  whole.shard = {};
  SweepRows rows(whole.plan.samples());
  for (const std::string& part : parts) {
    const SweepContents contents = SweepContents::read(beside(part));
    std::string differs = difference(whole.to_json(), contents.to_json());
    if (contents.plan.draws != whole.plan.draws)
      differs = fmt::format("samples were {}, are {}", whole.plan.draws, contents.plan.draws);
    if (!differs.empty())
      throw Error(part, "is of another sweep than " + parts[0] + ": " + differs);
    if (!std::filesystem::exists(part))
      throw Error(part, "is not there; a sweep leaves it when it is through");
    const std::int64_t end = rows.add(part, contents, [&](std::int64_t sample) {
      throw Error(part, fmt::format("sample {} is in another part, too", sample));
    });
    if (end != static_cast<std::int64_t>(std::filesystem::file_size(part)))
      throw Error(part, "ends within a sample");
  }
  for (std::int64_t sample = 0; sample < whole.plan.samples(); ++sample)
    if (!rows.has(sample)) throw Error(path, fmt::format("sample {} is in no part", sample));
  claim(path, whole);
  write_whole(path, [&](std::ostream& out) {
    out << whole.header();
    rows.copy(out);
  });
  return whole;
}

}  // namespace seam
