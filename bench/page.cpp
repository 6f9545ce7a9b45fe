#include "bench/page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/decimate.hpp"
#include "bench/figure.hpp"
#include "bench/markdown.hpp"
#include "bench/method_style.hpp"
#include "bench/pack.hpp"
#include "bench/page_replay.hpp"
#include "bench/page_template.hpp"
#include "scenes/scene.hpp"
#include <seam/error.hpp>
#include <seam/recording.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;

constexpr int format = 1;  // of summary.json
constexpr int curve_points = 1500;
constexpr double near = 0.045;  // [s] around a join, where every tick is kept
constexpr const char* data_mark = "SEAM_REPORT_DATA";

Json read_summary(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path, "cannot be read, must be what seam bench left");
  const Json summary = Json::parse(file);
  const Json& found = summary.at("format");
  if (found != format)
    throw Error(path, fmt::format("format {}, must be {}", found.dump(), format));
  return summary;
}

struct Curves {
  std::vector<std::string> names;
  Eigen::MatrixXd values;

  void add(const std::string& prefix, const std::vector<std::string>& of,
           const Eigen::MatrixXd& columns) {
    if (columns.cols() == 0) return;
    for (const std::string& name : of) names.push_back(prefix + name);
    values.conservativeResize(columns.rows(), values.cols() + columns.cols());
    values.rightCols(columns.cols()) = columns;
  }
};

Recording read_recording(const std::string& path) {
  Recording recording = Recording::read(path);
  for (const auto& [kind, values] :
       {std::pair("ref.", &recording.ref), {"q.", &recording.q}, {"torque.", &recording.torque}})
    if (values->cols() == 0) throw Error(path, std::string("has no column ") + kind + "<joint>");
  return recording;
}

// What is drawn: references, by how much they are missed, torques, and what the scene adds.
Curves curves_of(const Recording& recording) {
  Curves curves;
  const auto& joints = recording.joints;
  const auto& coordinates = recording.coordinates;
  curves.add("ref.", joints, recording.ref);
  curves.add("ref_vel.", joints, recording.ref_vel);
  curves.add("ref_acc.", joints, recording.ref_acc);
  curves.add("torque.", joints, recording.torque);
  curves.add("error.", joints, recording.ref - recording.q);
  curves.add("ref.", coordinates, recording.tool_ref);
  curves.add("ref_vel.", coordinates, recording.tool_vel);
  curves.add("ref_acc.", coordinates, recording.tool_acc);
  for (const Signal& signal : recording.signals) curves.add("", {signal.name}, signal.values);
  return curves;
}

// A figure as the terminal's table shows it.
Json cells(const Json& columns, const Json& metrics) {
  Json cells = Json::array();
  for (const Json& column : columns) {
    const Json& value = metrics.at(column.at("name").get<std::string>());
    cells.push_back(shown(value.is_null() ? std::nan("") : value.get<double>(),
                          column.at("format").get<std::string>()));
  }
  return cells;
}

// One scene of the page, put together from its runs on all arms.
class ScenePage {
 public:
  ScenePage(const Json& scene, const std::string& results, PageMeshes& meshes)
      : scene_(scene), results_(results), meshes_(meshes) {}

  void add_arm(const Json& arm) { arms_.push_back(arm); }

  void add(const Json& run) {
    runs_.push_back(&run);
    for (const Json& join : run.at("joins")) joins_.push_back(join.at("time"));
  }

  Json page() {
    Json page = {{"name", scene_.at("scene")},
                 {"title", scene_.at("title")},
                 {"figure", scene_.at("figure")},
                 {"file", scene_.at("file")},
                 {"overrides", scene_.at("overrides")},
                 {"arms", arms_},
                 {"rim", scene_.at("rim")},
                 {"columns", scene_.at("columns")},
                 {"join_columns", scene_.at("join_columns")},
                 {"runs", Json::array()}};
    for (const Json* run : runs_) page["runs"].push_back(run_page(*run));
    page["time"] = time_;
    page["stage"] = stage_;
    page["camera"] = camera_;
    page["why_no_arm"] = why_no_arm_;
    page["curves"] = names_;
    page["torque"] = torque_joint_;
    page["pack"] = pack_.text();
    return page;
  }

