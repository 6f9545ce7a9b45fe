#include "scenes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "plugin/files/src/sequence_entry.hpp"
#include <seam/controller.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double most_seconds = 3600.0;

void read_steps(const YamlEntry& entry, Scene& scene) {
  if (const auto start = entry.find("start"))
    start->fail("not known in a scene, which begins at the robot's start");
  SequenceFile file = read_sequence(
      entry, [&](const Primitive& primitive) { require_reachable(primitive, scene.robot); });
  scene.sequence = std::move(file.sequence);
  scene.primitive_names = std::move(file.primitives);
}

void read_robot(const YamlEntry& entry, Scene& scene) {
  entry.only({"urdf", "start"});
  const YamlEntry urdf = entry.at("urdf");
  scene.robot = at_key(urdf, [&] { return RobotModel::read(urdf.path()); });
  scene.start.setZero(scene.robot.dof());
  const auto start = entry.find("start");
  if (!start) return;
  for (const auto& [name, position] : start->entries()) {
    const int i = at_key(position, [&, joint = name] { return scene.robot.joint(joint); });
    const Joint& joint = scene.robot.joints[static_cast<std::size_t>(i)];
    scene.start(i) = position.number();
    if (scene.start(i) < joint.lower || scene.start(i) > joint.upper)
      position.fail(position.text() + ", must be in " + std::to_string(joint.lower) + " to " +
                    std::to_string(joint.upper));
  }
}

double read_tick(const YamlEntry& entry, const ControlSettings& control) {
  const double dt = entry.positive();
  if (dt < least_tick || dt > largest_tick) entry.fail(entry.text() + ", must be in 1e-6 to 0.1 s");
  if (!control.stable_at(dt)) entry.fail(entry.text() + ", is too long for the control gains");
  return dt;
}

ControlSettings read_control(const YamlEntry& entry) {
  entry.only({"Kp", "Kd", "reference"});
  ControlSettings control;
  if (const auto Kp = entry.find("Kp")) control.Kp = Kp->not_negative();
  if (const auto Kd = entry.find("Kd")) control.Kd = Kd->not_negative();
  if (const auto reference = entry.find("reference")) {
    if (reference->text() == "plain")
      control.reference = ControlSettings::Reference::plain;
    else if (reference->text() != "matched")
      reference->fail("\"" + reference->text() + "\", must be matched or plain");
  }
  return control;
}

}  // namespace

int Scene::ticks(double step) const {
  return static_cast<int>(std::lround((sequence.duration() + settle) / step));
}

Scene Scene::read(const std::string& path) {
  const YamlEntry root = YamlEntry::read(path);
  root.require_format("seam-scene", 1);
  root.only({"format", "title", "robot", "sequence", "control", "dt", "settle", "figure"});
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  scene.title = root.at("title").text();
  read_robot(root.at("robot"), scene);
  read_steps(root.at("sequence"), scene);
  if (const auto control = root.find("control")) scene.control = read_control(*control);
  if (const auto dt = root.find("dt")) scene.dt = read_tick(*dt, scene.control);
  if (const auto settle = root.find("settle")) {
    scene.settle = settle->not_negative();
    if (scene.settle > most_seconds) settle->fail(settle->text() + ", must be <= 3600 s");
  }
  if (!(scene.sequence.duration() < most_seconds))
    root.at("sequence").fail("has no end that is known beforehand, or one beyond 3600 s");
  const YamlEntry figure = root.at("figure");
  scene.figure = figure.text();
  at_key(figure, [&] { return scene.robot.joint(scene.figure); });
  const auto& moved = scene.sequence.coordinates();
  if (std::find(moved.begin(), moved.end(), scene.figure) == moved.end())
    figure.fail("\"" + scene.figure + "\", is moved by no primitive");
  return scene;
}

}  // namespace seam
