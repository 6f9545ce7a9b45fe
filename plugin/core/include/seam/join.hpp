#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// How an execution takes over from whatever ran before it.
enum class Join {
  dmp2,   ///< y and ẏ continue; ÿ steps
  dmp2a,  ///< y, ẏ and ÿ continue: the weights are changed so that the forcing gives the right ÿ (Eqs. 19–22)
  dmp3,  ///< y, ẏ and ÿ continue: the filtered goal r starts where it gives the right ÿ (Eq. 6)
  dmp2j,  ///< y, ẏ, ÿ and the jerk continue: as dmp2a, with the forcing's rate as a second condition
};

/// In the order in which tables show them.
inline constexpr std::array<Join, 4> all_joins{Join::dmp2, Join::dmp2a, Join::dmp3, Join::dmp2j};

/// The name, as in `dmp2a`.
std::string_view to_string(Join method) noexcept;
/// @throws Error  no such method (lists those there are)
Join join_from_name(std::string_view name);

/// Which weights dmp2a changes. The paper's (20) and (22) as printed leave out Σψ and leave a step in
/// acceleration; these are corrected.
enum class WeightChange {
  smallest,   ///< the change of least norm, by the pseudo-inverse (Eq. 21)
  first,      ///< the first kernel's alone (Eq. 20, corrected)
  strongest,  ///< that of the kernel which is strongest at the phase (Eq. 22, corrected)
};

/// A method, and what it leaves open. A Join alone will do where these are wanted.
struct JoinSettings {
  Join method = Join::dmp3;                      // how to take over
  WeightChange change = WeightChange::smallest;  // of dmp2a

  JoinSettings() = default;
  /// From a method alone, too.
  JoinSettings(Join join, WeightChange weight_change = WeightChange::smallest)
      : method(join), change(weight_change) {}
};

/// Position, velocity, acceleration and jerk of D coordinates at one instant [rad or m, per s, per s², per s³].
struct Sample {
  Eigen::VectorXd position;      // y
  Eigen::VectorXd velocity;      // ẏ
  Eigen::VectorXd acceleration;  // ÿ
  Eigen::VectorXd jerk;          // y⃛, only where it is asked for: see Execution::state

  /// All zero.
  explicit Sample(int dimensions = 0)
      : position(Eigen::VectorXd::Zero(dimensions)),
        velocity(Eigen::VectorXd::Zero(dimensions)),
        acceleration(Eigen::VectorXd::Zero(dimensions)),
        jerk(Eigen::VectorXd::Zero(dimensions)) {}
  /// Exchanges the values without copying them.
  void swap(Sample& other) noexcept {
    position.swap(other.position);
    velocity.swap(other.velocity);
    acceleration.swap(other.acceleration);
    jerk.swap(other.jerk);
  }
  /// At a position, all else zero.
  static Sample at_rest(const Eigen::VectorXd& position);
};

}  // namespace seam
