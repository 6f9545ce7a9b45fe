// Cost of a sequencer step, 7 coordinates × 10 kernels at 1 ms, beside a bare hand-written loop of the same
// arithmetic: two evaluations of ten kernels, two forcings, one exact step of the third-order system.

#include <array>
#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>

#include "bench/micro/benchmarks.hpp"
#include "bench/micro/pair.hpp"
#include <seam/seam.hpp>

namespace seam::micro {

namespace {

constexpr int D = 7;
constexpr int M = 10;
constexpr double dt = 1e-3;
constexpr double wish_limit = 20e-6;  // [s]

Primitive primitive(int kernels = M) {
  Primitive primitive;
  for (int d = 0; d < D; ++d) primitive.coordinates.push_back("q" + std::to_string(d));
  primitive.kernels = Kernels::even_in_time(kernels, 0.75, primitive.alpha);
  primitive.weights = 100.0 * Eigen::MatrixXd::Random(kernels, D);
  primitive.goal.setOnes(D);
  primitive.start_position.setZero(D);
  primitive.start_velocity = primitive.start_acceleration = primitive.start_position;
  return primitive;
}

/// The same mathematics in plain loops over arrays of fixed size.
class BareLoop {
 public:
  explicit BareLoop(const Primitive& from)
      : propagator_(from.gains, from.tau, dt), tau_(from.tau), gains_(from.gains) {
    for (int j = 0; j < M; ++j) {
      centers_[j] = from.kernels.centers(j);
      precision_[j] = 0.5 / (from.kernels.widths(j) * from.kernels.widths(j));
      for (int d = 0; d < D; ++d) weights_[j][d] = from.weights(j, d);
    }
    for (int d = 0; d < D; ++d) goal_[d] = from.goal(d);
    restart();
  }

  void restart() {
    elapsed_ = 0.0;
    for (int d = 0; d < D; ++d)
      offset_[d] = -goal_[d], velocity_[d] = 0.0, added_[d] = 20.0, rate_[d] = -280.0;
    forcing(1.0, start_);
  }

  void step() {
    elapsed_ += dt;
    forcing(std::exp(-2.0 * (elapsed_ - 0.5 * dt) / tau_), middle_);
    forcing(std::exp(-2.0 * elapsed_ / tau_), end_);
    const auto& P = propagator_.Phi;
    const auto& G = propagator_.Gamma;
    for (int d = 0; d < D; ++d) {
      const double y = P(0, 0) * offset_[d] + P(0, 1) * velocity_[d] + P(0, 2) * added_[d] +
                       P(0, 3) * rate_[d] + G(0, 0) * start_[d] + G(0, 1) * middle_[d] +
                       G(0, 2) * end_[d];
      const double v = P(1, 0) * offset_[d] + P(1, 1) * velocity_[d] + P(1, 2) * added_[d] +
                       P(1, 3) * rate_[d] + G(1, 0) * start_[d] + G(1, 1) * middle_[d] +
                       G(1, 2) * end_[d];
      const double e = P(2, 2) * added_[d] + P(2, 3) * rate_[d];
      rate_[d] = P(3, 2) * added_[d] + P(3, 3) * rate_[d];
      added_[d] = e;
      offset_[d] = y;
      velocity_[d] = v;
      start_[d] = end_[d];
      position[d] = goal_[d] + y;
      acceleration[d] = (end_[d] + e - gains_.K * y - gains_.D * tau_ * v) / (tau_ * tau_);
    }
  }

  std::array<double, D> position{}, acceleration{};

 private:
  void forcing(double x, std::array<double, D>& f) const {
    std::array<double, M> psi{};
    double sum = 0.0;
    for (int j = 0; j < M; ++j) {
      psi[j] = std::exp(-(x - centers_[j]) * (x - centers_[j]) * precision_[j]);
      sum += psi[j];
    }
    f.fill(0.0);
    for (int j = 0; j < M; ++j)
      for (int d = 0; d < D; ++d) f[d] += psi[j] * weights_[j][d];
    for (int d = 0; d < D; ++d) f[d] *= x / sum;
  }

