#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using test::refusal;

TEST(Sequence, KnowsWhenEachSwitchIsDue) {
  std::mt19937_64 random(14);
  Primitive primitive = test::random_primitive(random, 2);
  primitive.tau = 1.0;
  Sequence sequence;
  sequence.start_after(0.5)
      .then(primitive)
      .until(before_end(0.4))
      .then(primitive)
      .until(after(2.0))
      .then(primitive);
  EXPECT_DOUBLE_EQ(sequence.duration(), 0.5 + 0.6 + 2.0 + 1.0);
  EXPECT_EQ(sequence.coordinates(), primitive.coordinates);
}

TEST(Sequence, KnowsWhenARhythmIsDueWhereverItIsEntered) {
  std::mt19937_64 random(17);
  Primitive rhythm = test::random_primitive(random, 2, 20, Kind::rhythmic);
  rhythm.tau = 0.25;
  const auto duration = [&](const Switch& until, const Entry& entry) {
    return Sequence().then(rhythm).until(until).enter(entry).duration();
  };
  EXPECT_DOUBLE_EQ(duration(at_phase(3.0), {}), 0.75);
  EXPECT_DOUBLE_EQ(duration(at_phase(3.0), from_phase(1.0)), 0.5);
  EXPECT_DOUBLE_EQ(duration(at_phase(1.0), from_phase(3.0)), 0.25 * (2.0 * M_PI - 2.0));
  EXPECT_DOUBLE_EQ(duration(at_phase(1.0), from_phase(1.0)), 0.25 * 2.0 * M_PI);
  EXPECT_EQ(duration(at_phase(1.0), least_correction()), INFINITY);
  for (const Entry& entry : {Entry{}, from_phase(1.0), least_correction()}) {
    EXPECT_DOUBLE_EQ(duration(after_cycles(2.0), entry), M_PI);
    EXPECT_EQ(duration(after(0.7), entry), 0.7);
    EXPECT_EQ(duration(near_goal(0.1), entry), INFINITY);
    EXPECT_EQ(duration(on_call(), entry), INFINITY);
  }
}

TEST(Sequence, RefusesWhatCannotBePlayed) {
  std::mt19937_64 random(15);
  Primitive primitive = test::random_primitive(random, 2);
  primitive.tau = 1.0;
  Primitive other = test::random_primitive(random, 3);
  EXPECT_EQ(refusal([] { Sequence().coordinates(); }),
            "sequence: empty, must have at least one primitive");
  EXPECT_EQ(refusal([] { Sequence().until(at_end()); }), "sequence: until() before any primitive");
  EXPECT_EQ(refusal([] { Sequence().start_after(-1.0); }),
            "sequence: start delay -1.000000 s, must be >= 0");
  EXPECT_EQ(refusal([&] { Sequence().then(primitive).then(other); }),
            "sequence: primitive 2: its coordinates differ from those of the first primitive");
  for (const Switch bad :
       {before_end(1.0), before_end(NAN), after(0.0), after(-1.0), after(INFINITY)})
    EXPECT_THAT(refusal([&] { Sequence().then(primitive).until(bad); }),
                testing::StartsWith("sequence: primitive 1: its switch "));
  const Primitive rhythm = test::random_primitive(random, 2, 20, Kind::rhythmic);
  EXPECT_EQ(refusal([&] { Sequence().then(rhythm).until(before_end(0.1)); }),
            "sequence: primitive 1: is rhythmic and has no end, its switch must be another than "
            "before_end");
  EXPECT_EQ(refusal([&] { Sequence().then(primitive).until(after_cycles(1.0)); }),
            "sequence: primitive 1: is discrete and has no cycles, its switch must be another than "
            "cycles");
  EXPECT_EQ(refusal([&] { Sequence().then(primitive).until(at_phase(1.5)); }),
            "sequence: primitive 1: its switch is at phase 1.500000, must be in (0, 1)");
  EXPECT_EQ(refusal([&] { Sequence().then(primitive).until(near_goal(0.0)); }),
            "sequence: primitive 1: its switch is at a distance of 0.000000, must be > 0");
  EXPECT_EQ(refusal([&] { Sequence().then(primitive).enter(from_phase(1.0)); }),
            "sequence: primitive 1: is discrete and always entered at its beginning");
  EXPECT_EQ(refusal([&] { Sequence().then(rhythm).enter(from_phase(NAN)); }),
            "sequence: primitive 1: its entry phase is not finite");
  primitive.tau = -1.0;
  EXPECT_EQ(refusal([&] { Sequence().then(primitive); }),
            "primitive: tau -1, must be in 1e-06 to 1e+09");
}

// Rotation vectors about two reference orientations look alike, and mean different things.
TEST(Sequence, RefusesAnotherReferenceOrientation) {
  std::mt19937_64 random(16);
  Primitive first = test::random_primitive(random, 3);
  first.coordinates = {"rx", "ry", "rz"};
  Primitive second = first;
  first.reference_orientation = Eigen::Quaterniond(0.8, 0.0, 0.0, 0.6);
  second.reference_orientation = Eigen::Quaterniond(-0.8, 0.0, 0.0, -0.6);
  Sequence sequence;
  sequence.then(first).then(second);
  EXPECT_EQ(sequence.steps()[1].primitive.reference_orientation->w(), 0.8);
  second.reference_orientation = Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0);
  const std::string differs =
      "reference orientation 0.6 0 0 0.8, must be 0 0 0.6 0.8 (x y z w), the same for all";
  EXPECT_EQ(refusal([&] { sequence.then(second); }), "sequence: primitive 3: " + differs);
  Sequencer sequencer(sequence, Join::dmp3, Sample(3));
  const Sequence other = Sequence().then(second);
  EXPECT_EQ(refusal([&] { sequencer.append(other); }), "sequencer: " + differs);
  EXPECT_EQ(refusal([&] { sequencer.replace(other); }), "sequencer: " + differs);
  second.reference_orientation.reset();
  EXPECT_EQ(refusal([&] { sequence.then(second); }),
            "sequence: primitive 3: reference orientation unknown, must be 0 0 0.6 0.8 (x y z w), "
            "the same for all");
  EXPECT_EQ(refusal([&] { Sequence().then(second).then(first); }),
            "sequence: primitive 2: reference orientation 0 0 0.6 0.8, must be unknown (x y z w), "
            "the same for all");
}

}  // namespace
}  // namespace seam
