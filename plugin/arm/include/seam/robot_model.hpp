#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// Mass properties of a body in some frame.
struct Inertial {
  double mass = 0.0;                                  // [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // [m] centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // [kg m²] about the centre of mass

  /// Inertia about the frame's origin: I + m·(|c|²·1 − c·cᵀ).
  Eigen::Matrix3d about_origin() const;
};

/// The same body seen from frame a, given in frame b.
Inertial operator*(const Eigen::Isometry3d& X_a_b, const Inertial& b);
/// Two bodies of one frame joined rigidly (a payload in a hand, say).
Inertial operator+(const Inertial& a, const Inertial& b);

/// One shape of a body, as the URDF gives it.
struct Geometry {
  /// Kind of shape. A capsule is only touched: to be seen it is a cylinder and two spheres.
  enum class Type { box, cylinder, sphere, mesh, capsule };

  Type type = Type::sphere;                                        // kind of shape
  Eigen::Isometry3d X_body_shape = Eigen::Isometry3d::Identity();  // pose in the body
  /// [m] box: edges; cylinder: radius, -, length; sphere: radius; capsule: radius, -, length between its centres
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::string mesh;                                 // absolute path of the mesh file
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // of the mesh
  Eigen::Vector4d colour{0.8, 0.8, 0.8, 1.0};       // RGBA 0…1 (visuals)
  bool has_colour = false;  // the URDF gives it; else a mesh file's own colours hold
  std::string link;         // the URDF link it belongs to
};

/// A rigid body that moves with one joint: the URDF link behind the joint and every link fixed to
/// it. Its frame is the URDF link's, hence the joint's.
struct Body {
  std::string link;                  // name of the URDF link behind the joint
  Inertial inertial;                 // all fixed links together, in the body frame
  std::vector<Geometry> visuals;     // to be seen
  std::vector<Geometry> collisions;  // to be touched
};

/// A joint with one degree of freedom, moving body i against its parent body.
struct Joint {
  /// Turns between limits, turns without end, or slides.
  enum class Type { revolute, continuous, prismatic };

  std::string name;            // in the URDF
  Type type = Type::revolute;  // how it moves
  int parent = -1;             // index of the parent body, -1: the base
  /// Pose of the body in its parent at q = 0.
  Eigen::Isometry3d X_parent_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit, in the body frame
  double lower = 0.0;                               // [rad or m]; -infinity if continuous
  double upper = 0.0;                               // [rad or m]; infinity if continuous
  double speed = 0.0;   // [rad/s or m/s]; infinity if continuous and without a limit
  double effort = 0.0;  // [N·m or N]; likewise

  // What stands between drive and body, ≥ 0: see Robot, which simulates it, and ComputedTorque, which makes up for it.
  double damping = 0.0;        // [N·m·s/rad or N·s/m] b, viscous friction; the URDF's damping
  double friction = 0.0;       // [N·m or N] c, Coulomb friction; the URDF's friction
  double rotor_inertia = 0.0;  // [kg m² or kg] J as the joint feels it: gear ratio² × the rotor's
  double stiffness =
      std::numeric_limits<double>::infinity();  // [N·m/rad or N/m] k of an elastic joint
  double spring_damping = 0.0;                  // [N·m·s/rad or N·s/m] d beside this spring

  // A follower (URDF's mimic) is a joint like any other, with a torque of its own; it belongs at
  // q = multiplier·q_leader + offset.
  int leader = -1;          // joint that it follows, which follows none itself; -1: none
  double multiplier = 1.0;  // [its unit over the leader's]
  double offset = 0.0;      // [rad or m]

  bool follows() const { return leader >= 0; }  // a leader
  /// There is a spring between its motor and its body.
  bool is_elastic() const { return stiffness < std::numeric_limits<double>::infinity(); }
  /// Pose of the body in its parent at q [rad or m].
  Eigen::Isometry3d X_parent_body_at(double q) const;
};

/// A named frame (any URDF link) on a body; index -1 is the base.
struct Frame {
  std::string name;                                                // of the link
  int body = -1;                                                   // that carries it
  Eigen::Isometry3d X_body_frame = Eigen::Isometry3d::Identity();  // pose in the body
};

/// How a URDF is read.
struct UrdfSettings {
  std::vector<std::string> package_path;  // folders that hold packages, or are one: looked in first
  bool leave_out_missing_meshes = false;  // instead of refusing the robot
};

