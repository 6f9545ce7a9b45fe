#include "scenes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include "plugin/files/src/sequence_entry.hpp"
#include <seam/controller.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double most_seconds = 3600.0;

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

ToolSettings read_tool(const YamlEntry& entry, const Scene& scene) {
  entry.only({"link", "offset", "turned", "orientation"});
  ToolSettings tool;
  const YamlEntry link = entry.at("link");
  tool.link = link.text();
  at_key(link, [&] { return scene.robot.frame(tool.link).body; });
  if (const auto offset = entry.find("offset"))
    tool.X_link_tool.translation() = offset->numbers(3, "direction");
  if (const auto turned = entry.find("turned"))
    tool.X_link_tool.linear() = turned->orientation().toRotationMatrix();
  tool.orientation = Eigen::Quaterniond::Identity();
  if (const auto orientation = entry.find("orientation"))
    tool.orientation = orientation->orientation();
  tool.posture.rest = scene.start;
  return tool;
}

LiquidSettings read_liquid_settings(const YamlEntry& entry) {
  LiquidSettings liquid;
  const auto set = [&](const char* key, double& value) {
    if (const auto given = entry.find(key)) value = given->not_negative();
  };
  set("radius", liquid.radius);
  set("depth", liquid.depth);
  set("rim", liquid.rim);
  set("density", liquid.density);
  set("viscosity", liquid.viscosity);
  set("glass", liquid.glass);
  return liquid;
}

// In a glass that the tool holds upright.
void read_liquid(const YamlEntry& entry, Scene& scene) {
  entry.only({"bottom", "radius", "depth", "rim", "density", "viscosity", "glass", "frozen"});
  if (!scene.tool) entry.fail("needs a tool that holds it");
  const LiquidSettings liquid = read_liquid_settings(entry);
  const Eigen::Isometry3d X_link_glass =
      scene.tool->X_link_tool * Eigen::Translation3d(entry.at("bottom").numbers(3, "direction"));
  const auto still = entry.find("frozen");
  at_key(entry, [&] {
    const std::string& link = scene.tool->link;
    add_frozen_liquid(scene.robot, link, X_link_glass, liquid);
    if (still && still->choice({"no", "yes"}) == 1) {
      scene.simulated = scene.robot;
      return;
    }
    scene.liquid = liquid;
    add_liquid(scene.simulated, link, X_link_glass, liquid);
  });
}

VesselSettings read_vessel(const YamlEntry& entry, const char* where) {
  entry.only({where, "radius", "height", "wall", "mass"});
  VesselSettings vessel;
  const auto set = [&](const char* key, double& value) {
    if (const auto given = entry.find(key)) value = given->positive();
  };
  set("radius", vessel.radius);
  set("height", vessel.height);
  set("wall", vessel.wall);
  set("mass", vessel.mass);
  return vessel;
}

GrainSettings read_grains(const YamlEntry& entry) {
  entry.only({"count", "radius", "mass", "friction", "restitution", "frozen"});
  GrainSettings grains;
  if (const auto count = entry.find("count")) grains.count = count->count(1);
  if (const auto radius = entry.find("radius")) grains.radius = radius->positive();
  if (const auto mass = entry.find("mass")) grains.mass = mass->positive();
  if (const auto friction = entry.find("friction")) grains.friction = friction->not_negative();
  if (const auto bounce = entry.find("restitution")) grains.restitution = bounce->not_negative();
  return grains;
}

void read_pouring(const YamlEntry& entry, Scene& scene) {
  entry.only({"bottle", "grains", "glass", "places"});
  if (!scene.tool) entry.fail("needs a tool that holds the bottle");
  Pouring pouring;
  const YamlEntry bottle = entry.at("bottle");
  const YamlEntry glass = entry.at("glass");
  pouring.bottle = read_vessel(bottle, "bottom");
  pouring.glass = read_vessel(glass, "at");
  pouring.X_link_bottle =
      scene.tool->X_link_tool * Eigen::Translation3d(bottle.at("bottom").numbers(3, "direction"));
  pouring.glass_at = glass.at("at").numbers(3, "direction");
  if (const auto grains = entry.find("grains")) pouring.grains = read_grains(*grains);
  pouring.places = {Eigen::Vector3d::Zero()};
  if (const auto places = entry.find("places"))
    for (const YamlEntry& place : places->items())
      pouring.places.emplace_back(place.numbers(3, "direction"));
  const auto grains = entry.find("grains");
  const auto still = grains ? grains->find("frozen") : std::nullopt;
  const bool frozen = still && still->choice({"no", "yes"}) == 1;
  if (frozen) pouring.bottle.mass += pouring.grains.count * pouring.grains.mass;
  at_key(entry, [&] {
    for (RobotModel* robot : {&scene.robot, &scene.simulated})
      add_vessel(*robot, scene.tool->link, pouring.X_link_bottle, pouring.bottle);
  });
  if (!frozen) scene.pouring = std::move(pouring);
}

