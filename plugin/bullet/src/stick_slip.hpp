#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace seam {

/// Velocities of joints with Coulomb friction at the end of a tick: v with
///     A·v + c∘s = r,   sᵢ = sgn vᵢ where vᵢ ≠ 0, and |sᵢ| ≤ 1 where vᵢ = 0: the joint sticks,
/// the one minimum of ½vᵀAv − rᵀv + Σcᵢ|vᵢ|. A sweep of Gauss-Seidel lets go of joints; then those that slide go to the minimum that
/// their signs have, or to where the first of them comes to a stand, and on from there, until all that stand stick (H. Lee et al.,
/// Efficient sparse coding algorithms, NIPS 2006, whose feature-sign search this is but for the sweep). No step goes uphill, and there
/// are finitely many signs. Allocates when made only.
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
  bool slide_on(const Eigen::MatrixXd& A, const Eigen::VectorXd& r, const Eigen::VectorXd& c,
                Eigen::VectorXd& v) noexcept;
  bool all_stick_that_stand(const Eigen::MatrixXd& A, const Eigen::VectorXd& r,
                            const Eigen::VectorXd& c, const Eigen::VectorXd& v) const noexcept;

  Eigen::MatrixXd sliding_;  // A of the joints that slide; those that stand are held
  Eigen::LLT<Eigen::MatrixXd> factors_;
  Eigen::VectorXd minimum_;
};

}  // namespace seam
