#include <algorithm>

#include <seam/conditions.hpp>

namespace seam {

Conditions::Conditions(int unknowns, int most) {
  const int room = std::min(unknowns, most);
  q_.setZero(unknowns, room);
  l_.setZero(room, room);
  length_.setZero(room);
  z_.setZero(room);
  rest_.setZero(unknowns);
}

bool Conditions::add(const Eigen::Ref<const Eigen::VectorXd>& row, double least_share) noexcept {
  const double length = row.norm();
  if (count_ == q_.cols() || !(length > 0.0)) return false;
  rest_ = row / length;
  l_.row(count_).setZero();
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i < count_; ++i) {
      const double share = q_.col(i).dot(rest_);
      l_(count_, i) += share;
      rest_ -= share * q_.col(i);
    }
  const double outside = rest_.norm();
  if (!(outside > least_share)) return false;
  q_.col(count_) = rest_ / outside;
  l_(count_, count_) = outside;
  length_(count_++) = length;
  return true;
}

void Conditions::meet(int i, double right) noexcept {
  const double met = l_.row(i).head(i).dot(z_.head(i));
  z_(i) = (right / length_(i) - met) / l_(i, i);
}

}  // namespace seam
