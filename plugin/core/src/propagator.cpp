#include <algorithm>
#include <cmath>

#include <unsupported/Eigen/MatrixFunctions>

#include <seam/propagator.hpp>

namespace seam {

Propagator::Propagator(const Gains& gains, double tau, double dt) noexcept {
  const double s = dt / tau;
  // With velocities in this unit the spring's two entries are alike: the fewer squarings the exponential needs, the
  // less it loses, and short times or stiff springs would take dozens.
  const double unit = std::max(1.0, std::sqrt(gains.K)) / tau;
  Eigen::Matrix<double, 6, 6> generator = Eigen::Matrix<double, 6, 6>::Zero();
  generator(0, 1) = unit * dt;
  generator.row(1) << -gains.K, -gains.D * unit * tau, gains.K, 1.0, 0.0, 0.0;
  generator.row(1) *= s / (unit * tau);
  generator(2, 2) = -gains.H * s;
  // The forcing and its first two derivatives over the unit step drive the state.
  generator(3, 4) = 1.0;
  generator(4, 5) = 1.0;
  const Eigen::Matrix<double, 6, 6> flow = generator.exp();
  Phi = flow.topLeftCorner<3, 3>();
  Phi.row(1) *= unit;
  Phi.col(1) /= unit;
  Eigen::Matrix3d derivatives_from_nodes;
  derivatives_from_nodes << 1.0, 0.0, 0.0,  //
      -3.0, 4.0, -1.0,                      //
      4.0, -8.0, 4.0;
  Gamma = flow.topRightCorner<3, 3>() * derivatives_from_nodes;
  Gamma.row(1) *= unit;
}

}  // namespace seam
