#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/bullet_precision.hpp>
#include <seam/export.hpp>
#include <seam/robot_model.hpp>

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace SEAM_API seam {

/// Where a robot stands, and what it is to collisions.
struct RobotSettings {
  Eigen::Isometry3d X_world_base = Eigen::Isometry3d::Identity();  // pose of the URDF's root link
  UrdfSettings urdf;                                               // how `load` reads it
  bool colliders = true;       // give the links collision shapes
  bool self_collision = true;  // between bodies that no joint joins
  double friction = 0.5;       // of the colliders
  /// [m] No point of a mesh is further outside the hull that it collides as; nor further than a hundredth of the mesh's size
  /// (the diagonal of its box). The fewer vertices, the faster the step. 0: the exact hull.
  double hull_tolerance = 2e-3;
  /// Simulate what the model's joints have beside rigid bodies (see Robot::drive). Else it is the app's, or not there.
  bool joint_dynamics = true;
  /// Which side of an elastic joint is measured.
  enum class Encoders { motor, link };
  Encoders encoders = Encoders::motor;  // what controllers see
};

/// A robot in a Bullet world: the `btMultiBody` made from a URDF, its colliders and shapes, which
/// it owns. Body i of the model is link i of the multibody and degree of freedom i. A link's frame
/// is at the body's centre of mass along its principal axes (Bullet's convention); the base's is
/// the root link's. Bullet's own damping is off; no sleep. Bullet clamps joint velocities at ±100 rad/s
/// (`setMaxCoordinateVelocity`). The URDF's limits are written to the links but, as everywhere in
/// Bullet, nothing enforces them by itself.
///
/// Neighbouring bodies (joined by one joint) do not collide; others do. Bodies that are two joints apart are left out of
/// Bullet's checks while these joints are within their limits (or at most 0.01 rad or m beyond), if a proof at construction found
/// that the bodies stay 20 mm apart there, where Bullet makes no contacts. The proof holds for the shapes in the model:
/// what else an app wants to hang on a link belongs there.
///
/// A joint's friction, rotor and spring (see Joint; a URDF's `<dynamics>` gives the first) are simulated by `drive`, which a
/// Controller calls. With J, b and c of a joint, u the torque of its drive, M and h those of the bodies
///     (M(q) + J)·q̈ + h(q, q̇) + b·q̇ + c·sgn(q̇) = u
/// exactly for free motion, friction taken at the end of the tick, so that it is stable at any tick and a joint at rest sticks.
/// A joint of stiffness k has a motor of its own behind it, at θ:
///     J·θ̈ + b·θ̇ + c·sgn(θ̇) = u − t,   t = k(θ − q) + d(θ̇ − q̇),   M(q)·q̈ + h(q, q̇) = t
/// Where a contact or a constraint of Bullet's acts on the arm, it meets M alone, and friction as it is without it.
///
/// A mesh collides as its convex hull, simplified (see `hull_tolerance`), with Bullet's margin of 1 mm around it. With a
/// tolerance of 2 mm this surface is at most 1 mm outside the exact hull and at most 1 mm inside it.
///
/// The base belongs to Bullet's static filter group: it meets what moves, not what is
/// static. The world is borrowed: a robot that outlives it is only to be destroyed. Beside the colliders there is a
/// collision object in the world that nothing meets (it tells the robot when the world is gone): an app
/// that empties a world of its objects destroys its robots and plug-ins first.
class Robot {
 public:
  /// @throws Error  see RobotModel::read and load_mesh; a collider's mesh that reaches further than 1e9 m; a hull tolerance that
  ///                is not finite and >= 0; Bullet's libraries of both precisions are loaded
  static Robot load(const std::string& urdf_path, btMultiBodyDynamicsWorld& world,
                    const RobotSettings& settings = {});
  /// The same from a model that has been read already, or made.
  /// @throws Error  as `load`
  Robot(RobotModel model, btMultiBodyDynamicsWorld& world, const RobotSettings& settings = {});
  Robot(Robot&&) noexcept;             // controllers that borrow it must be made afterwards
  Robot& operator=(Robot&&) noexcept;  // likewise
  ~Robot();

  /// As it was read. Its warnings also name joints that move less inertia than Bullet's precision can tell from none (in
  /// float 1.2e-7 kg m² or kg, in double 2.2e-16): Bullet does not move them.
  const RobotModel& model() const noexcept;
  int dof() const noexcept { return model().dof(); }  // n joints
  btMultiBody& multibody() noexcept;                  // in Bullet; link i is joint i's body
  const btMultiBody& multibody() const noexcept;      // likewise
  btMultiBodyDynamicsWorld& world() const noexcept;   // in which it stands

  /// Positions [rad or m] and velocities [rad/s or m/s] of as many joints, from the first on, as there is room for.
  void state(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> qd) const noexcept;
  /// Of as many joints, from the first on: the state of the motors behind elastic joints, of the joints themselves where they are
  /// rigid.
  void motor_state(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> qd) const noexcept;
  /// What the encoders see of as many joints, from the first on: motor_state or state, see
  /// RobotSettings::encoders.
  void measured_state(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> qd) const noexcept;
  /// The torque of the drives for the tick of dt that comes, and what their joints make of it (friction, rotors, springs). To be
  /// called in each of the world's pre-ticks, substeps included, after whatever else adds torques to this robot's joints: a
  /// Controller does; where there is none, an app with drives of its own, or with none (zeros). Right for any number of
  /// substeps, though Bullet keeps joint torques over them: it tells substeps apart by a small torque on the base, which is
  /// fixed and cannot move. Do not add base torques from inside the tick. Neither allocates nor throws.
  /// @param dt      [s] > 0
  /// @param torque  [N·m or N] of as many joints, from the first on, as it has values
  void drive(double dt, const Eigen::VectorXd& torque) noexcept;
  /// Puts the arm at (q, q̇), which is RobotModel::neutral() to begin with. Followers are put where q says, not where
  /// their leaders have them (see RobotModel::place_followers). Colliders and their bounding boxes
  /// follow. Forces and torques that wait for the next step stay. The springs of elastic joints bear what holds the arm up
  /// there. Allocates.
  void reset(const Eigen::Ref<const Eigen::VectorXd>& q,
             const Eigen::Ref<const Eigen::VectorXd>& qd);
  /// Pose of the root link in the world.
  Eigen::Isometry3d X_world_base() const noexcept;
  /// Pose of any URDF link in the world, at the multibody's present state.
  Eigen::Isometry3d X_world_frame(const Frame& frame) const noexcept;
  /// The world's gravity in the frame of the root link [m/s²].
  Eigen::Vector3d gravity_in_base() const noexcept;

 private:
  friend class Controller;
  const std::shared_ptr<bool>& controlled() const noexcept;  // whether there is a controller of it

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seam
