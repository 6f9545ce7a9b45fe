// An engine that is not Bullet: MuJoCo has the arm, ArmController gives it its torques.

#include <cmath>
#include <fstream>
#include <memory>
#include <regex>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "plugin/examples/movement.hpp"
#include "scenes/scene.hpp"
#include "scenes/world.hpp"
#include "tests/drive_step.hpp"
#include "tests/support.hpp"
#include "tests/temp_folder.hpp"
#include <seam/bullet.hpp>
#include <seam/seam.hpp>

namespace seam::test {

namespace {

const std::string pa10 = std::string(SEAM_ASSETS) + "/pa10/pa10.urdf";

/// A URDF in MuJoCo, which reads meshes of other formats: without its shapes. Semi-implicit Euler, nothing that damps.
class MujocoArm {
 public:
  MujocoArm(const RobotModel& model, double dt) {
    const TempFolder folder;
    const std::string urdf = folder.path("arm.urdf");
    std::ofstream(urdf) << std::regex_replace(
        read_file(pa10), std::regex("<(visual|collision)>[^]*?</(visual|collision)>"), "");
    char why[1000] = "";
    model_.reset(mj_loadXML(urdf.c_str(), nullptr, why, sizeof why));
    if (!model_) throw Error(urdf, why);
    model_->opt.timestep = dt;
    model_->opt.integrator = mjINT_EULER;
    model_->opt.disableflags |= mjDSBL_LIMIT;
    for (int i = 0; i < model_->nv; ++i) {
      model_->dof_damping[i] = model_->dof_frictionloss[i] = model_->dof_armature[i] = 0.0;
    }
    data_.reset(mj_makeData(model_.get()));
    for (const Joint& joint : model.joints) {
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
      if (id < 0) throw Error(joint.name, "is not in MuJoCo");
      position_.push_back(model_->jnt_qposadr[id]);
      velocity_.push_back(model_->jnt_dofadr[id]);
    }
  }

