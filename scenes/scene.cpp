#include "scenes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include "plugin/files/src/sequence_entry.hpp"
#include "scenes/contents.hpp"
#include "scenes/own_folders.hpp"
#include "scenes/reality.hpp"
#include <seam/controller.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double most_seconds = 3600.0;
constexpr double most_ticks = 1e7;

void read_robot(const YamlEntry& entry, Scene& scene) {
  entry.only({"urdf", "start"});
  const YamlEntry urdf = entry.at("urdf");
  scene.urdf = urdf.path();
  scene.robot = at_key(urdf, [&] { return RobotModel::read(scene.urdf); });
  scene.start = scene.robot.neutral();
  const auto start = entry.find("start");
  if (!start) return;
  for (const auto& [name, position] : start->entries()) {
    const int i = at_key(position, [&, joint = name] { return scene.robot.joint(joint); });
    const Joint& joint = scene.robot.joints[static_cast<std::size_t>(i)];
    if (joint.follows()) position.fail("follows another joint, which must be set instead");
    scene.start(i) = position.number();
    if (scene.start(i) < joint.lower || scene.start(i) > joint.upper)
      position.fail(position.text() + ", must be in " + std::to_string(joint.lower) + " to " +
                    std::to_string(joint.upper));
  }
  scene.robot.place_followers(scene.start);
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
  for (const Sequence::Step& step : scene.sequence.steps())
    if (!step.wishes.empty())
      at_key(entry.at("steps"),
             [&] { reference(scene, step.primitive)->require_reachable_step(step); });
  scene.primitive_names = std::move(file.primitives);
  scene.couplings = std::move(file.couplings);
}

// Where the first primitive's demonstration began.
void start_with_tool(const YamlEntry& entry, Scene& scene) {
  const Primitive& first = scene.sequence.steps().front().primitive;
  TaskSpace space(scene.robot, scene.sequence, *scene.tool, scene.start);
  at_key(entry, [&] { scene.start = space.reach(space.pose(first.start_position)); });
}

double read_tick(const YamlEntry& entry) {
  const double dt = entry.positive();
  if (dt < least_tick || dt > largest_tick) entry.fail(entry.text() + ", must be in 1e-6 to 0.1 s");
  return dt;
}

double at_most(const YamlEntry& entry, double seconds) {
  if (seconds > most_seconds) entry.fail(entry.text() + ", must be <= 3600 s");
  return seconds;
}

double read_speed(const YamlEntry& entry) {
  const double speed = entry.positive();
  if (speed < 1e-3 || speed > 1e3) entry.fail(entry.text() + ", must be in 0.001 to 1000");
  return speed;
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
    to.then(std::move(step));
  }
  return to;
}

void hasten(double factor, Switch& when) {
  if (when.when == Switch::When::after || when.when == Switch::When::before_end)
    when.value /= factor;
}

// Plays all of it faster by a factor: every time is divided by it, tau's and events' included.
void hasten(double factor, Scene& scene) {
  scene.speed = factor;
  const Sequence& slow = scene.sequence;
  scene.sequence = changed(slow, slow.start_delay() / factor, [&](Sequence::Step& step) {
    step.primitive = step.primitive.at_speed(factor);
    hasten(factor, step.until);
    step.leave *= factor * factor;
    for (Wish& wish : step.wishes) {
      hasten(factor, wish.when);
      wish.velocity *= factor;
      wish.acceleration *= factor * factor;
    }
  });
  for (ObstacleSettings& coupling : scene.couplings) coupling = coupling.at_speed(factor);
  for (Event& event : scene.events) {
    event.at /= factor;
    event.when /= factor;
    event.velocity *= factor;
    event.over /= factor;
    if (event.what == Event::What::tau) event.value /= factor;
  }
  for (Dropout& dropout : scene.sensor.dropouts) {
    dropout.from /= factor;
    dropout.to /= factor;
  }
  for (SolidObstacle& obstacle : scene.obstacles) {
    obstacle.leaves /= factor;
    obstacle.over /= factor;
  }
  if (scene.ball) scene.ball->hasten(factor);
  scene.duration /= factor;
}

}  // namespace

