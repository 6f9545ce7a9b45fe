#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include "tests/allocation_guard.hpp"
#include "tests/support.hpp"
#include <seam/orientation.hpp>
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr unsigned seed = 41;

Vector3d random_vector(std::mt19937_64& random, double length) {
  std::normal_distribution<double> normal;
  const Vector3d v(normal(random), normal(random), normal(random));
  return length * v.normalized();
}

Quaterniond random_orientation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

RotationState random_state(std::mt19937_64& random, double angle) {
  return {random_vector(random, angle), random_vector(random, 2.0), random_vector(random, 10.0)};
}

TEST(Orientation, RotationVectorsComeBack) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 2000; ++i) {
    const Quaterniond q0 = random_orientation(random);
    const Vector3d rho = random_vector(random, uniform(random, 0.0, M_PI - 1e-6));
    const Quaterniond q = orientation(rho, q0);
    EXPECT_NEAR(q.norm(), 1.0, 1e-14);
    EXPECT_LT((rotation_vector(q, q0) - rho).norm(), 1e-14) << "seed " << seed << ", case " << i;
    EXPECT_EQ(rotation_vector(Quaterniond(-q.coeffs()), q0), rotation_vector(q, q0));
  }
}

TEST(Orientation, RotationVectorsOfMatricesAreThoseOfQuaternions) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 2000; ++i) {
    const double angle = std::pow(10.0, uniform(random, -12.0, 0.49));
    const Vector3d rho = angle * random_vector(random, 1.0).normalized();
    const Quaterniond q0 = random_orientation(random);
    const Eigen::Matrix3d turned = orientation(rho, Quaterniond::Identity()).toRotationMatrix();
    EXPECT_LT((rotation_vector(turned, Eigen::Matrix3d::Identity()) - rho).norm(), 1e-14 * angle)
        << "seed " << seed << ", angle " << angle;
    const Eigen::Matrix3d R0 = q0.toRotationMatrix();
    EXPECT_LT((rotation_vector(turned * R0, R0) - rho).norm(), 2e-15 + 1e-14 * angle)
        << "seed " << seed << ", angle " << angle;
  }
}

TEST(Orientation, OrientationsComeBack) {
  std::mt19937_64 random(seed + 1);
  for (int i = 0; i < 2000; ++i) {
    const Quaterniond q0 = random_orientation(random);
    const Quaterniond q = random_orientation(random);
    const Vector3d rho = rotation_vector(q, q0);
    EXPECT_LE(rho.norm(), M_PI);
    EXPECT_NEAR(std::abs(orientation(rho, q0).dot(q)), 1.0, 1e-14)
        << "seed " << seed + 1 << ", case " << i;
  }
}

// Eigen's own conversions, with the reference on the right: a world-fixed axis.
TEST(Orientation, TurnsAboutAnAxisOfTheFixedFrame) {
  std::mt19937_64 random(seed + 2);
  const Quaterniond q0 = random_orientation(random);
  const Quaterniond q = orientation({0.0, 0.0, 0.7}, q0);
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(0.7, Vector3d::UnitZ()).toRotationMatrix() * q0.toRotationMatrix();
  EXPECT_LT((q.toRotationMatrix() - expected).norm(), 1e-14);
}

TEST(Orientation, StatesComeBackAlsoNearAFullTurn) {
  std::mt19937_64 random(seed + 3);
  for (int i = 0; i < 3000; ++i) {
    const Quaterniond q0 = random_orientation(random);
    const double angle = std::pow(10.0, uniform(random, -12.0, std::log10(2.0 * M_PI - 0.05)));
    const RotationState state = random_state(random, angle);
    OrientationState turned;
    RotationState back;
    back.vector = 1.001 * state.vector;  // the last tick's
    EXPECT_EQ(to_orientation(state, q0, turned), angle <= M_PI);
    EXPECT_EQ(to_rotation(turned, q0, back), angle <= M_PI);
    const double gain = angle < M_PI ? 1.0 : 1.0 / (2.0 * M_PI - angle);  // of J⁻¹
    const double bound = 2e-13 * gain * gain;
    EXPECT_LT((back.vector - state.vector).norm(), bound) << "seed " << seed + 3 << ", case " << i;
    EXPECT_LT((back.velocity - state.velocity).norm(), 2.0 * bound) << angle;
    EXPECT_LT((back.acceleration - state.acceleration).norm(), 10.0 * gain * bound) << angle;
  }
}

