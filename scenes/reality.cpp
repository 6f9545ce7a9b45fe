#include "scenes/reality.hpp"

#include <filesystem>
#include <optional>

namespace seam {

namespace {

// Joints that a map does not name keep what they have.
PerJoint per_joint(const YamlEntry& entry, const RobotModel& robot, const PerJoint& before,
                   double (YamlEntry::*number)() const) {
  if (entry.is_text()) return (entry.*number)();
  Eigen::VectorXd each = before.each(robot.dof());
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
      setting = per_joint(*given, robot_, setting, &YamlEntry::not_negative);
  }
  void positive(const char* key, PerJoint& setting) const {
    if (const auto given = entry_.find(key))
      setting = per_joint(*given, robot_, setting, &YamlEntry::positive);
  }
  void not_negative(const char* key, double& setting) const {
    if (const auto given = entry_.find(key)) setting = given->not_negative();
  }

 private:
  const YamlEntry& entry_;
  const RobotModel& robot_;
};

void read_actuator(const YamlEntry& entry, const RobotModel& robot, ActuatorSettings& actuator) {
  if (entry.is_text()) {
    entry.choice({"ideal"});
    actuator = {};
    return;
  }
  entry.only({"quantum", "effort_limit", "rate", "lag"});
  if (const auto limit = entry.find("effort_limit"))
    actuator.limit_effort = limit->choice({"no", "yes"}) == 1;
  const Reader reader(entry, robot);
  reader.not_negative("quantum", actuator.quantum);
  reader.positive("rate", actuator.rate);
  reader.not_negative("lag", actuator.lag);
}

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

void read_sensor(const YamlEntry& entry, const RobotModel& robot, SensorSettings& sensor) {
  entry.only({"delay", "resolution", "position_noise", "velocity_noise", "dropouts"});
  const Reader reader(entry, robot);
  reader.not_negative("delay", sensor.delay);
  reader.not_negative("resolution", sensor.resolution);
  reader.not_negative("position_noise", sensor.position_noise);
  reader.not_negative("velocity_noise", sensor.velocity_noise);
  if (const auto dropouts = entry.find("dropouts")) {
    sensor.dropouts.clear();
    for (const YamlEntry& dropout : dropouts->items())
      sensor.dropouts.push_back(read_dropout(dropout));
  }
}

void read_guard(const YamlEntry& entry, const RobotModel& robot, GuardSettings& guard) {
  entry.only({"most_error", "least_effort", "longest_dropout", "frozen_beyond", "beyond_limits"});
  const Reader reader(entry, robot);
  reader.positive("most_error", guard.most_error);
  reader.not_negative("least_effort", guard.least_effort);
  reader.not_negative("longest_dropout", guard.longest_dropout);
  reader.not_negative("frozen_beyond", guard.frozen_beyond);
  reader.not_negative("beyond_limits", guard.beyond_limits);
}

void read_control(const YamlEntry& entry, const RobotModel& robot, ControlSettings& control) {
  entry.only({"Kp", "Kd", "reference", "friction_velocity", "observer", "most_correction"});
  using Reference = ControlSettings::Reference;
  if (const auto reference = entry.find("reference"))
    control.reference =
        reference->choice({"matched", "plain"}) == 0 ? Reference::matched : Reference::plain;
  if (const auto velocity = entry.find("friction_velocity"))
    control.friction_velocity = velocity->positive();
  const Reader reader(entry, robot);
  reader.not_negative("Kp", control.Kp);
  reader.not_negative("Kd", control.Kd);
  reader.not_negative("observer", control.observer);
  reader.not_negative("most_correction", control.most_correction);
}

// A setting of the joints that the scene's robot has, in the simulated one.
void read_joints(const YamlEntry& entry, const char* key, double Joint::*value,
                 double (YamlEntry::*number)() const, Scene& scene) {
  const auto given = entry.find(key);
  if (!given) return;
  auto& joints = scene.simulated.joints;
  Eigen::VectorXd before(scene.robot.dof());
  for (Eigen::Index i = 0; i < before.size(); ++i)
    before(i) = joints[static_cast<std::size_t>(i)].*value;
  const PerJoint now = per_joint(*given, scene.robot, before, number);
  for (Eigen::Index i = 0; i < before.size(); ++i)
    joints[static_cast<std::size_t>(i)].*value = now(i);
}

void read_friction(const YamlEntry& entry, Scene& scene) {
  entry.only({"viscous", "coulomb"});
  read_joints(entry, "viscous", &Joint::damping, &YamlEntry::not_negative, scene);
  read_joints(entry, "coulomb", &Joint::friction, &YamlEntry::not_negative, scene);
}

void read_elastic(const YamlEntry& entry, Scene& scene) {
  entry.only({"stiffness", "damping", "encoders"});
  read_joints(entry, "stiffness", &Joint::stiffness, &YamlEntry::positive, scene);
  read_joints(entry, "damping", &Joint::spring_damping, &YamlEntry::not_negative, scene);
  using Encoders = RobotSettings::Encoders;
  if (const auto encoders = entry.find("encoders"))
    scene.encoders = encoders->choice({"motor", "link"}) == 0 ? Encoders::motor : Encoders::link;
}

void require_rotors(const YamlEntry& elastic, const Scene& scene) {
  for (const Joint& joint : scene.simulated.joints)
    if (joint.is_elastic() && joint.rotor_inertia == 0.0)
      elastic.fail("joint \"" + joint.name + "\" needs a rotor_inertia > 0");
}

// What the controller's model is wrong by, and the arm carries besides.
struct ModelError {
  double mass = 0.0;  // share by which it has all masses too large
  Inertial load;
  std::optional<Frame> loaded;  // link
};

void read_payload(const YamlEntry& entry, const Scene& scene, ModelError& error) {
  entry.only({"mass", "link", "at"});
  error.load = {};
  error.load.mass = entry.at("mass").not_negative();
  if (const auto at = entry.find("at")) error.load.com = at->numbers(3, "direction");
  const YamlEntry link = entry.at("link");
  error.loaded = at_key(link, [&] { return scene.simulated.frame(link.text()); });
  if (error.loaded->body < 0)
    link.fail("\"" + error.loaded->name + "\", must be a link that moves");
}

void read_model_error(const YamlEntry& entry, const Scene& scene, ModelError& error) {
  entry.only({"mass", "payload"});
  if (const auto payload = entry.find("payload")) read_payload(*payload, scene, error);
  if (const auto mass = entry.find("mass")) {
    error.mass = mass->number();
    if (!(error.mass > -1.0)) mass->fail(mass->text() + ", must be > -1");
  }
}

void err(const ModelError& error, Scene& scene) {
  if (error.loaded) {
    Inertial& body = scene.simulated.bodies[static_cast<std::size_t>(error.loaded->body)].inertial;
    body = body + error.loaded->X_body_frame * error.load;
  }
  for (Body& body : scene.robot.bodies) {
    body.inertial.mass *= 1.0 + error.mass;
    body.inertial.inertia *= 1.0 + error.mass;
  }
}

// Shares of what is simulated; nothing: what the URDF says.
struct Known {
  std::optional<double> friction, rotors;
};

void read_known(const YamlEntry& entry, Known& known) {
  entry.only({"friction", "rotors"});
  if (const auto friction = entry.find("friction")) known.friction = friction->not_negative();
  if (const auto rotors = entry.find("rotors")) known.rotors = rotors->not_negative();
}

void know(const Known& known, Scene& scene) {
  for (std::size_t i = 0; i < scene.robot.joints.size(); ++i) {
    const Joint& simulated = scene.simulated.joints[i];
    Joint& believed = scene.robot.joints[i];
    if (known.friction) {
      believed.damping = simulated.damping;
      believed.friction = simulated.friction;
    }
    if (known.rotors) believed.rotor_inertia = *known.rotors * simulated.rotor_inertia;
  }
  if (known.friction) scene.control.friction_share = *known.friction;
}

// The scene's arm: its file, if it is not ideal.
std::optional<YamlEntry> arm_file(const YamlEntry& scene_file, Scene& scene) {
  const auto arm = scene_file.find("arm");
  if (!arm || arm->text() == ideal_arm) return std::nullopt;
  scene.arm = arm->text();
  const bool is_path = scene.arm.find_first_of("/.") != std::string::npos;
  const std::string path = is_path ? arm->path() : named_arm(scene.urdf, scene.arm);
  if (is_path) scene.arm = std::filesystem::path(path).stem().string();
  if (!std::filesystem::exists(path)) arm->fail("\"" + arm->text() + "\", there is no " + path);
  YamlEntry file = YamlEntry::read(path);
  file.require_format("seam-arm", 1);
  file.only({"format", "title", "rotor_inertia", "friction", "elastic", "actuator", "sensors",
             "model_error", "known", "control", "guard"});
  return file;
}

}  // namespace

