#pragma once

#include <string>

#include "bench/compare.hpp"

namespace seam {

/// The joint whose torque steps most at the joins: the one to show.
/// @param time    [s] N
/// @param torque  N × n
/// @param joins   [s]
std::size_t most_disturbed_joint(const Eigen::VectorXd& time, const Eigen::MatrixXd& torque,
                                 const std::vector<double>& joins);

/// Draws a comparison with gnuplot into DIR/SCENE/: `SCENE.png`, laid out as the paper's Fig. 1
/// (each primitive alone; joined position, velocity, acceleration of all methods), and `torque.png`
/// (a joint's torque, whole and around the last join), and a picture of each signal that the scene adds. The scripts and data that they are drawn
/// from stay beside them. The recordings must be there already.
/// @throws Error  gnuplot is not there or fails (names its log), a file cannot be written
void draw_figures(const Comparison& comparison, const std::string& dir);

}  // namespace seam
