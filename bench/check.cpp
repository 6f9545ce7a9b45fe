#include "bench/check.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <fmt/format.h>

#include "scenes/world.hpp"
#include <seam/inverse_dynamics.hpp>
#include <seam/robot.hpp>

namespace seam {

namespace {

constexpr double acceleration_bar = 1e-7;    // of the largest
constexpr double fastest = 4.0;              // [rad/s or m/s]
constexpr double hardest = 30.0;             // [rad/s² or m/s²]
constexpr double least_density = 10.0;       // [kg/m³]
constexpr double largest_density = 25000.0;  // [kg/m³]
constexpr double widest_gyration = 1.5;      // of the body's reach
constexpr double narrowest_gyration = 0.1;

class RandomStates {
 public:
  RandomStates(const RobotModel& robot, int seed)
      : robot_(robot), random_(static_cast<std::uint64_t>(seed)) {}

  double within(double low, double high) {
    return low + static_cast<double>(random_() >> 11) * 0x1p-53 * (high - low);
  }
  /// Within the limits; a joint that turns on and on stays within one turn to either side, one that slides so within 1 m.
  Eigen::VectorXd position() {
    return each([&](const Joint& joint) {
      const bool endless = std::isinf(joint.lower) || std::isinf(joint.upper);
      const double most = joint.type != Joint::Type::prismatic ? 2.0 * M_PI
                          : endless                            ? 1.0
                                                               : INFINITY;
      return within(std::max(joint.lower, std::min(-most, joint.upper)),
                    std::min(joint.upper, std::max(most, joint.lower)));
    });
  }
  /// Likewise, followers where their leaders have them.
  Eigen::VectorXd posture() {
    Eigen::VectorXd q = position();
    robot_.place_followers(q);
    return q;
  }
  Eigen::VectorXd velocity() {
    return each([&](const Joint& joint) {
      const double most = joint.speed > 0.0 ? std::min(joint.speed, fastest) : fastest;
      return within(-most, most);
    });
  }
  Eigen::VectorXd acceleration() {
    return each([&](const Joint&) { return within(-hardest, hardest); });
  }

 private:
  template <typename Value>
  Eigen::VectorXd each(Value value) {
    Eigen::VectorXd values(robot_.dof());
    for (int i = 0; i < robot_.dof(); ++i)
      values(i) = value(robot_.joints[static_cast<std::size_t>(i)]);
    return values;
  }

