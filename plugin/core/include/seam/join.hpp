#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <seam/primitive.hpp>

namespace seam {

/// How an execution takes over from whatever ran before it.
enum class Join {
  dmp2,   // y and ẏ continue; ÿ steps
  dmp2a,  // y, ẏ and ÿ continue: the smallest change of the weights that gives the right forcing
          // (Eq. 21)
  dmp3,   // y, ẏ and ÿ continue: the filtered goal r starts where it gives the right ÿ (Eq. 6)
};

inline constexpr std::array<Join, 3> all_joins{Join::dmp2, Join::dmp2a, Join::dmp3};

std::string_view to_string(Join method) noexcept;
/// @throws Error  no such method (lists those there are)
Join join_from_name(std::string_view name);

/// Position, velocity and acceleration of D coordinates at one instant [rad or m, per s, per s²].
struct Sample {
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;

  explicit Sample(int dimensions = 0)
      : position(Eigen::VectorXd::Zero(dimensions)),
        velocity(Eigen::VectorXd::Zero(dimensions)),
        acceleration(Eigen::VectorXd::Zero(dimensions)) {}
  /// At rest.
  static Sample at_rest(const Eigen::VectorXd& position);
};

/// The one act behind starting, joining and changing goal or τ: set what the method is free to set
/// so that an execution continues from a state. v = τẏ always holds; with a = a(p) at the entry
/// phase p:
///     dmp2   r = g
///     dmp2a  r = g,  w += a·(F − aᵀw)/|a|²,  F = τ²ÿ + τDẏ − K(g − y)      (Eqs. 19, 21)
///     dmp3   r = (τ²ÿ + τDẏ − aᵀw)/K + y                                   (Eq. 6)
/// (21) is written with the regressor a = sψ/Σψ of Eq. 2, in which the scale of ψ cancels.
/// @param at       state to continue from
/// @param row      a(p), M
/// @param weights  M × D, the execution's own copy
/// @param r        D, the filtered goal
void continue_from(const Sample& at, Join method, const Gains& gains, double tau,
                   const Eigen::VectorXd& goal, const Eigen::ArrayXd& row, Eigen::MatrixXd& weights,
                   Eigen::ArrayXd& r) noexcept;

}  // namespace seam
