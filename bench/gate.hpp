#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/compare.hpp"

namespace seam {

/// What was measured: scene (see on_arm) → method → metric, named as in summary.json. NaN: could not be measured.
using Figures = std::map<std::string, std::map<std::string, std::map<std::string, double>>>;

Figures figures(const std::vector<Comparison>& comparisons);

/// A figure that is not what it was. NaN stands for none.
struct Difference {
  enum class Kind {
    worse,
    better,
    other,    ///< neither: a metric that has no better and worse
    fresh,    ///< not among the baselines
    missing,  ///< among the baselines alone
  };

  Kind kind = Kind::other;
  std::string scene, method, metric;
  double was = std::numeric_limits<double>::quiet_NaN();
  double is = std::numeric_limits<double>::quiet_NaN();
  double allowed = 0.0;  // by how much they may differ
};

/// One line, e.g. `carrying dmp3: torque_jump_nm 0.0189 -> 15.4, worse by 81381 % (allowed: 1 %)`.
std::string to_string(const Difference& difference);

/// Figures as they should be: a folder with `tolerances.yaml` and a file SCENE.json for each scene. A tolerance is that of the
/// scene on this arm, else of the scene, else of the arm, else of all.
class Baselines {
 public:
  /// @throws Error  no such folder, a file that cannot be read or is not of the format (names file and place)
  explicit Baselines(const std::string& dir);

  /// What differs by more than its tolerance, in the scenes and methods that were played.
  /// @throws Error  a metric has no tolerance
  std::vector<Difference> check(const Figures& now) const;
  /// Renews the files of the scenes that were played, in them the figures that differ; each appears whole or not at all.
  /// @throws Error  cannot be written
  void update(const Figures& now);

 private:
  enum class Better { lower, higher, neither };
  struct Tolerance {
    double relative = 0.0;
    double absolute = 0.0;
    Better better = Better::lower;
  };
  using Tolerances = std::map<std::string, Tolerance>;

  Tolerance tolerance(const std::string& scene, const std::string& metric) const;
  /// Of a pair of figures, if they differ by more than their tolerance.
  std::optional<Difference> difference(Difference pair) const;

  std::string dir_;
  Figures was_;
  std::map<std::string, Tolerances>
      tolerances_;  // of a scene, of an arm (`-published`), and "" for all that have none of their own
};

}  // namespace seam
