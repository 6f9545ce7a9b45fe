#include <gmock/gmock.h>

#include "tests/refusals.hpp"
#include <seam/orientation.hpp>
#include <seam/primitive_file.hpp>
#include <seam/sequence_file.hpp>
#include <seam/sequencer.hpp>
#include <seam/table.hpp>

namespace seam {
namespace {

using test::BadCall;
using test::Outcome;
using test::run;
using testing::AllOf;
using testing::HasSubstr;

// Two demonstrations of one coordinate, and one of an orientation.
struct Kitchen : TempFolder {
  Kitchen() {
    Table reach{{"time", "z"}, Eigen::MatrixXd(201, 2)};
    Table wipe{{"time", "z"}, Eigen::MatrixXd(401, 2)};
    Table turn{{"time", "qx", "qy", "qz", "qw"}, Eigen::MatrixXd(201, 5)};
    for (int i = 0; i < wipe.values.rows(); ++i) {
      const double t = 0.01 * i;
      const double s = std::min(1.0, 0.5 * t);
      const double way = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
      wipe.values.row(i) << t, 0.3 + 0.1 * std::sin(2.0 * M_PI * t);
      if (i >= reach.values.rows()) continue;
      const Eigen::Vector4d q =
          orientation({way, 0.0, 0.0}, Eigen::Quaterniond::Identity()).coeffs();
      reach.values.row(i) << t, 0.4 * way;
      turn.values.row(i) << t, q.transpose();
    }
    reach.write(path("reach.csv"));
    wipe.write(path("wipe.csv"));
    turn.write(path("turn.csv"));
  }

  // A sequence of one step.
  std::string reaching(const std::string& step) const {
    return write("task.yaml",
                 "format: seam-sequence 1\n"
                 "primitives: {reach: {demonstration: reach.csv}}\n"
                 "steps: [" +
                     step + "]\n");
  }
};

TEST(LearnCommand, WritesWhatTheLibraryLearnsAndSummarisesTheFit) {
  const Kitchen kitchen;
  const Outcome outcome =
      run("learn " + kitchen.path("reach.csv") + " -o " + kitchen.path("reach.yaml"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const Demonstration demo = Demonstration::read(kitchen.path("reach.csv"));
  write_primitive(kitchen.path("expected.yaml"), learn(demo));
  EXPECT_EQ(test::read_file(kitchen.path("reach.yaml")),
            test::read_file(kitchen.path("expected.yaml")));
  const LearnReport report = assess(demo, learn(demo));
  char line[80];
  std::snprintf(line, sizeof line, "forcing term: relative RMS error %.2g, condition %.3g\n",
                report.forcing_error, report.condition);
  EXPECT_THAT(outcome.output, HasSubstr(line));
  std::snprintf(line, sizeof line, "reproduction: %.2g rad or m at most, %.2g RMS\n",
                report.error_max, report.error_rms);
  EXPECT_THAT(outcome.output, HasSubstr(line));
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("201 samples of z in 2 s\n"),
                                    HasSubstr("discrete, 10 kernels, tau 2 s\n")));
}

TEST(LearnCommand, TakesEverySetting) {
  const Kitchen kitchen;
  const Outcome outcome =
      run("learn " + kitchen.path("wipe.csv") + " --out " + kitchen.path("wipe.yaml") +
          " --kind rhythmic --period 1 --kernels 15 --width 0.9 --cutoff 20"
          " --method locally_weighted --alpha 3 --stiffness 150");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("rhythmic, 15 kernels, tau 0.159155 s, period 1 s\n"));
  LearnSettings settings;
  settings.kind = Kind::rhythmic;
  settings.period = 1.0;
  settings.kernels = 15;
  settings.width = 0.9;
  settings.method = LearnMethod::locally_weighted;
  settings.alpha = 3.0;
  settings.gains = Gains::critical(150.0);
  const Primitive expected = learn(Demonstration::read(kitchen.path("wipe.csv"), {20.0}), settings);
  write_primitive(kitchen.path("expected.yaml"), expected);
  EXPECT_EQ(test::read_file(kitchen.path("wipe.yaml")),
            test::read_file(kitchen.path("expected.yaml")));
}

TEST(LearnCommand, ChoosesTheKernelsThatReachAPrecision) {
  const Kitchen kitchen;
  const std::string files = kitchen.path("reach.csv") + " -o " + kitchen.path("reach.yaml");
  ASSERT_EQ(run("learn " + files + " --precision 2e-4").status, 0);
  const Primitive primitive = read_primitive(kitchen.path("reach.yaml"));
  const Demonstration demo = Demonstration::read(kitchen.path("reach.csv"));
  EXPECT_LE(assess(demo, primitive).error_max, 2e-4);
}

TEST(LearnCommand, TurnsAnOrientationFromTheReferenceThatItIsGiven) {
  const Kitchen kitchen;
  const std::string files = kitchen.path("turn.csv") + " -o " + kitchen.path("turn.yaml");
  const Outcome without = run("learn " + files);
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.output, HasSubstr("turn.csv: has an orientation, needs --reference QX QY QZ "
                                        "QW, the same for all primitives that are joined; its "
                                        "first sample: 0 0 0 1\n"));
  ASSERT_EQ(run("learn " + files + " --reference 0 0 0 1").status, 0);
  const Primitive primitive = read_primitive(kitchen.path("turn.yaml"));
  EXPECT_EQ(primitive.coordinates, (std::vector<std::string>{"rx", "ry", "rz"}));
  EXPECT_NEAR(primitive.goal(0), 1.0, 1e-9);
  EXPECT_EQ(primitive.reference_orientation->w(), 1.0);
}

