#pragma once

#include <array>

#include <Eigen/LU>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/kinematics.hpp>
#include <seam/posture_system.hpp>

namespace SEAM_API seam {

/// Where a tool should be and how it should move, in the frame of the robot's base: (v, ω) and (v̇, ω̇).
struct ToolState {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // R*, p*
  Vector6d velocity = Vector6d::Zero();                    // [m/s, rad/s]
  Vector6d acceleration = Vector6d::Zero();                // [m/s², rad/s²]
};

/// What the joints should do, and how well the tool follows by it.
struct JointSolution {
  Eigen::VectorXd position;      // n [rad or m]
  Eigen::VectorXd velocity;      // n, per second
  Eigen::VectorXd acceleration;  // n, per second squared
  double position_error = 0.0;   // [m] of the tool
  double angle_error = 0.0;      // [rad] likewise
};

/// Which of all joint positions for a pose are taken, and what gives way near a singularity (see InverseKinematics).
struct PostureSettings {
  Eigen::VectorXd
      rest;  // n, where the joints would like to be; empty: the middle of their limits, 0 without
  Eigen::VectorXd weight;      // n, > 0, how much; empty: 1 each
  double damped_below = 0.02;  // w₀, 0: no damping. In m³ and rad³; a PA-10 in mid-reach has 0.1
  double damping = 3e-4;       // λ₀² [m², rad²]
  double most_error = 5e-3;    // [m, rad] by which the tool may be off
};

/// Inverse kinematics of a redundant arm that does not depend on the path: of all joint positions that put the tool where
/// it should be, those nearest to a posture,
///     minimise ½(q − q_r)ᵀW(q − q_r)  subject to  e(q) = (p − p*, log R·R*ᵀ) = 0
/// A closed path of the tool is a closed path of the joints. The conditions for it, with multipliers μ (a wrench),
///     W(q − q_r) + J(q)ᵀμ = 0,  e(q) = 0
/// are solved by Newton's method, with the exact d(Jᵀμ)/dq; they stay regular where J has full
/// rank, and serve arms without redundancy too. Velocity and acceleration come from differentiating both conditions, and
/// so are exact and as continuous as the tool's.
///
/// The first guess is where the last five solutions lead after one more tick of the same length. On a smooth path one step
/// of Newton's method is then enough. After a jump, or where ticks change their length, that guess is no good: unless it
/// brings the tool ten times nearer to its pose, the last solution is the guess. A step shorter than 1e-11 is the last one,
/// since what it leaves is of the order of its square. Velocity and acceleration are solved for with that step's matrix, which
/// makes them exact to about 1e-10 of themselves.
///
/// Near a singularity, where w = √det JJᵀ falls below w₀, the tool may miss its pose a little so that the joints need not
/// move at will: the second condition becomes e(q) = λ²(w)μ, which minimises |e|²/2λ² beside the posture's cost, with
///     λ²(w) = λ₀²·(1 − w/w₀)⁴
/// so that positions, velocities and accelerations stay continuous where it sets in. The solution says by how much the
/// tool misses. Velocities and accelerations are then exact but for terms of the order of that angle.
///
/// Construction allocates; `follow` does not, and does not throw.
class InverseKinematics {
 public:
  /// What came of `follow`.
  enum class Status {
    exact,         ///< the tool is where it should be, to 1e-12
    damped,        ///< near a singularity: it is not quite there, see the solution's errors
    beyond_limit,  ///< it would be, with a joint beyond its limits
    lost,  ///< no solution near the one before: out of reach, or further off than `most_error`
  };

  /// @throws Error  the settings do not fit the robot, or it has fewer than six joints that move the tool
  InverseKinematics(const RobotModel& model, Kinematics kinematics,
                    const PostureSettings& posture = {});

  int dof() const noexcept { return kinematics_.dof(); }  // n joints

  /// Finds joint positions for a pose without knowing any near: from the posture and from random ones (seeded).
  /// @return  positions for which `follow` goes on
  /// @throws Error  out of reach: the distance [m] and angle [rad] by which the best one misses
  Eigen::VectorXd reach(const Eigen::Isometry3d& pose);

  /// Goes on from joint positions that put the tool near its next pose.
  void start(const Eigen::Ref<const Eigen::VectorXd>& q) noexcept;
  /// The joints for the tool's next state. Unless `exact` or `damped` the solution is left as it was.
  Status follow(const ToolState& target, JointSolution& solution) noexcept;

 private:
  static constexpr int most = PostureSystem::most;                          // joints
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most + 6, 1>;  // q, μ
  using System = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most + 6, most + 6>;

  /// The last solutions, the newest of them for a pose.
  struct History {
    static constexpr int most_length = 5;

    bool is_at(const Eigen::Isometry3d& target) const noexcept;
    void add(const Eigen::Isometry3d& target, const Vector& now) noexcept;
    void go_on(Vector& next) const noexcept;

    std::array<Vector, most_length> states;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    int newest = 0;
    int length = 0;  // solutions of one motion; 0: the newest may be a guess, or of another
  };
  struct Step {
    double joints;  // [rad or m], its length
    double wrench;  // share of it
  };

  Vector6d error(const Eigen::Isometry3d& target) const noexcept;
  void begin(const Eigen::Isometry3d& target) noexcept;
  void go_to_state() noexcept;
  bool converge(const ToolState& target) noexcept;
  Step take_step() noexcept;
  bool within_limits() const noexcept;
  void assemble() noexcept;
  void assemble_whole() noexcept;
  void solve() noexcept;
  double softness_here() const noexcept;
  double softness_at(const Eigen::VectorXd& q) noexcept;
  void soften() noexcept;
  double softness_curvature(const Eigen::VectorXd& qd) noexcept;
  void move_on(const Vector6d& acceleration, JointSolution& solution) noexcept;
  void estimate_wrench() noexcept;
  bool approach(const Eigen::Isometry3d& target);
  double posture_cost() const noexcept;

  Kinematics kinematics_;
  Eigen::VectorXd rest_, weight_, lower_, upper_;
  double damped_below_, damping_, most_error_, heaviest_;
  History history_;
  Vector state_;
  Eigen::VectorXd q_;
  Vector6d wrench_ = Vector6d::Zero();
  double softness_ = 0.0;           // λ² at q_
  Eigen::VectorXd softness_slope_;  // ∂λ²/∂q
  Eigen::VectorXd nearby_, curvature_;
  Eigen::MatrixXd gradient_;
  Jacobian scaled_;
  PostureSystem::Sides sides_;
  PostureSystem system_;  // does without damping
  bool whole_ = false;    // it did not do
  System matrix_;
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most + 6, 2> columns_;
  Eigen::PartialPivLU<System> factors_;
};

}  // namespace seam