// ω and ω̇ from the axis n and the angle θ, in extended precision:
//     ω = θ̇n + sin θ ṅ + (1 − cos θ) n×ṅ
using Long3 = Eigen::Matrix<long double, 3, 1>;

struct Expected {
  Vector3d velocity, acceleration;
};

Expected from_axis_and_angle(const RotationState& state) {
  const Long3 rho = state.vector.cast<long double>();
  const Long3 rate = state.velocity.cast<long double>();
  const Long3 second = state.acceleration.cast<long double>();
  const long double angle = rho.norm();
  const Long3 n = rho / angle;
  const long double angle1 = n.dot(rate);
  const Long3 n1 = (rate - n * angle1) / angle;
  const long double angle2 = n.dot(second) + n1.dot(rate);
  const Long3 n2 = (second - angle2 * n - 2.0L * angle1 * n1) / angle;
  const long double sine = std::sin(angle);
  const long double cosine = std::cos(angle);
  const long double versine = 2.0L * std::sin(angle / 2.0L) * std::sin(angle / 2.0L);
  const Long3 omega = angle1 * n + sine * n1 + versine * n.cross(n1);
  const Long3 omega1 = angle2 * n + angle1 * n1 + cosine * angle1 * n1 + sine * n2 +
                       sine * angle1 * n.cross(n1) + versine * n.cross(n2);
  return {omega.cast<double>(), omega1.cast<double>()};
}

TEST(Orientation, AngularVelocityAndAccelerationAreThoseOfAxisAndAngle) {
  std::mt19937_64 random(seed + 4);
  for (int i = 0; i < 5000; ++i) {
    const double angle = std::pow(10.0, uniform(random, -9.0, std::log10(6.2)));
    RotationState state = random_state(random, angle);
    const double scale = std::min(1.0, angle);  // all small alike: no digits cancel
    state.velocity *= scale;
    state.acceleration *= scale;
    const Expected expected = from_axis_and_angle(state);
    OrientationState turned;
    (void)to_orientation(state, Quaterniond::Identity(), turned);
    EXPECT_LT((turned.velocity - expected.velocity).norm(), 1e-14 * state.velocity.norm())
        << "seed " << seed + 4 << ", case " << i << ", angle " << angle;
    EXPECT_LT((turned.acceleration - expected.acceleration).norm(),
              1e-14 * state.acceleration.norm() + 1e-14 * state.velocity.squaredNorm())
        << "seed " << seed + 4 << ", case " << i << ", angle " << angle;
  }
}

TEST(Orientation, TakesTheLimitAtTheReference) {
  const RotationState at{Vector3d::Zero(), {1.0, -2.0, 0.5}, {3.0, 0.1, -4.0}};
  OrientationState turned;
  ASSERT_TRUE(to_orientation(at, Quaterniond::Identity(), turned));
  EXPECT_EQ(turned.orientation.coeffs(), Quaterniond::Identity().coeffs());
  EXPECT_EQ(turned.velocity, at.velocity);
  EXPECT_EQ(turned.acceleration, at.acceleration);
  for (const double angle : {1e-8, 1e-150, 1e-300, 5e-324}) {
    const Vector3d rho(0.0, angle, 0.0);
    EXPECT_LE(
        (rotation_vector(orientation(rho, Quaterniond::Identity()), Quaterniond::Identity()) - rho)
            .norm(),
        1e-15 * angle);
    RotationState near = at;
    near.vector = rho;
    ASSERT_TRUE(to_orientation(near, Quaterniond::Identity(), turned));
    const Vector3d omega = at.velocity + 0.5 * rho.cross(at.velocity);
    const Vector3d omega1 = at.acceleration + 0.5 * rho.cross(at.acceleration) +
                            at.velocity.cross(rho.cross(at.velocity)) / 6.0;
    EXPECT_LE((turned.velocity - omega).norm(), 1e-14 * omega.norm());
    EXPECT_LE((turned.acceleration - omega1).norm(), 1e-14 * omega1.norm());
  }
}

