#include "bench/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "bench/columns.hpp"
#include "bench/compare.hpp"
#include "bench/parallel.hpp"
#include "bench/run_json.hpp"
#include "scenes/play.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::int64_t probes = 64;
constexpr int probe_ticks = 8;

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// FNV-1a: tells a file from what it was, not from what somebody has made to look like it.
std::string checksum(const std::string& text) {
  std::uint64_t sum = 0xCBF29CE484222325U;
  for (const unsigned char c : text) sum = (sum ^ c) * 0x100000001B3U;
  return fmt::format("{:016x}", sum);
}

// Checksums of all files that a document names.
void add_files(const YAML::Node& node, const std::filesystem::path& folder, Json& files) {
  std::error_code none;
  if (node.IsScalar() && std::filesystem::is_regular_file(folder / node.Scalar(), none))
    files[node.Scalar()] = checksum(content((folder / node.Scalar()).string()));
  for (const auto& child : node)
    add_files(node.IsMap() ? child.second : static_cast<const YAML::Node&>(child), folder, files);
}

void add_files(const std::string& text, const std::filesystem::path& folder, Json& files) {
  try {
    add_files(YAML::Load(text), folder, files);
  } catch (const YAML::Exception&) {  // the scene says what is wrong with it
  }
}

std::string number(double value) {
  return std::isnan(value) ? "" : fmt::format("{:.17g}", value);
}

// So that it does not depend on where the scene lies.
std::string without_folder(std::string text, const std::string& scene) {
  const std::string folder = std::filesystem::path(scene).parent_path().string() + "/";
  if (folder.size() > 1 && text.rfind(folder, 0) == 0) text.erase(0, folder.size());
  return text;
}

}  // namespace

Sweep::Sweep(std::string scene, std::vector<std::string> overrides,
             std::vector<std::string> allowed, SweepPlan plan, const std::string& seam_version)
    : scene_(std::move(scene)), overrides_(std::move(overrides)), allowed_(std::move(allowed)) {
  plan.check();
  contents_.plan = std::move(plan);
  probe();
  const std::filesystem::path path = scene_;
  const std::string text = content(scene_);
  Json files{{path.filename().string(), checksum(text)}};
  add_files(text, path.parent_path(), files);
  for (const std::string& change : overrides_)
    add_files(change.substr(change.find('=') + 1), path.parent_path(), files);
  for (const Variation& variation : contents_.plan.variations)
    for (const std::string& value : variation.listed) add_files(value, path.parent_path(), files);
  contents_.subject = {{"versions", versions_json(seam_version)},
                       {"scene", path.stem().string()},
                       {"files", files},
                       {"set", overrides_}};
}

// The first sample that can be played, of some from all over the sweep, says what will be measured.
void Sweep::probe() {
  const std::int64_t samples = contents_.plan.samples();
  const std::int64_t tries = std::min(probes, samples);
  std::optional<Error> first;
  for (std::int64_t i = 0; i < tries; ++i) try {
      Scene scene = Scene::read(scene_, overrides_of(i * samples / tries), allowed_);
      scene.duration = probe_ticks * scene.dt;
      for (const Column& column : columns(play_at_first_place(scene, Join::dmp2, scene.dt)))
        contents_.metrics.push_back(column.name);
      return;
    } catch (const Error& error) {
      if (!first) first = error;
    }
  throw Error(*first);
}

std::vector<std::string> Sweep::overrides_of(std::int64_t sample) const {
  std::vector<std::string> all = overrides_;
  const std::vector<std::string> values = contents_.plan.values(sample);
  for (std::size_t k = 0; k < values.size(); ++k)
    all.push_back(contents_.plan.variations[k].key + "=" + values[k]);
  return all;
}

SweepContents Sweep::contents(const Shard& shard) const {
  SweepContents contents = contents_;
  contents.shard = shard;
  return contents;
}

std::string Sweep::play(std::int64_t sample) const {
  const std::vector<Join>& methods = contents_.plan.methods;
  std::string rows;
  try {
    const Scene scene = Scene::read(scene_, overrides_of(sample), allowed_);
    const auto comparisons = compare({scene}, methods, 1, [](int, int, const std::string&) {});
    for (const Run& run : comparisons.front().runs) {
      std::map<std::string, std::string> figures;
      for (const Column& column : columns(run.recording))
        figures[column.name] = number(column.of(run));
      rows += contents_.row_begin(sample, run.method);
      for (const std::string& metric : contents_.metrics) rows += figures[metric] + ",";
      rows += "ok\n";
    }
  } catch (const Error& error) {
    const std::string nothing(contents_.metrics.size(), ',');
    rows.clear();
    for (const Join method : methods)
      rows += contents_.row_begin(sample, method) + nothing +
              csv_field(without_folder(error.what(), scene_)) + "\n";
  }
  return rows;
}

void run_sweep(const Sweep& sweep, const Shard& shard, int jobs, SweepFile& file,
               const SweepProgress& progress) {
  const std::int64_t total = sweep.contents(shard).size();
  std::mutex mutex;
  const auto has = [&](std::int64_t sample) {
    const std::lock_guard lock(mutex);
    return file.has(sample);
  };
  for_each_index(total, jobs, [&](std::int64_t k) {
    const std::int64_t sample = shard.sample(k);
    if (has(sample)) return;
    const std::string rows = sweep.play(sample);
    const std::lock_guard lock(mutex);
    file.append(sample, rows);
    progress(file.done(), total);
  });
  file.finish();
}

}  // namespace seam
