#pragma once

#include <array>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>
#include <seam/kinematics.hpp>

namespace SEAM_API seam {

/// The linear equations for n joints x and a wrench y where a tool is moved and the joints keep to a posture
/// (see InverseKinematics),
///     A x + Jᵀy = a,   J x = b
/// with J 6 × n of full rank, and zᵀAz symmetric and > 0 for all z with J z = 0, as it is at a minimum of the posture's
/// cost. Six joints that move the tool well fulfil the second equation. The others move freely and the six make up for it:
/// these are the columns of Z, with J Z = 0. There remain the n − 6 equations of ZᵀAZ.
/// For up to 32 joints. Neither allocates nor throws.
class PostureSystem {
 public:
  static constexpr int most = 32;  // joints

  using Pair = Eigen::Array2d;               // of two right sides, or solutions
  using Sides = std::array<Pair, most + 6>;  // n joints, then 6 of the tool

  /// Chooses the six joints.
  /// @return  |det| of their columns, ≤ √det JJᵀ; 0 without full rank, or where J is not finite
  double choose(const Jacobian& J) noexcept;
  /// For the J of `choose`.
  /// @return  false where ZᵀAZ is not positive definite
  bool factor(const Eigen::MatrixXd& A) noexcept;
  /// Puts (x, y) where (a, b) is, both of them at once.
  void solve(Sides& sides) const noexcept;

 private:
  static constexpr int most_free = most - 6;
  template <int Size>
  using Numbers = std::array<double, Size>;

  void find_free_motions() noexcept;
  bool factor_free() noexcept;
  std::array<Pair, 6> move_tool(const Pair* b) const noexcept;
  void solve_free(std::array<Pair, most_free>& x) const noexcept;
  void hold(const Pair* rest, Pair* y) const noexcept;

  int n_ = 0;
  // All in an order of the joints in which the six are the first: P Jᵀ = L U.
  std::array<int, most> joint_ = {};         // it begins with that of last time
  std::array<Vector6d, most> L_;             // a row each; below the six, what Z is made of
  std::array<Vector6d, most> U_;             // likewise, the first six
  Vector6d inverse_;                         // of U's diagonal
  std::array<Numbers<most>, most> A_;        // a row each
  std::array<Vector6d, most_free> Z_;        // a column each, the six of it
  std::array<Numbers<most>, most_free> AZ_;  // a column each
  std::array<Numbers<most_free>, most_free>
      free_;  // ZᵀAZ = M D Mᵀ: M below the diagonal, D⁻¹ on it
};

}  // namespace seam
