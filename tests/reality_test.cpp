// What stands between a controller's plan and the motion: friction, errors of the model, sensors, actuators in scenes.

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>

#include "scenes/play.hpp"
#include "tests/refusals.hpp"
#include <seam/metrics.hpp>

namespace seam {
namespace {

using testing::HasSubstr;

Scene line(const std::vector<std::string>& overrides) {
  return Scene::read(std::string(SEAM_SCENES) + "/line.yaml", overrides);
}

Recording played(const std::vector<std::string>& overrides, Join method = Join::dmp3) {
  const Scene scene = line(overrides);
  return play(scene, method, scene.dt);
}

bool same_bits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

TEST(Reality, WithNothingWrongIsTheSameToTheBit) {
  const Recording ideal = played({});
  const Recording same =
      played({"actuator={quantum: 0, rate: 1e300, lag: 0}", "friction={viscous: 0, coulomb: 0}",
              "sensors={delay: 0, resolution: 0}", "model_error={mass: 0}"});
  EXPECT_TRUE(same_bits(ideal.torque, same.torque));
  EXPECT_TRUE(same_bits(ideal.q, same.q));
}

// A point mass that the controller does not know of pulls the arm down until K_p times its error holds it:
// at rest M·Kp·Δq = −Jᵀmg, of which the elbow's share is measured by the torque that is commanded.
TEST(Reality, APayloadIsHeldByTheFeedback) {
  const Recording recording =
      played({"model_error.payload={mass: 0.5, link: tool, at: [0, 0, 0.1]}", "settle=4"});
  const Scene scene = line({"model_error.payload={mass: 0.5, link: tool, at: [0, 0, 0.1]}"});
  const Eigen::Index last = recording.ticks() - 1;
  const Eigen::VectorXd q = recording.q.row(last);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(7);
  Eigen::VectorXd needed(7);
  InverseDynamics(scene.simulated).torque(q, rest, rest, needed);
  EXPECT_LT((recording.torque.row(last).transpose() - needed).norm(), 0.02);
  Eigen::VectorXd known(7);
  InverseDynamics(scene.robot).torque(q, rest, rest, known);
  EXPECT_GT((needed - known).norm(), 1.0);
}

// Masses 10 % too large make all torques of the model 10 % too large.
TEST(Reality, AMassErrorIsTheControllersAndNotBullets) {
  const Scene scene = line({"model_error.mass=0.1"}), exact = line({});
  const Eigen::VectorXd q = scene.start, zero = Eigen::VectorXd::Zero(7);
  Eigen::VectorXd wrong(7), right(7), simulated(7);
  InverseDynamics(scene.robot).torque(q, zero, q, wrong);
  InverseDynamics(exact.robot).torque(q, zero, q, right);
  InverseDynamics(scene.simulated).torque(q, zero, q, simulated);
  EXPECT_LT((wrong - 1.1 * right).norm(), 1e-12 * right.norm());
  EXPECT_EQ(simulated, right);
}

class RealityMoves : public testing::TestWithParam<const char*> {};

TEST_P(RealityMoves, TheArmFromItsReferenceAndStaysFinite) {
  for (const Join method : all_joins) {
    const RunMetrics metrics = measure(played({GetParam()}, method));
    EXPECT_GT(metrics.tracking_max_rad, 1e-8) << to_string(method);
    EXPECT_LT(metrics.tracking_max_rad, 0.5) << to_string(method);
  }
}

INSTANTIATE_TEST_SUITE_P(, RealityMoves,
                         testing::Values("actuator.lag=0.005", "actuator.quantum=0.1",
                                         "actuator={effort_limit: yes, lag: 0.005, rate: 1000}",
                                         "friction.viscous=2", "friction.coulomb={S2: 5, E1: 3}",
                                         "sensors.delay=0.003", "sensors.resolution=1e-4",
                                         "sensors={position_noise: 1e-4, velocity_noise: 0.01}",
                                         "model_error.mass=-0.2"));

// Where the torque may not jump, a method that makes it jump is left behind.
TEST(Reality, JoinsDifferInTrackingBehindARateLimitOrALag) {
  for (const char* actuator : {"actuator.rate=500", "actuator.lag=0.005"}) {
    const double dmp2 = measure(played({actuator}, Join::dmp2)).tracking_after_join_max_rad;
    for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j})
      EXPECT_LT(measure(played({actuator}, method)).tracking_after_join_max_rad, 0.7 * dmp2)
          << actuator << " " << to_string(method);
  }
}

