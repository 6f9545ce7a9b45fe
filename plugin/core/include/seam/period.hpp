#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/demonstration.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// Period T [s] of a rhythmic demonstration of two periods or more. The lag at which the movement
/// is most like itself (the mean square of y(t + T) − y(t), over all coordinates, is less than a
/// fifth of its mean over all shorter lags) is refined until a Fourier series of that period, five
/// harmonics, leaves the least residual over the whole demonstration. Noise and uneven times do no
/// harm; coordinates count as they stand, so that the largest movement decides.
/// @throws Error  there is none, or less than two are shown
double find_period(const Demonstration& demo);

/// What a movement of period T [s] moves about: the constant term of the Fourier series that fits
/// the positions best (five harmonics, fewer where there are few samples). It is the mean over
/// whole periods, but needs neither whole periods nor even times. D values.
Eigen::VectorXd find_centre(const Demonstration& demo, double period);

}  // namespace seam