 private:
  Json run_page(const Json& run) {
    const std::string name = on_arm(scene_.at("scene"), run.at("arm"));
    const std::string beside = results_ + "/" + name + "/" + run.at("method").get<std::string>();
    const std::string path = beside + ".csv";
    const Recording recording = read_recording(path);
    const Curves curves = curves_of(recording);
    if (names_.empty()) begin(recording, curves);
    if (curves.names != names_ || recording.ticks() != ticks_)
      throw Error(path, "has other columns or times than the scene's other recordings");
    Json page = {{"method", run.at("method")},
                 {"arm", run.at("arm")},
                 {"dt", run.at("dt")},
                 {"seed", run.at("seed")},
                 {"outcomes", run.at("outcomes")},
                 {"metrics", run.at("metrics")},
                 {"cells", cells(scene_.at("columns"), run.at("metrics"))},
                 {"joins", joins(run)},
                 {"values", pack_.add(decimated(curves.values, kept_))}};
    page["motion"] = motion(beside + ".replay.json");
    return page;
  }

  Json joins(const Json& run) const {
    Json list = Json::array();
    for (const Json& join : run.at("joins"))
      list.push_back({{"time", join.at("time")},
                      {"cells", cells(scene_.at("join_columns"), join.at("metrics"))}});
    return list;
  }

  // Null where there is no replay: the page says so.
  Json motion(const std::string& path) {
    if (!std::filesystem::exists(path)) return {};
    const Replay replay = Replay::read(path);
    const Json stage = stage_of(replay);
    if (stage.is_null()) return {};
    if (stage_.is_null()) {
      stage_ = stage;
      camera_ = page_camera(replay.camera);
    }
    if (stage != stage_) throw Error(path, "shows other parts than the scene's other replays");
    return page_motion(replay, pack_);
  }

  // Null, and the reason is told, where its meshes are not there any more (results from another machine).
  Json stage_of(const Replay& replay) {
    try {
      return page_stage(replay, meshes_);
    } catch (const Error& error) {
      why_no_arm_ = error.what();
      return {};
    }
  }

  void begin(const Recording& recording, const Curves& curves) {
    names_ = curves.names;
    ticks_ = recording.ticks();
    kept_ = kept_ticks(recording.time, joins_, near, curve_points);
    time_ = pack_.add(recording.time(kept_), 1e-6);
    torque_joint_ = torque_joint(recording);
  }

  // The figure's own joint, or the one whose torque the first method's joins disturb most.
  std::string torque_joint(const Recording& recording) const {
    const auto& joints = recording.joints;
    const std::string figure = scene_.at("figure");
    if (std::find(joints.begin(), joints.end(), figure) != joints.end()) return figure;
    return joints[most_disturbed_joint(recording.time, recording.torque, joins_)];
  }

  const Json& scene_;
  std::string results_;
  PageMeshes& meshes_;
  Json arms_ = Json::array();
  std::vector<const Json*> runs_;
  std::vector<double> joins_;  // [s] of all runs
  std::vector<std::string> names_;
  Eigen::Index ticks_ = 0;
  std::vector<Eigen::Index> kept_;
  std::string torque_joint_;
  Pack pack_;
  Json time_, stage_, camera_;
  std::string why_no_arm_;
};

Json method_styles() {
  Json methods = Json::array();
  for (const Join method : all_joins) {
    const MethodStyle style = style_of(method);
    methods.push_back(
        {{"name", to_string(method)}, {"colour", style.colour}, {"dash", style.dash}});
  }
  return methods;
}

Json page_data(const Json& summary, const std::string& results) {
  PageMeshes meshes;
  std::vector<ScenePage> pages;
  std::string last;
  for (const Json& scene : summary.at("scenes")) {
    if (pages.empty() || scene.at("scene") != last) pages.emplace_back(scene, results, meshes);
    pages.back().add_arm(scene.at("arm"));
    last = scene.at("scene");
    for (const Json& run : summary.at("runs"))
      if (run.at("scene") == last && run.at("arm") == scene.at("arm")) pages.back().add(run);
  }
  Json scenes = Json::array();
  for (ScenePage& page : pages) scenes.push_back(page.page());
  return {{"versions", summary.at("versions")},
          {"methods", method_styles()},
          {"meshes", meshes.page()},
          {"scenes", scenes}};
}

// Text that stands in a script element, whatever it holds.
std::string in_script(const Json& data) {
  std::string text;
  for (const char c : data.dump()) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

std::string filled(const std::string& data) {
  std::string page(page_template);
  return page.replace(page.find(data_mark), std::string(data_mark).size(), data);
}

}  // namespace

void write_page(const std::string& results, const std::string& path) {
  const std::string summary = (std::filesystem::path(results) / "summary.json").string();
  try {
    write_whole(path, filled(in_script(page_data(read_summary(summary), results))));
  } catch (const Json::exception& error) {
    throw Error(summary, std::string("is not what seam bench left: ") + error.what());
  } catch (const fmt::format_error& error) {
    throw Error(summary, std::string("a column's format: ") + error.what());
  }
}

}  // namespace seam
