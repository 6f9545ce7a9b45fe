#include "scenes/scene.hpp"

#include <cmath>
#include <filesystem>
#include <map>

#include "scenes/yaml_reader.hpp"
#include <seam/demonstration.hpp>
#include <seam/error.hpp>
#include <seam/learn.hpp>

namespace seam {

namespace {

// What a reader of the library refuses is refused at the key that named it.
template <typename Action>
auto at_key(const YamlEntry& entry, Action action) {
  try {
    return action();
  } catch (const Error& error) {
    entry.fail(error.what());
  }
}

Gains read_gains(const YamlEntry& entry) {
  entry.only({"K", "D", "H"});
  Gains gains = Gains::critical(entry.at("K").positive());
  if (const auto D = entry.find("D")) gains.D = D->positive();
  if (const auto H = entry.find("H")) gains.H = H->positive();
  return gains;
}

Primitive read_primitive(const YamlEntry& entry) {
  entry.only({"demonstration", "kernels", "width", "alpha", "gains", "window"});
  LearnSettings settings;
  DerivativeSettings derivatives;
  if (const auto kernels = entry.find("kernels")) settings.kernels = kernels->count(2);
  if (const auto width = entry.find("width")) settings.width = width->positive();
  if (const auto alpha = entry.find("alpha")) settings.alpha = alpha->positive();
  if (const auto gains = entry.find("gains")) settings.gains = read_gains(*gains);
  if (const auto window = entry.find("window")) derivatives.window = window->not_negative();
  const YamlEntry file = entry.at("demonstration");
  return at_key(file,
                [&] { return learn(Demonstration::read(file.path(), derivatives), settings); });
}

Switch read_switch(const YamlEntry& entry) {
  entry.only({"after", "before_end"});
  const auto time = entry.find("after");
  const auto rest = entry.find("before_end");
  if (time && rest) entry.fail("must have one of after, before_end, not both");
  return time ? after(time->positive()) : before_end(entry.at("before_end").not_negative());
}

void read_sequence(const YamlEntry& entry, const std::map<std::string, Primitive>& primitives,
                   Scene& scene) {
  entry.only({"start_after", "steps"});
  if (const auto delay = entry.find("start_after"))
    scene.sequence.start_after(delay->not_negative());
  for (const YamlEntry& step : entry.at("steps").items()) {
    step.only({"play", "until"});
    const YamlEntry play = step.at("play");
    const auto primitive = primitives.find(play.text());
    if (primitive == primitives.end())
      play.fail("\"" + play.text() + "\", is not among the primitives");
    at_key(play, [&] { scene.sequence.then(primitive->second); });
    if (const auto until = step.find("until")) {
      const Switch when = read_switch(*until);
      at_key(*until, [&] { scene.sequence.until(when); });
    }
    scene.primitive_names.push_back(play.text());
  }
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
  root.only(
      {"format", "title", "robot", "primitives", "sequence", "control", "dt", "settle", "figure"});
  const YamlEntry format = root.at("format");
  if (format.text() != "seam-scene 1")
    format.fail("\"" + format.text() + "\", must be seam-scene 1");
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  scene.title = root.at("title").text();
  read_robot(root.at("robot"), scene);
  std::map<std::string, Primitive> primitives;
  for (const auto& [name, entry] : root.at("primitives").entries())
    primitives.emplace(name, read_primitive(entry));
  read_sequence(root.at("sequence"), primitives, scene);
  if (const auto control = root.find("control")) scene.control = read_control(*control);
  if (const auto dt = root.find("dt")) scene.dt = dt->positive();
  if (const auto settle = root.find("settle")) scene.settle = settle->not_negative();
  const YamlEntry figure = root.at("figure");
  scene.figure = figure.text();
  at_key(figure, [&] { return scene.robot.joint(scene.figure); });
  return scene;
}

}  // namespace seam
