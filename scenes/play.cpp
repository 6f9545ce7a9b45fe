#include "scenes/play.hpp"

#include <algorithm>
#include <optional>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "scenes/film.hpp"
#include "scenes/springs.hpp"
#include "scenes/world.hpp"
#include <seam/bullet.hpp>
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double same_tick = 1e-6;  // of a tick

Recording room_for(const Scene& scene, int ticks) {
  std::vector<std::string> names;
  Eigen::VectorXd effort(scene.robot.dof());
  for (const Joint& joint : scene.robot.joints) {
    effort(static_cast<Eigen::Index>(names.size())) = joint.effort;
    names.push_back(joint.name);
  }
  std::vector<std::string> tool;
  if (scene.tool) tool = scene.sequence.coordinates();
  Recording recording(std::move(names), std::move(effort), ticks, std::move(tool));
  for (const Joint& joint : scene.robot.joints)
    recording.slides.push_back(joint.type == Joint::Type::prismatic);
  return recording;
}

// The joints' state before a tick, and what is recorded of it.
class Joints {
 public:
  Joints(const Scene& scene, const Robot& robot, int ticks)
      : robot_(robot), q_(Eigen::VectorXd::Zero(scene.robot.dof())), qd_(q_) {
    if (!scene.simulated.is_elastic()) return;
    if (scene.tool) space_.emplace(scene.robot, scene.sequence, *scene.tool, scene.start);
    springs_.emplace(robot, ticks);
  }
  void look(Eigen::Index row) {
    robot_.state(q_, qd_);
    if (springs_) springs_->look(row);
  }
  void record(const Controller::Tick& tick, Eigen::Index row, Recording& recording) {
    recording.q.row(row) = q_;
    recording.qd.row(row) = qd_;
    if (springs_) springs_->compare(row, tick.reference);
    if (!recording.in_task_space()) return;
    const ToolError error = space_ ? space_->miss(tick.sequence, q_) : tick.tool_error;
    recording.tool_error_m(row) = error.distance;
    recording.tool_error_rad(row) = error.angle;
  }
  void finish(Recording& recording) const {
    if (springs_) springs_->finish(recording);
  }

 private:
  const Robot& robot_;
  Eigen::VectorXd q_, qd_;
  std::optional<TaskSpace> space_;  // where the controller sees the motors, and not the tool
  std::optional<Springs> springs_;
};

void record(const Controller::Tick& tick, double time, Eigen::Index row, Recording& recording) {
  recording.time(row) = time;
  recording.running(row) = tick.running;
  recording.ref.row(row) = tick.reference.position;
  recording.ref_vel.row(row) = tick.reference.velocity;
  recording.ref_acc.row(row) = tick.reference.acceleration;
  recording.torque.row(row) = tick.torque;
  if (!recording.in_task_space()) return;
  recording.tool_ref.row(row) = tick.sequence.position;
  recording.tool_vel.row(row) = tick.sequence.velocity;
  recording.tool_acc.row(row) = tick.sequence.acceleration;
}

bool linear(const Scene& scene, Eigen::Index coordinate) {
  if (scene.tool) return coordinate < 3;
  const std::string& name = scene.sequence.coordinates()[static_cast<std::size_t>(coordinate)];
  const auto joint = static_cast<std::size_t>(scene.robot.joint(name));
  return scene.robot.joints[joint].type == Joint::Type::prismatic;
}

// Steps in acceleration of a tool's x y z and of joints that slide are linear, of all other coordinates of angles.
RecordedJoin join_of(const Scene& scene, double time, int primitive, const Eigen::VectorXd& before,
                     const Eigen::VectorXd& after) {
  RecordedJoin join{time, primitive, 0.0, 0.0};
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    double& largest = linear(scene, i) ? join.linear_jump : join.acceleration_jump;
    largest = std::max(largest, std::abs(after(i) - before(i)));
  }
  return join;
}

