#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include <seam/demonstration.hpp>
#include <seam/error.hpp>
#include <seam/table.hpp>

namespace seam {

namespace {

constexpr int fit_samples = 5;  // least samples under one cubic

void require_well_formed(const Demonstration& demo) {
  const std::string place = "demonstration";
  const auto N = demo.time.size();
  if (demo.coordinates.empty()) throw Error(place, "no coordinates");
  if (demo.position.rows() != N ||
      demo.position.cols() != static_cast<Eigen::Index>(demo.coordinates.size()))
    throw Error(place, "positions must be samples x coordinates");
  if (N < fit_samples)
    throw Error(place, std::to_string(N) + " samples, must be >= " + std::to_string(fit_samples));
  if (!demo.time.allFinite() || !demo.position.allFinite())
    throw Error(place, "a value is not finite");
  for (Eigen::Index i = 1; i < N; ++i)
    if (!(demo.time(i) > demo.time(i - 1)))
      throw Error(place, "sample " + std::to_string(i + 1) + ": time " +
                             std::to_string(demo.time(i)) + " s does not increase");
}

struct Range {
  Eigen::Index first, count;
};

Range fit_range(const Eigen::VectorXd& time, Eigen::Index i, double window) {
  Eigen::Index first = i;
  Eigen::Index last = i;
  while (first > 0 && time(i) - time(first - 1) <= window) --first;
  while (last + 1 < time.size() && time(last + 1) - time(i) <= window) ++last;
  while (last - first + 1 < fit_samples) {
    const bool earlier = last + 1 == time.size() ||
                         (first > 0 && time(i) - time(first - 1) <= time(last + 1) - time(i));
    earlier ? --first : ++last;
  }
  return {first, last - first + 1};
}

void fit_derivatives(Demonstration& demo, Eigen::Index i, const Range& range) {
  const double scale = std::max(demo.time(i) - demo.time(range.first),
                                demo.time(range.first + range.count - 1) - demo.time(i));
  const Eigen::ArrayXd u =
      (demo.time.segment(range.first, range.count).array() - demo.time(i)) / scale;
  Eigen::MatrixXd powers(range.count, 4);
  powers << Eigen::VectorXd::Ones(range.count), u.matrix(), u.square().matrix(), u.cube().matrix();
  const Eigen::MatrixXd fit =
      powers.householderQr().solve(demo.position.middleRows(range.first, range.count));
  demo.velocity.row(i) = fit.row(1) / scale;
  demo.acceleration.row(i) = 2.0 * fit.row(2) / (scale * scale);
}

}  // namespace

Demonstration Demonstration::from_positions(std::vector<std::string> coordinates,
                                            Eigen::VectorXd time, Eigen::MatrixXd position,
                                            const DerivativeSettings& settings) {
  Demonstration demo{std::move(coordinates), std::move(time), std::move(position), {}, {}};
  require_well_formed(demo);
  demo.velocity.resizeLike(demo.position);
  demo.acceleration.resizeLike(demo.position);
  for (Eigen::Index i = 0; i < demo.time.size(); ++i)
    fit_derivatives(demo, i, fit_range(demo.time, i, settings.window));
  return demo;
}

Demonstration Demonstration::read(const std::string& path, const DerivativeSettings& settings) {
  const Table table = Table::read(path);
  if (table.columns.front() != "time")
    throw Error(path + ":1",
                "first column \"" + table.columns.front() + "\", must be \"time\" [s]");
  for (Eigen::Index i = 1; i < table.values.rows(); ++i)
    if (!(table.values(i, 0) > table.values(i - 1, 0)))
      throw Error(path + ":" + std::to_string(i + 2), "column \"time\": does not increase");
  try {
    return from_positions({table.columns.begin() + 1, table.columns.end()}, table.values.col(0),
                          table.values.rightCols(table.values.cols() - 1), settings);
  } catch (const Error& error) {
    throw Error(path, error.what());
  }
}

}  // namespace seam
