// The gate bites: this program's joins are broken on purpose, and its figures are compared with the committed ones. The
// linker puts the functions below in place of those that Sequencer calls (see CMakeLists.txt).

#include <gmock/gmock.h>

#include "bench/gate.hpp"
#include <seam/execution.hpp>

namespace {

double error = 0.0;  // [rad/s²] by which a join mistakes the incoming acceleration

}  // namespace

// Execution::reinitialise(const Sample&, double, const JoinSettings&)
extern "C" {
void __real__ZN4seam9Execution12reinitialiseERKNS_6SampleEdRKNS_12JoinSettingsE(
    seam::Execution* execution, const seam::Sample& at, double phase,
    const seam::JoinSettings& join);
void __wrap__ZN4seam9Execution12reinitialiseERKNS_6SampleEdRKNS_12JoinSettingsE(
    seam::Execution* execution, const seam::Sample& at, double phase,
    const seam::JoinSettings& join) {
  seam::Sample mistaken = at;
  mistaken.acceleration.array() += error;
  __real__ZN4seam9Execution12reinitialiseERKNS_6SampleEdRKNS_12JoinSettingsE(execution, mistaken,
                                                                             phase, join);
}
}

namespace seam {
namespace {

std::vector<Difference> differences() {
  const auto quiet = [](int, int, const std::string&) {};
  const std::vector<Join> methods(all_joins.begin(), all_joins.end());
  const auto line = Scene::read(std::string(SEAM_SCENES) + "/line.yaml");
  return Baselines(SEAM_BASELINES).check(figures(compare({line}, methods, 2, quiet)));
}

TEST(BrokenJoin, PassesTheGateWhileItIsWhole) {
  error = 0.0;
  EXPECT_THAT(differences(), testing::IsEmpty());
}

TEST(BrokenJoin, FailsAtTheGateForEachMethodThatIsToContinueTheAcceleration) {
  error = 0.05;
  for (const char* method : {"dmp2a", "dmp3", "dmp2j"}) {
    const auto is_worse = [&](const char* metric) {
      for (const Difference& difference : differences())
        if (difference.method == method && difference.metric == metric)
          return difference.kind == Difference::Kind::worse;
      return false;
    };
    EXPECT_TRUE(is_worse("torque_jump_nm")) << method;
    EXPECT_TRUE(is_worse("torque_jump_order")) << method;
    EXPECT_TRUE(is_worse("acceleration_jump_rad_s2")) << method;
  }
  for (const Difference& difference : differences()) EXPECT_NE(difference.method, "dmp2");
}

}  // namespace
}  // namespace seam