std::string named_arm(const std::string& urdf, const std::string& name) {
  return (std::filesystem::path(urdf).parent_path() / (name + ".yaml")).string();
}

void read_reality(const YamlEntry& scene_file, Scene& scene) {
  ModelError error;
  Known known;
  std::optional<YamlEntry> elastic;
  const std::optional<YamlEntry> arm = arm_file(scene_file, scene);
  const YamlEntry* const files[] = {arm ? &*arm : nullptr, &scene_file};
  for (const YamlEntry* file : files) {
    if (!file) continue;
    const auto read = [&](const char* key, auto&& reader) {
      if (const auto entry = file->find(key)) reader(*entry);
    };
    read_joints(*file, "rotor_inertia", &Joint::rotor_inertia, &YamlEntry::not_negative, scene);
    read("friction", [&](const YamlEntry& entry) { read_friction(entry, scene); });
    read("elastic", [&](const YamlEntry& entry) {
      read_elastic(entry, scene);
      elastic = entry;
    });
    read("actuator",
         [&](const YamlEntry& entry) { read_actuator(entry, scene.robot, scene.actuator); });
    read("sensors", [&](const YamlEntry& entry) { read_sensor(entry, scene.robot, scene.sensor); });
    read("model_error", [&](const YamlEntry& entry) { read_model_error(entry, scene, error); });
    read("known", [&](const YamlEntry& entry) { read_known(entry, known); });
    read("control",
         [&](const YamlEntry& entry) { read_control(entry, scene.robot, scene.control); });
    read("guard", [&](const YamlEntry& entry) { read_guard(entry, scene.robot, scene.guard); });
  }
  if (elastic) require_rotors(*elastic, scene);
  know(known, scene);
  err(error, scene);
}

}  // namespace seam