TEST(Reality, NoiseFollowsTheSeed) {
  const char* noise = "sensors.position_noise=1e-4";
  EXPECT_TRUE(same_bits(played({noise}).torque, played({noise}).torque));
  EXPECT_FALSE(same_bits(played({noise}).torque, played({noise, "seed=3"}).torque));
}

TEST(Reality, ADropoutIsBridgedOrStopsTheArmAndIsTold) {
  const Recording bridged = played({"sensors.dropouts=[{from: 0.6, to: 0.65}]"});
  EXPECT_LT(measure(bridged).tracking_max_rad, 1e-9);
  EXPECT_THAT(bridged.incident,
              HasSubstr("from 0.6 s on there was no state of the joints for 0.05"));
  const Recording stopped = played({"sensors.dropouts=[{from: 0.6, to: 2, state: frozen}]"});
  EXPECT_THAT(stopped.incident,
              testing::EndsWith("there was no state of the joints for more than 0.1 s"));
  EXPECT_EQ(stopped.outcomes.front().name, "stopped_share");
  EXPECT_EQ(stopped.outcomes.front().value, 1.0);
  const Recording patient =
      played({"sensors.dropouts=[{from: 0.6, to: 0.8}]", "guard.longest_dropout=0.3"});
  EXPECT_EQ(patient.outcomes.front().value, 0.0);
  EXPECT_EQ(played({}).incident, "");
}

TEST(Reality, AGuardIsSetPerJoint) {
  const Recording stopped =
      played({"guard={most_error: {E1: 0.001}, least_effort: 0}", "friction.viscous={E1: 20}"});
  EXPECT_THAT(stopped.incident, HasSubstr("joint \"E1\" was off its reference by 0.001"));
  EXPECT_EQ(
      played({"guard={most_error: {S1: 0.001}, least_effort: 0}", "friction.viscous={E1: 20}"})
          .incident,
      "");
}

struct Bad {
  const char* name;
  const char* text;
  const char* message;
};

class RealityRefuses : public testing::TestWithParam<Bad> {};

TEST_P(RealityRefuses, WithTheKey) {
  EXPECT_THAT(test::refusal([] { line({GetParam().text}); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    , RealityRefuses,
    testing::Values(
        Bad{"NegativeLag", "actuator.lag=-1", "key \"lag\": -1, must be >= 0"},
        Bad{"NoRate", "actuator.rate=0", "key \"rate\": 0, must be > 0"},
        Bad{"UnknownOfActuator", "actuator.gain=1", "key \"gain\": not known here"},
        Bad{"UnknownJoint", "friction.coulomb={E9: 1}", "key \"E9\": robot \"pa10\": no joint"},
        Bad{"NegativeFriction", "friction.viscous={E1: -1}", "key \"E1\": -1, must be >= 0"},
        Bad{"DropoutBackwards", "sensors.dropouts=[{from: 1, to: 0.5}]",
            "key \"to\": 0.5, must be after its beginning"},
        Bad{"UnknownState", "sensors.dropouts=[{from: 1, to: 2, state: odd}]", "key \"state\""},
        Bad{"NoError", "guard.most_error=0", "key \"most_error\": 0, must be > 0"},
        Bad{"UnknownOfGuard", "guard.patience=1", "key \"patience\": not known here"},
        Bad{"DelayOfNoTime", "sensors.delay=nan", "key \"delay\": \"nan\", must be a finite"},
        Bad{"NegativeNoise", "sensors.position_noise=-1", "\"position_noise\": -1, must be >= 0"},
        Bad{"NoMassAtAll", "model_error.mass=-1", "key \"mass\": -1, must be > -1"},
        Bad{"NoLink", "model_error.payload={mass: 1}", "needs the key \"link\""},
        Bad{"LinkThatStands", "model_error.payload={mass: 1, link: base}", "a link that moves"},
        Bad{"NegativePayload", "model_error.payload={mass: -1, link: tool}", "\"mass\": -1"}),
    test::by_name);

}  // namespace
}  // namespace seam
