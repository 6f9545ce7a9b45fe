#include <Eigen/QR>

#include <seam/basis.hpp>
#include <seam/error.hpp>
#include <seam/learn.hpp>

namespace seam {

namespace {

Eigen::MatrixXd regressor_matrix(const Demonstration& demo, const Primitive& primitive) {
  const Basis basis(primitive.kernels, primitive.alpha);
  Eigen::MatrixXd A(demo.samples(), basis.count());
  Eigen::ArrayXd row(basis.count());
  for (int i = 0; i < demo.samples(); ++i) {
    basis.regressor(basis.advance(basis.start_phase(), demo.time(i) - demo.time(0), primitive.tau),
                    row);
    A.row(i) = row.matrix().transpose();
  }
  return A;
}

Eigen::MatrixXd forcing_target(const Demonstration& demo, const Primitive& primitive) {
  const double tau = primitive.tau;
  const Gains& gains = primitive.gains;
  return tau * tau * demo.acceleration + tau * gains.D * demo.velocity +
         gains.K * (demo.position.rowwise() - primitive.goal.transpose());
}

void require_learnable(const Demonstration& demo, const LearnSettings& settings) {
  const auto N = demo.position.rows();
  const auto D = demo.position.cols();
  const auto same = [&](const Eigen::MatrixXd& m) { return m.rows() == N && m.cols() == D; };
  if (demo.time.size() != N || !same(demo.velocity) || !same(demo.acceleration) ||
      demo.coordinates.size() != static_cast<std::size_t>(D))
    throw Error("demonstration", "time, position, velocity and acceleration differ in size");
  if (N < 2 * settings.kernels)
    throw Error("demonstration", std::to_string(N) + " samples, must be >= " +
                                     std::to_string(2 * settings.kernels) + " (2 per kernel)");
}

}  // namespace

Primitive learn(const Demonstration& demo, const LearnSettings& settings) {
  require_learnable(demo, settings);
  Primitive primitive;
  primitive.coordinates = demo.coordinates;
  primitive.gains = settings.gains;
  primitive.alpha = settings.alpha;
  primitive.kernels = Kernels::even_in_time(settings.kernels, settings.width, settings.alpha);
  primitive.tau = demo.duration();
  primitive.goal = demo.position.bottomRows<1>().transpose();
  primitive.start_position = demo.position.topRows<1>().transpose();
  primitive.start_velocity = demo.velocity.topRows<1>().transpose();
  primitive.start_acceleration = demo.acceleration.topRows<1>().transpose();
  primitive.weights = regressor_matrix(demo, primitive)
                          .completeOrthogonalDecomposition()
                          .solve(forcing_target(demo, primitive));
  primitive.validate();
  return primitive;
}

}  // namespace seam
