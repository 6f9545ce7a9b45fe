#include <set>

#include "shown.hpp"
#include <seam/error.hpp>
#include <seam/orientation.hpp>
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

std::string range_of(const Bounds& bounds) {
  return shown(bounds.least) + " to " + shown(bounds.largest);
}

void require_within(double value, const Bounds& bounds, const std::string& name) {
  if (!bounds.hold(value))
    throw Error("primitive", name + " " + shown(value) + ", must be in " + range_of(bounds));
}

void require_entries(const Eigen::Ref<const Eigen::MatrixXd>& values, const Bounds& bounds,
                     const std::string& name) {
  for (const double value : values.reshaped())
    if (!bounds.hold(value))
      throw Error("primitive",
                  name + ": an entry is " + shown(value) + ", must be in " + range_of(bounds));
}

void require_vector(const Eigen::VectorXd& value, Eigen::Index size, const Bounds& bounds,
                    const std::string& name) {
  require(value.size() == size, name + " has " + std::to_string(value.size()) +
                                    " entries, must have " + std::to_string(size));
  require_entries(value, bounds, name);
}

}  // namespace

Primitive Primitive::at_speed(double factor) const {
  Primitive faster = *this;
  faster.tau /= factor;
  faster.start_velocity *= factor;
  faster.start_acceleration *= factor * factor;
  return faster;
}

void Primitive::validate() const {
  require(dimensions() > 0, "no coordinates");
  const auto size = static_cast<std::size_t>(dimensions());
  require(coordinates.size() == size, std::to_string(coordinates.size()) +
                                          " coordinate names for " + std::to_string(size) +
                                          " goals");
  const std::set<std::string> names(coordinates.begin(), coordinates.end());
  require(names.size() == size, "coordinate names repeat");
  require_within(gains.K, gain_bounds, "K");
  require_within(gains.D, gain_bounds, "D");
  require_within(gains.H, gain_bounds, "H");
  require_within(alpha, alpha_bounds, "alpha");
  require_within(tau, tau_bounds, "tau");
  require(kernels.count() >= 2, "fewer than 2 kernels");
  require_vector(kernels.centers, kernels.count(), center_bounds, "centers");
  require_vector(kernels.widths, kernels.count(), width_bounds, "widths");
  require(weights.rows() == kernels.count() && weights.cols() == dimensions(),
          "weights are " + std::to_string(weights.rows()) + " x " + std::to_string(weights.cols()) +
              ", must be " + std::to_string(kernels.count()) + " x " +
              std::to_string(dimensions()));
  require_entries(weights, value_bounds, "weights");
  require_vector(goal, dimensions(), value_bounds, "goal");
  require_vector(start_position, dimensions(), value_bounds, "start_position");
  require_vector(start_velocity, dimensions(), value_bounds, "start_velocity");
  require_vector(start_acceleration, dimensions(), value_bounds, "start_acceleration");
  require_reference("primitive", coordinates, reference_orientation);
}

}  // namespace seam
