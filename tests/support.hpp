#pragma once

#include <fstream>
#include <functional>
#include <random>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/temp_folder.hpp"
#include <seam/demonstration.hpp>
#include <seam/error.hpp>
#include <seam/learn.hpp>

namespace seam::test {

/// The message of the Error that an action throws; a failure if it throws none.
inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A demonstration with exact derivatives, sampled every 1 ms.
/// @param curve  position, velocity and acceleration at a time
inline Demonstration demonstrate(double duration,
                                 const std::function<Eigen::Vector3d(double)>& curve) {
  const int N = static_cast<int>(std::lround(duration * 1000.0)) + 1;
  Demonstration demo{{"y"},
                     Eigen::VectorXd(N),
                     Eigen::MatrixXd(N, 1),
                     Eigen::MatrixXd(N, 1),
                     Eigen::MatrixXd(N, 1)};
  for (int i = 0; i < N; ++i) {
    const double t = duration * i / (N - 1);
    const Eigen::Vector3d at = curve(t);
    demo.time(i) = t;
    demo.position(i, 0) = at(0);
    demo.velocity(i, 0) = at(1);
    demo.acceleration(i, 0) = at(2);
  }
  return demo;
}

/// Minimum-jerk movement from 0 to `distance` (Flash and Hogan 1985).
inline Demonstration minimum_jerk(double distance = 1.0, double duration = 1.0) {
  return demonstrate(duration, [=](double t) {
    const double s = t / duration;
    return Eigen::Vector3d(
        distance * s * s * s * (10.0 + s * (-15.0 + 6.0 * s)),
        distance * 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration,
        distance * 60.0 * s * (1.0 + s * (-3.0 + 2.0 * s)) / (duration * duration));
  });
}

/// A random, valid primitive with forcing of realistic size.
inline Primitive random_primitive(std::mt19937_64& random, int dimensions, int kernels = 10,
                                  Kind kind = Kind::discrete) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&](double scale) {
    return Eigen::VectorXd(
        Eigen::VectorXd::NullaryExpr(dimensions, [&] { return scale * uniform(random); }));
  };
  Primitive primitive;
  primitive.kind = kind;
  for (int d = 0; d < dimensions; ++d) primitive.coordinates.push_back("y" + std::to_string(d));
  primitive.gains = Gains::critical(200.0 + 100.0 * uniform(random));
  primitive.tau = 1.0 + 0.6 * uniform(random);
  primitive.kernels =
      Kernels::even_in_time(kernels, 0.75 + 0.25 * uniform(random), primitive.alpha);
  if (kind == Kind::rhythmic) {
    primitive.kernels = Kernels::even_in_phase(kernels, 1.0 + 0.2 * uniform(random));
    primitive.tau /= 2.0 * M_PI;
  }
  primitive.weights =
      Eigen::MatrixXd::NullaryExpr(kernels, dimensions, [&] { return 200.0 * uniform(random); });
  if (kind == Kind::rhythmic) {
    // Three harmonics, as a movement that is shown has.
    primitive.weights.setZero();
    for (int d = 0; d < dimensions; ++d)
      for (int h = 1; h <= 3; ++h) {
        const double phase = M_PI * uniform(random);
        primitive.weights.col(d).array() +=
            200.0 / h * uniform(random) * (h * primitive.kernels.centers.array() + phase).cos();
      }
  }
  primitive.goal = vector(1.0);
  primitive.start_position = vector(1.0);
  primitive.start_velocity = vector(0.5);
  primitive.start_acceleration = vector(1.0);
  return primitive;
}

}  // namespace seam::test
