#include <set>

#include <seam/error.hpp>
#include <seam/primitive.hpp>

namespace seam {

namespace {

void require_kernels(int count, double width) {
  if (count < 2) throw Error("kernels", "count " + std::to_string(count) + ", must be >= 2");
  if (!(width > 0.0)) throw Error("kernels", "width " + std::to_string(width) + ", must be > 0");
}

}  // namespace

Kernels Kernels::even_in_time(int count, double width, double alpha) {
  require_kernels(count, width);
  if (!(alpha > 0.0)) throw Error("kernels", "alpha " + std::to_string(alpha) + ", must be > 0");
  Kernels kernels{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int j = 0; j < count; ++j) kernels.centers(j) = std::exp(-alpha * j / (count - 1));
  for (int j = 0; j + 1 < count; ++j)
    kernels.widths(j) = width * std::abs(kernels.centers(j + 1) - kernels.centers(j));
  kernels.widths(count - 1) = kernels.widths(count - 2);
  return kernels;
}

Kernels Kernels::even_in_phase(int count, double width) {
  require_kernels(count, width);
  const double distance = 2.0 * M_PI / count;
  return {distance * Eigen::VectorXd::LinSpaced(count, 0.0, count - 1.0),
          Eigen::VectorXd::Constant(count, width * distance)};
}

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw Error("primitive", what);
}

void require_positive(double value, const std::string& name) {
  require(std::isfinite(value) && value > 0.0,
          name + " " + std::to_string(value) + ", must be > 0");
}

void require_vector(const Eigen::VectorXd& value, Eigen::Index size, const std::string& name) {
  require(value.size() == size, name + " has " + std::to_string(value.size()) +
                                    " entries, must have " + std::to_string(size));
  require(value.allFinite(), name + " has an entry that is not finite");
}

}  // namespace

void Primitive::validate() const {
  require(dimensions() > 0, "no coordinates");
  const auto size = static_cast<std::size_t>(dimensions());
  require(coordinates.size() == size, std::to_string(coordinates.size()) +
                                          " coordinate names for " + std::to_string(size) +
                                          " goals");
  const std::set<std::string> names(coordinates.begin(), coordinates.end());
  require(names.size() == size, "coordinate names repeat");
  require_positive(gains.K, "K");
  require_positive(gains.D, "D");
  require_positive(gains.H, "H");
  require_positive(alpha, "alpha");
  require_positive(tau, "tau");
  require(kernels.count() >= 2, "fewer than 2 kernels");
  require_vector(kernels.centers, kernels.count(), "centers");
  require_vector(kernels.widths, kernels.count(), "widths");
  require(kernels.widths.minCoeff() > 0.0, "a kernel width is not > 0");
  require(weights.rows() == kernels.count() && weights.cols() == dimensions(),
          "weights are " + std::to_string(weights.rows()) + " x " + std::to_string(weights.cols()) +
              ", must be " + std::to_string(kernels.count()) + " x " +
              std::to_string(dimensions()));
  require(weights.allFinite(), "weights have an entry that is not finite");
  require_vector(goal, dimensions(), "goal");
  require_vector(start_position, dimensions(), "start_position");
  require_vector(start_velocity, dimensions(), "start_velocity");
  require_vector(start_acceleration, dimensions(), "start_acceleration");
}

}  // namespace seam