  const RobotModel& robot_;
  std::mt19937_64 random_;
};

RobotSettings without_shapes() {
  RobotSettings settings;
  settings.colliders = false;
  return settings;
}

// Accelerations asked of the inverse dynamics against those that a step of the world makes.
void compare_dynamics(const RobotModel& model, const CheckSettings& settings, RobotCheck& check) {
  const double dt = 1e-2;
  RobotSettings tilted = without_shapes();
  tilted.X_world_base.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  World world;
  Robot robot(model, *world, tilted);
  InverseDynamics dynamics(model);
  dynamics.set_gravity(robot.gravity_in_base());
  RandomStates random(model, settings.seed);
  Eigen::VectorXd q(model.dof()), before(model.dof()), after(model.dof()), torque(model.dof());
  for (int k = 0; k < settings.samples && model.dof() > 0; ++k) {
    const Eigen::VectorXd asked = random.acceleration();
    q = random.position();
    before = random.velocity();
    robot.reset(q, before);
    dynamics.torque(q, before, asked, torque);
    for (int i = 0; i < model.dof(); ++i) robot.multibody().addJointTorque(i, btScalar(torque(i)));
    world->stepSimulation(btScalar(dt), 0);
    robot.state(q, after);
    const double error = ((after - before) / dt - asked).cwiseAbs().maxCoeff();
    if (!(error <= check.acceleration_error)) check.acceleration_error = error;
    if (std::isnan(error)) return;
    check.largest_acceleration = std::max(check.largest_acceleration, asked.cwiseAbs().maxCoeff());
  }
}

Eigen::VectorXd holding_torque(const RobotModel& model, const CheckSettings& settings) {
  const InverseDynamics dynamics(model);
  RandomStates random(model, settings.seed);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.dof());
  Eigen::VectorXd torque = rest, most = rest;
  for (int k = 0; k < settings.samples; ++k) {
    dynamics.torque(random.posture(), rest, rest, torque);
    most = most.cwiseMax(torque.cwiseAbs());
  }
  return most;
}

// The last frame behind as many joints as any.
const Frame& tip_of(const RobotModel& model) {
  const auto joints_before = [&](const Frame& frame) {
    int count = 0;
    for (int i = frame.body; i >= 0; i = model.joints[static_cast<std::size_t>(i)].parent) ++count;
    return count;
  };
  const Frame* tip = &model.frames.front();
  for (const Frame& frame : model.frames)
    if (joints_before(frame) >= joints_before(*tip)) tip = &frame;
  return *tip;
}

void find_reach(const RobotModel& model, const CheckSettings& settings, RobotCheck& check) {
  World world;
  Robot robot(model, *world, without_shapes());
  const Frame& tip = tip_of(model);
  check.tip = tip.name;
  RandomStates random(model, settings.seed);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model.dof());
  for (int k = 0; k < settings.samples; ++k) {
    robot.reset(random.posture(), rest);
    const Eigen::Vector3d at = robot.X_world_frame(tip).translation();
    check.reached.extend(at);
    check.reach = std::max(check.reach, at.norm());
    check.mean_reach += at.norm() / settings.samples;
  }
}

void find_odd(Check& check, bool is_odd, const std::string& text) {
  if (!is_odd) return;
  check.verdict = std::max(check.verdict, Verdict::warning);
  check.oddities.push_back(text);
}

Check check_reading(const RobotModel& model) {
  Check check{"URDF", Verdict::ok, "", {}};
  for (const std::string& warning : model.warnings) find_odd(check, true, warning);
  return check;
}

Check check_limits(const RobotModel& model) {
  Check check{"limits", Verdict::ok, "", {}};
  for (const Joint& joint : model.joints) {
    const std::string here = "joint \"" + joint.name + "\": ";
    find_odd(
        check, joint.lower == joint.upper,
        here + fmt::format("lower and upper limit are both {:g}: it cannot move", joint.lower));
    find_odd(check, joint.effort == 0.0, here + "effort limit 0");
    find_odd(check, joint.speed == 0.0, here + "velocity limit 0");
    if (!joint.follows()) continue;
    const Joint& leader = model.joints[static_cast<std::size_t>(joint.leader)];
    const double ends[] = {joint.multiplier * leader.lower + joint.offset,
                           joint.multiplier * leader.upper + joint.offset};
    const double slack = 1e-3 * (joint.upper - joint.lower);
    find_odd(check,
             std::min(ends[0], ends[1]) < joint.lower - slack ||
                 std::max(ends[0], ends[1]) > joint.upper + slack,
             here + "\"" + leader.name + "\" takes it beyond its limits");
  }
  return check;
}

Check check_inertia(const RobotModel& model, const std::vector<BodyFigures>& bodies) {
  Check check{"inertia", Verdict::ok, "", {}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Inertial& inertial = model.bodies[i].inertial;
    const BodyFigures& body = bodies[i];
    if (!(inertial.mass > 0.0)) continue;
    const std::string here = "link \"" + model.bodies[i].link + "\": ";
    if (inertial.inertia.isIdentity(1e-12)) {
      find_odd(check, true, here + "inertia 1 1 1 kg m², which looks like a placeholder");
      continue;
    }
    if (body.box.isEmpty()) continue;
    const double widest = body.gyration(2);
    find_odd(check,
             widest > widest_gyration * body.reach || widest < narrowest_gyration * body.reach,
             here + fmt::format("radius of gyration {:.3g} m, its shape reaches {:.3g} m from its "
                                "centre of mass",
                                widest, body.reach));
    const double aside = body.box.exteriorDistance(inertial.com);
    find_odd(check, aside > 0.1 * body.box.diagonal().norm(),
             here + fmt::format("centre of mass {:.3g} m outside its shape", aside));
    find_odd(
        check,
        body.density > 0.0 && (body.density < least_density || body.density > largest_density),
        here + fmt::format("{:.3g} kg in its shape are {:.3g} kg/m³", inertial.mass, body.density));
  }
  return check;
}

