// The matchers for users' tests, and what they say.

#include "seam/testing.hpp"  // first: it needs nothing of GoogleTest

#include <limits>

#include <gmock/gmock.h>

namespace seam {
namespace {

using testing::HasSubstr;
using testing::Not;

Recording stepping() {
  Recording recording({"shoulder", "elbow"}, Eigen::Vector2d(10.0, 4.0), 100);
  recording.time.setLinSpaced(100, 0.0, 0.99);
  recording.torque.col(0).tail(50).setConstant(0.25);
  recording.torque.col(1).tail(50).setConstant(-1.5);
  recording.torque.col(1).tail(20).array() += 2.0;
  recording.ref_acc.col(0).tail(50).setConstant(7.0);
  recording.q(60, 1) = 0.02;
  recording.joins = {{0.5, 1, 0.0}, {0.8, 2, 0.0}};
  return recording;
}

template <typename Matcher>
std::string said(const Matcher& matcher, const Recording& recording) {
  testing::StringMatchResultListener listener;
  const testing::Matcher<const Recording&> any = matcher;
  const bool matches = any.MatchAndExplain(recording, &listener);
  EXPECT_EQ(matches, listener.str().empty());
  EXPECT_EQ(matcher.why_not(recording), listener.str());
  return listener.str();
}

template <typename Matcher>
std::string description(const Matcher& matcher) {
  return testing::DescribeMatcher<const Recording&>(matcher);
}

TEST(TorqueIsContinuousAt, HoldsWithinTheLimitAndNotBeyond) {
  EXPECT_THAT(stepping(), TorqueIsContinuousAt(0.3).within(1e-9));
  EXPECT_THAT(stepping(), TorqueIsContinuousAt(0.5).within(1.51));
  EXPECT_THAT(stepping(), Not(TorqueIsContinuousAt(0.5).within(1.49)));
}

TEST(TorqueIsContinuousAt, NamesJointSizeTimeAndLimit) {
  EXPECT_EQ(said(TorqueIsContinuousAt(0.5).within(0.5), stepping()),
            "torque of joint elbow steps by -1.5 N·m at 0.5 s, must be within 0.5 N·m");
  EXPECT_EQ(description(TorqueIsContinuousAt(0.5).within(0.5)),
            "torque steps by no more than 0.5 N·m at 0.5 s");
}

TEST(TorqueIsContinuousAt, FailsWhereItCannotBeMeasured) {
  EXPECT_THAT(said(TorqueIsContinuousAt(0.01).within(5.0), stepping()),
              HasSubstr("cannot be measured at 0.01 s: needs 4 finite ticks to either side"));
  EXPECT_THAT(stepping(), Not(TorqueIsContinuousAt(7.0).within(5.0)));
  EXPECT_EQ(said(TorqueIsContinuousAt(0.5).within(5.0), Recording()),
            "torque cannot be measured: it is not in the recording");
  Recording broken = stepping();
  broken.torque(52, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(broken, Not(TorqueIsContinuousAt(0.5).within(5.0)));
}

TEST(TorqueIsContinuousAt, FitsLongerLinesToNoise) {
  Recording noisy = stepping();
  noisy.torque.setZero();
  noisy.torque.col(1).segment(48, 1).setConstant(0.4);
  EXPECT_THAT(noisy, Not(TorqueIsContinuousAt(0.5).within(0.5)));
  EXPECT_THAT(noisy, TorqueIsContinuousAt(0.5).within(0.5).fitting(20));
  EXPECT_THAT(said(TorqueIsContinuousAt(0.1).within(0.5).fitting(20), noisy),
              HasSubstr("needs 21 finite ticks to either side"));
}

TEST(TorqueIsContinuousAtAllJoins, NamesTheWorst) {
  EXPECT_EQ(said(TorqueIsContinuousAtAllJoins().within(0.5), stepping()),
            "torque of joint elbow steps by 2 N·m at 0.8 s, must be within 0.5 N·m");
  EXPECT_THAT(stepping(), TorqueIsContinuousAtAllJoins().within(2.1));
  EXPECT_EQ(description(TorqueIsContinuousAtAllJoins().within(0.5)),
            "torque steps by no more than 0.5 N·m at any join");
  Recording none = stepping();
  none.joins.clear();
  EXPECT_EQ(said(TorqueIsContinuousAtAllJoins().within(9.0), none),
            "there is no join in the recording");
}

TEST(AccelerationIsContinuousAt, NamesJointSizeTimeAndLimit) {
  EXPECT_THAT(stepping(), AccelerationIsContinuousAt(0.8).within(1e-9));
  EXPECT_EQ(said(AccelerationIsContinuousAt(0.5).within(1.0), stepping()),
            "reference acceleration of joint shoulder steps by 7 rad/s² at 0.5 s, must be within "
            "1 rad/s²");
}

TEST(TracksWithin, NamesJointSizeTimeAndLimit) {
  EXPECT_THAT(stepping(), TracksWithin(0.021));
  EXPECT_EQ(said(TracksWithin(0.01), stepping()),
            "joint elbow is 0.02 rad from its reference at 0.6 s, must be within 0.01 rad");
  EXPECT_EQ(description(TracksWithin(0.01)), "joints stay within 0.01 rad of their references");
  Recording bare = stepping();
  bare.ref.resize(0, 0);
  EXPECT_THAT(said(TracksWithin(9.0), bare), HasSubstr("needs ref and q"));
}

TEST(Matchers, ShowARecordingInAFewWords) {
  EXPECT_EQ(testing::PrintToString(stepping()), "a recording of 2 joints, 100 ticks, 2 joins");
}

}  // namespace
}  // namespace seam
