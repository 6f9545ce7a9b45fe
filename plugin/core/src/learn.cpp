#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "learning.hpp"
#include "least_squares.hpp"
#include "shown.hpp"
#include <seam/basis.hpp>
#include <seam/error.hpp>
#include <seam/learn.hpp>
#include <seam/period.hpp>
#include <seam/recursive_learner.hpp>

namespace seam {

namespace {

constexpr int most_kernels = 100;
constexpr double widths_tried[] = {0.5, 0.75, 1.0, 1.5};

void require_setting(bool holds, const std::string& name, double value, const std::string& limit) {
  if (!holds) throw Error("learning", name + " " + shown(value) + ", must be " + limit);
}

void require_settings(const LearnSettings& settings) {
  require_setting(settings.kernels == 0 || settings.kernels >= 2, "kernels", settings.kernels,
                  ">= 2, or 0 for the default");
  require_setting(settings.width >= 0.0, "width", settings.width, "> 0, or 0 for the default");
  require_setting(std::isfinite(settings.period) && settings.period >= 0.0, "period",
                  settings.period, "> 0 s, or 0 to find it");
  require_setting(std::isfinite(settings.precision) && settings.precision >= 0.0, "precision",
                  settings.precision, "> 0, or 0 for none");
}

int kernel_count(const LearnSettings& settings) {
  if (settings.kernels > 0) return settings.kernels;
  return settings.kind == Kind::discrete ? 10 : 20;
}

Kernels make_kernels(const LearnSettings& settings) {
  const bool discrete = settings.kind == Kind::discrete;
  const double standard = discrete ? 0.75 : 0.32 * 20.0 / (2.0 * M_PI);
  const double width = settings.width > 0.0 ? settings.width : standard;
  return discrete ? Kernels::even_in_time(kernel_count(settings), width, settings.alpha)
                  : Kernels::even_in_phase(kernel_count(settings), width);
}

void require_samples(const Demonstration& demo, int kernels) {
  if (demo.samples() < 2 * kernels)
    throw Error(demo.source, std::to_string(demo.samples()) + " samples, must be >= " +
                                 std::to_string(2 * kernels) + " (2 per kernel)");
}

double period_of(const Demonstration& demo, const LearnSettings& settings) {
  if (settings.period == 0.0) return find_period(demo);
  const double held = demo.duration() * demo.samples() / (demo.samples() - 1.0);
  if (held < settings.period * (1.0 - 1e-9))
    throw Error(demo.source, "lasts " + shown(demo.duration()) + " s, must hold a period of " +
                                 shown(settings.period) + " s");
  return settings.period;
}

Eigen::MatrixXd least_squares_weights(const Demonstration& demo, const Primitive& primitive) {
  const Basis basis(primitive);
  const int M = basis.count();
  LeastSquares problem(M, demo.dimensions());
  for (int i = 0; i < demo.samples(); ++i) {
    double* row = problem.next_row();
    basis.regressor(phase_of(basis, demo, i, primitive.tau), row);
    for (int d = 0; d < demo.dimensions(); ++d) row[M + d] = forcing_target(primitive, d, demo, i);
  }
  return problem.solution();
}

double kernel(const Primitive& primitive, int j, double phase) {
  const double c = primitive.kernels.centers(j);
  const double width = primitive.kernels.widths(j);
  const double exponent = primitive.kind == Kind::discrete ? -0.5 * (phase - c) * (phase - c)
                                                           : std::cos(phase - c) - 1.0;
  return std::exp(exponent / (width * width));
}

Eigen::MatrixXd locally_weighted_weights(const Demonstration& demo, const Primitive& primitive) {
  const Basis basis(primitive);
  const bool discrete = primitive.kind == Kind::discrete;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(basis.count(), demo.dimensions());
  Eigen::VectorXd norm = Eigen::VectorXd::Constant(basis.count(), 1e-300);
  for (int i = 0; i < demo.samples(); ++i) {
    const double phase = phase_of(basis, demo, i, primitive.tau);
    const double s = discrete ? phase : 1.0;
    for (int j = 0; j < basis.count(); ++j) {
      const double psi = kernel(primitive, j, phase);
      norm(j) += psi * s * s;
      for (int d = 0; d < demo.dimensions(); ++d)
        weights(j, d) += psi * s * forcing_target(primitive, d, demo, i);
    }
  }
  return norm.cwiseInverse().asDiagonal() * weights;
}

Eigen::MatrixXd recursive_weights(const Demonstration& demo, const Primitive& primitive,
                                  const LearnSettings& settings) {
  const bool discrete = primitive.kind == Kind::discrete;
  RecursiveLearner learner(demo.coordinates, primitive.goal,
                           primitive.tau * (discrete ? 1.0 : 2.0 * M_PI), settings);
  for (int i = 0; i < demo.samples(); ++i)
    learner.add(demo.time(i), demo.position.row(i).transpose(), demo.velocity.row(i).transpose(),
                demo.acceleration.row(i).transpose());
  return learner.primitive().weights;
}

Eigen::MatrixXd weights(const Demonstration& demo, const Primitive& primitive,
                        const LearnSettings& settings) {
  switch (settings.method) {
    case LearnMethod::locally_weighted:
      return locally_weighted_weights(demo, primitive);
    case LearnMethod::recursive:
      return recursive_weights(demo, primitive, settings);
    default:
      return least_squares_weights(demo, primitive);
  }
}

// Goal and duration (centre and period) do not hang on the kernels.
Primitive learn_kernels(const Demonstration& demo, const Eigen::VectorXd& goal, double duration,
                        const LearnSettings& settings) {
  require_samples(demo, kernel_count(settings));
  Primitive primitive = unlearned(demo.coordinates, goal, duration, settings);
  primitive.start_position = demo.position.topRows<1>().transpose();
  primitive.start_velocity = demo.velocity.topRows<1>().transpose();
  primitive.start_acceleration = demo.acceleration.topRows<1>().transpose();
  primitive.weights = weights(demo, primitive, settings);
  primitive.reference_orientation = demo.reference_orientation;
  primitive.validate();
  return primitive;
}

struct Trial {
  Primitive primitive;
  double error = std::numeric_limits<double>::infinity();
};

Trial best_width(const Demonstration& demo, const Eigen::VectorXd& goal, double duration,
                 LearnSettings settings) {
  const std::vector<double> widths =
      settings.width > 0.0 ? std::vector<double>{settings.width}
                           : std::vector<double>(std::begin(widths_tried), std::end(widths_tried));
  Trial best;
  for (const double width : widths) {
    settings.width = width;
    Primitive primitive = learn_kernels(demo, goal, duration, settings);
    const double error = assess(demo, primitive).error_max;
    if (error < best.error) best = {std::move(primitive), error};
  }
  return best;
}

Primitive learn_precisely(const Demonstration& demo, const Eigen::VectorXd& goal, double duration,
                          LearnSettings settings) {
  const int limit =
      std::min(settings.kernels > 0 ? settings.kernels : most_kernels, demo.samples() / 2);
  Trial best;
  for (settings.kernels = 2; settings.kernels <= limit; ++settings.kernels) {
    Trial trial = best_width(demo, goal, duration, settings);
    if (trial.error < best.error) best = std::move(trial);
    if (best.error <= settings.precision) return best.primitive;
  }
  throw Error(demo.source, "precision " + shown(settings.precision) +
                               " is not reached: " + shown(best.error) + " at best, with " +
                               std::to_string(best.primitive.kernels.count()) + " of at most " +
                               std::to_string(limit) + " kernels");
}

}  // namespace

Primitive unlearned(std::vector<std::string> coordinates, const Eigen::VectorXd& goal,
                    double duration, const LearnSettings& settings) {
  require_settings(settings);
  Primitive primitive;
  primitive.kind = settings.kind;
  primitive.coordinates = std::move(coordinates);
  primitive.gains = settings.gains;
  primitive.alpha = settings.alpha;
  primitive.kernels = make_kernels(settings);
  primitive.weights.setZero(primitive.kernels.count(), goal.size());
  primitive.goal = goal;
  primitive.tau = settings.kind == Kind::discrete ? duration : duration / (2.0 * M_PI);
  primitive.start_position = goal;
  primitive.start_velocity.setZero(goal.size());
  primitive.start_acceleration.setZero(goal.size());
  primitive.validate();
  return primitive;
}

Primitive learn(const Demonstration& demo, const LearnSettings& settings) {
  demo.validate();
  require_settings(settings);
  const bool discrete = settings.kind == Kind::discrete;
  const double duration = discrete ? demo.duration() : period_of(demo, settings);
  const Eigen::VectorXd goal = discrete ? Eigen::VectorXd(demo.position.bottomRows<1>().transpose())
                                        : find_centre(demo, duration);
  return settings.precision > 0.0 ? learn_precisely(demo, goal, duration, settings)
                                  : learn_kernels(demo, goal, duration, settings);
}

}  // namespace seam