// A change on the way is recorded as a join of the primitive with itself.
void happen(const Event& event, const Scene& scene, double time, Sequencer& sequencer,
            std::vector<RecordedJoin>& joins) {
  const Eigen::VectorXd before = sequencer.sample().acceleration;
  if (!event.happen(sequencer))
    throw Error(scene.name, "what should happen at " + std::to_string(event.at) +
                                " s cannot: nothing runs then, or nothing that it fits");
  if (event.what != Event::What::hand_over)
    joins.push_back(
        join_of(scene, time, sequencer.running(), before, sequencer.sample().acceleration));
}

void add_joins(const Scene& scene, const Sequencer& sequencer, std::vector<RecordedJoin>& joins) {
  for (int i = 0; i < sequencer.joins(); ++i) {
    const JoinEvent& event = sequencer.join(i);
    joins.push_back(join_of(scene, event.time, event.primitive, event.acceleration_before,
                            event.acceleration_after));
  }
  std::stable_sort(joins.begin(), joins.end(),
                   [](const RecordedJoin& a, const RecordedJoin& b) { return a.time < b.time; });
}

Recording play_at(const Scene& scene, Join method, double dt, std::size_t place,
                  Replay* replay = nullptr) {
  if (!(dt >= 0.5 * least_tick && dt <= largest_tick))
    throw Error(scene.name, "a tick of " + std::to_string(dt) + " s, must be in 1e-6 to 0.1 s");
  World world;
  RobotSettings settings;
  settings.encoders = scene.encoders;
  Robot robot(scene.simulated, *world, settings);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(robot.dof());
  start.head(scene.start.size()) = scene.start;
  robot.reset(start, Eigen::VectorXd::Zero(robot.dof()));
  Controller controller(robot, scene.sequence_at(place), method, scene.controller());
  add_obstacles(scene.couplings, controller.sequencer());
  Plugin plugin(*world);
  plugin.add(controller);

  const int ticks = scene.ticks(dt);
  Recording recording = room_for(scene, ticks);
  const auto objects = make_objects(scene, robot, ticks, dt, place);
  std::optional<Film> film;
  if (replay) film.emplace(scene, method, robot, objects, dt, ticks, *replay);
  Joints joints(scene, robot, ticks);
  int limited = 0;
  auto event = scene.events.begin();
  for (int k = 0; k < ticks; ++k) {
    for (; event != scene.events.end() && event->at <= (k + same_tick) * dt; ++event)
      happen(*event, scene, k * dt, controller.sequencer(), recording.joins);
    for (const auto& object : objects) object->pre_tick(k, k * dt);
    if (film) film->pre_tick(k);
    joints.look(k);
    world->stepSimulation(dt, 0);
    record(controller.last_tick(), k * dt, k, recording);
    joints.record(controller.last_tick(), k, recording);
    limited += controller.limited() ? 1 : 0;
  }
  for (const auto& object : objects) object->finish(recording);
  const bool stopped = controller.status() == Controller::Status::stopped;
  recording.outcomes.push_back({"stopped_share", stopped ? 1.0 : 0.0});
  recording.outcomes.push_back({"limited_share", static_cast<double>(limited) / ticks});
  if (controller.incident().cause != Incident::Cause::none)
    recording.incident = controller.what_happened();
  add_joins(scene, controller.sequencer(), recording.joins);
  joints.finish(recording);
  if (film) film->finish(recording);
  return recording;
}

// The worse of what came of two runs.
void keep_worse(const std::vector<Outcome>& other, std::vector<Outcome>& outcomes) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    outcomes[i].value = outcomes[i].more_is_better ? std::min(outcomes[i].value, other[i].value)
                                                   : std::max(outcomes[i].value, other[i].value);
  }
}

}  // namespace

Recording play(const Scene& scene, Join method, double dt, Replay* replay) {
  Recording recording = play_at(scene, method, dt, 0, replay);
  for (std::size_t place = 1; place < scene.places(); ++place) {
    const Recording other = play_at(scene, method, dt, place);
    keep_worse(other.outcomes, recording.outcomes);
    if (recording.incident.empty()) recording.incident = other.incident;
  }
  return recording;
}

Recording play_at_first_place(const Scene& scene, Join method, double dt) {
  return play_at(scene, method, dt, 0);
}

}  // namespace seam
