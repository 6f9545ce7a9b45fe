#include "scenes/liquid.hpp"

#include <cmath>
#include <limits>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double lambda = 1.8411837813406593;
constexpr double g = 9.81;  // [m/s²]

void require(bool good, const char* what, double value, const char* limit) {
  if (!good || !std::isfinite(value))
    throw Error("liquid", std::string(what) + " " + std::to_string(value) + ", must be " + limit);
}

void validate(const LiquidSettings& liquid) {
  require(liquid.radius > 0.0, "radius", liquid.radius, "> 0");
  require(liquid.depth > 0.0, "depth", liquid.depth, "> 0");
  require(liquid.rim >= 0.0, "rim", liquid.rim, ">= 0");
  require(liquid.density > 0.0, "density", liquid.density, "> 0");
  require(liquid.viscosity > 0.0, "viscosity", liquid.viscosity, "> 0");
  require(liquid.glass >= 0.0, "glass", liquid.glass, ">= 0");
}

double logarithmic_decrement(const LiquidSettings& liquid) {
  const double deep = lambda * liquid.depth / liquid.radius;
  const double shallow =
      0.318 / std::sinh(deep) * (1.0 + (1.0 - liquid.depth / liquid.radius) / std::cosh(deep));
  return 4.98 * std::sqrt(liquid.viscosity) * std::pow(liquid.radius, -0.75) * std::pow(g, -0.25) *
         (1.0 + shallow);
}

// A thin wall without a bottom.
Inertial wall(const LiquidSettings& liquid) {
  const double height = liquid.depth + liquid.rim;
  const double r2 = liquid.radius * liquid.radius;
  const double across = liquid.glass * (0.5 * r2 + height * height / 12.0);
  const Eigen::Vector3d moments(across, across, liquid.glass * r2);
  return {liquid.glass, {0.0, 0.0, 0.5 * height}, moments.asDiagonal()};
}

Inertial point(double mass, double height) {
  return {mass, {0.0, 0.0, height}, Eigen::Matrix3d::Zero()};
}

// All of the liquid but m₁; it has the inertia across the axis that the whole has when it is frozen.
Inertial fixed_part(const LiquidSettings& liquid) {
  const Slosh slosh(liquid);
  const double mass = slosh.mass - slosh.modal_mass;
  const double height =
      (0.5 * slosh.mass * liquid.depth - slosh.modal_mass * slosh.modal_height) / mass;
  const double about_bottom =
      slosh.mass * (0.25 * liquid.radius * liquid.radius + liquid.depth * liquid.depth / 3.0);
  const double across = about_bottom - mass * height * height -
                        slosh.modal_mass * slosh.modal_height * slosh.modal_height;
  const Eigen::Vector3d moments(across, across, 0.0);
  return {mass, {0.0, 0.0, height}, moments.asDiagonal()};
}

Inertial& carrier(RobotModel& robot, const Frame& frame) {
  if (frame.body < 0) throw Error("liquid", "link \"" + frame.name + "\" does not move");
  return robot.bodies[static_cast<std::size_t>(frame.body)].inertial;
}

void add_slider(RobotModel& robot, const char* name, int parent, const Eigen::Isometry3d& X,
                const Eigen::Vector3d& axis, const Inertial& inertial) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  Joint joint;
  joint.name = name;
  joint.type = Joint::Type::prismatic;
  joint.parent = parent;
  joint.X_parent_body = X;
  joint.axis = axis;
  joint.lower = -unlimited;
  joint.upper = joint.speed = joint.effort = unlimited;
  robot.joints.push_back(joint);
  robot.bodies.push_back({name, inertial, {}, {}});
}

}  // namespace

Slosh::Slosh(const LiquidSettings& liquid) {
  validate(liquid);
  const double R = liquid.radius;
  const double h = liquid.depth;
  const double t = std::tanh(lambda * h / R);
  mass = M_PI * R * R * h * liquid.density;
  frequency = std::sqrt(g * lambda / R * t);
  damping = logarithmic_decrement(liquid) / (2.0 * M_PI);
  modal_mass = mass * 2.0 * R * t / (lambda * h * (lambda * lambda - 1.0));
  modal_height = h - 2.0 * R / lambda * std::tanh(0.5 * lambda * h / R);
  wave_per_shift = 2.0 * lambda * t / (lambda * lambda - 1.0);
}

Inertial frozen(const LiquidSettings& liquid) {
  const Slosh slosh(liquid);
  return wall(liquid) + fixed_part(liquid) + point(slosh.modal_mass, slosh.modal_height);
}

void add_liquid(RobotModel& robot, const std::string& link, const Eigen::Isometry3d& X_link_glass,
                const LiquidSettings& liquid) {
  const Slosh slosh(liquid);
  const Frame frame = robot.frame(link);
  const Eigen::Isometry3d X_body_glass = frame.X_body_frame * X_link_glass;
  Inertial& body = carrier(robot, frame);
  body = body + X_body_glass * (wall(liquid) + fixed_part(liquid));
  const Eigen::Isometry3d at_mode = X_body_glass * Eigen::Translation3d(0, 0, slosh.modal_height);
  add_slider(robot, "slosh_x", frame.body, at_mode, Eigen::Vector3d::UnitX(), {});
  add_slider(robot, "slosh_y", robot.dof() - 1, Eigen::Isometry3d::Identity(),
             Eigen::Vector3d::UnitY(), point(slosh.modal_mass, 0.0));
}

void add_frozen_liquid(RobotModel& robot, const std::string& link,
                       const Eigen::Isometry3d& X_link_glass, const LiquidSettings& liquid) {
  const Frame frame = robot.frame(link);
  Inertial& body = carrier(robot, frame);
  body = body + frame.X_body_frame * X_link_glass * frozen(liquid);
}

// The surface A·J₁(λρ)/J₁(λ)·cos θ, integrated by the midpoint rule.
double share_above_rim(const LiquidSettings& liquid, double wave) {
  constexpr int rings = 200;
  constexpr int sectors = 400;
  double volume = 0.0;  // of R²
  for (int i = 0; i < rings; ++i) {
    const double rho = (i + 0.5) / rings;
    const double height =
        wave * std::cyl_bessel_j(1.0, lambda * rho) / std::cyl_bessel_j(1.0, lambda);
    for (int k = 0; k < sectors; ++k) {
      const double eta = height * std::cos(2.0 * M_PI * (k + 0.5) / sectors);
      volume += rho * std::max(eta - liquid.rim, 0.0);
    }
  }
  return volume * 2.0 / (rings * sectors) / liquid.depth;
}

Liquid::Liquid(Robot& robot, const LiquidSettings& settings) : robot_(robot), slosh_(settings) {
  const auto& joints = robot.model().joints;
  if (joints.size() < 2 || joints.back().name != "slosh_y")
    throw Error("liquid", "was not added to the robot");
}

void Liquid::pre_tick() noexcept {
  btMultiBody& multibody = robot_.multibody();
  for (int axis = 0; axis < 2; ++axis) {
    const int i = robot_.dof() - 2 + axis;
    const double shift = multibody.getJointPos(i);
    waves_(axis) = slosh_.wave_per_shift * shift;
    multibody.addJointTorque(
        i, -slosh_.modal_mass * slosh_.frequency *
               (slosh_.frequency * shift + 2.0 * slosh_.damping * multibody.getJointVel(i)));
  }
}

}  // namespace seam
