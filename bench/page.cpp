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
#include <seam/error.hpp>
#include <seam/table.hpp>

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

bool begins_with(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

Eigen::Index column(const Table& table, const std::string& path, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) throw Error(path, "has no column \"" + name + "\"");
  return found - table.columns.begin();
}

// What is drawn: references, torques, what the scene adds; not the measured positions, which differ by what is
// drawn as the tracking error.
bool is_drawn(const std::string& name) {
  for (const char* other : {"time", "switch", "tool_error_"})
    if (begins_with(name, other)) return false;
  return !begins_with(name, "q.") && !begins_with(name, "qd.");
}

struct Curves {
  std::vector<std::string> names;
  Eigen::VectorXd time;
  Eigen::MatrixXd values;
};

Curves read_curves(const std::string& path) {
  const Table table = Table::read(path);
  Curves curves{{}, table.values.col(column(table, path, "time")), {}};
  curves.values.resize(table.values.rows(), table.values.cols());
  const auto add = [&](const std::string& name, const auto& values) {
    curves.values.col(static_cast<Eigen::Index>(curves.names.size())) = values;
    curves.names.push_back(name);
  };
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    const auto values = table.values.col(static_cast<Eigen::Index>(c));
    if (is_drawn(name)) add(name, values);
    if (begins_with(name, "q."))
      add("error." + name.substr(2),
          table.values.col(column(table, path, "ref." + name.substr(2))) - values);
  }
  curves.values.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(curves.names.size()));
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

// One scene of the page, put together from its runs.
class ScenePage {
 public:
  ScenePage(const Json& scene, std::string folder, PageMeshes& meshes)
      : scene_(scene), folder_(std::move(folder)), meshes_(meshes) {}

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
                 {"rim", scene_.at("rim")},
                 {"columns", scene_.at("columns")},
                 {"join_columns", scene_.at("join_columns")},
                 {"runs", Json::array()}};
    for (const Json* run : runs_) page["runs"].push_back(run_page(*run));
    page["time"] = time_;
    page["stage"] = stage_;
    page["camera"] = camera_;
    page["curves"] = names_;
    page["torque"] = torque_joint_;
    page["pack"] = pack_.text();
    return page;
  }

 private:
  Json run_page(const Json& run) {
    const std::string method = run.at("method");
    const std::string path = folder_ + "/" + method + ".csv";
    const Curves curves = read_curves(path);
    if (names_.empty()) begin(curves);
    if (curves.names != names_ || curves.time.size() != ticks_)
      throw Error(path, "has other columns or times than the scene's other recordings");
    Json page = {{"method", method},
                 {"dt", run.at("dt")},
                 {"seed", run.at("seed")},
                 {"outcomes", run.at("outcomes")},
                 {"metrics", run.at("metrics")},
                 {"cells", cells(scene_.at("columns"), run.at("metrics"))},
                 {"joins", joins(run)},
                 {"values", pack_.add(decimated(curves.values, kept_))}};
    page["motion"] = motion(folder_ + "/" + method + ".replay.json");
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
    const Json stage = page_stage(replay, meshes_);
    if (stage_.is_null()) {
      stage_ = stage;
      camera_ = page_camera(replay.camera);
    }
    if (stage != stage_) throw Error(path, "shows other parts than the scene's other replays");
    return page_motion(replay, pack_);
  }

  void begin(const Curves& curves) {
    names_ = curves.names;
    ticks_ = curves.time.size();
    kept_ = kept_ticks(curves.time, joins_, near, curve_points);
    Eigen::VectorXd time(static_cast<Eigen::Index>(kept_.size()));
    for (std::size_t i = 0; i < kept_.size(); ++i)
      time(static_cast<Eigen::Index>(i)) = curves.time(kept_[i]);
    time_ = pack_.add(time, 1e-6);
    torque_joint_ = torque_joint(curves);
  }

  // The figure's own joint, or the one whose torque the first method's joins disturb most.
  std::string torque_joint(const Curves& curves) const {
    const std::string figure = scene_.at("figure");
    std::vector<std::string> joints;
    std::vector<Eigen::Index> found;
    for (std::size_t c = 0; c < curves.names.size(); ++c) {
      if (!begins_with(curves.names[c], "torque.")) continue;
      joints.push_back(curves.names[c].substr(7));
      if (joints.back() == figure) return figure;
      found.push_back(static_cast<Eigen::Index>(c));
    }
    if (joints.empty()) throw Error(folder_, "its recordings have no torque");
    return joints[most_disturbed_joint(curves.time, curves.values(Eigen::all, found), joins_)];
  }

  const Json& scene_;
  std::string folder_;
  PageMeshes& meshes_;
  std::vector<const Json*> runs_;
  std::vector<double> joins_;  // [s] of all runs
  std::vector<std::string> names_;
  Eigen::Index ticks_ = 0;
  std::vector<Eigen::Index> kept_;
  std::string torque_joint_;
  Pack pack_;
  Json time_, stage_, camera_;
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
  Json scenes = Json::array();
  PageMeshes meshes;
  for (const Json& scene : summary.at("scenes")) {
    const std::string name = scene.at("scene");
    ScenePage page(scene, results + "/" + name, meshes);
    for (const Json& run : summary.at("runs"))
      if (run.at("scene") == name) page.add(run);
    scenes.push_back(page.page());
  }
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