std::string on_arm(const std::string& scene, const std::string& arm) {
  return arm == ideal_arm ? scene : scene + "-" + arm;
}

Sequence Scene::sequence_at(std::size_t place) const {
  if (place == 0) return sequence;
  return changed(sequence, sequence.start_delay(), [&](Sequence::Step& step) {
    step.primitive.goal.head<3>() += pouring->places[place];
    for (Wish& wish : step.wishes)
      if (wish.position.size() > 0) wish.position.head<3>() += pouring->places[place];
  });
}

ControllerSettings Scene::controller() const {
  ControllerSettings settings(control, tool, robot);
  settings.actuator = actuator;
  settings.sensor = sensor;
  settings.guard = guard;
  return settings;
}

Frame Scene::tool_frame() const {
  if (!tool) return robot.frames.back();
  Frame frame = robot.frame(tool->link);
  frame.X_body_frame = frame.X_body_frame * tool->X_link_tool;
  return frame;
}

int Scene::ticks(double step) const {
  return static_cast<int>(std::lround(duration / step));
}

Scene Scene::read(const std::string& path, const std::vector<std::string>& overrides,
                  const std::vector<std::string>& allowed) {
  const YamlEntry root = YamlEntry::read(path, overrides, with_own_folders(allowed));
  root.require_format("seam-scene", 1);
  root.only({"format",        "title",       "robot",   "arm",    "tool",     "liquid",   "pouring",
             "sequence",      "events",      "control", "known",  "actuator", "friction", "elastic",
             "rotor_inertia", "model_error", "sensors", "guard",  "method",   "seed",     "dt",
             "settle",        "duration",    "speed",   "camera", "table",    "figure",   "gates",
             "obstacles",     "ball"});
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  scene.title = root.at("title").text();
  scene.text = root.file_text();
  scene.overrides = overrides;
  read_robot(root.at("robot"), scene);
  const auto tool = root.find("tool");
  if (tool) scene.tool = read_tool(*tool, scene);
  scene.simulated = scene.robot;
  if (const auto liquid = root.find("liquid")) read_liquid(*liquid, scene);
  if (const auto pouring = root.find("pouring")) read_pouring(*pouring, scene);
  read_reality(root, scene);
  read_steps(root.at("sequence"), scene);
  if (tool) start_with_tool(*tool, scene);
  if (const auto method = root.find("method"))
    scene.method = at_key(*method, [&] { return join_from_name(method->text()); });
  if (const auto dt = root.find("dt")) scene.dt = read_tick(*dt);
  if (const auto seed = root.find("seed")) scene.seed = scene.sensor.seed = seed->count(0);
  if (const auto events = root.find("events"))
    scene.events = read_events(*events, scene.sequence.coordinates(), scene.seed);
  scene.duration = read_duration(root, scene.sequence);
  if (const auto gates = root.find("gates")) scene.gates = read_gates(*gates);
  if (const auto obstacles = root.find("obstacles")) scene.obstacles = read_obstacles(*obstacles);
  if (const auto ball = root.find("ball")) read_ball(*ball, scene);
  if (const auto speed = root.find("speed")) {
    const double factor = read_speed(*speed);
    at_key(*speed, [&] { hasten(factor, scene); });
  }
  if (!(scene.duration <= most_ticks * scene.dt))
    root.fail("has more than 1e7 ticks, must be shorter, or its dt longer");
  if (const auto camera = root.find("camera")) scene.camera = read_camera(*camera);
  if (const auto table = root.find("table")) scene.table = read_table(*table);
  const YamlEntry figure = root.at("figure");
  scene.figure = figure.text();
  const auto& moved = scene.sequence.coordinates();
  if (std::find(moved.begin(), moved.end(), scene.figure) == moved.end())
    figure.fail("\"" + scene.figure + "\", is moved by no primitive");
  return scene;
}

}  // namespace seam
