#include "bench/pack.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <zlib.h>

#include "scenes/base64.hpp"

namespace seam {
namespace {

using Json = nlohmann::ordered_json;

std::string unpacked(const Pack& pack, std::size_t size) {
  const std::string small = from_base64(pack.text());
  std::string bytes(size + 1, '\0');
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                       reinterpret_cast<const Bytef*>(small.data()), small.size()),
            Z_OK);
  bytes.resize(length);
  return bytes;
}

double one_of(const Json& numbers, Eigen::Index c) {
  return numbers.is_array() ? numbers.at(static_cast<std::size_t>(c)).get<double>()
                            : numbers.get<double>();
}

// As the page does it.
Eigen::MatrixXd matrix(const std::string& bytes, const Json& found) {
  const auto rows = found.at("rows").get<Eigen::Index>();
  const auto columns = found.at("columns").get<Eigen::Index>();
  const auto plane = static_cast<std::size_t>(rows * columns);
  Eigen::MatrixXd values(rows, columns);
  std::size_t k = found.at("at").get<std::size_t>();
  for (Eigen::Index c = 0; c < columns; ++c) {
    std::int64_t level = 0;
    for (Eigen::Index i = 0; i < rows; ++i, ++k) {
      std::uint32_t code = 0;
      for (std::size_t b = 0; b < 4; ++b)
        code |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(k + b * plane)))
                << (8 * b);
      level += code & 1U ? -static_cast<std::int64_t>(code >> 1U) - 1 : code >> 1U;
      values(i, c) =
          one_of(found.at("zero"), c) + one_of(found.at("step"), c) * static_cast<double>(level);
    }
  }
  return values;
}

TEST(Pack, KeepsEveryColumnToAMillionthOfItsRange) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(777, 0.0, 3.0);
  Eigen::MatrixXd values(777, 4);
  values << t, 90.0 * (5.0 * t.array()).sin().matrix(), -1e-3 * t.cwiseAbs2(),
      Eigen::VectorXd::Constant(777, 0.1);
  Pack pack;
  pack.add(t, 1e-3);
  const Json found = pack.add(values);
  const Eigen::MatrixXd back = matrix(unpacked(pack, 4 * 777 * 5), found);
  for (Eigen::Index c = 0; c < 4; ++c) {
    const double range = values.col(c).maxCoeff() - values.col(c).minCoeff();
    EXPECT_LE((back - values).col(c).cwiseAbs().maxCoeff(), 1e-6 * range + 1e-8) << c;
  }
}

TEST(Pack, KeepsAResolutionAlsoWithLargeStepsBetweenRows) {
  Eigen::MatrixXd values(5, 2);
  values << 0, -1e5, 1e5, 1e5, -1e5, 0, 0.0004, 0.0016, 7, 8;
  Pack pack;
  const Json found = pack.add(values, 1e-3);
  EXPECT_LE((matrix(unpacked(pack, 4 * 10), found) - values).cwiseAbs().maxCoeff(), 0.5001e-3);
}

TEST(Pack, HoldsNothingOfTheLastBitsOfAConstant) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(3, 1, 100.0);
  values(1) += 1e-13;
  Pack pack;
  const Json found = pack.add(values);
  const Eigen::MatrixXd back = matrix(unpacked(pack, 12), found);
  EXPECT_EQ(back(0), back(1));
  EXPECT_NEAR(back(0), 100.0, 1e-5);
}

}  // namespace
}  // namespace seam
