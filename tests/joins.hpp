#pragma once

#include <random>
#include <string>
#include <vector>

#include "tests/support.hpp"
#include <seam/join.hpp>

namespace seam::test {

/// All but dmp2, with every way of changing weights.
inline const std::vector<JoinSettings> continuous_methods{Join::dmp2a,
                                                          {Join::dmp2a, WeightChange::first},
                                                          {Join::dmp2a, WeightChange::strongest},
                                                          Join::dmp3,
                                                          Join::dmp2j};

inline std::vector<JoinSettings> all_methods() {
  std::vector<JoinSettings> methods{Join::dmp2};
  methods.insert(methods.end(), continuous_methods.begin(), continuous_methods.end());
  return methods;
}

inline std::string word(Kind kind) {
  return kind == Kind::discrete ? "Discrete" : "Rhythmic";
}

inline std::string word(const JoinSettings& join) {
  const char* changes[] = {"", "First", "Strongest"};
  return std::string(to_string(join.method)) + changes[static_cast<int>(join.change)];
}

inline double largest(const Eigen::VectorXd& v) {
  return v.cwiseAbs().maxCoeff();
}

/// One coordinate with a period of a second.
inline Primitive rhythm() {
  std::mt19937_64 random(14);
  Primitive primitive = random_primitive(random, 1, 20, Kind::rhythmic);
  primitive.tau = 1.0 / (2.0 * M_PI);
  return primitive;
}

}  // namespace seam::test
