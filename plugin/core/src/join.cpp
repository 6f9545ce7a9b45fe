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
    case Join::dmp2j:
      return "dmp2j";
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

}  // namespace seam