TEST(LearnCommand, TakesRotationVectorsOfTheFileAsAboutTheReference) {
  const Kitchen kitchen;
  Table turn = Table::read(kitchen.path("turn.csv"));
  turn.columns = {"time", "rx", "ry", "rz", "z"};
  turn.write(kitchen.path("vectors.csv"));
  const std::string files = kitchen.path("vectors.csv") + " -o " + kitchen.path("turn.yaml");
  ASSERT_EQ(run("learn " + files).status, 0);
  EXPECT_FALSE(read_primitive(kitchen.path("turn.yaml")).reference_orientation);
  ASSERT_EQ(run("learn " + files + " --reference 0.6 0 0 0.8").status, 0);
  EXPECT_EQ(read_primitive(kitchen.path("turn.yaml")).reference_orientation->x(), 0.6);
}

TEST(RolloutCommand, RefusesPrimitivesAboutDifferentReferences) {
  const Kitchen kitchen;
  const std::string call = "learn " + kitchen.path("turn.csv") + " -o " + kitchen.path("");
  ASSERT_EQ(run(call + "a.yaml --reference 0 0 0 1").status, 0);
  ASSERT_EQ(run(call + "b.yaml --reference 0 0.6 0 0.8").status, 0);
  const std::string path = kitchen.write("task.yaml",
                                         "format: seam-sequence 1\n"
                                         "primitives: {a: {file: a.yaml}, b: {file: b.yaml}}\n"
                                         "steps: [{play: a}, {play: b}]\n");
  const Outcome outcome = run("rollout " + path + " --method dmp3 -o " + kitchen.path("out.csv"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output, "seam: " + path +
                                ":3: key \"play\": sequence: primitive 2: reference orientation 0 "
                                "0.6 0 0.8, must be 0 0 0 1 (x y z w), the same for all\n");
}

const char* const task = R"(format: seam-sequence 1
start_after: 0.1
primitives:
  reach: {file: reach.yaml}
  wipe: {demonstration: wipe.csv, kind: rhythmic, period: 1}
steps:
  - {play: reach, until: {before_end: 0.4}}
  - {play: wipe, enter: least_correction, until: {cycles: 1.5}}
)";

TEST(RolloutCommand, RecordsWhatTheSequencerPlays) {
  const Kitchen kitchen;
  ASSERT_EQ(run("learn " + kitchen.path("reach.csv") + " -o " + kitchen.path("reach.yaml")).status,
            0);
  const std::string path = kitchen.write("task.yaml", task);
  const std::string call = "rollout " + path + " --method dmp2a --dt 0.002 -o ";
  const Outcome outcome = run(call + kitchen.path("a.csv"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  ASSERT_EQ(run(call + kitchen.path("b.csv")).status, 0);
  EXPECT_EQ(test::read_file(kitchen.path("a.csv")), test::read_file(kitchen.path("b.csv")));

  const Table table = Table::read(kitchen.path("a.csv"));
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"time", "switch", "ref.z", "ref_vel.z", "ref_acc.z"}));
  // 0.1 s of rest, 1.6 s of reaching, 1.5 s of wiping, 1 s of settling.
  ASSERT_EQ(table.values.rows(), 2101);
  const SequenceFile file = read_sequence(path);
  Sequencer sequencer(file.sequence, Join::dmp2a, file.start_state());
  for (Eigen::Index k = 0; k < table.values.rows(); ++k) {
    const Sample& at = sequencer.sample();
    Eigen::RowVectorXd expected(5);
    expected << static_cast<double>(k) * 0.002, sequencer.running(), at.position, at.velocity,
        at.acceleration;
    ASSERT_EQ(table.values.row(k), expected) << k;
    sequencer.step(0.002);
  }
  EXPECT_EQ(table.values(0, 1), -1.0);
  EXPECT_EQ(table.values(2100, 1), 1.0);
  EXPECT_NEAR(table.values(2100, 2), 0.3, 0.01);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("    0.1000  reach "), HasSubstr("    1.7000  wipe "),
                                    HasSubstr("    3.2000  rest at the goal "),
                                    HasSubstr("a.csv: 2101 rows every 2 ms\n")));
}

