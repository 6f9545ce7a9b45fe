#include <cmath>

#include "learning.hpp"
#include <seam/error.hpp>
#include <seam/recursive_learner.hpp>

namespace seam {

RecursiveLearner::RecursiveLearner(std::vector<std::string> coordinates,
                                   const Eigen::VectorXd& goal, double duration,
                                   const LearnSettings& settings, double lambda)
    : primitive_(unlearned(std::move(coordinates), goal, duration, settings)),
      basis_(primitive_),
      P_(lambda * Eigen::MatrixXd::Identity(basis_.count(), basis_.count())),
      row_(basis_.count()),
      gain_(basis_.count()),
      target_(goal.size()),
      miss_(goal.size()) {
  if (!(std::isfinite(lambda) && lambda > 0.0))
    throw Error("recursive learner", "lambda " + std::to_string(lambda) + ", must be > 0");
}

bool RecursiveLearner::add(double time, const Eigen::Ref<const Eigen::VectorXd>& position,
                           const Eigen::Ref<const Eigen::VectorXd>& velocity,
                           const Eigen::Ref<const Eigen::VectorXd>& acceleration) noexcept {
  const Eigen::Index D = primitive_.goal.size();
  if (position.size() != D || velocity.size() != D || acceleration.size() != D) return false;
  for (Eigen::Index d = 0; d < D; ++d)
    target_(d) = forcing_target(primitive_, d, position(d), velocity(d), acceleration(d));
  if (!std::isfinite(time) || !target_.allFinite()) return false;
  if (samples_++ == 0) {
    start_time_ = time;
    primitive_.start_position = position;
    primitive_.start_velocity = velocity;
    primitive_.start_acceleration = acceleration;
  }
  basis_.regressor(basis_.advance(basis_.start_phase(), time - start_time_, primitive_.tau),
                   row_.data());
  gain_.noalias() = P_ * row_;
  const double scale = 1.0 / (1.0 + row_.dot(gain_));
  miss_.noalias() = target_ - row_.transpose() * primitive_.weights;
  primitive_.weights.noalias() += scale * gain_ * miss_;
  P_.noalias() -= scale * gain_ * gain_.transpose();
  return true;
}

}  // namespace seam
