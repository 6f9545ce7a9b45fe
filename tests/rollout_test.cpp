#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/error.hpp>
#include <seam/rollout.hpp>

namespace seam {
namespace {

using testing::HasSubstr;

Primitive primitive(unsigned seed, std::vector<std::string> coordinates = {"a", "b"}) {
  std::mt19937_64 random(seed);
  Primitive made = test::random_primitive(random, static_cast<int>(coordinates.size()), 10);
  made.tau = 1.0;
  made.coordinates = std::move(coordinates);
  return made;
}

Sequence task() {
  return Sequence().then(primitive(1)).until(before_end(0.3)).then(primitive(2));
}

TEST(Rollout, HoldsWhatTheSequencerStepsThrough) {
  const Recording path = rollout(task(), Join::dmp3, {0.01, 0.5});
  Sequencer sequencer(task(), Join::dmp3, task().start_state());
  ASSERT_EQ(path.ticks(), 221);  // 0.7 s, 1 s, and half a second behind it
  for (int k = 0; k < path.ticks(); ++k) {
    EXPECT_EQ(path.time(k), k * 0.01);
    EXPECT_EQ(path.running(k), sequencer.running());
    EXPECT_EQ(path.ref.row(k).transpose(), sequencer.sample().position);
    EXPECT_EQ(path.ref_vel.row(k).transpose(), sequencer.sample().velocity);
    EXPECT_EQ(path.ref_acc.row(k).transpose(), sequencer.sample().acceleration);
    sequencer.step(0.01);
  }
  EXPECT_EQ(path.joints, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(path.torque.size(), 0);
  path.validate();
}

TEST(Rollout, TellsTheStepsAtItsJoins) {
  const Recording path = rollout(task(), Join::dmp2);
  Sequencer sequencer(task(), Join::dmp2, task().start_state());
  while (sequencer.joins() < 2) sequencer.step(1e-3);
  ASSERT_EQ(path.joins.size(), 2U);
  const JoinEvent& event = sequencer.join(1);
  EXPECT_EQ(path.joins[1].time, event.time);
  EXPECT_EQ(path.joins[1].acceleration_jump,
            (event.acceleration_after - event.acceleration_before).cwiseAbs().maxCoeff());
  EXPECT_EQ(path.joins[1].linear_jump, 0.0);
}

TEST(Rollout, OfAToolIsInTaskSpace) {
  const Recording path =
      rollout(Sequence().then(primitive(3, {"x", "y", "z", "rx", "ry", "rz"})), Join::dmp2);
  EXPECT_TRUE(path.in_task_space());
  EXPECT_EQ(path.ref.size(), 0);
  EXPECT_EQ(path.tool_acc.cols(), 6);
  EXPECT_GT(path.joins[0].linear_jump, 0.0);
  EXPECT_GT(path.joins[0].acceleration_jump, 0.0);
}

TEST(Rollout, OfASequencerThatRunsBeginsThere) {
  Sequencer sequencer(task(), Join::dmp3, task().start_state());
  sequencer.step(0.5);
  const Eigen::VectorXd here = sequencer.sample().position;
  const Recording path = rollout(sequencer, {0.01, 0.0, 1.0});
  EXPECT_EQ(path.ref.row(0).transpose(), here);
  ASSERT_EQ(path.joins.size(), 1U);  // not the start, which is past
  EXPECT_NEAR(path.joins[0].time, 0.2, 1e-12);
}

TEST(Rollout, RefusesWhatHasNoEndAndSettingsThatWillNotDo) {
  const auto refusal = [](const RolloutSettings& settings, const Sequence& sequence) {
    try {
      rollout(sequence, Join::dmp3, settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const Sequence endless = Sequence().then(primitive(1)).until(on_call());
  EXPECT_THAT(refusal({0.1, 1.0, 0.0, 5.0}, endless),
              HasSubstr("primitive 1 has not handed over after 5 s"));
  EXPECT_THAT(refusal({0.0}, task()), HasSubstr("dt 0 s, must be > 0"));
  EXPECT_THAT(refusal({NAN}, task()), HasSubstr("dt nan s, must be > 0"));
  EXPECT_THAT(refusal({0.1, -1.0}, task()), HasSubstr("settle -1 s"));
  EXPECT_THAT(refusal({0.1, 0.0, INFINITY}, task()), HasSubstr("duration inf s"));
  EXPECT_THAT(refusal({1e-7}, task()), HasSubstr("rows"));
  EXPECT_THAT(refusal({}, Sequence()), HasSubstr("empty"));
}

TEST(Rollout, OfPartsThatDoNotFitIsNoRecording) {
  const Recording good = rollout(task(), Join::dmp3);
  const auto refusal = [&](auto change) {
    Recording bad = good;
    change(bad);
    try {
      bad.validate();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal([](Recording& r) { r.ref.conservativeResize(3, 2); }),
              HasSubstr("ref is 3 x 2, must be"));
  EXPECT_THAT(refusal([](Recording& r) { r.torque.setZero(r.ticks(), 1); }),
              HasSubstr("torque is"));
  EXPECT_THAT(refusal([](Recording& r) { r.running.resize(1); }), HasSubstr("running is 1 x 1"));
  EXPECT_THAT(refusal([](Recording& r) { r.effort.resize(5); }),
              HasSubstr("effort has 5 values, must be 2"));
  EXPECT_THAT(refusal([](Recording& r) { r.slides.push_back(true); }),
              HasSubstr("slides has 3 values"));
  EXPECT_THAT(refusal([](Recording& r) {
                r.signals.push_back({"s", Eigen::VectorXd::Zero(1)});
              }),
              HasSubstr("s is 1 x 1"));
}

}  // namespace
}  // namespace seam
