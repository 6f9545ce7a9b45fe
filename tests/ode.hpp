#pragma once

#include <cmath>
#include <functional>

#include <Eigen/Core>

#include <seam/join.hpp>
#include <seam/primitive.hpp>

namespace seam::test {

/// All coordinates of Eqs. 1-5, 9-11 solved by the classical Runge-Kutta method in long double with many small steps: an
/// independent solution, which shares no code with the library's. Joins are written out as the paper prints them, with
/// its misprints put right; dmp2j, changes on the way and the added forcing as Execution's comment states them.
class Ode {
 public:
  using Real = long double;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  enum Column { y, yd, r, e, ed };  // of the state: e is the added forcing
  enum { ydd = 2, yddd };           // of a motion, behind y and ẏ

  Primitive primitive;
  Matrix weights, change;  // M × D
  Vector goal;
  Real tau, amplitude = 1.0L;
  /// C(y, ẏ, t); may be empty.
  std::function<Vector(const Vector&, const Vector&, Real)> coupling;

  /// Stands at the primitive's own start.
  explicit Ode(const Primitive& from)
      : primitive(from),
        weights(from.weights.cast<Real>()),
        change(Matrix::Zero(from.weights.rows(), from.weights.cols())),
        goal(from.goal.cast<Real>()),
        tau(from.tau),
        now_{Matrix::Zero(from.dimensions(), 5), rhythmic() ? 0.0L : 1.0L, 0.0L} {
    now_.x.col(y) = from.start_position.cast<Real>();
    now_.x.col(yd) = from.start_velocity.cast<Real>();
    now_.x.col(r) = goal;
  }

  /// y, ẏ, ÿ and the jerk: D × 4.
  Matrix motion() const {
    const Gains& g = primitive.gains;
    const State rate = slope(now_);
    Matrix m(now_.x.rows(), 4);
    m << now_.x.col(y), now_.x.col(yd), rate.x.col(yd), Vector::Zero(now_.x.rows());
    m.col(yddd) = (Real(g.K) * (rate.x.col(r) - m.col(yd)) - tau * Real(g.D) * m.col(ydd) +
                   forcing_rate(now_)) /
                      (tau * tau) +
                  coupled_rate(m);
    return m;
  }
  Real phase() const { return now_.p; }
  Real time() const { return now_.t; }
  void set_time(Real time) { now_.t = time; }
  Vector added() const { return now_.x.col(e); }

  /// Continues a motion (D × 4) at a phase.
  void join(const Matrix& motion, Real phase, const JoinSettings& with) {
    join_ = with;
    joined_at_ = phase;
    change.setZero();
    now_.x.rightCols(2).setZero();
    now_.p = phase;
    continue_from(motion, true);
  }
  void set_goal(const Eigen::VectorXd& to) {
    const Matrix before = motion();
    goal = to.cast<Real>();
    continue_from(before, false);
  }
  void set_tau(double to) {
    const Matrix before = motion();
    tau = to;
    continue_from(before, false);
  }
  void set_amplitude(double to) {
    const Matrix before = motion();
    amplitude = to;
    continue_from(before, false);
  }

  void advance(Real time, int steps) {
    const Real h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const State k1 = slope(now_);
      const State k2 = slope(now_.plus(k1, h / 2));
      const State k3 = slope(now_.plus(k2, h / 2));
      const State k4 = slope(now_.plus(k3, h));
      now_ = now_.plus(k1, h / 6).plus(k2, h / 3).plus(k3, h / 3).plus(k4, h / 6);
    }
  }

  /// ψ, and its derivative with respect to the phase.
  Vector kernels(Real phase, int derivative = 0) const {
    Vector psi(weights.rows());
    for (Eigen::Index j = 0; j < psi.size(); ++j) {
      const Real from_center = phase - Real(primitive.kernels.centers(j));
      const Real twice_square = 2.0L * std::pow(Real(primitive.kernels.widths(j)), 2.0L);
      const Real distance = rhythmic() ? 1.0L - std::cos(from_center) : from_center * from_center;
      const Real towards = rhythmic() ? std::sin(from_center) : 2.0L * from_center;
      psi(j) = std::exp(-distance / twice_square);
      if (derivative == 1) psi(j) *= -towards / twice_square;
    }
    return psi;
  }

 private:
  struct State {
    Matrix x;  // D × 5
    Real p;    // phase
    Real t;    // time, which a coupling depends on
    State plus(const State& k, Real h) const { return {x + h * k.x, p + h * k.p, t + h * k.t}; }
  };

  bool rhythmic() const { return primitive.kind == Kind::rhythmic; }
  Real phase_rate(Real p) const {
    return rhythmic() ? 1.0L / tau : -Real(primitive.alpha) * p / tau;
  }

  /// What each weight is worth at a phase, and its rate by the rule for quotients.
  Vector worth(Real p) const {
    const Vector psi = kernels(p);
    return (amplitude * (rhythmic() ? 1.0L : p) / psi.sum()) * psi;
  }
  Vector worth_rate(Real p) const {
    const Vector psi = kernels(p);
    const Vector slope = kernels(p, 1);
    const Real sum = psi.sum();
    Vector rate = (slope * sum - psi * slope.sum()) / (sum * sum);
    if (!rhythmic()) rate = p * rate + psi / sum;
    return amplitude * phase_rate(p) * rate;
  }

