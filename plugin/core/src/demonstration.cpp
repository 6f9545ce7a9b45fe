#include <algorithm>
#include <cmath>
#include <set>

#include "shown.hpp"
#include "smoothing_spline.hpp"
#include <seam/demonstration.hpp>
#include <seam/error.hpp>
#include <seam/orientation.hpp>
#include <seam/primitive.hpp>
#include <seam/table.hpp>

namespace seam {

namespace {

constexpr int least_samples = 5;
const std::string velocity_prefix = "vel.";
const std::string acceleration_prefix = "acc.";

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

bool is_derivative(const std::string& column) {
  return starts_with(column, velocity_prefix) || starts_with(column, acceleration_prefix);
}

std::string quoted(const std::string& name) {
  return '"' + name + '"';
}

void require_cutoff(const DerivativeSettings& settings) {
  if (!(settings.cutoff > 0.0))
    throw Error("derivatives", "cutoff " + std::to_string(settings.cutoff) + " Hz, must be > 0");
}

void require_increasing(const Demonstration& demo) {
  for (Eigen::Index i = 1; i < demo.time.size(); ++i)
    if (!(demo.time(i) > demo.time(i - 1)))
      throw Error(demo.source, "sample " + std::to_string(i + 1) + ": time " +
                                   std::to_string(demo.time(i)) + " s does not increase");
}

// Those of a primitive.
void require_bounds(const Demonstration& demo) {
  if (!tau_bounds.hold(demo.duration()))
    throw Error(demo.source, "lasts " + shown(demo.duration()) + " s, must be in " +
                                 shown(tau_bounds.least) + " to " + shown(tau_bounds.largest));
  for (const double value : demo.position.reshaped())
    if (!value_bounds.hold(value))
      throw Error(demo.source, "a position is " + shown(value) + ", must be in " +
                                   shown(value_bounds.least) + " to " +
                                   shown(value_bounds.largest));
}

void require_positions(const Demonstration& demo) {
  const auto D = static_cast<Eigen::Index>(demo.coordinates.size());
  if (D == 0) throw Error(demo.source, "no coordinates");
  if (std::set<std::string>(demo.coordinates.begin(), demo.coordinates.end()).size() !=
      demo.coordinates.size())
    throw Error(demo.source, "coordinate names repeat");
  if (demo.position.rows() != demo.time.size() || demo.position.cols() != D)
    throw Error(demo.source, "positions must be samples x coordinates");
  if (demo.samples() < least_samples)
    throw Error(demo.source, std::to_string(demo.samples()) +
                                 " samples, must be >= " + std::to_string(least_samples));
  if (!demo.time.allFinite() || !demo.position.allFinite())
    throw Error(demo.source, "a time or position is not finite");
  require_increasing(demo);
  require_bounds(demo);
}

// The columns whose names are the coordinates' behind a prefix; none of them is N × 0.
Eigen::MatrixXd take_columns(const Table& table, const std::string& place,
                             const std::vector<std::string>& coordinates,
                             const std::string& prefix) {
  const auto& columns = table.columns;
  const auto given = std::find_if(columns.begin(), columns.end(), [&](const std::string& column) {
    return !prefix.empty() && starts_with(column, prefix);
  });
  if (!prefix.empty() && given == columns.end()) return Eigen::MatrixXd(table.values.rows(), 0);
  Eigen::MatrixXd taken(table.values.rows(), coordinates.size());
  Eigen::Index c = 0;
  for (const std::string& coordinate : coordinates) {
    const auto column = std::find(columns.begin(), columns.end(), prefix + coordinate);
    if (column == columns.end())
      throw Error(place, "no column " + quoted(prefix + coordinate) + ", must be there as " +
                             quoted(*given) + " is");
    taken.col(c++) = table.values.col(column - columns.begin());
  }
  return taken;
}

std::vector<std::string> coordinates_of(const Table& table, const std::string& place) {
  if (table.columns.front() != "time")
    throw Error(place, "first column " + quoted(table.columns.front()) + ", must be \"time\" [s]");
  std::vector<std::string> coordinates;
  std::copy_if(table.columns.begin() + 1, table.columns.end(), std::back_inserter(coordinates),
               [](const std::string& column) { return !is_derivative(column); });
  for (const std::string& column : table.columns)
    if (is_derivative(column) &&
        std::find(coordinates.begin(), coordinates.end(), column.substr(velocity_prefix.size())) ==
            coordinates.end())
      throw Error(place, "column " + quoted(column) + ": no coordinate " +
                             quoted(column.substr(velocity_prefix.size())) + ", must have one");
  return coordinates;
}

void require_increasing_lines(const Table& table, const std::string& path) {
  for (Eigen::Index i = 1; i < table.values.rows(); ++i)
    if (!(table.values(i, 0) > table.values(i - 1, 0)))
      throw Error(path + ":" + std::to_string(i + 2),
                  "column \"time\": does not increase, must be later than the line before");
}

void complete_derivatives(Demonstration& demo, const DerivativeSettings& settings) {
  const bool has_velocity = demo.velocity.cols() > 0;
  const bool has_acceleration = demo.acceleration.cols() > 0;
  if (has_velocity && has_acceleration) return;
  const SmoothingSpline fit(demo.time, has_velocity ? demo.velocity : demo.position,
                            settings.cutoff);
  if (!has_velocity) demo.velocity = fit.derivative(demo.time, 1);
  if (!has_acceleration) demo.acceleration = fit.derivative(demo.time, has_velocity ? 1 : 2);
}

// Slopes at the samples, of the parabola through three neighbours.
Eigen::MatrixXd slopes(const Eigen::VectorXd& time, const Eigen::MatrixXd& values) {
  Eigen::MatrixXd result(values.rows(), values.cols());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const Eigen::Index m = std::clamp<Eigen::Index>(i, 1, time.size() - 2);
    const double before = time(m) - time(m - 1);
    const double after = time(m + 1) - time(m);
    const Eigen::RowVectorXd left = (values.row(m) - values.row(m - 1)) / before;
    const Eigen::RowVectorXd right = (values.row(m + 1) - values.row(m)) / after;
    const Eigen::RowVectorXd bend = (right - left) / (before + after);
    result.row(i) = left + bend * (2.0 * time(i) - time(m) - time(m - 1));
  }
  return result;
}

// The cubic of given values and slopes at both ends of the interval that begins at sample i.
Eigen::RowVectorXd between(const Eigen::MatrixXd& values, const Eigen::MatrixXd& slope,
                           Eigen::Index i, double length, double u) {
  const double rise = u * u * (3.0 - 2.0 * u);
  return (1.0 - rise) * values.row(i) + rise * values.row(i + 1) +
         length * u * (1.0 - u) * ((1.0 - u) * slope.row(i) - u * slope.row(i + 1));
}

}  // namespace

