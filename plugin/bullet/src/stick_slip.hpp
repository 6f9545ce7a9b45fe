#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace seam {

/// Velocities of joints with Coulomb friction at the end of a tick: v with
///     A·v + c∘s = r,   sᵢ = sgn vᵢ where vᵢ ≠ 0, and |sᵢ| ≤ 1 where vᵢ = 0: the joint sticks,
/// the one minimum of ½vᵀAv − rᵀv + Σcᵢ|vᵢ|. A sweep of Gauss-Seidel (which converges to it, P. Tseng, J. Optim. Theory Appl.
/// 109, 2001) says who sticks and which way the others slide; the solution with those signs is taken if it bears them out.
/// Allocates when made only.
class StickSlip {
 public:
  explicit StickSlip(Eigen::Index joints);

  /// @param A  n × n, symmetric, positive definite
  /// @param r  n
  /// @param c  n, ≥ 0
  /// @param v  n; where to begin (the velocities before), and the result
  void solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& r, const Eigen::VectorXd& c,
             Eigen::VectorXd& v) noexcept;

 private:
  bool solve_with_signs(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                        const Eigen::VectorXd& c, Eigen::VectorXd& v) noexcept;

  Eigen::MatrixXd sliding_;  // A of the joints that slide; those that stick are held
  Eigen::LLT<Eigen::MatrixXd> factors_;
  Eigen::VectorXd found_;
};

}  // namespace seam
