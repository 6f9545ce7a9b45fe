#include "bench/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <regex>

#include <fmt/format.h>

#include "bench/columns.hpp"
#include "bench/compare.hpp"
#include "bench/gnuplot.hpp"
#include "bench/markdown.hpp"
#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/own_folders.hpp"
#include <seam/error.hpp>
#include <seam/table.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

constexpr const char* joint_speed = "joint_speed_rad_s";
constexpr int most_values = 1000;

bool is_log(const YamlEntry& entry) {
  const auto scale = entry.find("scale");
  return scale && scale->choice({"linear", "log"}) == 1;
}

std::vector<double> read_values(const YamlEntry& entry) {
  Eigen::VectorXd values;
  if (entry.is_list()) {
    values = entry.numbers();
  } else {
    entry.only({"from", "to", "count"});
    const YamlEntry count = entry.at("count");
    if (count.count(2) > most_values) count.fail(count.text() + ", must be <= 1000");
    values.setLinSpaced(count.count(2), entry.at("from").number(), entry.at("to").number());
  }
  for (Eigen::Index i = 1; i < values.size(); ++i)
    if (!(values(i) > values(i - 1))) entry.fail("must increase");
  return {values.begin(), values.end()};
}

double speed_at_last_join(const Recording& recording) {
  const double dt = recording.dt();
  const auto tick = static_cast<Eigen::Index>(std::ceil(recording.joins.back().time / dt - 1e-6));
  return recording.ref_vel.row(std::min<Eigen::Index>(tick, recording.ticks() - 1))
      .cwiseAbs()
      .maxCoeff();
}

std::map<std::string, double> figures_of(const Run& run) {
  std::map<std::string, double> figures = seam::figures(run);
  figures[joint_speed] = speed_at_last_join(run.recording);
  return figures;
}

const std::string dmp2(to_string(Join::dmp2));

double abscissa(const Experiment& experiment, const Measured& at) {
  return experiment.over.empty() ? at.value : at.figures.at(dmp2).at(experiment.over);
}

double chosen(std::vector<double> values, const std::string& which) {
  if (which == "first") return values.front();
  if (which == "last") return values.back();
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return which == "least" ? *least : *most;
}

// Three digits, and no exponent where a person would write none.
std::string short_form(double value) {
  return shown(value, std::abs(value) >= 1000.0 && std::abs(value) < 1e6 ? "{:.0f}" : "{:.3g}");
}

std::vector<Scene> variants_at(const Experiment& experiment, double value) {
  std::vector<Scene> scenes;
  for (const auto& [name, changes] : experiment.variants) {
    std::vector<std::string> overrides = experiment.overrides;
    overrides.insert(overrides.end(), changes.begin(), changes.end());
    overrides.push_back(fmt::format("{}={}", experiment.vary, value));
    scenes.push_back(Scene::read(experiment.scene, overrides, experiment.allowed));
  }
  return scenes;
}

void require_measured(const Experiment& experiment, const Measured& measured) {
  std::vector<std::string> metrics;
  for (const Experiment::Panel& panel : experiment.panels) metrics.push_back(panel.metric);
  if (!experiment.over.empty()) metrics.push_back(experiment.over);
  for (const std::string& metric : metrics)
    if (measured.figures.at(dmp2).count(metric) == 0)
      throw Error(experiment.name,
                  "metric \"" + metric + "\" is not measured in " + experiment.scene);
}

}  // namespace

Experiment Experiment::read(const std::string& path, const std::vector<std::string>& allowed) {
  const YamlEntry root = YamlEntry::read(path, {}, with_own_folders(allowed));
  root.require_format("seam-experiment", 1);
  root.only(
      {"format", "title", "scene", "set", "variants", "vary", "values", "axis", "panels", "text"});
  Experiment experiment;
  experiment.allowed = allowed;
  experiment.name = std::filesystem::path(path).stem().string();
  experiment.title = root.at("title").text();
  experiment.scene = root.at("scene").path();
  if (const auto set = root.find("set"))
    for (const YamlEntry& change : set->items()) experiment.overrides.push_back(change.text());
  if (const auto variants = root.find("variants"))
    for (const auto& [name, set] : variants->entries())
      for (const YamlEntry& change : set.items())
        experiment.variants[name].push_back(change.text());
  experiment.vary = root.at("vary").text();
  experiment.values = read_values(root.at("values"));
  const YamlEntry axis = root.at("axis");
  axis.only({"label", "metric", "scale"});
  experiment.label = axis.at("label").text();
  if (const auto metric = axis.find("metric")) experiment.over = metric->text();
  experiment.log = is_log(axis);
  for (const YamlEntry& entry : root.at("panels").items()) {
    entry.only({"metric", "label", "scale"});
    experiment.panels.push_back(
        {entry.at("metric").text(), entry.at("label").text(), is_log(entry)});
  }
  experiment.text = root.at("text").text();
  return experiment;
}

