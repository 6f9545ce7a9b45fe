#include <random>

#include <gmock/gmock.h>

#include <seam/glide.hpp>

namespace seam {
namespace {

using Vector = Eigen::Vector3d;

TEST(Glide, GoesByTheQuinticFromRestToRest) {
  Glide<double> glide(2.0);
  ASSERT_TRUE(glide.move(5.0, 1.0, 0.5));
  EXPECT_EQ(glide.value(0.9), 2.0);
  EXPECT_EQ(glide.value(1.0), 2.0);
  for (const double s : {0.1, 0.5, 0.8})
    EXPECT_NEAR(glide.value(1.0 + 0.5 * s), 5.0 - 3.0 * fade(s), 1e-14);
  EXPECT_EQ(glide.value(1.5), 5.0);
  EXPECT_EQ(glide.value(1e9), 5.0);
  EXPECT_EQ(glide.rate(1.5), 0.0);
  EXPECT_EQ(glide.target(), 5.0);
}

// Sent elsewhere at any time, any number of times: value, rate and curvature are what they were, and each the derivative of
// the one before it.
TEST(Glide, ContinuesWhereverItIsSentOnTheWay) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto somewhere = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  Glide<Vector> glide(somewhere());
  double time = 0.0;
  for (int i = 0; i < 1000; ++i) {
    time += uniform(random);
    const Glide<Vector> before = glide;
    ASSERT_TRUE(glide.move(somewhere(), time, 0.01 + uniform(random)));
    EXPECT_LT((glide.value(time) - before.value(time)).norm(), 1e-14);
    EXPECT_LT((glide.rate(time) - before.rate(time)).norm(), 1e-11);
    EXPECT_LT((glide.curvature(time) - before.curvature(time)).norm(), 1e-8) << "seed 71, " << i;
    EXPECT_EQ(glide.value(time - 1e-3), before.value(time - 1e-3));
    const double h = 1e-6;
    const double at = time + h + 0.1 * uniform(random);
    const double fastest = 1.0 + glide.curvature(at).norm();
    EXPECT_LT(((glide.value(at + h) - glide.value(at - h)) / (2.0 * h) - glide.rate(at)).norm(),
              1e-5 * fastest);
    EXPECT_LT(((glide.rate(at + h) - glide.rate(at - h)) / (2.0 * h) - glide.curvature(at)).norm(),
              1e-3 * fastest)
        << "seed 71, " << i;
    // Over a long time nothing carries it far beyond where it has been sent.
    EXPECT_LT((glide.value(at) - Vector::Constant(0.5)).cwiseAbs().maxCoeff(), 1.5);
  }
}

// A strength that comes and goes at any time stays a strength.
TEST(Glide, OfAStrengthStaysWithinItsBounds) {
  std::mt19937_64 random(72);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    Glide<double> strength(0.0);
    ASSERT_TRUE(strength.move(1.0, 0.0, 0.3));
    const double turn = 0.3 * uniform(random);
    ASSERT_TRUE(strength.move(0.0, turn, std::pow(10.0, -2.0 + 4.0 * uniform(random))));
    for (double t = turn; t < turn + 5.0; t += 0.01) {
      EXPECT_GE(strength.value(t), -1e-14) << "seed 72, case " << i;
      EXPECT_LE(strength.value(t), 1.0 + 1e-14) << "seed 72, case " << i;
    }
  }
}

TEST(Glide, DropsAMoveThatHasNotBegun) {
  Glide<double> glide(0.0);
  ASSERT_TRUE(glide.move(1.0, 5.0, 1.0));
  ASSERT_TRUE(glide.move(-1.0, 2.0, 1.0));
  EXPECT_EQ(glide.value(1.0), 0.0);
  EXPECT_EQ(glide.value(7.0), -1.0);
}

TEST(Glide, RefusesWhatWillNotDo) {
  Glide<Vector> glide(Vector::Zero());
  EXPECT_FALSE(glide.move(Vector(NAN, 0, 0), 0.0, 1.0));
  EXPECT_FALSE(glide.move(Vector::Ones(), INFINITY, 1.0));
  for (const double over : {0.0, -1.0, 1e-7, 1e7, static_cast<double>(NAN)})
    EXPECT_FALSE(glide.move(Vector::Ones(), 0.0, over));
  EXPECT_EQ(glide.value(1.0), Vector::Zero());
}

}  // namespace
}  // namespace seam