// Numerical derivatives of the orientation itself, of fourth order.
Vector3d curve(double t) {
  return {1.2 * std::sin(1.3 * t), 0.9 * std::cos(0.7 * t) - 0.3, 0.8 * std::sin(2.1 * t + 0.4)};
}

RotationState curve_state(double t) {
  return {
      curve(t),
      {1.56 * std::cos(1.3 * t), -0.63 * std::sin(0.7 * t), 1.68 * std::cos(2.1 * t + 0.4)},
      {-2.028 * std::sin(1.3 * t), -0.441 * std::cos(0.7 * t), -3.528 * std::sin(2.1 * t + 0.4)}};
}

template <typename Value>
Value derivative(const std::function<Value(double)>& f, double t, double h) {
  return Value((8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h));
}

TEST(Orientation, AngularVelocityAndAccelerationAreDerivatives) {
  std::mt19937_64 random(seed + 5);
  const Quaterniond q0 = random_orientation(random);
  const auto q = [&](double t) { return Eigen::Vector4d(orientation(curve(t), q0).coeffs()); };
  const auto omega = [&](double t) {
    OrientationState at;
    (void)to_orientation(curve_state(t), q0, at);
    return at.velocity;
  };
  for (double t = 0.0; t < 6.0; t += 0.37) {
    OrientationState at;
    ASSERT_TRUE(to_orientation(curve_state(t), q0, at)) << t;
    const Quaterniond rate(derivative<Eigen::Vector4d>(q, t, 1e-3));
    const Vector3d numerical = 2.0 * (rate * at.orientation.conjugate()).vec();
    EXPECT_LT((at.velocity - numerical).norm(), 1e-10) << t;
    EXPECT_LT((at.acceleration - derivative<Vector3d>(omega, t, 1e-3)).norm(), 1e-10) << t;
  }
}

TEST(Orientation, FollowsAMotionAcrossAHalfTurn) {
  const Quaterniond q0 = Quaterniond::Identity();
  RotationState followed;
  for (double angle = 3.0; angle < 3.3; angle += 0.01) {
    const OrientationState at{orientation({angle, 0.0, 0.0}, q0), {1.0, 0.0, 0.0}};
    followed.vector = {angle - 0.01, 0.0, 0.0};
    EXPECT_EQ(to_rotation(at, q0, followed), angle <= M_PI);
    EXPECT_NEAR(followed.vector(0), angle, 1e-14);
    RotationState alone;
    EXPECT_TRUE(to_rotation(at, q0, alone));
    EXPECT_NEAR(alone.vector(0), angle <= M_PI ? angle : angle - 2.0 * M_PI, 1e-14);
  }
}

TEST(Orientation, ReportsWhatItCannotMap) {
  const Quaterniond q0 = Quaterniond::Identity();
  OrientationState turned;
  RotationState bad;
  EXPECT_TRUE(to_orientation({{M_PI, 0.0, 0.0}}, q0, turned));
  EXPECT_FALSE(to_orientation({{M_PI + 1e-6, 0.0, 0.0}}, q0, turned));
  EXPECT_NEAR(turned.orientation.w(), -5e-7, 1e-12);
  bad.acceleration(2) = NAN;
  turned.velocity(0) = 7.0;
  EXPECT_FALSE(to_orientation(bad, q0, turned));
  EXPECT_EQ(turned.velocity(0), 7.0);
  turned.orientation.x() = NAN;
  RotationState kept;
  kept.vector(1) = 0.5;
  EXPECT_FALSE(to_rotation(turned, q0, kept));
  EXPECT_EQ(kept.vector(1), 0.5);
}