/// A fixed-base robot as plain data, read from a URDF and checked. Links behind fixed joints are
/// merged into the body that carries them, so that body i, joint i and degree of freedom i are one
/// index everywhere; the merged links remain as frames. Parents come before their children,
/// branches in the order of the URDF's <joint> elements.
struct RobotModel {
  std::string name;           // in the URDF
  Body base;                  // fixed to the world; needs no mass
  std::vector<Joint> joints;  // joint i moves body i
  std::vector<Body> bodies;   // parents before children
  std::vector<Frame> frames;  // one per URDF link, the root link first

  /// Left out, a line each: link, name, where the file was looked for.
  std::vector<std::string> missing_meshes;
  /// What is odd about the URDF, and what was done about it: a line each, as in
  /// `link "b": mass 1e-20 kg: taken for none`.
  std::vector<std::string> warnings;

  int dof() const { return static_cast<int>(joints.size()); }  // n
  bool is_elastic() const;                                     // a joint is
  /// @throws Error  no joint of that name (lists those there are)
  int joint(const std::string& joint_name) const;
  /// @throws Error  no link of that name
  const Frame& frame(const std::string& link_name) const;

  /// Puts every follower where its leader has it. Neither allocates nor throws.
  void place_followers(Eigen::Ref<Eigen::VectorXd> q) const noexcept;
  /// Where a robot begins: each joint at 0 or the limit next to it, followers where that has them.
  Eigen::VectorXd neutral() const;
  /// Inertia that each joint moves at q while the others are at rest [kg m² or kg], without rotors: the diagonal of M(q).
  Eigen::VectorXd moved_inertia(const Eigen::VectorXd& q) const;

  /// Reads a URDF tree of revolute, continuous, prismatic and fixed joints.
  ///
  /// A joint with <mimic> follows (see Joint); where it mimics a follower, it follows that one's leader.
  ///
  /// A link without inertial, or with one of mass 0, has none (as in Bullet; other readers take the former for 1 kg); one
  /// of some mass with an inertia of zeros is a point. Where a joint moves such links alone (the "dummy links" of a
  /// wrist), what is behind them must make up for it: the joints' inertia matrix, scaled to a diagonal of ones, must
  /// have no eigenvalue below 1e-5 in 100 random positions within the limits. Where that fails, the heaviest point that is
  /// turned gets the inertia of a ball of water of its mass, with a warning, and then the next, as long as it helps. Where
  /// it fails in special positions only (300 with joints at 0, at right angles and at limits, such as a wrist without mass
  /// that is stretched), a warning says so: there, accelerations have no bound.
  ///
  /// Refused, with file, element and value, is what cannot be simulated: XML and numbers that cannot be read, or are not
  /// finite; xacro that is not expanded; links that are not in one tree, named twice, or not there; a type of joint that
  /// neither URDF nor Bullet knows; a zero axis; moving bodies whose mass, with all that is fixed to them, is negative;
  /// moving bodies without mass that leave the joints' inertia matrix singular in most positions, or with a negative moment
  /// that makes it negative in any; masses and moments beyond 1e15, distances and position limits beyond 1e9; and a mesh
  /// file that is not found, unless the settings leave it out. The base is fixed: its mass and inertia move nothing.
  ///
  /// Everything else that is odd is taken in, and told in `warnings`:
  /// - inertia of a link: moments that are negative by rounding (1e-6 of the largest, or a gyration of 1 µm) are taken for 0; others that are
  ///   negative, or break the triangle rule, and masses < 0 are counted as they are: what matters is the body that the link
  ///   is part of. Products that are missing are 0, a mass without inertia is a point, less than 1e-15 kg is no mass;
  /// - joints that move nothing with mass (finger pads), and spherical, floating and planar joints, are held where they
  ///   are: they become fixed, at 0 or at the limit next to it;
  /// - lower > upper means no limit, as in Bullet; so do missing limits, and a negative effort or speed. A revolute joint
  ///   without position limits is continuous;
  /// - a joint that mimics itself, in a ring, or one that does not move, follows none; negative damping or friction is 0;
  /// - `<capsule>`, which URDF lacks, is Bullet's along z; other unknown shapes, and those of size or scale ≤ 0, are left out;
  /// - a robot without a name is called after its file; of materials of one name the first counts, those that say nothing
  ///   are left out; of vectors of too many numbers the first count; a scale of one number is that of all axes, a colour of
  ///   three is opaque.
  ///
  /// A continuous joint may go without <limit>. Not read: <safety_controller>, <calibration>, <transmission>, textures; an undefined material counts as none. Mesh names may
  /// be `package://NAME/…` (folders of `package_path`, then ROS_PACKAGE_PATH, then the folders
  /// above the URDF, which may be the package or hold it), `file://…`, or relative to the URDF.
  /// @throws Error
  static RobotModel read(const std::string& urdf_path, const UrdfSettings& settings = {});
};

}  // namespace seam
