#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/basis.hpp>
#include <seam/export.hpp>
#include <seam/learn.hpp>

namespace SEAM_API seam {

/// Learns from samples as they arrive (Eqs. 16, 17), with a = a(p) a row of A:
///     P ← P − P a aᵀ P/(1 + aᵀ P a),  w ← w + (f* − aᵀw)·P a,  P₀ = λI,  w₀ = 0
/// After all samples the weights are those of least squares, but for a pull towards 0 of relative
/// size 1/(λσ²), σ the smallest singular value of A: below 1e-6 with the discrete defaults from 100
/// samples on. f* (Eq. 12) needs to know in advance where the movement leads and how long it takes.
/// Adding a sample neither allocates nor throws.
class RecursiveLearner {
 public:
  /// @param goal      D; of a rhythmic movement, its centre
  /// @param duration  [s] > 0; of a rhythmic movement, its period
  /// @param settings  kind, kernels, width, alpha and gains count
  /// @param lambda    of P₀; 1e6 to 1e9: larger pulls less but loses digits
  /// @throws Error  settings, goal or duration out of range
  RecursiveLearner(std::vector<std::string> coordinates, const Eigen::VectorXd& goal,
                   double duration, const LearnSettings& settings = {}, double lambda = 1e9);

  /// Takes the next sample. Times may be uneven; the first sample's is where the phase starts.
  /// @param time  [s]
  /// @return      false, and nothing is changed, if a value is not finite or a size not D
  bool add(double time, const Eigen::Ref<const Eigen::VectorXd>& position,
           const Eigen::Ref<const Eigen::VectorXd>& velocity,
           const Eigen::Ref<const Eigen::VectorXd>& acceleration) noexcept;

  int samples() const noexcept { return samples_; }  // so far
  /// What is learned so far.
  const Primitive& primitive() const noexcept { return primitive_; }

 private:
  Primitive primitive_;
  Basis basis_;
  Eigen::MatrixXd P_;                 // M × M
  Eigen::VectorXd row_, gain_;        // a, P a
  Eigen::RowVectorXd target_, miss_;  // f*, f* − aᵀw
  double start_time_ = 0.0;           // [s]
  int samples_ = 0;
};

}  // namespace seam
