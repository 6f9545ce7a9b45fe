#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <seam/join.hpp>

namespace seam {

/// A question to a scene: one of its entries is varied, and what comes of it is measured with every method.
struct Experiment {
  /// One metric of the answer: a part of the plot, and columns of the table.
  struct Panel {
    /// As in summary.json, or joint_speed_rad_s: of the reference, at the last join; of a variant: VARIANT.METRIC.
    std::string metric;
    std::string label;  // with the unit
    bool log = false;
  };

  std::string name;                             // the file's name without its ending
  std::string title;                            // one line
  std::string scene;                            // path of the scene file
  std::vector<std::string> overrides, allowed;  // see Scene::read
  /// The scene with further overrides, by name; "" is the scene without.
  std::map<std::string, std::vector<std::string>> variants{{"", {}}};
  std::string vary;            // the entry that is varied
  std::vector<double> values;  // increasing
  std::string over;            // metric, of dmp2's run, over which all is drawn; empty: the value
  std::string label;           // of that axis, with the unit
  bool log = false;
  std::vector<Panel> panels;
  std::string text;  // what it shows, with figures in braces: see `answer`

  /// Reads a file of the format `seam-experiment 1` (see bench/experiments/).
  /// @param allowed  folders of which it and its scene may name files, see Scene::read
  /// @throws Error  names file, line and key
  static Experiment read(const std::string& path, const std::vector<std::string>& allowed = {});
};

/// What came of one value: method → metric → figure. NaN: could not be measured.
struct Measured {
  double value = 0.0;
  std::map<std::string, std::map<std::string, double>> figures;
};

/// Called after each value has been played.
using ExperimentProgress = std::function<void(int done, int total)>;

/// Plays the scene once per value and method, and at dt/2.
/// @throws Error  the scene refuses a value, or a metric is not measured in it
std::vector<Measured> perform(const Experiment& experiment, int jobs,
                              const ExperimentProgress& progress);

/// The text with its figures put in: `{METHOD METRIC first}`, or last, least, most; `{x first}` is the axis itself.
/// @throws Error  a brace that holds something else
std::string answer(const Experiment& experiment, const std::vector<Measured>& measured);

/// A Markdown table, a row per value.
std::string table(const Experiment& experiment, const std::vector<Measured>& measured);

/// Writes NAME.csv, NAME.md (picture, text, table) and the picture NAME.png into a folder that is there.
/// @throws Error  cannot be written, or gnuplot fails
void write_experiment(const Experiment& experiment, const std::vector<Measured>& measured,
                      const std::string& dir);

}  // namespace seam