TEST(RolloutCommand, NeedsADurationWhereNothingEndsTheSequence) {
  const Kitchen kitchen;
  const std::string path = kitchen.reaching("{play: reach, until: on_call}");
  const std::string call =
      "rollout " + path + " --method dmp3 --dt 0.01 -o " + kitchen.path("out.csv");
  const Outcome endless = run(call);
  EXPECT_EQ(endless.status, 2);
  EXPECT_THAT(endless.output,
              HasSubstr("task.yaml: rollout: primitive 1 has not handed over after 600 s"));
  EXPECT_FALSE(std::filesystem::exists(kitchen.path("out.csv")));
  ASSERT_EQ(run(call + " --duration 0.5").status, 0);
  EXPECT_EQ(Table::read(kitchen.path("out.csv")).values.rows(), 51);
}

TEST(RolloutCommand, RefusesMoreRowsThanMemoryHolds) {
  const Kitchen kitchen;
  const std::string path = kitchen.reaching("{play: reach}");
  const std::string call = "rollout " + path + " --method dmp3 -o " + kitchen.path("out.csv");
  for (const char* options : {" --dt 1e-6 --duration 36000", " --dt 1e-5 --settle 3600"}) {
    const Outcome outcome = run(call + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_THAT(outcome.output,
                AllOf(HasSubstr("task.yaml: rollout: dt 1e-0"),
                      HasSubstr(" s gives more than 2e+06 rows, must be larger\n")));
  }
  EXPECT_FALSE(std::filesystem::exists(kitchen.path("out.csv")));
}

TEST(FilesProgram, Helps) {
  for (const char* arguments : {"learn --help", "rollout --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_THAT(outcome.output, HasSubstr("[s]")) << arguments;
  }
}

class FilesProgramRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(FilesProgramRefuses, WithOneLineAndExitCodeTwoAndNoFile) {
  const Kitchen kitchen;
  test::expect_refused(GetParam(), kitchen);
  const auto files = std::filesystem::directory_iterator(kitchen.path(""));
  EXPECT_EQ(std::distance(begin(files), end(files)), 3) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(
    , FilesProgramRefuses,
    testing::Values(
        BadCall{"NoDemonstration", "learn -o @out.yaml", "demonstration is required"},
        BadCall{"NoOutput", "learn @reach.csv", "--out is required"},
        BadCall{"NoSuchDemonstration", "learn @rich.csv -o @out.yaml", "rich.csv: cannot be read"},
        BadCall{"UnknownKind", "learn @reach.csv -o @out.yaml --kind dance", "--kind"},
        BadCall{"UnknownFit", "learn @reach.csv -o @out.yaml --method magic", "--method"},
        BadCall{"NegativePeriod", "learn @wipe.csv -o @out.yaml --period -1", "--period"},
        BadCall{"OneKernel", "learn @reach.csv -o @out.yaml --kernels 1", "--kernels"},
        BadCall{"ManyKernels", "learn @reach.csv -o @out.yaml --kernels 150", "reach.csv"},
        BadCall{"ZeroCutoff", "learn @reach.csv -o @out.yaml --cutoff 0", "--cutoff"},
        BadCall{"ShortReference", "learn @turn.csv -o @out.yaml --reference 0 0 1", "--reference"},
        BadCall{"ReferenceNotUnit", "learn @turn.csv -o @out.yaml --reference 0 0 1 1",
                "--reference: quaternion of norm 1.41421, must be 1 within 0.001"},
        BadCall{"ReferenceOfNothing", "learn @reach.csv -o @out.yaml --reference 0 0 0 1",
                "reference orientation 0 0 0 1, must have the coordinates rx, ry and rz"},
        BadCall{"UnwritableFile", "learn @reach.csv -o @none/out.yaml",
                "none/out.yaml: cannot be written"},
        BadCall{"NoMethod", "rollout @task.yaml -o @out.csv", "--method is required"},
        BadCall{"UnknownMethod", "rollout @task.yaml -o @out.csv --method dmp9",
                "must be one of dmp2, dmp2a, dmp3"},
        BadCall{"NoSequence", "rollout @task.yaml -o @out.csv --method dmp3",
                "task.yaml: cannot be read"},
        BadCall{"NotASequence", "rollout @reach.csv -o @out.csv --method dmp3", "reach.csv:1: "},
        BadCall{"ZeroStep", "rollout @task.yaml -o @out.csv --method dmp3 --dt 0", "--dt"},
        BadCall{"StepIsNoNumber", "rollout @task.yaml -o @out.csv --method dmp3 --dt nan",
                "--dt: nan, must be a finite number"},
        BadCall{"EndlessDuration", "rollout @task.yaml -o @out.csv --method dmp3 --duration 1e300",
                "--duration: Value 1e300 not in range"}),
    test::by_name);

}  // namespace
}  // namespace seam
