#pragma once

#include <Eigen/Core>

#include <seam/basis.hpp>
#include <seam/join.hpp>
#include <seam/primitive.hpp>
#include <seam/propagator.hpp>

namespace seam {

/// A primitive while it runs: its state, its own copy of the weights, and the integration of Eqs.
/// 1–5. Construction allocates; nothing after it does.
class Execution {
 public:
  /// Stands at the primitive's own start (phase 1, the demonstration's first position and velocity,
  /// r = g).
  /// @throws Error  the primitive is not valid
  explicit Execution(const Primitive& primitive);

  /// Continues from a state at a phase of the primitive, as the method says (see `continue_from`).
  void reinitialise(const Sample& at, double phase, Join method) noexcept;
  /// Advances by dt [s] ≥ 0. Exact in the linear part, of fourth order in the forcing.
  void step(double dt) noexcept;

  const Sample& sample() const noexcept { return sample_; }
  double phase() const noexcept { return phase_; }
  double elapsed() const noexcept { return elapsed_; }  // [s] since the last re-initialisation
  double tau() const noexcept { return tau_; }          // [s]
  double start_phase() const noexcept { return basis_.start_phase(); }

 private:
  void set_step(double dt) noexcept;
  void forcing(double phase, Eigen::ArrayXd& f) noexcept;
  void refresh_sample() noexcept;

  Gains gains_;
  double tau_;
  Basis basis_;
  Eigen::MatrixXd learned_weights_;  // M × D, as in the primitive
  Eigen::MatrixXd weights_;          // M × D, as joined
  Eigen::VectorXd goal_;
  Propagator propagator_;
  double dt_ = 0.0;
  double entry_phase_ = 1.0;
  double phase_ = 1.0;
  double elapsed_ = 0.0;
  Eigen::ArrayXd row_;                      // M
  Eigen::ArrayXd offset_, velocity_, lag_;  // y − g, ẏ, r − g
  Eigen::ArrayXd f_start_, f_middle_, f_end_;
  Sample sample_;
};

}  // namespace seam
