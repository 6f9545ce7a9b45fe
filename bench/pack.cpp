#include "bench/pack.hpp"

#include <cmath>

#include <zlib.h>

#include "scenes/base64.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

using Json = nlohmann::ordered_json;

constexpr double levels = 1 << 20;
constexpr double finest = 1e-9;

std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1U) ^ (value < 0 ? ~0U : 0U);
}

Json found_at(std::size_t at, const Eigen::MatrixXd& values) {
  return {{"at", at}, {"rows", values.rows()}, {"columns", values.cols()}};
}

std::vector<double> list(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

// So that it is short as text.
double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace

void Pack::append(const Eigen::MatrixXd& values, const Eigen::VectorXd& zero,
                  const Eigen::VectorXd& step) {
  const std::size_t begin = bytes_.size();
  const auto plane = static_cast<std::size_t>(values.size());
  bytes_.resize(begin + 4 * plane);
  std::size_t k = begin;
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    std::int32_t before = 0;
    for (Eigen::Index i = 0; i < values.rows(); ++i, ++k) {
      const auto level = static_cast<std::int32_t>(std::lround((values(i, c) - zero(c)) / step(c)));
      const std::uint32_t code = zigzag(level - before);
      for (std::size_t b = 0; b < 4; ++b)
        bytes_[k + b * plane] = static_cast<unsigned char>(code >> (8U * b));
      before = level;
    }
  }
}

Json Pack::add(const Eigen::MatrixXd& values, double step) {
  Json matrix = found_at(bytes_.size(), values);
  matrix["zero"] = 0.0;
  matrix["step"] = step;
  append(values, Eigen::VectorXd::Zero(values.cols()),
         Eigen::VectorXd::Constant(values.cols(), step));
  return matrix;
}

Json Pack::add(const Eigen::MatrixXd& values) {
  Json matrix = found_at(bytes_.size(), values);
  const Eigen::VectorXd zero = values.colwise().minCoeff().transpose().unaryExpr(&as_float);
  const Eigen::VectorXd range = values.colwise().maxCoeff() - values.colwise().minCoeff();
  const Eigen::VectorXd largest = values.cwiseAbs().colwise().maxCoeff();
  const Eigen::VectorXd step =
      (range / levels).cwiseMax(finest * largest).cwiseMax(finest).unaryExpr(&as_float);
  append(values, zero, step);
  matrix["zero"] = list(zero);
  matrix["step"] = list(step);
  return matrix;
}

std::string Pack::text() const {
  uLongf size = compressBound(bytes_.size());
  std::vector<unsigned char> small(size);
  if (compress2(small.data(), &size, bytes_.data(), bytes_.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw Error("zlib", "no memory");
  return base64({reinterpret_cast<const char*>(small.data()), size});
}

}  // namespace seam
