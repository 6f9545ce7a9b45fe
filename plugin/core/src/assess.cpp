#include <algorithm>
#include <cmath>

#include "learning.hpp"
#include "least_squares.hpp"
#include <seam/basis.hpp>
#include <seam/error.hpp>
#include <seam/execution.hpp>
#include <seam/learn.hpp>
#include <seam/orientation.hpp>

namespace seam {

namespace {

constexpr int least_steps = 200;

void fit_figures(const Demonstration& demo, const Primitive& primitive, LearnReport& report) {
  const Basis basis(primitive);
  LeastSquares matrix(basis.count(), 0);
  Eigen::RowVectorXd row(basis.count());
  double missed = 0.0;
  double wanted = 0.0;
  for (int i = 0; i < demo.samples(); ++i) {
    basis.regressor(phase_of(basis, demo, i, primitive.tau), row.data());
    std::copy_n(row.data(), row.size(), matrix.next_row());
    for (int d = 0; d < demo.dimensions(); ++d) {
      const double target = forcing_target(primitive, d, demo, i);
      const double rest = target - row.dot(primitive.weights.col(d));
      wanted += target * target;
      missed += rest * rest;
    }
  }
  report.forcing_error = missed > 0.0 ? std::sqrt(missed / wanted) : 0.0;
  report.condition = matrix.condition();
}

// Positions of the primitive at the demonstration's times. The steps are even, as the execution
// prefers, and the cubics between them are of the same order as its integration.
Eigen::MatrixXd roll_out(const Demonstration& demo, const Primitive& primitive) {
  const int steps = std::max(demo.samples() - 1, least_steps);
  const double dt = demo.duration() / steps;
  Execution execution(primitive);
  Eigen::MatrixXd reached(demo.samples(), demo.dimensions());
  Sample before = execution.sample();
  int k = 0;
  for (int i = 0; i < demo.samples(); ++i) {
    const double at = (demo.time(i) - demo.time(0)) / dt;
    for (; k < steps && (k == 0 || at > k); ++k) {
      before = execution.sample();
      execution.step(dt);
    }
    const Sample& after = execution.sample();
    const double u = std::clamp(at - (k - 1), 0.0, 1.0);
    const double rise = u * u * (3.0 - 2.0 * u);
    reached.row(i) = (1.0 - rise) * before.position + rise * after.position +
                     dt * u * (1.0 - u) * ((1.0 - u) * before.velocity - u * after.velocity);
  }
  return reached;
}

}  // namespace

LearnReport assess(const Demonstration& demo, const Primitive& primitive) {
  demo.validate();
  primitive.validate();
  if (demo.coordinates != primitive.coordinates)
    throw Error(demo.source, "coordinates differ from the primitive's, must be the same");
  require_same_reference(demo.source, primitive.reference_orientation, demo.reference_orientation);
  LearnReport report{};
  fit_figures(demo, primitive, report);
  const Eigen::ArrayXXd error = roll_out(demo, primitive) - demo.position;
  report.error_max = error.abs().maxCoeff();
  report.error_rms = std::sqrt(error.square().mean());
  return report;
}

}  // namespace seam
