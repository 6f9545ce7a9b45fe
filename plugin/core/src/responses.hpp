#pragma once

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/basis.hpp>
#include <seam/export.hpp>
#include <seam/primitive.hpp>

namespace seam {

/// How the second-order system answers, from rest, to each of its M kernels alone. In units of τ, s = t/τ, it does not depend
/// on τ, nor on the coordinate:
///     R″ = a(p(s)) − KR − DR′
/// s is 0 at the beginning of a discrete phase, x = exp(−αs), and φ of a rhythmic one. A table over s is made once, by
/// Gauss's rule on panels that are as short as the sharpest of the kernels needs.
class Responses {
 public:
  explicit Responses(const Primitive& primitive);

  /// The s at a phase; of a rhythmic one within the first turn.
  double at_phase(double phase) const noexcept;
  /// Whether answers at an s are known: discrete until x = 0.01, or somewhat beyond τ; rhythmic for two turns; none at all where
  /// gains or kernels are too sharp, or more than 1e5 numbers would have to be kept.
  bool cover(double s) const noexcept { return panels() > 0 && s <= panels() * panel_; }

  using State = Eigen::Matrix<double, Eigen::Dynamic, 2>;  // M × (R, R′)
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4>;   // M × (R, R′, R″, R‴)

  /// The state at an s that is covered, of what the kernels have done from the beginning on.
  /// @param row  M values to work with
  void state(double s, Eigen::Ref<State> state, Eigen::Ref<Eigen::VectorXd> row) const noexcept;
  /// What the kernels do from an s on, at a later one; both are covered.
  /// @param begun  the state at `from`
  void rows(double from, const State& begun, double to, Eigen::Ref<Rows> rows) const noexcept;

  /// The table: `panels()` + 1 points, a `panel()` apart.
  int panels() const noexcept { return static_cast<int>(table_.cols()) / width - 1; }
  double panel() const noexcept { return panel_; }
  /// R and R′ at the i-th point, of what the kernels do from an s on, and a(p) there.
  /// @param begun  the state at `from`
  void at_point(int i, double from, const State& begun,
                Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3>> answers) const noexcept;

 private:
  static constexpr int width = 3;
  struct Pulse {
    double h, rate;
  };
  Pulse pulse(double s) const noexcept;
  auto point(int i) const noexcept { return table_.middleCols<width>(width * i); }  // R, R′, a
  // What a state, or minus it, has become a time after nothing acts any more; to be added.
  void evolve(double s, double sign, const Eigen::Ref<const State>& from,
              Eigen::Ref<State> to) const noexcept;
  void add_panel(double from, double length, Eigen::Ref<State> state,
                 Eigen::Ref<Eigen::VectorXd> row) const noexcept;

  Gains gains_;
  Basis basis_;
  double panel_ = 1.0;
  Eigen::MatrixXd table_;
};

}  // namespace seam
