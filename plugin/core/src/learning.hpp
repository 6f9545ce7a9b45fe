#pragma once

#include <Eigen/Core>

#include <seam/basis.hpp>
#include <seam/learn.hpp>

namespace seam {

/// A primitive that lacks what only samples can tell: weights (zero) and the start (zero).
/// @param duration  [s], or a rhythmic movement's period
Primitive unlearned(std::vector<std::string> coordinates, const Eigen::VectorXd& goal,
                    double duration, const LearnSettings& settings);

/// The phase of a demonstration's sample.
inline double phase_of(const Basis& basis, const Demonstration& demo, int sample, double tau) {
  return basis.advance(basis.start_phase(), demo.time(sample) - demo.time(0), tau);
}

/// f* (Eq. 12) of one coordinate at one instant.
inline double forcing_target(const Primitive& primitive, Eigen::Index d, double position,
                             double velocity, double acceleration) {
  return primitive.tau * (primitive.tau * acceleration + primitive.gains.D * velocity) +
         primitive.gains.K * (position - primitive.goal(d));
}

inline double forcing_target(const Primitive& primitive, Eigen::Index d, const Demonstration& demo,
                             Eigen::Index i) {
  return forcing_target(primitive, d, demo.position(i, d), demo.velocity(i, d),
                        demo.acceleration(i, d));
}

}  // namespace seam
