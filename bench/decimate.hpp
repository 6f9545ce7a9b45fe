#pragma once

#include <vector>

#include <Eigen/Core>

namespace seam {

/// The ticks that a picture of a recording keeps: every one within `near` of a join, and evenly spaced ones between, the
/// last one too.
/// @param time    [s] N, even
/// @param joins   [s]
/// @param near    [s]
/// @param points  about how many are kept away from the joins
std::vector<Eigen::Index> kept_ticks(const Eigen::VectorXd& time, const std::vector<double>& joins,
                                     double near, int points);

/// The values at those ticks; where a column goes further up or down between them than they show (by 0.5 % of its
/// range), its extremes there take their places, so that what is short is still seen.
/// @param values  N × C
/// @return        kept × C
Eigen::MatrixXd decimated(const Eigen::MatrixXd& values, const std::vector<Eigen::Index>& kept);

}  // namespace seam