TEST(Orientation, MapsWithoutAllocating) {
  std::mt19937_64 random(seed + 6);
  const Quaterniond q0 = random_orientation(random);
  const RotationState state = random_state(random, 1.0);
  OrientationState turned;
  RotationState back;
  const AllocationGuard guard;
  EXPECT_TRUE(to_orientation(state, q0, turned));
  EXPECT_TRUE(to_rotation(turned, q0, back));
  const Vector3d again = rotation_vector(orientation(back.vector, q0), q0);
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_LT((again - state.vector).norm(), 1e-14);
  static_assert(noexcept(to_orientation(state, q0, turned)));
  static_assert(noexcept(to_rotation(turned, q0, back)));
}

// What a join leaves in ω̇, from the exact one-sided accelerations.
double acceleration_step(Join method) {
  std::mt19937_64 random(seed + 7);
  Primitive first = test::random_primitive(random, 3);
  Primitive second = test::random_primitive(random, 3);
  for (Primitive* primitive : {&first, &second}) primitive->weights *= 0.5;
  Sequence sequence;
  sequence.then(first).until(after(0.5)).then(second);
  Sequencer sequencer(sequence, method, Sample::at_rest(first.start_position));
  for (int i = 0; i < 500; ++i) sequencer.step(1e-3);
  EXPECT_EQ(sequencer.joins(), 2);
  const JoinEvent& join = sequencer.join(1);
  const Sample& at = sequencer.sample();
  const Quaterniond q0 = random_orientation(random);
  OrientationState before;
  OrientationState after;
  EXPECT_TRUE(to_orientation({at.position, at.velocity, join.acceleration_before}, q0, before));
  EXPECT_TRUE(to_orientation({at.position, at.velocity, join.acceleration_after}, q0, after));
  EXPECT_GT(before.velocity.norm(), 0.1) << "nothing turns at the join";
  return (after.acceleration - before.acceleration).norm() / before.acceleration.norm();
}

TEST(Orientation, AJoinIsContinuousInAngularAcceleration) {
  EXPECT_GT(acceleration_step(Join::dmp2), 1e-2);
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j})
    EXPECT_LT(acceleration_step(method), 1e-9) << to_string(method);
}

// The same seen from outside: differences of the orientation across the join shrink with the step.
TEST(Orientation, AJoinIsContinuousInAngularVelocityAndAccelerationAsSampled) {
  std::mt19937_64 random(seed + 8);
  Sequence sequence;
  sequence.then(test::random_primitive(random, 3)).until(after(0.5));
  sequence.then(test::random_primitive(random, 3));
  const Sample start = Sample::at_rest(sequence.steps()[0].primitive.start_position);
  const auto step_of = [&](Join method, double dt) {
    Sequencer sequencer(sequence, method, start);
    sequencer.step(0.5 - dt);
    OrientationState before;
    OrientationState after;
    const auto now = [&](OrientationState& state) {
      const Sample& at = sequencer.sample();
      (void)to_orientation({at.position, at.velocity, at.acceleration}, Quaterniond::Identity(),
                           state);
    };
    now(before);
    sequencer.step(2.0 * dt);
    now(after);
    EXPECT_LT((after.velocity - before.velocity).norm(), 1e3 * dt);
    return (after.acceleration - before.acceleration).norm();
  };
  for (const Join method : {Join::dmp2a, Join::dmp3, Join::dmp2j})
    EXPECT_LT(step_of(method, 1e-6), 0.02 * step_of(method, 1e-4)) << to_string(method);
  EXPECT_GT(step_of(Join::dmp2, 1e-6), 0.5 * step_of(Join::dmp2, 1e-4));
}

