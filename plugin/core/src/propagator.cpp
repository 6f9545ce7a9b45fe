#include <algorithm>
#include <cmath>

#include <unsupported/Eigen/MatrixFunctions>

#include <seam/propagator.hpp>

namespace seam {

Propagator::Propagator(const Gains& gains, double tau, double dt) noexcept {
  const double s = dt / tau;
  // With velocities in this unit the spring's two entries are alike, and those of e with ė in units of H/τ: the fewer
  // squarings the exponential needs, the less it loses, and short times or stiff springs would take dozens.
  const double unit = std::max(1.0, std::sqrt(gains.K)) / tau;
  const double decay = gains.H / tau;
  Eigen::Matrix<double, 7, 7> generator = Eigen::Matrix<double, 7, 7>::Zero();
  generator(0, 1) = unit * dt;
  generator.row(1) << -gains.K, -gains.D * unit * tau, 1.0, 0.0, 1.0, 0.0, 0.0;
  generator.row(1) *= s / (unit * tau);
  generator(2, 3) = decay * dt;
  generator(3, 2) = -decay * dt;
  generator(3, 3) = -2.0 * decay * dt;
  // The forcing and its first two derivatives over the unit step drive the state.
  generator(4, 5) = 1.0;
  generator(5, 6) = 1.0;
  const Eigen::Matrix<double, 7, 7> flow = generator.exp();
  const Eigen::Array4d units(1.0, unit, 1.0, decay);
  Phi = units.matrix().asDiagonal() * flow.topLeftCorner<4, 4>() *
        units.inverse().matrix().asDiagonal();
  Eigen::Matrix3d derivatives_from_nodes;
  derivatives_from_nodes << 1.0, 0.0, 0.0,  //
      -3.0, 4.0, -1.0,                      //
      4.0, -8.0, 4.0;
  Gamma = flow.topRightCorner<2, 3>() * derivatives_from_nodes;
  Gamma.row(1) *= unit;
}

}  // namespace seam