std::vector<Measured> perform(const Experiment& experiment, int jobs,
                              const ExperimentProgress& progress) {
  const std::vector<Join> methods(all_joins.begin(), all_joins.end());
  const auto quiet = [](int, int, const std::string&) {};
  std::vector<Measured> measured;
  for (const double value : experiment.values) {
    Measured& at = measured.emplace_back();
    at.value = value;
    const std::vector<Comparison> compared =
        compare(variants_at(experiment, value), methods, jobs, quiet);
    auto variant = experiment.variants.begin();
    for (const Comparison& comparison : compared) {
      const std::string prefix = variant->first.empty() ? "" : variant->first + ".";
      for (const Run& run : comparison.runs)
        for (const auto& [metric, figure] : figures_of(run))
          at.figures[std::string(to_string(run.method))][prefix + metric] = figure;
      ++variant;
    }
    require_measured(experiment, at);
    progress(static_cast<int>(measured.size()), static_cast<int>(experiment.values.size()));
  }
  return measured;
}

std::string answer(const Experiment& experiment, const std::vector<Measured>& measured) {
  static const std::regex brace(R"(\{(?:(\w+) ([\w.]+)|x) (first|last|least|most)\})");
  std::string text = experiment.text;
  for (std::smatch match; std::regex_search(text, match, brace);) {
    std::vector<double> values;
    for (const Measured& at : measured) {
      if (!match[1].matched) {
        values.push_back(abscissa(experiment, at));
        continue;
      }
      const auto method = at.figures.find(match[1]);
      if (method == at.figures.end() || method->second.count(match[2]) == 0)
        throw Error(experiment.name, "text: " + match.str() + ", must name a method and a metric");
      values.push_back(method->second.at(match[2]));
    }
    text = match.prefix().str() + short_form(chosen(values, match[3])) + match.suffix().str();
  }
  if (text.find('{') != std::string::npos)
    throw Error(experiment.name, "text: " + text.substr(text.find('{'), 40) +
                                     ", must be {METHOD METRIC first, last, least or most}");
  return text;
}

std::string table(const Experiment& experiment, const std::vector<Measured>& measured) {
  Rows rows(1, {experiment.label});
  for (const Experiment::Panel& panel : experiment.panels)
    for (const Join method : all_joins)
      rows[0].push_back(fmt::format("{} {}", to_string(method), panel.label));
  for (const Measured& at : measured) {
    auto& row = rows.emplace_back(1, shown(abscissa(experiment, at), "{:.4g}"));
    for (const Experiment::Panel& panel : experiment.panels)
      for (const Join method : all_joins)
        row.push_back(short_form(at.figures.at(std::string(to_string(method))).at(panel.metric)));
  }
  return markdown(rows, 0);
}

namespace {

// All figures of all methods, not just those that are drawn.
Table all_figures(const Experiment& experiment, const std::vector<Measured>& measured) {
  Table all{{"x", experiment.vary}, {}};
  for (const auto& [method, figures] : measured.front().figures)
    for (const auto& [metric, figure] : figures) all.columns.push_back(method + "." + metric);
  all.values.resize(static_cast<Eigen::Index>(measured.size()),
                    static_cast<Eigen::Index>(all.columns.size()));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    all.values(row, 0) = abscissa(experiment, measured[i]);
    all.values(row, 1) = measured[i].value;
    Eigen::Index column = 2;
    for (const auto& [method, figures] : measured[i].figures)
      for (const auto& [metric, figure] : figures) all.values(row, column++) = figure;
  }
  return all;
}

std::string script(const Experiment& experiment) {
  const auto panels = static_cast<int>(experiment.panels.size());
  std::string text = preamble(600 * panels, 520);
  text += fmt::format("set multiplot layout 1,{} title {}\nset tmargin 4\nset key tmargin left\n",
                      panels, quoted(experiment.title));
  text += "set xlabel " + quoted(experiment.label) + "\n";
  if (experiment.log) text += "set logscale x\n";
  for (const Experiment::Panel& panel : experiment.panels) {
    text += "set ylabel " + quoted(panel.label) + " offset 1\n";
    text +=
        panel.log ? "set logscale y\nset format y '%g'\n" : "unset logscale y\nset format y '%g'\n";
    text += "plot ";
    for (const Join method : all_joins)
      text += fmt::format("{}'{}.csv' using 'x':{} with linespoints pt 7 ps 0.9 {} title '{}'",
                          method == all_joins.front() ? "" : ", \\\n  ", experiment.name,
                          quoted(fmt::format("{}.{}", to_string(method), panel.metric)),
                          style(method), to_string(method));
    text += "\nunset key\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace

void write_experiment(const Experiment& experiment, const std::vector<Measured>& measured,
                      const std::string& dir) {
  const std::string text = answer(experiment, measured);
  const std::filesystem::path folder = dir;
  all_figures(experiment, measured).write((folder / (experiment.name + ".csv")).string());
  draw(dir, experiment.name, script(experiment));
  write_whole((folder / (experiment.name + ".md")).string(),
              fmt::format("## {0}\n\n`seam experiment {1}`\n\n{2}\n\n![{0}]({1}.png)\n\n{3}",
                          experiment.title, experiment.name, text, table(experiment, measured)));
}

}  // namespace seam