  Propagator propagator_;
  double tau_;
  Gains gains_;
  std::array<double, M> centers_{}, precision_{};
  std::array<std::array<double, D>, M> weights_{};
  std::array<double, D> goal_{}, offset_{}, velocity_{}, added_{}, rate_{}, start_{}, middle_{},
      end_{};
  double elapsed_ = 0.0;
};

constexpr int ticks = 1000;

Timed steps(const std::shared_ptr<Sequencer>& sequencer) {
  return timed([=] {
    for (int k = 0; k < ticks; ++k) {
      sequencer->step(dt);
      benchmark::DoNotOptimize(sequencer->sample().position.data());
      benchmark::ClobberMemory();
    }
  });
}

Timed steps(const std::shared_ptr<BareLoop>& loop) {
  return timed([=] {
    for (int k = 0; k < ticks; ++k) {
      loop->step();
      benchmark::DoNotOptimize(loop->position.data());
      benchmark::ClobberMemory();
    }
  });
}

/// @param rate_moves  each step is of another length and needs a propagator of its own
Pair play(Join join, bool rate_moves) {
  const Primitive shown = primitive();
  Sequence sequence;
  sequence.then(shown).until(after(1e9));
  const Sequencer fresh(sequence, join, Sample::at_rest(shown.start_position));
  const auto sequencer = std::make_shared<Sequencer>(fresh);
  const auto loop = std::make_shared<BareLoop>(shown);
  const auto restart = [=] {
    *sequencer = fresh;
    if (rate_moves) sequencer->set_rate(0.5, 10.0);
    loop->restart();
  };
  return {steps(sequencer), steps(loop), ticks, restart};
}

/// A wish of seven coordinates of twenty kernels that is moved on the way, as a camera does.
Pair wishing() {
  const Primitive shown = primitive(20);
  const auto execution = std::make_shared<Execution>(shown);
  execution->reinitialise(Sample::at_rest(shown.start_position), 1.0, Join::dmp2a);
  for (int k = 0; k < 100; ++k) execution->step(dt);
  const Wish wish =
      hit(Eigen::VectorXd::Constant(D, 0.4), Eigen::VectorXd::Constant(D, 0.2), at(0.6));
  constexpr int moves = 100;
  return {timed([=] {
            for (int i = 0; i < moves; ++i) benchmark::DoNotOptimize(execution->set_wish(0, wish));
          }),
          [] { return moves * wish_limit; }, moves};
}

/// A step while something is in the way.
Pair coupled() {
  Primitive shown = primitive();
  for (int d = 0; d < 3; ++d) shown.coordinates[static_cast<std::size_t>(d)] = "xyz"[d];
  Sequence sequence;
  sequence.then(shown).until(after(1e9));
  const auto alone =
      std::make_shared<Sequencer>(sequence, Join::dmp3, Sample::at_rest(shown.start_position));
  const auto round = std::make_shared<Sequencer>(*alone);
  add_obstacles({ObstacleSettings{Eigen::Vector3d::Constant(0.5), Box{}}}, *round);
  return {steps(round), steps(alone), ticks};
}

}  // namespace

void add_step_benchmarks() {
  for (const Join join : all_joins)
    add_pair("sequencer step, " + std::string(to_string(join)) + " / bare loop", 1.2, 2000,
             [join] { return play(join, false); });
  add_pair("sequencer step while the rate moves / bare loop", 3.0, 500,
           [] { return play(Join::dmp3, true); });
  add_pair("a wish moved on the way, 7 coordinates × 20 kernels / 20 µs", 1.0, 500, wishing);
  add_pair("sequencer step beside a box / without", no_bar, 500, coupled);
}

}  // namespace seam::micro