// A turn about a skew axis beside a straight line, with signs of the quaternions that jump about.
Demonstration turning(double angle, const Quaterniond& q0, int samples = 101) {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0);
  Eigen::MatrixXd position(samples, 6);
  for (int i = 0; i < samples; ++i) {
    const double s = time(i) * time(i) * (3.0 - 2.0 * time(i));
    const Quaterniond q = orientation(angle * s * Vector3d(0.6, 0.0, 0.8), q0);
    const double sign = i % 3 == 1 ? -1.0 : 1.0;
    position.row(i) << time(i), sign * 1.0005 * q.x(), sign * 1.0005 * q.y(), sign * 1.0005 * q.z(),
        sign * 1.0005 * q.w(), 2.0 * time(i);
  }
  return Demonstration::from_positions({"x", "qx", "qy", "qz", "qw", "z"}, time, position);
}

TEST(OrientationDemonstration, BecomesThreeCoordinates) {
  std::mt19937_64 random(seed + 9);
  const Quaterniond q0 = random_orientation(random);
  Demonstration demo = turning(3.0, q0);
  demo.source = "turn.csv";
  EXPECT_NEAR(std::abs(first_orientation(demo).dot(q0)), 1.0, 1e-14);
  const Demonstration turned = with_rotation_vector(demo, first_orientation(demo));
  EXPECT_EQ(turned.coordinates, (std::vector<std::string>{"x", "rx", "ry", "rz", "z"}));
  Eigen::MatrixXd vectors(demo.samples(), 3);
  for (int i = 0; i < demo.samples(); ++i) {
    const double t = demo.time(i);
    vectors.row(i) = 3.0 * t * t * (3.0 - 2.0 * t) * Eigen::RowVector3d(0.6, 0.0, 0.8);
  }
  const Demonstration expected =
      Demonstration::from_positions({"rx", "ry", "rz"}, demo.time, vectors);
  EXPECT_LT((turned.position.middleCols(1, 3) - vectors).norm(), 1e-12);
  EXPECT_LT((turned.velocity.middleCols(1, 3) - expected.velocity).norm(), 1e-9);
  EXPECT_LT((turned.acceleration.middleCols(1, 3) - expected.acceleration).norm(), 1e-6);
  EXPECT_EQ(turned.source, "turn.csv");
  EXPECT_EQ(turned.position.col(4), demo.position.col(5));
  EXPECT_EQ(turned.velocity.col(0), demo.velocity.col(0));
  EXPECT_EQ(turned.acceleration.col(4), demo.acceleration.col(5));
}

TEST(OrientationDemonstration, CarriesItsReferenceToThePrimitive) {
  const Quaterniond q0(0.8, 0.0, 0.6, 0.0);
  const Demonstration turned = with_rotation_vector(turning(1.0, q0), q0);
  EXPECT_EQ(turned.reference_orientation->coeffs(), q0.coeffs());
  EXPECT_EQ(turned.resample(50.0).reference_orientation->coeffs(), q0.coeffs());
  EXPECT_EQ(learn(turned).reference_orientation->coeffs(), q0.coeffs());
  Primitive other = learn(turned);
  other.reference_orientation = Quaterniond::Identity();
  EXPECT_THAT(test::refusal([&] { assess(turned, other); }), HasSubstr("must be 0 0 0 1"));
  Demonstration bad = turned;
  bad.coordinates[1] = "roll";
  EXPECT_THAT(test::refusal([&] { learn(bad); }), HasSubstr("must have the coordinates rx, ry"));
  EXPECT_THAT(
      test::refusal([&] { with_rotation_vector(turning(1.0, q0), Quaterniond(1, 1, 0, 0)); }),
      HasSubstr("of norm 1.41421356, must be 1 within 1e-9"));
}

