#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// A few linear conditions rᵢᵀΔ = bᵢ on M unknowns, and the smallest Δ that meets them: Δ = Aᵀ(AAᵀ)⁻¹b for the rows A, each
/// scaled to unit length. The rows are made orthonormal one after the other (Gram and Schmidt, twice each), A = LQ, so that
/// a row that depends on those before it shows, and Δ = Qᵀz with Lz = b. The part of Δ that the first rows ask for does not
/// change when more are added. Only construction allocates.
class Conditions {
 public:
  /// Room for conditions on M unknowns: M of them, and no more than `most`.
  Conditions(int unknowns, int most);

  /// Drops all of them.
  void clear() noexcept { count_ = 0; }
  /// Adds a row of M values behind the others, if there is room and more than a share of its length lies outside of what they
  /// span (the sine of the angle between them); else changes nothing.
  bool add(const Eigen::Ref<const Eigen::VectorXd>& row, double least_share) noexcept;
  int count() const noexcept { return count_; }  // of the rows
  /// Meets the i-th condition, those before it having been met.
  /// @param right  bᵢ
  void meet(int i, double right) noexcept;
  /// The part of Δ that rows from `first` to before `last` ask for, all of them having been met; M values.
  auto change(int first, int last) const noexcept {
    return q_.middleCols(first, last - first).lazyProduct(z_.segment(first, last - first));
  }

 private:
  Eigen::MatrixXd q_;       // M × room, orthonormal columns
  Eigen::MatrixXd l_;       // room × room, a row's shares in the columns of q_
  Eigen::VectorXd length_;  // of the rows
  Eigen::VectorXd z_;
  Eigen::VectorXd rest_;  // M
  int count_ = 0;
};

}  // namespace seam
