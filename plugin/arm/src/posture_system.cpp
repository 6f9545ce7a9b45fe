#include <cmath>
#include <utility>

#include <seam/posture_system.hpp>

namespace seam {

double PostureSystem::choose(const Jacobian& J) noexcept {
  if (n_ != J.cols()) {
    n_ = static_cast<int>(J.cols());
    for (int i = 0; i < n_; ++i) joint_[i] = i;
  }
  for (int i = 0; i < n_; ++i) U_[i] = J.col(joint_[i]);
  double volume = 1.0;
  for (int k = 0; k < 6; ++k) {
    int best = k;
    for (int i = k + 1; i < n_; ++i)
      if (std::abs(U_[i](k)) > std::abs(U_[best](k))) best = i;
    if (best != k) {
      std::swap(joint_[k], joint_[best]);
      std::swap(L_[k], L_[best]);
      std::swap(U_[k], U_[best]);
    }
    volume *= std::abs(U_[k](k));
    if (!(volume > 0.0)) return 0.0;
    inverse_(k) = 1.0 / U_[k](k);
    for (int i = k + 1; i < n_; ++i) {
      L_[i](k) = U_[i](k) * inverse_(k);
      U_[i] -= L_[i](k) * U_[k];
    }
  }
  return volume;
}

bool PostureSystem::factor(const Eigen::MatrixXd& A) noexcept {
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) A_[i][j] = A(joint_[i], joint_[j]);
  find_free_motions();
  return factor_free();
}

void PostureSystem::find_free_motions() noexcept {
  for (int f = 0; f < n_ - 6; ++f) {
    Vector6d z = -L_[f + 6];
    for (int k = 4; k >= 0; --k)
      for (int i = k + 1; i < 6; ++i) z(k) -= L_[i](k) * z(i);
    Z_[f] = z;
    for (int i = 0; i < n_; ++i) {
      AZ_[f][i] = A_[i][f + 6];
      for (int k = 0; k < 6; ++k) AZ_[f][i] += A_[i][k] * z(k);
    }
  }
}

bool PostureSystem::factor_free() noexcept {
  for (int g = 0; g < n_ - 6; ++g)
    for (int f = g; f < n_ - 6; ++f) {
      double sum = AZ_[g][f + 6];
      for (int k = 0; k < 6; ++k) sum += Z_[f](k) * AZ_[g][k];
      for (int m = 0; m < g; ++m) sum -= free_[f][m] * free_[g][m] / free_[m][m];
      if (f == g && !(sum > 0.0)) return false;
      free_[f][g] = f == g ? 1.0 / sum : sum * free_[g][g];
    }
  return true;
}

void PostureSystem::solve(Sides& sides) const noexcept {
  std::array<Pair, 6> chosen = move_tool(&sides[n_]);
  std::array<Pair, most> rest;
  for (int i = 0; i < n_; ++i) {
    rest[i] = sides[joint_[i]];
    for (int k = 0; k < 6; ++k) rest[i] -= A_[i][k] * chosen[k];
  }
  std::array<Pair, most_free> free;
  for (int f = 0; f < n_ - 6; ++f) {
    free[f] = rest[f + 6];
    for (int k = 0; k < 6; ++k) free[f] += Z_[f](k) * rest[k];
  }
  solve_free(free);
  for (int f = 0; f < n_ - 6; ++f)
    for (int k = 0; k < 6; ++k) {
      chosen[k] += Z_[f](k) * free[f];
      rest[k] -= AZ_[f][k] * free[f];
    }
  for (int f = 0; f < n_ - 6; ++f) sides[joint_[f + 6]] = free[f];
  for (int k = 0; k < 6; ++k) sides[joint_[k]] = chosen[k];
  hold(rest.data(), &sides[n_]);
}

// The six joints alone: J x = b.
std::array<PostureSystem::Pair, 6> PostureSystem::move_tool(const Pair* b) const noexcept {
  std::array<Pair, 6> x;
  for (int k = 0; k < 6; ++k) {
    x[k] = b[k];
    for (int i = 0; i < k; ++i) x[k] -= U_[i](k) * x[i];
    x[k] *= inverse_(k);
  }
  for (int k = 4; k >= 0; --k)
    for (int i = k + 1; i < 6; ++i) x[k] -= L_[i](k) * x[i];
  return x;
}

void PostureSystem::solve_free(std::array<Pair, most_free>& x) const noexcept {
  for (int f = 0; f < n_ - 6; ++f)
    for (int g = 0; g < f; ++g) x[f] -= free_[f][g] * x[g];
  for (int f = n_ - 7; f >= 0; --f) {
    x[f] *= free_[f][f];
    for (int g = f + 1; g < n_ - 6; ++g) x[f] -= free_[g][f] * x[g];
  }
}

// What is left at the six joints is the wrench's: Jᵀy = rest.
void PostureSystem::hold(const Pair* rest, Pair* y) const noexcept {
  for (int k = 0; k < 6; ++k) {
    y[k] = rest[k];
    for (int i = 0; i < k; ++i) y[k] -= L_[k](i) * y[i];
  }
  for (int k = 5; k >= 0; --k) {
    for (int i = k + 1; i < 6; ++i) y[k] -= U_[k](i) * y[i];
    y[k] *= inverse_(k);
  }
}

}  // namespace seam
