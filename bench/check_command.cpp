#include "bench/check_command.hpp"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/check.hpp"
#include "bench/markdown.hpp"
#include "scenes/own_folders.hpp"

namespace seam {

namespace {

struct Options {
  std::string urdf;
  UrdfSettings reading;
  CheckSettings check;
};

const char* name_of(Joint::Type type) {
  switch (type) {
    case Joint::Type::revolute:
      return "revolute";
    case Joint::Type::continuous:
      return "continuous";
    default:
      return "prismatic";
  }
}

const std::string& link_of(const RobotModel& robot, int body) {
  return body < 0 ? robot.base.link : robot.bodies[static_cast<std::size_t>(body)].link;
}

std::string limits_of(const Joint& joint) {
  if (std::isinf(joint.lower) && std::isinf(joint.upper)) return "none";
  if (joint.type == Joint::Type::prismatic)
    return fmt::format("{:.4g} to {:.4g} m", joint.lower, joint.upper);
  return fmt::format("{:.3f} to {:.3f} rad ({:.0f} to {:.0f}°)", joint.lower, joint.upper,
                     joint.lower * 180.0 / M_PI, joint.upper * 180.0 / M_PI);
}

std::string with_unit(double limit, const char* unit) {
  return std::isfinite(limit) ? fmt::format("{:.4g} {}", limit, unit) : "none";
}

std::string leader_of(const RobotModel& robot, const Joint& joint) {
  if (!joint.follows()) return "";
  const std::string& leader = robot.joints[static_cast<std::size_t>(joint.leader)].name;
  return fmt::format("{:g} {}{}", joint.multiplier, leader,
                     joint.offset == 0.0 ? "" : fmt::format(" {:+g}", joint.offset));
}

std::string joints_table(const RobotModel& robot, const RobotCheck& check) {
  Rows rows{{"joint", "type", "moves", "limits", "speed", "effort", "to hold up", "damping",
             "friction", "follows"}};
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const bool linear = joint.type == Joint::Type::prismatic;
    rows.push_back({joint.name, name_of(joint.type),
                    link_of(robot, joint.parent) + " → " + link_of(robot, i), limits_of(joint),
                    with_unit(joint.speed, linear ? "m/s" : "rad/s"),
                    with_unit(joint.effort, linear ? "N" : "N·m"),
                    fmt::format("{:.0f} %", 100.0 * check.holding(i) / joint.effort),
                    with_unit(joint.damping, linear ? "N·s/m" : "N·m·s/rad"),
                    with_unit(joint.friction, linear ? "N" : "N·m"), leader_of(robot, joint)});
    if (!(joint.effort > 0.0)) rows.back()[6] = "n/a";
  }
  return markdown(rows, 4);
}

std::string numbers(const Eigen::Vector3d& v, const char* format) {
  std::string text;
  for (const double x : v) text += (text.empty() ? "" : " ") + shown(x, format);
  return text;
}

std::string bodies_table(const RobotModel& robot, const RobotCheck& check) {
  Rows rows{{"link, with what is fixed to it", "mass [kg]", "centre of mass [m]",
             "moments of inertia [kg m²]", "gyration [m]", "shape [m]", "density [kg/m³]"}};
  for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
    const Inertial& inertial = robot.bodies[i].inertial;
    const BodyFigures& body = check.bodies[i];
    auto& row = rows.emplace_back();
    row.push_back(robot.bodies[i].link);
    if (inertial.mass > 0.0)
      row.insert(row.end(), {shown(inertial.mass, "{:.4g}"), numbers(inertial.com, "{:.3f}"),
                             numbers(body.moments, "{:.2g}"), shown(body.gyration(2), "{:.2g}")});
    else
      row.insert(row.end(), {"none", "", "", ""});
    row.push_back(body.box.isEmpty() ? "none" : numbers(body.box.sizes(), "{:.2f}"));
    row.push_back(body.density > 0.0 ? shown(body.density, "{:.0f}") : "");
  }
  return markdown(rows, 1);
}

const char* name_of(Verdict verdict) {
  return verdict == Verdict::ok ? "ok" : verdict == Verdict::warning ? "warning" : "FAILED";
}

std::string summary(const Check& check) {
  std::string text = fmt::format("{:<8} {}", check.name, check.figure);
  if (check.figure.empty())
    text += check.oddities.empty() ? "nothing odd"
                                   : fmt::format("{} to look at", check.oddities.size());
  text += fmt::format(": {}\n", name_of(check.verdict));
  for (const std::string& odd : check.oddities) text += fmt::format("         - {}\n", odd);
  return text;
}

void print(const RobotModel& robot, const RobotCheck& check, const std::string& urdf) {
  double mass = 0.0;
  for (const Body& body : robot.bodies) mass += body.inertial.mass;
  fmt::print("{} ({}): {} joints, {} links, {:.4g} kg move\n", robot.name, urdf, robot.dof(),
             robot.frames.size(), mass);
  if (robot.dof() > 0)
    fmt::print("\n{}\n{}", joints_table(robot, check), bodies_table(robot, check));
  fmt::print("\n");
  for (const Check& one : check.checks) fmt::print("{}", summary(one));
}

void look_over(const Options& options) {
  const RobotModel robot = RobotModel::read(own_or_given(options.urdf), options.reading);
  const RobotCheck check = check_robot(robot, options.check);
  print(robot, check, options.urdf);
  if (check.verdict() == Verdict::failed) throw CLI::RuntimeError(1);
}

}  // namespace

void add_check_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  options->reading.leave_out_missing_meshes = true;
  CLI::App& command = *app.add_subcommand("check", "look over a robot's URDF, on one page");
  command.add_option("robot", options->urdf, "URDF")->required();
  command
      .add_option("--package-path", options->reading.package_path,
                  "folder that is or holds a package of meshes; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--samples", options->check.samples, "random states within the limits")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options->check.seed, "of the random states")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.footer(
      "Exit code 1 if a mesh is missing, or Bullet does not make the accelerations that its "
      "inverse dynamics asks for "
      "to 1e-7 of the largest; warnings leave it at 0. Example: seam check "
      "arm_description/urdf/arm.urdf --package-path .");
  command.callback([options] { look_over(*options); });
}

}  // namespace seam