// About another reference it is the same motion: q, ω and ω̇ stay.
TEST(OrientationDemonstration, CanBeTurnedAboutAnotherReference) {
  std::mt19937_64 random(seed + 10);
  const Quaterniond q0 = random_orientation(random);
  const Quaterniond q1 = orientation({0.3, -0.2, 0.4}, q0);
  const Demonstration from = with_rotation_vector(turning(2.0, q0), q0);
  const Demonstration to = with_reference(from, q1);
  EXPECT_EQ(to.reference_orientation->coeffs(), q1.coeffs());
  EXPECT_EQ(to.position.col(0), from.position.col(0));
  EXPECT_EQ(to.acceleration.col(4), from.acceleration.col(4));
  EXPECT_LT((to.position - with_rotation_vector(turning(2.0, q0), q1).position).norm(), 1e-12);
  const auto state = [](const Demonstration& demo, int i) {
    OrientationState at;
    EXPECT_TRUE(to_orientation({demo.position.row(i).segment<3>(1).transpose(),
                                demo.velocity.row(i).segment<3>(1).transpose(),
                                demo.acceleration.row(i).segment<3>(1).transpose()},
                               *demo.reference_orientation, at));
    return at;
  };
  for (const int i : {0, 37, 100}) {
    EXPECT_LT((state(from, i).velocity - state(to, i).velocity).norm(), 1e-12);
    EXPECT_LT((state(from, i).acceleration - state(to, i).acceleration).norm(), 1e-11);
  }
  EXPECT_THAT(test::refusal([&] {
                with_reference(from, orientation({-1.9, 0.0, -2.5}, q0));
              }),
              HasSubstr("rad from the reference orientation, must be within pi"));
  EXPECT_THAT(test::refusal([&] { with_reference(turning(1.0, q0), q1); }),
              HasSubstr("has no reference orientation"));
}

TEST(OrientationDemonstration, MayEndAHalfTurnFromItsReferenceAndNotFurther) {
  const Quaterniond q0 = Quaterniond::Identity();
  EXPECT_EQ(with_rotation_vector(turning(M_PI, q0), q0).samples(), 101);
  EXPECT_THAT(test::refusal([&] { with_rotation_vector(turning(M_PI + 0.01, q0), q0); }),
              testing::AllOf(testing::StartsWith("demonstration: sample "),
                             HasSubstr("rad from the reference orientation, must be within pi")));
}

TEST(OrientationDemonstration, IsRefusedWhereItIsNoOrientation) {
  const Quaterniond q0 = Quaterniond::Identity();
  const auto spoiled = [&](const std::function<void(Demonstration&)>& spoil) {
    Demonstration demo = turning(1.0, q0);
    spoil(demo);
    return test::refusal([&] { with_rotation_vector(demo, q0); });
  };
  EXPECT_EQ(spoiled([](Demonstration& demo) { demo.position.row(6).segment<4>(1).setZero(); }),
            "demonstration: sample 7: quaternion of norm 0.000000, must be 1 within 0.001");
  EXPECT_THAT(spoiled([](Demonstration& demo) { demo.position.row(6) *= 1.002; }),
              HasSubstr("sample 7: quaternion of norm 1.002501, must be 1 within 0.001"));
  EXPECT_THAT(spoiled([](Demonstration& demo) { demo.position(0, 2) = NAN; }),
              HasSubstr("sample 1: quaternion of norm nan"));
  EXPECT_EQ(spoiled([](Demonstration& demo) { demo.coordinates[4] = "w"; }),
            "demonstration: no column \"qw\", an orientation must have qx, qy, qz and qw");
  EXPECT_EQ(spoiled([](Demonstration& demo) { demo.coordinates[5] = "ry"; }),
            "demonstration: column \"ry\" is there beside qx, qy, qz and qw");
  EXPECT_THAT(test::refusal([] { first_orientation({}); }), HasSubstr("no samples"));
}

}  // namespace
}  // namespace seam
