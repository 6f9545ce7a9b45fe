#include <unsupported/Eigen/MatrixFunctions>

#include <seam/propagator.hpp>

namespace seam {

Propagator::Propagator(const Gains& gains, double tau, double dt) noexcept {
  const double s = dt / tau;
  Eigen::Matrix<double, 6, 6> generator = Eigen::Matrix<double, 6, 6>::Zero();
  generator(0, 1) = dt;
  generator.row(1) << -gains.K * s / tau, -gains.D * s, gains.K * s / tau, s / tau, 0.0, 0.0;
  generator(2, 2) = -gains.H * s;
  // The forcing and its first two derivatives over the unit step drive the state.
  generator(3, 4) = 1.0;
  generator(4, 5) = 1.0;
  const Eigen::Matrix<double, 6, 6> flow = generator.exp();
  Phi = flow.topLeftCorner<3, 3>();
  Eigen::Matrix3d derivatives_from_nodes;
  derivatives_from_nodes << 1.0, 0.0, 0.0,  //
      -3.0, 4.0, -1.0,                      //
      4.0, -8.0, 4.0;
  Gamma = flow.topRightCorner<3, 3>() * derivatives_from_nodes;
}

}  // namespace seam