  /// The changed weights of a rhythmic primitive return to the learned ones over half a cycle from a join.
  Real share(Real p) const {
    const Real s = (p - joined_at_) / pi;
    if (!rhythmic()) return 1.0L;
    return s < 1.0L ? 1.0L - s * s * s * (10.0L - 15.0L * s + 6.0L * s * s) : 0.0L;
  }
  Real share_rate(Real p) const {
    const Real s = (p - joined_at_) / pi;
    if (!rhythmic() || s >= 1.0L) return 0.0L;
    return -(30.0L * s * s - 60.0L * s * s * s + 30.0L * s * s * s * s) / (pi * tau);
  }
  static constexpr Real pi = 3.14159265358979323846264338327950288L;

  Vector forcing(const State& s) const {
    return (weights + share(s.p) * change).transpose() * worth(s.p) + s.x.col(e);
  }
  Vector forcing_rate(const State& s) const {
    return (weights + share(s.p) * change).transpose() * worth_rate(s.p) +
           share_rate(s.p) * (change.transpose() * worth(s.p)) + s.x.col(ed);
  }

  State slope(const State& s) const {
    const Gains& g = primitive.gains;
    const Real decay = Real(g.H) / tau;
    State rate{Matrix(s.x.rows(), 5), phase_rate(s.p), 1.0L};
    rate.x.col(y) = s.x.col(yd);
    rate.x.col(yd) =
        (Real(g.K) * (s.x.col(r) - s.x.col(y)) - Real(g.D) * tau * s.x.col(yd) + forcing(s)) /
        (tau * tau);
    if (coupling) rate.x.col(yd) += coupling(s.x.col(y), s.x.col(yd), s.t);
    rate.x.col(r) = Real(g.H) / tau * (goal - s.x.col(r));
    rate.x.col(e) = s.x.col(ed);
    rate.x.col(ed) = -2.0L * decay * s.x.col(ed) - decay * decay * s.x.col(e);
    return rate;
  }

  Vector coupled(const Vector& at, const Vector& moving, Real t) const {
    return coupling ? coupling(at, moving, t) : Vector::Zero(at.size());
  }
  /// Along a motion, by a central difference.
  Vector coupled_rate(const Matrix& m) const {
    const Real h = 1e-6L;
    const auto shifted = [&](Real by) {
      return coupled(m.col(y) + by * m.col(yd) + by * by / 2 * m.col(ydd),
                     m.col(yd) + by * m.col(ydd), now_.t + by);
    };
    return (shifted(h) - shifted(-h)) / (2 * h);
  }

  void continue_from(const Matrix& m, bool joining) {
    const Gains& g = primitive.gains;
    const Vector acts = coupled(m.col(y), m.col(yd), now_.t);
    const Vector missing = tau * tau * (m.col(ydd) - acts) + Real(g.D) * tau * m.col(yd) -
                           Real(g.K) * (goal - m.col(y)) - forcing(now_);
    const Vector missing_rate = tau * tau * (m.col(yddd) - coupled_rate(m)) +
                                Real(g.D) * tau * m.col(ydd) + Real(g.K) * m.col(yd) -
                                forcing_rate(now_);
    now_.x.leftCols(2) = m.leftCols(2);
    now_.x.col(r) = goal;
    if (join_.method == Join::dmp3) now_.x.col(r) += missing / Real(g.K);
    if (join_.method == Join::dmp2 || join_.method == Join::dmp3) return;
    if (weights_hold() && (joining || !rhythmic())) {
      change_weights(missing, missing_rate);
    } else {
      now_.x.col(e) += missing;
      if (join_.method == Join::dmp2j) now_.x.col(ed) += missing_rate;
    }
  }

  bool weights_hold() const {
    if (!rhythmic() && now_.p < 0.05L) return false;
    const Vector a = worth(now_.p);
    if (join_.method == Join::dmp2j) {
      const Real own_rate = rhythmic() ? 1.0L / tau : Real(primitive.alpha) / tau;
      return across(a, worth_rate(now_.p)).norm() >= a.norm() * own_rate;
    }
    return join_.change != WeightChange::first || a(0) > 0.1L * a.maxCoeff();
  }
  static Vector across(const Vector& a, const Vector& b) {
    return b - a * (a.dot(b) / a.squaredNorm());
  }

  void change_weights(const Vector& missing, const Vector& missing_rate) {
    const Vector a = worth(now_.p);
    if (join_.method == Join::dmp2j) {
      // Along a for the value, and across it for what then is missing of the rate.
      const Vector b = worth_rate(now_.p);
      const Vector n = across(a, b);
      const Vector rest = missing_rate - missing * (a.dot(b) / a.squaredNorm());
      change += a / a.squaredNorm() * missing.transpose();
      change += n / n.squaredNorm() * rest.transpose();
    } else if (join_.change == WeightChange::smallest) {  // Eq. 21, F·S/s − Σwψ on ψ/|ψ|²
      const Vector psi = kernels(now_.p);
      const Real sum = psi.sum() / (rhythmic() ? amplitude : now_.p);
      change += psi / psi.squaredNorm() * (sum * missing.transpose());
    } else {  // Eqs. 20 and 22
      Eigen::Index k = 0;
      if (join_.change == WeightChange::strongest) a.maxCoeff(&k);
      change.row(k) += missing.transpose() / a(k);
    }
  }

  JoinSettings join_{Join::dmp2};
  Real joined_at_ = 0.0L;
  State now_;
};

}  // namespace seam::test
