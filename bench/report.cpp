#include "bench/report.hpp"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "bench/columns.hpp"
#include "bench/figure.hpp"
#include "bench/parallel.hpp"
#include "bench/results_folder.hpp"
#include "bench/run_json.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;

// What is no UTF-8 in a scene file is replaced, not refused.
constexpr auto as_it_can = Json::error_handler_t::replace;

template <typename Columns>
Json headings(const Columns& columns) {
  Json list = Json::array();
  for (const auto& column : columns)
    list.push_back({{"name", column.name}, {"heading", column.heading}, {"format", column.format}});
  return list;
}

// What was measured, and on what.
Json scene_json(const Comparison& comparison) {
  const Scene& scene = comparison.scene;
  const Recording& recording = comparison.runs.front().recording;
  return {{"scene", scene.name},
          {"arm", scene.arm},
          {"title", scene.title},
          {"figure", scene.figure},
          {"file", scene.text},
          {"overrides", scene.overrides},
          {"rim", scene.liquid ? Json(scene.liquid->rim) : Json()},
          {"columns", headings(columns(recording))},
          {"join_columns", headings(join_columns(recording))}};
}

Json outcomes_json(const Recording& recording) {
  Json outcomes = Json::object();
  for (const auto& [name, value] : shown_outcomes(recording)) outcomes[name] = value;
  return outcomes;
}

Json summary(const std::vector<Comparison>& comparisons, const std::string& seam_version) {
  Json scenes = Json::array(), runs = Json::array();
  for (const Comparison& comparison : comparisons) scenes.push_back(scene_json(comparison));
  for (const Comparison& comparison : comparisons)
    for (const Run& run : comparison.runs) {
      Json entry{{"scene", comparison.scene.name},  {"arm", comparison.scene.arm},
                 {"method", to_string(run.method)}, {"dt", comparison.scene.dt},
                 {"seed", comparison.scene.seed},   {"outcomes", outcomes_json(run.recording)}};
      entry.update(to_json(run));
      runs.push_back(std::move(entry));
    }
  return {
      {"format", 1}, {"versions", versions_json(seam_version)}, {"scenes", scenes}, {"runs", runs}};
}

void remove_file(const std::filesystem::path& path) {
  std::error_code status;
  std::filesystem::remove(path, status);
  if (status) throw Error(path.string(), "cannot be replaced: " + status.message());
}

void write_comparison(const Comparison& comparison, const std::string& dir) {
  const std::filesystem::path folder =
      std::filesystem::path(dir) / on_arm(comparison.scene.name, comparison.scene.arm);
  make_folder(folder.string());
  for (const Run& run : comparison.runs) {
    const std::string beside = (folder / to_string(run.method)).string();
    run.recording.write(beside + ".csv");
    run.replay.write(beside + ".replay.json");
  }
  draw_figures(comparison, dir);
}

}  // namespace

void write_results(const std::vector<Comparison>& comparisons, const std::string& seam_version,
                   const std::string& dir, int jobs) {
  const std::filesystem::path results = dir;
  make_folder(results.string());
  for (const char* last : {"summary.json", "report.html"}) remove_file(results / last);
  std::string tables;
  for (const Comparison& comparison : comparisons)
    tables += (tables.empty() ? "" : "\n") + title_on_arm(comparison.scene) + " (`" +
              on_arm(comparison.scene.name, comparison.scene.arm) + "`):\n\n" + table(comparison);
  for_each_index(static_cast<std::int64_t>(comparisons.size()), jobs, [&](std::int64_t i) {
    write_comparison(comparisons[static_cast<std::size_t>(i)], dir);
  });
  write_whole((results / "table.md").string(), tables);
  write_whole((results / "overview.md").string(), overview(comparisons));
  write_whole((results / "summary.json").string(),
              summary(comparisons, seam_version).dump(2, ' ', false, as_it_can) + "\n");
}

}  // namespace seam
