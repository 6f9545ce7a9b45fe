#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/sequence.hpp>

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
                testing::StartsWith("sequence: primitive 1: its switch is due"));
  primitive.tau = -1.0;
  EXPECT_EQ(refusal([&] { Sequence().then(primitive); }), "primitive: tau -1.000000, must be > 0");
}

}  // namespace
}  // namespace seam