void Demonstration::validate() const {
  require_positions(*this);
  for (const Eigen::MatrixXd* derivative : {&velocity, &acceleration})
    if (derivative->rows() != position.rows() || derivative->cols() != position.cols())
      throw Error(source, "time, position, velocity and acceleration differ in size");
  if (!velocity.allFinite() || !acceleration.allFinite())
    throw Error(source, "a velocity or acceleration is not finite");
  require_reference(source, coordinates, reference_orientation);
}

void Demonstration::require_coordinates(const std::vector<std::string>& names) const {
  for (const std::string& coordinate : coordinates) {
    if (std::find(names.begin(), names.end(), coordinate) != names.end()) continue;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    throw Error(source, "coordinate " + quoted(coordinate) + ", must be one of " + list);
  }
}

Demonstration Demonstration::from_positions(std::vector<std::string> coordinates,
                                            Eigen::VectorXd time, Eigen::MatrixXd position,
                                            const DerivativeSettings& settings) {
  require_cutoff(settings);
  Demonstration demo{std::move(coordinates), std::move(time), std::move(position), {}, {}};
  require_positions(demo);
  complete_derivatives(demo, settings);
  return demo;
}

Demonstration Demonstration::read(const std::string& path, const DerivativeSettings& settings) {
  require_cutoff(settings);
  const Table table = Table::read(path);
  const std::string header = path + ":1";
  Demonstration demo;
  demo.source = path;
  demo.coordinates = coordinates_of(table, header);
  require_increasing_lines(table, path);
  demo.time = table.values.col(0);
  demo.position = take_columns(table, header, demo.coordinates, "");
  demo.velocity = take_columns(table, header, demo.coordinates, velocity_prefix);
  demo.acceleration = take_columns(table, header, demo.coordinates, acceleration_prefix);
  require_positions(demo);
  complete_derivatives(demo, settings);
  return demo;
}

Demonstration Demonstration::resample(double rate) const {
  validate();
  const auto N = std::lround(duration() * rate) + 1;
  if (!(rate > 0.0) || N < least_samples)
    throw Error(source, "rate " + std::to_string(rate) + " 1/s, must be > 0 and give >= " +
                            std::to_string(least_samples) + " samples");
  Demonstration even{coordinates,
                     Eigen::VectorXd::LinSpaced(N, time(0), time(time.size() - 1)),
                     Eigen::MatrixXd(N, dimensions()),
                     Eigen::MatrixXd(N, dimensions()),
                     Eigen::MatrixXd(N, dimensions()),
                     source,
                     reference_orientation};
  const Eigen::MatrixXd jerk = slopes(time, acceleration);
  Eigen::Index i = 0;
  for (Eigen::Index k = 0; k < N; ++k) {
    while (i + 2 < time.size() && even.time(k) >= time(i + 1)) ++i;
    const double length = time(i + 1) - time(i);
    const double u = (even.time(k) - time(i)) / length;
    even.position.row(k) = between(position, velocity, i, length, u);
    even.velocity.row(k) = between(velocity, acceleration, i, length, u);
    even.acceleration.row(k) = between(acceleration, jerk, i, length, u);
  }
  return even;
}

}  // namespace seam