std::unique_ptr<JointReference> reference(const Scene& scene, const Primitive& primitive) {
  if (!scene.tool) return std::make_unique<JointSpace>(scene.robot, primitive.coordinates);
  return std::make_unique<TaskSpace>(scene.robot, Sequence().then(primitive), *scene.tool,
                                     scene.start);
}

void read_steps(const YamlEntry& entry, Scene& scene) {
  if (const auto start = entry.find("start"))
    start->fail("not known in a scene, which begins at the robot's start");
  SequenceFile file = read_sequence(entry, [&](const Primitive& primitive) {
    reference(scene, primitive)->require_reachable(primitive);
  });
  scene.sequence = std::move(file.sequence);
  scene.primitive_names = std::move(file.primitives);
}

// Where the first primitive's demonstration began.
void start_with_tool(const YamlEntry& entry, Scene& scene) {
  const Primitive& first = scene.sequence.steps().front().primitive;
  TaskSpace space(scene.robot, scene.sequence, *scene.tool, scene.start);
  at_key(entry, [&] { scene.start = space.reach(space.pose(first.start_position)); });
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

double at_most(const YamlEntry& entry, double seconds) {
  if (seconds > most_seconds) entry.fail(entry.text() + ", must be <= 3600 s");
  return seconds;
}

double read_duration(const YamlEntry& root, const Sequence& sequence) {
  const auto settle = root.find("settle");
  if (const auto duration = root.find("duration")) {
    if (settle) settle->fail("has no meaning beside duration");
    return at_most(*duration, duration->positive());
  }
  if (!(sequence.duration() < most_seconds))
    root.at("sequence")
        .fail("has no end that is known beforehand, or one beyond 3600 s: needs the key duration");
  return sequence.duration() + (settle ? at_most(*settle, settle->not_negative()) : 1.0);
}

}  // namespace

namespace {

// A sequence of which every step is changed somehow.
Sequence changed(const Sequence& from, double start_delay,
                 const std::function<void(Sequence::Step&)>& change) {
  Sequence to;
  to.start_after(start_delay);
  for (Sequence::Step step : from.steps()) {
    change(step);
    const bool rhythmic = step.primitive.kind == Kind::rhythmic;
    to.then(std::move(step.primitive));
    if (rhythmic) to.enter(step.entry);
    to.until(step.until);
  }
  return to;
}

}  // namespace

Sequence Scene::sequence_at(std::size_t place) const {
  if (place == 0) return sequence;
  return changed(sequence, sequence.start_delay(), [&](Sequence::Step& step) {
    step.primitive.goal.head<3>() += pouring->places[place];
  });
}

void Scene::hasten(double factor) {
  if (!(std::isfinite(factor) && factor > 0.0))
    throw Error(name, "speed " + std::to_string(factor) + ", must be > 0");
  sequence = changed(sequence, sequence.start_delay() / factor, [&](Sequence::Step& step) {
    step.primitive.tau /= factor;
    step.primitive.start_velocity *= factor;
    step.primitive.start_acceleration *= factor * factor;
    const auto when = step.until.when;
    if (when == Switch::When::after || when == Switch::When::before_end) step.until.value /= factor;
  });
  for (Event& event : events) {
    event.at /= factor;
    event.over /= factor;
    if (event.what == Event::What::tau) event.value /= factor;
  }
  duration /= factor;
}

int Scene::ticks(double step) const {
  return static_cast<int>(std::lround(duration / step));
}

Scene Scene::read(const std::string& path) {
  const YamlEntry root = YamlEntry::read(path);
  root.require_format("seam-scene", 1);
  root.only({"format", "title", "robot", "tool", "liquid", "pouring", "sequence", "events",
             "control", "seed", "dt", "settle", "duration", "figure"});
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  scene.title = root.at("title").text();
  read_robot(root.at("robot"), scene);
  const auto tool = root.find("tool");
  if (tool) scene.tool = read_tool(*tool, scene);
  scene.simulated = scene.robot;
  if (const auto liquid = root.find("liquid")) read_liquid(*liquid, scene);
  if (const auto pouring = root.find("pouring")) read_pouring(*pouring, scene);
  read_steps(root.at("sequence"), scene);
  if (tool) start_with_tool(*tool, scene);
  if (const auto control = root.find("control")) scene.control = read_control(*control);
  if (const auto dt = root.find("dt")) scene.dt = read_tick(*dt, scene.control);
  if (const auto seed = root.find("seed")) scene.seed = seed->count(0);
  if (const auto events = root.find("events"))
    scene.events = read_events(*events, scene.sequence.coordinates(), scene.seed);
  scene.duration = read_duration(root, scene.sequence);
  const YamlEntry figure = root.at("figure");
  scene.figure = figure.text();
  const auto& moved = scene.sequence.coordinates();
  if (std::find(moved.begin(), moved.end(), scene.figure) == moved.end())
    figure.fail("\"" + scene.figure + "\", is moved by no primitive");
  return scene;
}

}  // namespace seam