  /// Rotors and viscous friction of the model, which MuJoCo has, too (and takes implicitly).
  void add_drives(const RobotModel& model) {
    for (std::size_t i = 0; i < velocity_.size(); ++i) {
      model_->dof_armature[velocity_[i]] = model.joints[i].rotor_inertia;
      model_->dof_damping[velocity_[i]] = model.joints[i].damping;
    }
    mj_setConst(model_.get(), data_.get());
  }
  int dof() const { return model_->nv; }
  void reset(const Eigen::VectorXd& q) {
    for (std::size_t i = 0; i < position_.size(); ++i)
      data_->qpos[position_[i]] = q(static_cast<Eigen::Index>(i));
  }
  void state(Eigen::VectorXd& q, Eigen::VectorXd& qd) const {
    for (std::size_t i = 0; i < position_.size(); ++i) {
      q(static_cast<Eigen::Index>(i)) = data_->qpos[position_[i]];
      qd(static_cast<Eigen::Index>(i)) = data_->qvel[velocity_[i]];
    }
  }
  void step(const Eigen::VectorXd& torque) {
    for (std::size_t i = 0; i < velocity_.size(); ++i)
      data_->qfrc_applied[velocity_[i]] = torque(static_cast<Eigen::Index>(i));
    mj_step(model_.get(), data_.get());
  }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
  std::vector<int> position_, velocity_;  // where MuJoCo has each joint
};

struct Played {
  double error = 0.0;      // [rad] of a joint from its reference, at most
  Eigen::VectorXd travel;  // n [rad] between a joint's extremes
};

Played play(const RobotModel& model, const Sequence& sequence,
            const ArmControllerSettings& settings, const Eigen::VectorXd& start, double seconds,
            Join join) {
  constexpr double dt = 1e-3;
  MujocoArm arm(model, dt);
  EXPECT_EQ(arm.dof(), model.dof());
  arm.reset(start);
  Eigen::VectorXd q = start, qd = Eigen::VectorXd::Zero(start.size());
  Eigen::VectorXd least = q, most = q;
  ArmController controller(model, sequence, join, settings, q, qd);
  Played played;
  for (int k = 0; k < std::lround(seconds / dt); ++k) {
    arm.step(controller.tick(dt, q, qd));
    played.error = std::max(played.error,
                            (controller.last_tick().reference.position - q).cwiseAbs().maxCoeff());
    arm.state(q, qd);
    least = least.cwiseMin(q);
    most = most.cwiseMax(q);
  }
  EXPECT_TRUE(controller.finished());
  EXPECT_EQ(controller.status(), ArmController::Status::following) << controller.what_happened();
  played.travel = most - least;
  return played;
}

// The same arm in both engines, with rotors and viscous friction, swings from where it is let go of.
TEST(MujocoWithDrives, SwingsAsBulletDoesWithRotorsAndFriction) {
  RobotModel model = RobotModel::read(pa10);
  const double rotors[] = {0.75, 0.75, 0.2125, 0.2125, 0.00575, 0.00575, 0.00575};
  const double viscous[] = {10, 10, 5, 5, 2, 2, 2};
  for (std::size_t i = 0; i < 7; ++i) {
    model.joints[i].rotor_inertia = rotors[i];
    model.joints[i].damping = viscous[i];
  }
  constexpr double dt = 1e-3;
  Eigen::VectorXd start(7);
  start << 0.2, 0.5, -0.3, 0.8, 0.4, 0.6, -0.1;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(7);
  Eigen::VectorXd push(7);
  push << 40.0, 20.0, 10.0, 10.0, 3.0, 2.0, 2.0;
  MujocoArm mujoco(model, dt);
  mujoco.add_drives(model);
  mujoco.reset(start);
  World world;
  RobotSettings without_shapes;
  without_shapes.colliders = false;
  Robot robot(model, *world, without_shapes);
  robot.reset(start, zero);
  Eigen::VectorXd q = start, qd = zero, their_q = start, their_qd = zero;
  double farthest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::VectorXd torque = std::sin(0.01 * k) * push;
    drive_step(world, robot, torque, dt);
    mujoco.step(torque);
    robot.state(q, qd);
    mujoco.state(their_q, their_qd);
    farthest = std::max(farthest, (q - their_q).cwiseAbs().maxCoeff());
  }
  EXPECT_GT((q - start).cwiseAbs().minCoeff(), 0.05);
  EXPECT_LT(farthest, 1e-9);
}

class Mujoco : public testing::TestWithParam<Join> {};

TEST_P(Mujoco, PlaysTheSceneLine) {
  const Scene scene = Scene::read(std::string(SEAM_SCENES) + "/line.yaml");
  const Played played = play(scene.robot, scene.sequence, scene.controller(), scene.start,
                             scene.duration, GetParam());
  EXPECT_LE(played.error, 1e-9);
  EXPECT_GT(played.travel(3), 0.5);
}

// What it looks like where the model's masses are 1 % off.
TEST_P(Mujoco, TellsAModelThatErrs) {
  const Scene scene = Scene::read(std::string(SEAM_SCENES) + "/line.yaml");
  RobotModel erring = scene.robot;
  for (Body& body : erring.bodies) body.inertial.mass *= 1.01;
  EXPECT_GT(
      play(erring, scene.sequence, scene.controller(), scene.start, scene.duration, GetParam())
          .error,
      1e-4);
}

TEST_P(Mujoco, MovesAllSevenJoints) {
  const RobotModel model = RobotModel::read(pa10);
  std::vector<std::string> names;
  for (const Joint& joint : model.joints) names.push_back(joint.name);
  Eigen::VectorXd start(7), there(7), back(7);
  start << 0.2, 0.5, -0.3, 0.8, 0.4, 0.6, -0.1;
  there << -0.3, 0.9, 0.2, 1.3, -0.2, 0.1, 0.7;
  back << 0.4, 0.2, -0.1, 0.9, 0.3, 0.9, 0.2;
  const auto reach = [&](const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
    return learn(movement(names, from, to, 1.0));
  };
  Sequence task;
  task.then(reach(start, there)).until(before_end(0.4)).then(reach(there, back));
  const Played played = play(model, task, {}, start, 2.5, GetParam());
  EXPECT_LE(played.error, 1e-9);
  EXPECT_GT(played.travel.minCoeff(), 0.3);
}

INSTANTIATE_TEST_SUITE_P(EveryJoin, Mujoco,
                         testing::Values(Join::dmp2, Join::dmp2a, Join::dmp3, Join::dmp2j),
                         [](const auto& of) { return std::string(to_string(of.param)); });

}  // namespace

}  // namespace seam::test
