#include <algorithm>
#include <cmath>

#include "least_squares.hpp"
#include <seam/error.hpp>
#include <seam/period.hpp>

namespace seam {

namespace {

constexpr int most_harmonics = 5;
constexpr int grid_samples = 2048;
constexpr int fit_samples = 2000;
constexpr double likeness = 0.2;
constexpr double longest_lag = 0.55;  // of what is looked at

// The first part of a demonstration.
struct Part {
  const Demonstration& demo;
  int samples;

  double duration() const { return demo.time(samples - 1) - demo.time(0); }
};

// 1, cos φ, sin φ, cos 2φ …
void fourier_row(double phase, int harmonics, double* row) {
  const double c = std::cos(phase);
  const double s = std::sin(phase);
  row[0] = 1.0;
  row[1] = c;
  row[2] = s;
  for (int h = 2; h <= harmonics; ++h) {
    row[2 * h - 1] = row[2 * h - 3] * c - row[2 * h - 2] * s;
    row[2 * h] = row[2 * h - 2] * c + row[2 * h - 3] * s;
  }
}

// The centre and the residual of the series that fits best.
struct Fourier {
  Eigen::VectorXd centre;
  double residual;
};

Fourier fourier_fit(const Part& part, double period, int stride) {
  const int harmonics = std::clamp((part.samples / stride - 1) / 4, 1, most_harmonics);
  const int M = 2 * harmonics + 1;
  LeastSquares problem(M, part.demo.dimensions());
  for (int i = 0; i < part.samples; i += stride) {
    double* row = problem.next_row();
    fourier_row(2.0 * M_PI * (part.demo.time(i) - part.demo.time(0)) / period, harmonics, row);
    for (int d = 0; d < part.demo.dimensions(); ++d) row[M + d] = part.demo.position(i, d);
  }
  return {problem.solution().row(0).transpose(), problem.residual()};
}

// Positions at even times, one sample behind the other.
Eigen::MatrixXd even_positions(const Part& part, int count) {
  const Demonstration& demo = part.demo;
  Eigen::MatrixXd even(demo.dimensions(), count);
  int i = 0;
  for (int k = 0; k < count; ++k) {
    const double t = demo.time(0) + part.duration() * k / (count - 1);
    while (i + 2 < part.samples && t >= demo.time(i + 1)) ++i;
    const double u = (t - demo.time(i)) / (demo.time(i + 1) - demo.time(i));
    even.col(k) = (1.0 - u) * demo.position.row(i) + u * demo.position.row(i + 1);
  }
  return even;
}

// The lag of the first dip of likeness, in samples; 0 if there is none.
int first_dip(const Eigen::MatrixXd& even) {
  const Eigen::Index count = even.cols();
  const auto limit = static_cast<int>(longest_lag * static_cast<double>(count));
  int best = 0;
  double deepest = likeness;
  double sum = 0.0;
  for (int lag = 1; lag <= limit; ++lag) {
    const double difference =
        (even.rightCols(count - lag) - even.leftCols(count - lag)).colwise().squaredNorm().mean();
    sum += difference;
    const double relative = difference * lag / sum;
    if (relative < deepest) {
      deepest = relative;
      best = lag;
    } else if (best > 0 && relative > likeness) {
      break;
    }
  }
  return best;
}

double rough_period(const Demonstration& demo) {
  for (int samples = std::min(demo.samples(), 2 * grid_samples);;
       samples = std::min(demo.samples(), 2 * samples)) {
    const Part part{demo, samples};
    const int count = std::min(samples, grid_samples);
    const int lag = first_dip(even_positions(part, count));
    if (lag > 0) return part.duration() * lag / (count - 1);
    if (samples == demo.samples()) break;
  }
  throw Error(demo.source, "no period found, must show two or more (or give it)");
}

// Golden-section search for the least residual around a period.
double refined(const Part& part, double period) {
  constexpr double golden = 0.6180339887498949;
  const int stride = std::max(1, part.samples / fit_samples);
  const auto residual = [&](double T) { return fourier_fit(part, T, stride).residual; };
  const double reach = 0.25 * period * std::min(1.0, period / part.duration());
  double low = period - reach;
  double high = period + reach;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double at_left = residual(left);
  double at_right = residual(right);
  while (high - low > 1e-9 * period) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      at_left = residual(left = high - golden * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = residual(right = low + golden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

int samples_within(const Demonstration& demo, double duration) {
  const double* begin = demo.time.data();
  const double* end = begin + demo.time.size();
  return static_cast<int>(std::upper_bound(begin, end, demo.time(0) + duration) - begin);
}

}  // namespace

double find_period(const Demonstration& demo) {
  demo.validate();
  double period = rough_period(demo);
  for (double shown = 3.0 * period;; shown *= 2.0) {
    const Part part{demo, samples_within(demo, shown)};
    period = refined(part, period);
    if (part.samples == demo.samples()) return period;
  }
}

Eigen::VectorXd find_centre(const Demonstration& demo, double period) {
  return fourier_fit({demo, demo.samples()}, period, 1).centre;
}

}  // namespace seam
