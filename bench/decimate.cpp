#include "bench/decimate.hpp"

#include <algorithm>
#include <cmath>

namespace seam {

namespace {

constexpr double seen = 0.005;  // of a column's range

// Three kept ticks, the last of them the next one's first: the first two take the extremes between, in their order.
void show_extremes(const Eigen::VectorXd& values, Eigen::Index begin, Eigen::Index end,
                   double least, Eigen::Ref<Eigen::Vector3d> shown) {
  Eigen::Index low = 0, high = 0;
  const auto between = values.segment(begin, end - begin);
  const double lowest = between.minCoeff(&low), highest = between.maxCoeff(&high);
  if (lowest > shown.minCoeff() - least && highest < shown.maxCoeff() + least) return;
  shown(0) = low < high ? lowest : highest;
  shown(1) = low < high ? highest : lowest;
}

}  // namespace

std::vector<Eigen::Index> kept_ticks(const Eigen::VectorXd& time, const std::vector<double>& joins,
                                     double near, int points) {
  const Eigen::Index ticks = time.size();
  const Eigen::Index every = std::max<Eigen::Index>(1, ticks / points);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < ticks; ++k) {
    const bool close = std::any_of(joins.begin(), joins.end(),
                                   [&](double join) { return std::abs(time(k) - join) <= near; });
    if (close || k % every == 0 || k == ticks - 1) kept.push_back(k);
  }
  return kept;
}

Eigen::MatrixXd decimated(const Eigen::MatrixXd& values, const std::vector<Eigen::Index>& kept) {
  const auto rows = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd shown(rows, values.cols());
  for (Eigen::Index i = 0; i < rows; ++i)
    shown.row(i) = values.row(kept[static_cast<std::size_t>(i)]);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const double least = seen * (values.col(c).maxCoeff() - values.col(c).minCoeff());
    for (Eigen::Index i = 0; i + 2 < rows; i += 2) {
      const auto at = static_cast<std::size_t>(i);
      if (kept[at + 2] - kept[at] > 2)
        show_extremes(values.col(c), kept[at], kept[at + 2], least, shown.col(c).segment<3>(i));
    }
  }
  return shown;
}

}  // namespace seam
