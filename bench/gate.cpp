#include "bench/gate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/columns.hpp"
#include "plugin/files/src/yaml_reader.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;
using Change = Difference::Kind;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int format = 1;

// Six digits are enough for every tolerance, and leave the last bits of a machine out of the files.
double rounded(double value) {
  return std::isfinite(value) ? std::stod(fmt::format("{:.6g}", value)) : value;
}

std::map<std::string, std::map<std::string, double>> read_runs(const std::string& path) {
  std::ifstream file(path);
  try {
    const Json json = Json::parse(file);
    if (json.at("format") != format)
      throw Error(path, "format " + json.at("format").dump() + ", must be 1");
    std::map<std::string, std::map<std::string, double>> runs;
    for (const auto& [method, metrics] : json.at("runs").items())
      for (const auto& [metric, value] : metrics.items())
        runs[method][metric] = value.is_null() ? none : value.get<double>();
    return runs;
  } catch (const Json::exception& error) {
    throw Error(path, std::string("not a baseline: ") + error.what());
  }
}

const char* word(Change kind) {
  switch (kind) {
    case Change::worse:
      return "worse";
    case Change::better:
      return "better";
    default:
      return "other";
  }
}

}  // namespace

Figures figures(const std::vector<Comparison>& comparisons) {
  Figures figures;
  for (const Comparison& comparison : comparisons)
    for (const Run& run : comparison.runs)
      figures[on_arm(comparison.scene.name, comparison.scene.arm)]
             [std::string(to_string(run.method))] = seam::figures(run);
  return figures;
}

std::string to_string(const Difference& difference) {
  const auto& [kind, scene, method, metric, was, is, allowed] = difference;
  const std::string name = scene + " " + method + ": " + metric;
  if (kind == Change::fresh) return fmt::format("{} {:.4g}, is not among the baselines", name, is);
  if (kind == Change::missing) return fmt::format("{} was {:.4g} and is not measured", name, was);
  const std::string change = fmt::format("{} {:.4g} -> {:.4g}, {}", name, was, is, word(kind));
  if (!std::isfinite(was) || !std::isfinite(is)) return change;
  const double scale = std::abs(was);
  if (scale == 0.0 || std::abs(is - was) > 1e4 * scale)
    return fmt::format("{} by {:.3g} (allowed: {:.2g})", change, std::abs(is - was), allowed);
  return fmt::format("{} by {:.3g} % (allowed: {:.2g} %)", change,
                     100.0 * std::abs(is - was) / scale, 100.0 * allowed / scale);
}

Baselines::Baselines(const std::string& dir) : dir_(dir) {
  const std::filesystem::path folder = dir;
  const YamlEntry root = YamlEntry::read((folder / "tolerances.yaml").string());
  root.require_format("seam-tolerances", format);
  root.only({"format", "metrics", "arms", "scenes"});
  const auto read = [](const YamlEntry& metrics, Tolerances& tolerances) {
    for (const auto& [metric, entry] : metrics.entries()) {
      entry.only({"relative", "absolute", "better"});
      Tolerance& tolerance = tolerances[metric];
      if (const auto relative = entry.find("relative"))
        tolerance.relative = relative->not_negative();
      if (const auto absolute = entry.find("absolute"))
        tolerance.absolute = absolute->not_negative();
      if (const auto better = entry.find("better"))
        tolerance.better = static_cast<Better>(better->choice({"lower", "higher", "neither"}));
    }
  };
  read(root.at("metrics"), tolerances_[""]);
  if (const auto arms = root.find("arms"))
    for (const auto& [arm, metrics] : arms->entries()) read(metrics, tolerances_[on_arm("", arm)]);
  if (const auto scenes = root.find("scenes"))
    for (const auto& [scene, metrics] : scenes->entries()) read(metrics, tolerances_[scene]);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json")
      was_[entry.path().stem().string()] = read_runs(entry.path().string());
}

Baselines::Tolerance Baselines::tolerance(const std::string& scene,
                                          const std::string& metric) const {
  const std::size_t arm = std::min(scene.rfind('-'), scene.size());
  for (const std::string& of : {scene, scene.substr(0, arm), scene.substr(arm), std::string()})
    if (const auto tolerances = tolerances_.find(of); tolerances != tolerances_.end())
      if (const auto found = tolerances->second.find(metric); found != tolerances->second.end())
        return found->second;
  throw Error(dir_ + "/tolerances.yaml", "needs a tolerance of " + metric);
}

std::optional<Difference> Baselines::difference(Difference pair) const {
  const Tolerance tolerance = this->tolerance(pair.scene, pair.metric);
  pair.allowed = std::max(tolerance.absolute, tolerance.relative * std::abs(pair.was));
  const bool both_unknown = std::isnan(pair.was) && std::isnan(pair.is);
  if (both_unknown || std::abs(pair.is - pair.was) <= pair.allowed) return std::nullopt;
  const bool lost = std::isnan(pair.is);  // what can no longer be measured is worse
  const bool lower = pair.is < pair.was;
  if (tolerance.better != Better::neither)
    pair.kind =
        !lost && lower == (tolerance.better == Better::lower) ? Change::better : Change::worse;
  return pair;
}

std::vector<Difference> Baselines::check(const Figures& now) const {
  std::vector<Difference> differences;
  for (const auto& [scene, methods] : now)
    for (const auto& [method, metrics] : methods) {
      std::map<std::string, double> was;
      if (const auto of_scene = was_.find(scene); of_scene != was_.end())
        if (const auto of_run = of_scene->second.find(method); of_run != of_scene->second.end())
          was = of_run->second;
      for (const auto& [metric, value] : metrics) {
        const auto before = was.find(metric);
        if (before == was.end())
          differences.push_back({Change::fresh, scene, method, metric, none, value});
        else if (auto changed =
                     difference({Change::other, scene, method, metric, before->second, value}))
          differences.push_back(*changed);
        was.erase(metric);
      }
      for (const auto& [metric, value] : was)
        differences.push_back({Change::missing, scene, method, metric, value, none});
    }
  return differences;
}

void Baselines::update(const Figures& now) {
  for (const auto& [scene, methods] : now) {
    for (const auto& [method, metrics] : methods) {
      auto renewed = metrics;
      for (auto& [metric, value] : renewed) {
        const auto& was = was_[scene][method];
        const auto before = was.find(metric);
        if (before != was.end() &&
            !difference({Change::other, scene, method, metric, before->second, value}))
          value = before->second;
      }
      was_[scene][method] = renewed;
    }
    Json runs;
    for (const auto& [method, metrics] : was_[scene])
      for (const auto& [metric, value] : metrics) runs[method][metric] = rounded(value);
    const Json json{{"format", format}, {"runs", runs}};
    write_whole(dir_ + "/" + scene + ".json", json.dump(2) + "\n");
  }
}

}  // namespace seam
