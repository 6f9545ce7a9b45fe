#pragma once

#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/noise.hpp>
#include <seam/per_joint.hpp>
#include <seam/robot_model.hpp>

namespace SEAM_API seam {

/// A time in which the joints' state does not come through, from the first tick at or after its beginning on.
struct Dropout {
  /// What comes instead.
  enum class What {
    missing,  ///< all values are NaN
    frozen,   ///< all values stay as they were measured last
  };

  double from = 0.0;          // [s] since the controller was made
  double to = 0.0;            // [s]
  What what = What::missing;  // comes instead
};

/// What becomes of the joints' state on its way to the controller; by default nothing.
struct SensorSettings {
  double delay = 0.0;             // [s]
  PerJoint resolution = 0.0;      // [rad] step of the positions, 0: none
  PerJoint position_noise = 0.0;  // [rad] standard deviation of white noise
  PerJoint velocity_noise = 0.0;  // [rad/s] likewise
  int seed = 0;                   // of the noise
  std::vector<Dropout> dropouts;  // in any order
};

/// True state in, measured state out, once per tick at a time t:
///     (q, q̇)(t − delay), by straight lines between ticks (before the first tick: the first)
///     + noise, then q to the nearest multiple of the resolution; nothing of it during a dropout
/// It remembers the last `most_ticks` ticks; a delay beyond them is that of the oldest. Neither allocates nor throws
/// after construction.
class Sensor {
 public:
  static constexpr int most_ticks = 1000;  // that are remembered

  /// @throws Error  a setting is negative or not finite, there are not as many as joints, or a dropout does not end after it
  ///                began
  Sensor(const RobotModel& model, const SensorSettings& settings);

  /// Whether the measured state is always the true one.
  bool ideal() const noexcept { return ideal_; }
  /// @param dt  [s] > 0, from this tick to the next
  void measure(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept;
  /// The state before now is none of this one's past any more: the arm was put elsewhere.
  void forget() noexcept { count_ = 0; }
  const Eigen::VectorXd& q() const noexcept { return q_; }    // n, as measured last
  const Eigen::VectorXd& qd() const noexcept { return qd_; }  // likewise

 private:
  struct Seen {
    double time = 0.0;  // [s]
    Eigen::VectorXd q, qd;
  };

  const Seen& seen(int ticks_ago) const noexcept;
  void remember(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) noexcept;
  void look_back(double time) noexcept;
  void disturb() noexcept;
  const Dropout* dropout() const noexcept;

  bool ideal_;
  double delay_;
  Eigen::VectorXd resolution_, position_noise_, velocity_noise_;
  std::vector<Dropout> dropouts_;
  Noise noise_;
  std::vector<Seen> past_;  // a ring; empty without a delay
  int latest_ = -1;
  int count_ = 0;
  double time_ = 0.0;
  Eigen::VectorXd q_, qd_;
};

}  // namespace seam
