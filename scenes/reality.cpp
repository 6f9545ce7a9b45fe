#include "scenes/reality.hpp"

#include <limits>

namespace seam {

namespace {

// Joints that a map does not name keep `otherwise`.
PerJoint per_joint(const YamlEntry& entry, const RobotModel& robot, double otherwise,
                   double (YamlEntry::*number)() const) {
  if (entry.is_text()) return (entry.*number)();
  Eigen::VectorXd each = Eigen::VectorXd::Constant(robot.dof(), otherwise);
  for (const auto& [name, value] : entry.entries()) {
    const int joint = at_key(value, [&, of = name] { return robot.joint(of); });
    each(joint) = (value.*number)();
  }
  return each;
}

class Reader {
 public:
  Reader(const YamlEntry& entry, const RobotModel& robot) : entry_(entry), robot_(robot) {}

  void not_negative(const char* key, PerJoint& setting) const {
    if (const auto given = entry_.find(key))
      setting = per_joint(*given, robot_, 0.0, &YamlEntry::not_negative);
  }
  void positive(const char* key, PerJoint& setting) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (const auto given = entry_.find(key))
      setting = per_joint(*given, robot_, none, &YamlEntry::positive);
  }

 private:
  const YamlEntry& entry_;
  const RobotModel& robot_;
};

Dropout read_dropout(const YamlEntry& entry) {
  entry.only({"from", "to", "state"});
  Dropout dropout;
  dropout.from = entry.at("from").not_negative();
  const YamlEntry to = entry.at("to");
  dropout.to = to.number();
  if (!(dropout.to > dropout.from)) to.fail(to.text() + ", must be after its beginning");
  if (const auto state = entry.find("state"))
    dropout.what =
        state->choice({"missing", "frozen"}) == 0 ? Dropout::What::missing : Dropout::What::frozen;
  return dropout;
}

}  // namespace

ActuatorSettings read_actuator(const YamlEntry& entry, const RobotModel& robot) {
  ActuatorSettings actuator;
  if (entry.is_text()) {
    entry.choice({"ideal"});
    return actuator;
  }
  entry.only({"quantum", "effort_limit", "rate", "lag"});
  if (const auto limit = entry.find("effort_limit"))
    actuator.limit_effort = limit->choice({"no", "yes"}) == 1;
  const Reader reader(entry, robot);
  reader.not_negative("quantum", actuator.quantum);
  reader.positive("rate", actuator.rate);
  reader.not_negative("lag", actuator.lag);
  return actuator;
}

FrictionSettings read_friction(const YamlEntry& entry, const RobotModel& robot) {
  entry.only({"viscous", "coulomb"});
  FrictionSettings friction;
  const Reader reader(entry, robot);
  reader.not_negative("viscous", friction.viscous);
  reader.not_negative("coulomb", friction.coulomb);
  return friction;
}

SensorSettings read_sensor(const YamlEntry& entry, const RobotModel& robot) {
  entry.only({"delay", "resolution", "position_noise", "velocity_noise", "dropouts"});
  SensorSettings sensor;
  if (const auto delay = entry.find("delay")) sensor.delay = delay->not_negative();
  const Reader reader(entry, robot);
  reader.not_negative("resolution", sensor.resolution);
  reader.not_negative("position_noise", sensor.position_noise);
  reader.not_negative("velocity_noise", sensor.velocity_noise);
  if (const auto dropouts = entry.find("dropouts"))
    for (const YamlEntry& dropout : dropouts->items())
      sensor.dropouts.push_back(read_dropout(dropout));
  return sensor;
}

GuardSettings read_guard(const YamlEntry& entry, const RobotModel& robot) {
  entry.only({"most_error", "longest_dropout", "frozen_beyond", "beyond_limits"});
  GuardSettings guard;
  Reader(entry, robot).positive("most_error", guard.most_error);
  for (const auto& [key, bound] : {std::pair{"longest_dropout", &guard.longest_dropout},
                                   {"frozen_beyond", &guard.frozen_beyond},
                                   {"beyond_limits", &guard.beyond_limits}})
    if (const auto given = entry.find(key)) *bound = given->not_negative();
  return guard;
}

void read_model_error(const YamlEntry& entry, Scene& scene) {
  entry.only({"mass", "payload"});
  if (const auto payload = entry.find("payload")) {
    payload->only({"mass", "link", "at"});
    Inertial load;
    load.mass = payload->at("mass").not_negative();
    if (const auto at = payload->find("at")) load.com = at->numbers(3, "direction");
    const YamlEntry link = payload->at("link");
    const Frame& frame =
        at_key(link, [&]() -> const Frame& { return scene.simulated.frame(link.text()); });
    if (frame.body < 0) link.fail("\"" + frame.name + "\", must be a link that moves");
    Inertial& body = scene.simulated.bodies[static_cast<std::size_t>(frame.body)].inertial;
    body = body + frame.X_body_frame * load;
  }
  if (const auto mass = entry.find("mass")) {
    const double factor = 1.0 + mass->number();
    if (!(factor > 0.0)) mass->fail(mass->text() + ", must be > -1");
    for (Body& body : scene.robot.bodies) {
      body.inertial.mass *= factor;
      body.inertial.inertia *= factor;
    }
  }
}

}  // namespace seam