Check check_meshes(const RobotModel& model, const MeshCatalogue& meshes) {
  Check check{"meshes", Verdict::ok, "", model.missing_meshes};
  int triangles = 0;
  std::size_t read = 0;
  for (const auto& [path, mesh] : meshes.files()) {
    triangles += mesh.triangles;
    if (mesh.unreadable.empty())
      ++read;
    else
      check.oddities.push_back(mesh.unreadable);
  }
  check.figure = fmt::format("{} files read, {} triangles", read, triangles);
  if (!check.oddities.empty()) check.verdict = Verdict::failed;
  return check;
}

Check check_dynamics(const RobotCheck& robot, const CheckSettings& settings) {
  const bool agrees = robot.acceleration_error <= acceleration_bar * robot.largest_acceleration;
  return {"dynamics",
          agrees || robot.bodies.empty() ? Verdict::ok : Verdict::failed,
          fmt::format("Bullet makes accelerations that the inverse dynamics asks for to {:.1e} "
                      "rad/s² or m/s², the largest is {:.1f} (bar {:g} of it, {} states, tilted "
                      "base)",
                      robot.acceleration_error, robot.largest_acceleration, acceleration_bar,
                      settings.samples),
          {}};
}

Check check_holding(const RobotModel& model, const RobotCheck& robot) {
  Check check{"holding", Verdict::ok, "", {}};
  for (int i = 0; i < model.dof(); ++i) {
    const Joint& joint = model.joints[static_cast<std::size_t>(i)];
    const bool linear = joint.type == Joint::Type::prismatic;
    find_odd(check, joint.effort > 0.0 && robot.holding(i) > joint.effort,
             fmt::format("joint \"{}\": up to {:.3g} {} to hold the robot up, it has {:.3g}",
                         joint.name, robot.holding(i), linear ? "N" : "N·m", joint.effort));
  }
  return check;
}

Check check_reach(const RobotCheck& robot) {
  Check check{"reach", Verdict::ok, "", {}};
  check.figure = fmt::format("link \"{}\" comes {:.3g} m from the root link, {:.3g} m on average",
                             robot.tip, robot.reach, robot.mean_reach);
  const char* const axes[] = {"x", "y", "z"};
  for (int d = 0; d < 3 && !robot.reached.isEmpty(); ++d)
    check.figure += fmt::format("{} {} {:.2f} to {:.2f}", d == 0 ? ":" : ",", axes[d],
                                robot.reached.min()(d), robot.reached.max()(d));
  return check;
}

}  // namespace

Verdict RobotCheck::verdict() const {
  Verdict worst = Verdict::ok;
  for (const Check& check : checks) worst = std::max(worst, check.verdict);
  return worst;
}

RobotCheck check_robot(const RobotModel& robot, const CheckSettings& settings) {
  RobotCheck check;
  body_figures(robot.base, check.meshes);  // reads its meshes
  for (const Body& body : robot.bodies) check.bodies.push_back(body_figures(body, check.meshes));
  compare_dynamics(robot, settings, check);
  check.holding = holding_torque(robot, settings);
  find_reach(robot, settings, check);
  check.checks = {check_reading(robot),
                  check_limits(robot),
                  check_inertia(robot, check.bodies),
                  check_meshes(robot, check.meshes),
                  check_dynamics(check, settings),
                  check_holding(robot, check),
                  check_reach(check)};
  return check;
}

}  // namespace seam
