#include <seam/error.hpp>
#include <seam/join.hpp>

namespace seam {

std::string_view to_string(Join method) noexcept {
  switch (method) {
    case Join::dmp2:
      return "dmp2";
    case Join::dmp2a:
      return "dmp2a";
    case Join::dmp3:
      return "dmp3";
  }
  return "";
}

Join join_from_name(std::string_view name) {
  std::string known;
  for (const Join method : all_joins) {
    if (to_string(method) == name) return method;
    known += (known.empty() ? "" : ", ") + std::string(to_string(method));
  }
  throw Error("method \"" + std::string(name) + "\"", "not known, must be one of " + known);
}

Sample Sample::at_rest(const Eigen::VectorXd& position) {
  Sample sample(static_cast<int>(position.size()));
  sample.position = position;
  return sample;
}

void continue_from(const Sample& at, Join method, const Gains& gains, double tau,
                   const Eigen::VectorXd& goal, const Eigen::ArrayXd& row, Eigen::MatrixXd& weights,
                   Eigen::ArrayXd& r) noexcept {
  const double row_norm2 = row.square().sum();
  for (Eigen::Index d = 0; d < goal.size(); ++d) {
    const double forcing = (row * weights.col(d).array()).sum();
    const double pull = tau * tau * at.acceleration(d) + tau * gains.D * at.velocity(d);
    r(d) = goal(d);
    if (method == Join::dmp2a) {
      const double needed = pull - gains.K * (goal(d) - at.position(d));
      weights.col(d).array() += row * ((needed - forcing) / row_norm2);
    } else if (method == Join::dmp3) {
      r(d) = (pull - forcing) / gains.K + at.position(d);
    }
  }
}

}  // namespace seam
