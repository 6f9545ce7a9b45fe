#include <cfloat>
#include <cstring>

#include <gmock/gmock.h>

#include "tests/refusals.hpp"
#include <seam/orientation.hpp>
#include <seam/primitive_file.hpp>
#include <seam/sequence_file.hpp>
#include <seam/sequencer.hpp>

namespace seam {
namespace {

using test::BadFile;
using test::replaced;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr unsigned seed = 51;

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_bits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_bits(const std::optional<Eigen::Quaterniond>& a,
               const std::optional<Eigen::Quaterniond>& b) {
  return a.has_value() == b.has_value() && (!a || same_bits(a->coeffs(), b->coeffs()));
}

bool same_bits(const Gains& a, const Gains& b) {
  return same_bits(a.K, b.K) && same_bits(a.D, b.D) && same_bits(a.H, b.H);
}

bool same_bits(const Primitive& a, const Primitive& b) {
  return a.kind == b.kind && a.coordinates == b.coordinates && same_bits(a.gains, b.gains) &&
         same_bits(a.alpha, b.alpha) && same_bits(a.kernels.centers, b.kernels.centers) &&
         same_bits(a.kernels.widths, b.kernels.widths) && same_bits(a.weights, b.weights) &&
         same_bits(a.goal, b.goal) && same_bits(a.tau, b.tau) &&
         same_bits(a.start_position, b.start_position) &&
         same_bits(a.start_velocity, b.start_velocity) &&
         same_bits(a.start_acceleration, b.start_acceleration) &&
         same_bits(a.reference_orientation, b.reference_orientation);
}

bool same_bits(const Sample& a, const Sample& b) {
  return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.acceleration, b.acceleration) && same_bits(a.jerk, b.jerk);
}

// Any double that a primitive may hold: every exponent alike, denormals, both zeros and the ends among them.
double any_number(std::mt19937_64& random, const Bounds& bounds = value_bounds) {
  const double special[] = {0.0,      -0.0, bounds.least, bounds.largest, DBL_MIN, 5e-324,
                            2.2e-310, 1e22, 0.1};
  for (;;) {
    const double chosen = special[random() % std::size(special)];
    if (random() % 4 == 0 && bounds.hold(chosen)) return chosen;
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (bounds.hold(value)) return value;
  }
}

// A unit quaternion of any sign, also where rounding has left its norm beside 1.
Eigen::Quaterniond any_orientation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d xyzw(normal(random), normal(random), normal(random), normal(random));
  return Eigen::Quaterniond(xyzw.normalized() * (random() % 2 ? 1.0 : 1.0 + 0.9 * unit_tolerance));
}

Primitive any_primitive(std::mt19937_64& random) {
  const bool turns = random() % 2;
  const auto D = static_cast<Eigen::Index>(turns ? 4 : 1 + random() % 7);
  const auto M = static_cast<Eigen::Index>(2 + random() % 20);
  const auto any = [&](Eigen::Index rows, Eigen::Index cols, const Bounds& bounds = value_bounds) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return any_number(random, bounds); }));
  };
  Primitive primitive;
  primitive.kind = random() % 2 ? Kind::rhythmic : Kind::discrete;
  const char* const odd[] = {"y",        "no", "12",  "left arm", "a: \"b\" # c\\",
                             "\xCF\x86", "-",  "\t\n"};
  for (Eigen::Index d = 0; d < D; ++d)
    primitive.coordinates.push_back(odd[random() % std::size(odd)] + std::to_string(d));
  if (turns) {
    primitive.coordinates = {"ry", "a", "rx", "rz"};
    primitive.reference_orientation = any_orientation(random);
  }
  const auto gain = [&] { return any_number(random, gain_bounds); };
  primitive.gains = {gain(), gain(), gain()};
  primitive.alpha = any_number(random, alpha_bounds);
  primitive.tau = any_number(random, tau_bounds);
  primitive.kernels.centers = any(M, 1, center_bounds);
  primitive.kernels.widths = any(M, 1, width_bounds);
  primitive.weights = any(M, D);
  for (Eigen::VectorXd* vector : {&primitive.goal, &primitive.start_position,
                                  &primitive.start_velocity, &primitive.start_acceleration})
    *vector = any(D, 1);
  return primitive;
}

TEST(PrimitiveFile, ComesBackBitForBit) {
  const TempFolder folder;
  const std::string path = folder.path("any.yaml");
  std::mt19937_64 random(seed);
  for (int i = 0; i < 300; ++i) {
    const Primitive primitive = any_primitive(random);
    write_primitive(path, primitive);
    EXPECT_TRUE(same_bits(read_primitive(path), primitive)) << "seed " << seed << ", case " << i;
  }
}

TEST(PrimitiveFile, IsTheSameTextWhenWrittenAgain) {
  const TempFolder folder;
  std::mt19937_64 random(seed + 1);
  write_primitive(folder.path("a.yaml"), test::random_primitive(random, 7));
  write_primitive(folder.path("b.yaml"), read_primitive(folder.path("a.yaml")));
  EXPECT_EQ(test::read_file(folder.path("a.yaml")), test::read_file(folder.path("b.yaml")));
  EXPECT_THAT(test::read_file(folder.path("a.yaml")), StartsWith("format: seam-primitive 1\n"));
}

TEST(PrimitiveFile, AppearsWholeOrNotAtAll) {
  const TempFolder folder;
  std::mt19937_64 random(seed + 2);
  Primitive primitive = test::random_primitive(random, 2);
  write_primitive(folder.path("kept.yaml"), primitive);
  const std::string kept = test::read_file(folder.path("kept.yaml"));
  primitive.weights(0, 0) = NAN;
  EXPECT_THAT(test::refusal([&] { write_primitive(folder.path("kept.yaml"), primitive); }),
              HasSubstr("weights: an entry is nan, must be in -1e+30 to 1e+30"));
  EXPECT_EQ(test::read_file(folder.path("kept.yaml")), kept);
  EXPECT_THAT(
      test::refusal([&] { write_primitive("/proc/none.yaml", test::random_primitive(random, 2)); }),
      StartsWith("/proc/none.yaml: cannot be written"));
  primitive = test::random_primitive(random, 1);
  primitive.coordinates[0].clear();
  EXPECT_EQ(test::refusal([&] { write_primitive(folder.path("new.yaml"), primitive); }),
            "primitive: a coordinate has no name");
  EXPECT_FALSE(std::filesystem::exists(folder.path("new.yaml")));
}

const std::string good_primitive = R"(format: seam-primitive 1
kind: discrete
coordinates: ["x", "y"]
tau: 1.2
alpha: 2
gains: {K: 200, D: 28, H: 14}
goal: [0.3, +1e-1]
start:
  position: [0, 0]
  velocity: [0, 0]
  acceleration: [0, 0]
kernels:
  centers: [1, 0.5, 0.1]
  widths: [0.4, 0.3, 0.3]
weights:
  - [1.5, 20]
  - [-30, 4]
  - [7, -1]
)";

TEST(PrimitiveFile, IsReadAsItIsDocumented) {
  const TempFolder folder;
  const Primitive primitive = read_primitive(folder.write("good.yaml", good_primitive));
  EXPECT_EQ(primitive.kind, Kind::discrete);
  EXPECT_EQ(primitive.coordinates, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(primitive.tau, 1.2);
  EXPECT_EQ(primitive.gains.H, 14.0);
  EXPECT_EQ(primitive.goal(1), 0.1);
  EXPECT_EQ(primitive.kernels.centers(2), 0.1);
  EXPECT_EQ(primitive.kernels.widths(0), 0.4);
  EXPECT_EQ(primitive.weights(1, 0), -30.0);
}

class PrimitiveFileRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(PrimitiveFileRefuses, WithFileLineAndKey) {
  test::expect_refused(GetParam(), good_primitive, TempFolder(),
                       [](const std::string& path) { read_primitive(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , PrimitiveFileRefuses,
    testing::Values(
        BadFile{"NewerFormat", "primitive 1", "primitive 3",
                ":1: key \"format\": \"seam-primitive 3\", must be seam-primitive 1 to 2 (a newer "
                "seam has written this file)"},
        BadFile{"NewerFormatBeforeItsNewKeys", "1\nkind", "10\ncolour: blue\nkind",
                ":1: key \"format\": \"seam-primitive 10\""},
        BadFile{"OtherFormat", "seam-primitive 1", "seam-scene 1",
                ":1: key \"format\": \"seam-scene 1\", must be seam-primitive 1"},
        BadFile{"FormatWithTail", "primitive 1", "primitive 1b",
                ":1: key \"format\": \"seam-primitive 1b\", must be seam-primitive 1"},
        BadFile{"FormatZero", "primitive 1", "primitive 0", ":1: key \"format\": "},
        BadFile{"NoFormat", "format: seam-primitive 1\n", "", ":1: needs the key \"format\""},
        BadFile{"FormatAList", "seam-primitive 1", "[1]", ":1: key \"format\": must be a text"},
        BadFile{"NoKind", "kind: discrete\n", "", ":1: needs the key \"kind\""},
        BadFile{"UnknownKind", "discrete", "dance",
                ":2: key \"kind\": \"dance\", must be one of discrete, rhythmic"},
        BadFile{"NoCoordinates", "[\"x\", \"y\"]", "[]",
                ":3: key \"coordinates\": must be a list with at least one entry"},
        BadFile{"OneCoordinate", "[\"x\", \"y\"]", "[x]",
                ":7: key \"goal\": 2 numbers, must be 1 (one per coordinate)"},
        BadFile{"RepeatedCoordinate", "\"y\"]", "\"x\"]", ":1: primitive: coordinate names repeat"},
        BadFile{"NamelessCoordinate", "\"y\"]", "\"\"]", ":3: key \"coordinates\": must be a text"},
        BadFile{"NoTau", "tau: 1.2\n", "", ":1: needs the key \"tau\""},
        BadFile{"EmptyTau", "tau: 1.2", "tau:", ":4: key \"tau\": must be a finite number"},
        BadFile{"NegativeTau", "1.2", "-1.2", ":4: key \"tau\": -1.2, must be > 0"},
        BadFile{"InfiniteTau", "1.2", ".inf", ":4: key \"tau\": \".inf\", must be a finite number"},
        BadFile{"HugeTau", "1.2", "1e999", ":4: key \"tau\": \"1e999\", must be a finite number"},
        BadFile{"TauWithUnit", "1.2", "1.2 s", ":4: key \"tau\": \"1.2 s\", must be a finite"},
        BadFile{"TwiceTau", "alpha: 2", "tau: 2", ":5: key \"tau\": appears twice"},
        BadFile{"ZeroAlpha", "alpha: 2", "alpha: 0", ":5: key \"alpha\": 0, must be > 0"},
        BadFile{"NoH", ", H: 14", "", ":6: key \"gains\": needs the key \"H\""},
        BadFile{"UnknownGain", ", H: 14", ", H: 14, P: 1",
                ":6: key \"P\": not known here, must be one of K, D, H"},
        BadFile{"NegativeK", "K: 200", "K: -200", ":6: key \"K\": -200, must be > 0"},
        BadFile{"GoalNotFinite", "0.3, +1e-1", "nan, 0.1",
                ":7: key \"goal\": \"nan\", must be a finite number"},
        BadFile{"LongGoal", "0.3, +1e-1", "0.3, 0.1, 0",
                ":7: key \"goal\": 3 numbers, must be 2 (one per coordinate)"},
        BadFile{"GoalNotAList", "[0.3, +1e-1]", "0.3", ":7: key \"goal\": must be a list"},
        BadFile{"NoStart", "start:\n", "stop:\n", ":8: key \"stop\": not known here"},
        BadFile{"NoVelocity", "  velocity: [0, 0]\n", "", ":8: key \"start\": needs the key"},
        BadFile{"StartWithJerk", "  acceleration: [0, 0]", "  acceleration: [0, 0]\n  jerk: [0, 0]",
                ":12: key \"jerk\": not known here"},
        BadFile{"ShortVelocity", "velocity: [0, 0]", "velocity: [0]",
                ":10: key \"velocity\": 1 numbers, must be 2"},
        BadFile{"ShortWidths", "[0.4, 0.3, 0.3]", "[0.4, 0.3]",
                ":14: key \"widths\": 2 numbers, must be 3 (one per kernel)"},
        BadFile{"ZeroWidth", "[0.4,", "[0,",
                ":1: primitive: widths: an entry is 0, must be in 1e-09 to 1e+09"},
        BadFile{"TinyWidth", "[0.4,", "[1e-160,",
                ":1: primitive: widths: an entry is 1e-160, must"},
        BadFile{"FarCenter", "[1, 0.5,", "[1e200, 0.5,",
                ":1: primitive: centers: an entry is 1e+200, must be in -1e+06 to 1e+06"},
        BadFile{"HugeK", "K: 200", "K: 1e300",
                ":1: primitive: K 1e+300, must be in 1e-06 to 1e+06"},
        BadFile{"TinyAlpha", "alpha: 2", "alpha: 1e-300",
                ":1: primitive: alpha 1e-300, must be in 1e-06 to 20"},
        BadFile{"DenormalTau", "tau: 1.2", "tau: 1e-320", ":1: primitive: tau 9.99989e-321, must"},
        BadFile{"ShortTau", "tau: 1.2", "tau: 1e-300",
                ":1: primitive: tau 1e-300, must be in 1e-06 to 1e+09"},
        BadFile{"HugeWeight", "[7, -1]", "[7, -1e31]",
                ":1: primitive: weights: an entry is -1e+31, must be in -1e+30 to 1e+30"},
        BadFile{"ReferenceWithoutItsCoordinates", "kind: ", "reference: [0, 0, 0, 1]\nkind: ",
                ":2: key \"reference\": primitive: reference orientation 0 0 0 1, must have the "
                "coordinates rx, ry and rz"},
        BadFile{"ReferenceNotUnit", "kind: ", "reference: [0, 0, 1, 1]\nkind: ",
                ":2: key \"reference\": quaternion of norm 1.414214, must be 1 within 0.001"},
        BadFile{"ReferenceNotFinite", "kind: ", "reference: [0, .nan, 0, 1]\nkind: ",
                ":2: key \"reference\": \".nan\", must be a finite number"},
        BadFile{"ShortReference", "kind: ", "reference: [0, 0, 1]\nkind: ",
                ":2: key \"reference\": 3 numbers, must be 4 (one per part x y z w)"},
        BadFile{"MissingRow", "  - [7, -1]\n", "",
                ":15: key \"weights\": 2 rows, must be 3 (one per kernel)"},
        BadFile{"ShortRow", "[-30, 4]", "[-30]",
                ":17: key \"weights\": 1 numbers, must be 2 (one per coordinate)"},
        BadFile{"WeightNotFinite", "[7, -1]", "[7, -inf]",
                ":18: key \"weights\": \"-inf\", must be a finite number"},
        BadFile{"WeightAText", "[7, -1]", "[7, heavy]",
                ":18: key \"weights\": \"heavy\", must be a finite number"},
        BadFile{"WeightAList", "[7, -1]", "[7, [1]]",
                ":18: key \"weights\": must be a finite number"},
        BadFile{"ExtraKey", "weights:", "colour: blue\nweights:",
                ":15: key \"colour\": not known here, must be one of format, reference"},
        BadFile{"CutOff", "  - [7, -1]", "  - [7, -1", ":"},
        BadFile{"SecondDocument", "- [7, -1]\n", "- [7, -1]\n---\nformat: more\n",
                ":19: not part of the document, which ends before this"},
        BadFile{"KeyOfTwoLines", "alpha: 2", "\"al\\npha\": 2",
                ":5: key \"al pha\": not known here"},
        BadFile{"StrayBracket", "[7, -1]\n", "[7, -1]]\n", ":"},
        BadFile{"StrayBrackets", "format: ", ",", ":1: "},
        BadFile{"StrayBraceBeforeMore", "H: 14}", "H: 14}}", ":6: "}),
    test::by_name);

TEST(PrimitiveFile, RefusesWhatIsNotAFile) {
  const TempFolder folder;
  EXPECT_EQ(test::refusal([&] { read_primitive(folder.path("none.yaml")); }),
            folder.path("none.yaml") + ": cannot be read: No such file or directory");
  EXPECT_THAT(test::refusal([&] { read_primitive(folder.path("")); }), HasSubstr("is a folder"));
  EXPECT_THAT(test::refusal([&] { read_primitive(folder.write("empty.yaml", "")); }),
              HasSubstr("must be a map"));
  EXPECT_THAT(test::refusal([&] { read_primitive(folder.write("list.yaml", "[1, 2]")); }),
              HasSubstr("list.yaml:1: must be a map"));
}

// What a killed writer would leave is refused wherever it was cut.
TEST(PrimitiveFile, RefusesEveryBeginningOfAFile) {
  const TempFolder folder;
  for (std::size_t size = 0; size + 3 < good_primitive.size(); ++size)
    EXPECT_THAT(test::refusal([&] {
                  read_primitive(folder.write("cut.yaml", good_primitive.substr(0, size)));
                }),
                HasSubstr("cut.yaml"))
        << size;
}

// Every kind of switch and entry, a primitive played twice, a start that moves.
SequenceFile all_sorts(std::mt19937_64& random) {
  const auto number = [&] { return std::uniform_real_distribution<double>(0.1, 0.4)(random); };
  Primitive reach = test::random_primitive(random, 3, 8);
  Primitive wipe = test::random_primitive(random, 3, 12, Kind::rhythmic);
  if (random() % 2) reach.reference_orientation = any_orientation(random);
  wipe.reference_orientation = reach.reference_orientation;
  if (reach.reference_orientation) reach.coordinates = wipe.coordinates = {"rz", "ry", "rx"};
  SequenceFile file;
  file.sequence.then(reach).until(before_end(number()));
  file.sequence.then(wipe).enter(least_correction()).until(after_cycles(10.0 * number()));
  file.sequence.then(reach).until(after(number()));
  file.sequence.then(reach).until(at_phase(number()));
  file.sequence.then(wipe).enter(from_phase(number() - 7.0)).until(on_call());
  file.sequence.then(reach).until(near_goal(number() * 1e-3));
  file.sequence.then(reach).until(before_end(-number()));
  file.sequence.then(wipe);
  file.primitives = {"reach", "wipe", "reach", "reach", "wipe", "reach", "reach", "wipe"};
  file.start = Sample(3);
  for (Eigen::VectorXd* part :
       {&file.start->position, &file.start->velocity, &file.start->acceleration, &file.start->jerk})
    *part = Eigen::VectorXd::NullaryExpr(3, [&] { return any_number(random); });
  return file;
}

void expect_same_bits(const SequenceFile& a, const SequenceFile& b) {
  EXPECT_EQ(a.primitives, b.primitives);
  EXPECT_TRUE(same_bits(a.sequence.start_delay(), b.sequence.start_delay()));
  EXPECT_TRUE(same_bits(a.start_state(), b.start_state()));
  EXPECT_EQ(a.start.has_value(), b.start.has_value());
  ASSERT_EQ(a.sequence.steps().size(), b.sequence.steps().size());
  for (std::size_t i = 0; i < a.sequence.steps().size(); ++i) {
    const Sequence::Step& one = a.sequence.steps()[i];
    const Sequence::Step& two = b.sequence.steps()[i];
    EXPECT_TRUE(same_bits(one.primitive, two.primitive)) << i;
    EXPECT_EQ(one.until.when, two.until.when) << i;
    EXPECT_TRUE(same_bits(one.until.value, two.until.value)) << i;
    EXPECT_EQ(one.entry.where, two.entry.where) << i;
    EXPECT_TRUE(same_bits(one.entry.phase, two.entry.phase)) << i;
  }
}

TEST(SequenceFile, ComesBackBitForBit) {
  const TempFolder folder;
  std::mt19937_64 random(seed + 3);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed + 3) + ", case " + std::to_string(i));
    const SequenceFile file = all_sorts(random);
    write_sequence(folder.path("all.yaml"), file);
    expect_same_bits(read_sequence(folder.path("all.yaml")), file);
  }
  SequenceFile bare;
  bare.sequence.start_after(0.1 + 0.2).then(test::random_primitive(random, 1));
  bare.primitives = {"only"};
  write_sequence(folder.path("bare.yaml"), bare);
  expect_same_bits(read_sequence(folder.path("bare.yaml")), bare);
}

TEST(SequenceFile, RefusesToWriteWhatWouldNotComeBack) {
  const TempFolder folder;
  std::mt19937_64 random(seed + 4);
  const SequenceFile good = all_sorts(random);
  const auto refusal = [&](const std::function<void(SequenceFile&)>& spoil) {
    SequenceFile file = good;
    spoil(file);
    return test::refusal([&] { write_sequence(folder.path("bad.yaml"), file); });
  };
  EXPECT_EQ(refusal([](SequenceFile& file) { file.primitives[3] = "wipe"; }),
            "sequence: \"wipe\" is the name of two different primitives");
  EXPECT_EQ(refusal([](SequenceFile& file) { file.primitives.pop_back(); }),
            "sequence: 7 names for 8 primitives");
  EXPECT_EQ(refusal([](SequenceFile& file) { file.primitives[0].clear(); }),
            "sequence: a primitive has no name");
  EXPECT_EQ(refusal([](SequenceFile& file) { file.start->velocity(1) = NAN; }),
            "sequence: the start's velocity must be 3 finite numbers");
  EXPECT_EQ(refusal([](SequenceFile& file) { file.start = Sample(2); }),
            "sequence: the start's position must be 3 finite numbers");
  EXPECT_EQ(refusal([](SequenceFile& file) { file = {}; }),
            "sequence: empty, must have at least one primitive");
  EXPECT_FALSE(std::filesystem::exists(folder.path("bad.yaml")));
}

const std::string good_sequence = R"(format: seam-sequence 1
start:
  position: {x: 0.5}
  velocity: {y: -1}
start_after: 0
primitives:
  reach: {file: parts/reach.yaml}
  ramp: {demonstration: ramp.csv, kernels: 12, width: 0.7, alpha: 2, gains: {K: 150}, cutoff: 5}
  wipe: {file: parts/wipe.yaml}
steps:
  - {play: reach, until: {before_end: 0.4}}
  - {play: wipe, enter: {phase: 1.5}, until: {cycles: 2}}
  - {play: ramp, until: {at_phase: 0.2}}
  - {play: reach}
)";

void write_parts(const TempFolder& folder) {
  folder.write("parts/reach.yaml", good_primitive);
  folder.write("parts/wipe.yaml", replaced(good_primitive, "discrete", "rhythmic"));
  std::string ramp = "time,x,y\n";
  for (int i = 0; i <= 100; ++i) {
    const std::string t = std::to_string(0.01 * i);
    ramp.append(t).append(",").append(t).append(",0\n");
  }
  folder.write("ramp.csv", ramp);
}

TEST(SequenceFile, IsReadAsItIsDocumented) {
  const TempFolder folder;
  write_parts(folder);
  const SequenceFile file = read_sequence(folder.write("good.yaml", good_sequence));
  const auto& steps = file.sequence.steps();
  EXPECT_EQ(file.primitives, (std::vector<std::string>{"reach", "wipe", "ramp", "reach"}));
  EXPECT_EQ(file.start_state().position, Eigen::Vector2d(0.5, 0.0));
  EXPECT_EQ(file.start_state().velocity, Eigen::Vector2d(0.0, -1.0));
  EXPECT_EQ(steps[0].until.value, 0.4);
  EXPECT_EQ(steps[1].entry.where, Entry::Where::phase);
  EXPECT_EQ(steps[1].entry.phase, 1.5);
  EXPECT_EQ(steps[1].until.when, Switch::When::cycles);
  EXPECT_EQ(steps[2].primitive.kernels.count(), 12);
  EXPECT_EQ(steps[2].primitive.gains.K, 150.0);
  EXPECT_EQ(steps[2].primitive.gains.D, 2.0 * std::sqrt(150.0));
  EXPECT_NEAR(steps[2].primitive.goal(0), 1.0, 1e-12);
  EXPECT_EQ(steps[3].until.when, Switch::When::before_end);
  EXPECT_EQ(steps[3].until.value, 0.0);
}

// The same with wishes: the demonstration is learned with 12 kernels.
const std::string wishing =
    replaced(good_sequence, "{play: ramp, until: {at_phase: 0.2}}", R"({play: ramp, leave: {x: 2},
     pass: [{position: {x: 0.3}, at: 0.4}, {velocity: {y: 0.1}, acceleration: {x: 0}, at_phase: 0.3}],
     hit: {position: {x: 0.9, y: 0.2}, velocity: {x: 1}, at: 0.8}}
  - {play: ramp, arrive: {before_end: 0.1, smooth: no}}
  - {play: ramp, arrive: yes})");

TEST(SequenceFile, ReadsWishesAsTheyAreDocumentedAndWritesThemBack) {
  const TempFolder folder;
  write_parts(folder);
  const std::string text = replaced(wishing, "seam-sequence 1", "seam-sequence 2");
  const SequenceFile read = read_sequence(folder.write("good.yaml", text));
  const std::string again = folder.path("again.yaml");
  write_sequence(again, read);
  EXPECT_THAT(test::read_file(again), StartsWith("format: seam-sequence 2\n"));
  for (const SequenceFile& file : {read, read_sequence(again)}) {
    const auto& steps = file.sequence.steps();
    const auto& wishes = steps[2].wishes;
    ASSERT_EQ(wishes.size(), 3u);
    EXPECT_EQ(steps[2].leave(0), 2.0);
    EXPECT_TRUE(std::isnan(steps[2].leave(1)));
    EXPECT_EQ(wishes[0].position(0), 0.3);
    EXPECT_TRUE(std::isnan(wishes[0].position(1)));
    EXPECT_EQ(wishes[0].when.when, Switch::When::after);
    EXPECT_EQ(wishes[0].when.value, 0.4);
    EXPECT_EQ(wishes[1].velocity(1), 0.1);
    EXPECT_EQ(wishes[1].acceleration(0), 0.0);
    EXPECT_EQ(wishes[1].when.when, Switch::When::at_phase);
    EXPECT_EQ(wishes[2].then, Wish::Then::hand_over);
    EXPECT_EQ(wishes[2].position(1), 0.2);
    EXPECT_EQ(steps[2].until.when, Switch::When::after);
    EXPECT_EQ(steps[2].until.value, 0.8);
    EXPECT_EQ(steps[3].wishes[0].then, Wish::Then::stay);
    EXPECT_EQ(steps[3].wishes[0].when.value, 0.1);
    EXPECT_FALSE(steps[3].wishes[0].smooth);
    EXPECT_TRUE(steps[4].wishes[0].smooth);
    EXPECT_TRUE(steps[5].wishes.empty());
  }
  write_sequence(again, read_sequence(folder.write("plain.yaml", good_sequence)));
  EXPECT_THAT(test::read_file(again), StartsWith("format: seam-sequence 1\n"));
}

TEST(SequenceFile, RefusesWishesThatCannotBe) {
  const TempFolder folder;
  write_parts(folder);
  const auto refused = [&](const std::string& from, const std::string& to) {
    return test::refusal(
        [&] { read_sequence(folder.write("bad.yaml", replaced(wishing, from, to))); });
  };
  EXPECT_THAT(refused("position: {x: 0.3}", "position: {z: 0.3}"),
              HasSubstr("key \"z\": is not among the primitives' coordinates"));
  EXPECT_THAT(refused("position: {x: 0.3}", "position: {x: .nan}"), HasSubstr("key \"x\": "));
  EXPECT_THAT(refused("{x: 0.3}, at: 0.4", "{x: 0.3}"), HasSubstr("needs its moment"));
  EXPECT_THAT(refused("at: 0.4", "at: 0.4, cycles: 2"), HasSubstr("not several"));
  EXPECT_THAT(refused("at: 0.4", "at: 0.0001"), HasSubstr("asks too much"));
  EXPECT_THAT(refused("at: 0.4", "at: -1"), HasSubstr("must be > 0"));
  EXPECT_THAT(refused("at: 0.4", "at: 0.9"), HasSubstr("must be before its switch"));
  EXPECT_THAT(refused("position: {x: 0.3}, at", "orientation: [0, 0, 0, 1], at"),
              HasSubstr("key \"orientation\": "));
  EXPECT_THAT(refused("leave: {x: 2}", "leave: {q: 2}"), HasSubstr("key \"q\""));
  EXPECT_THAT(refused("smooth: no", "smooth: perhaps"), HasSubstr("smooth"));
  EXPECT_THAT(refused("arrive: yes", "arrive: soon"), HasSubstr("arrive"));
  EXPECT_THAT(refused("enter: {phase: 1.5}", "arrive: yes, enter: {phase: 1.5}"),
              HasSubstr("rhythmic"));
}

// The primitive as it was written before there were reference orientations, of an orientation.
const std::string old_turn = replaced(
    replaced(replaced(replaced(good_primitive, "\"x\", \"y\"", "rx, ry, rz"), "0.3, +1e-1",
                      "0.3, 0.1, 0"),
             "start:\n  position: [0, 0]\n  velocity: [0, 0]\n  acceleration: [0, 0]",
             "start:\n  position: [0, 0, 0]\n  velocity: [0, 0, 0]\n  acceleration: [0, 0, 0]"),
    "  - [1.5, 20]\n  - [-30, 4]\n  - [7, -1]",
    "  - [1.5, 20, 0]\n  - [-30, 4, 0]\n  - [7, -1, 0]");

std::string turn_about(const std::string& reference) {
  return replaced(old_turn, "primitive 1\n", "primitive 2\nreference: [" + reference + "]\n");
}

TEST(PrimitiveFile, CarriesItsReferenceOrientation) {
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    return read_primitive(folder.write("turn.yaml", text)).reference_orientation;
  };
  EXPECT_FALSE(read(old_turn));
  EXPECT_EQ(read(turn_about("0.6, 0, 0, -0.8"))->coeffs(), Eigen::Vector4d(0.6, 0.0, 0.0, -0.8));
  EXPECT_NEAR(read(turn_about("0.6001, 0, 0, 0.8"))->norm(), 1.0, 1e-15);
  const std::string path = folder.path("turn.yaml");
  write_primitive(path, read_primitive(path));
  EXPECT_THAT(test::read_file(path), StartsWith("format: seam-primitive 2\nreference: ["));
}

// A sequence of what is there, and the reference orientations of its steps.
class ReferenceOfASequence : public testing::Test {
 protected:
  ReferenceOfASequence() {
    std::string csv = "time,qx,qy,qz,qw\n";
    for (int i = 0; i <= 100; ++i) {
      const double half = 0.5 * (0.2 + 0.01 * i);
      csv += std::to_string(0.01 * i) + ",0,0," + std::to_string(std::sin(half)) + "," +
             std::to_string(std::cos(half)) + "\n";
    }
    folder_.write("shown.csv", csv);
    folder_.write("old.yaml", old_turn);
    folder_.write("half.yaml", turn_about("0, 0, 0.6, 0.8"));
    folder_.write("half_minus.yaml", turn_about("0, 0, -0.6, -0.8"));
    folder_.write("none.yaml", turn_about("0, 0, 0, 1"));
  }

  std::string write(const std::vector<std::string>& played, const std::string& reference = "") {
    std::string text =
        "format: seam-sequence 1\nprimitives:\n  shown: {demonstration: shown.csv}\n";
    for (const char* name : {"old", "half", "half_minus", "none"})
      if (std::count(played.begin(), played.end(), name))
        text += "  " + std::string(name) + ": {file: " + name + ".yaml}\n";
    text += "steps:\n";
    for (const std::string& name : played) text += "  - {play: " + name + "}\n";
    return folder_.write("task.yaml", text + reference);
  }

  SequenceFile read(const std::vector<std::string>& played, const std::string& reference = "") {
    return read_sequence(write(played, reference));
  }

  std::string refused(const std::vector<std::string>& played, const std::string& reference = "") {
    return test::refusal([&] { read(played, reference); });
  }

  static const Primitive& step(const SequenceFile& file, std::size_t i) {
    return file.sequence.steps()[i].primitive;
  }

  TempFolder folder_;
};

TEST_F(ReferenceOfASequence, IsTheFirstSampleOfADemonstrationWhereNothingElseIsSaid) {
  const SequenceFile file = read({"shown"});
  EXPECT_EQ(file.sequence.coordinates(), (std::vector<std::string>{"rx", "ry", "rz"}));
  EXPECT_NEAR(step(file, 0).reference_orientation->z(), std::sin(0.1), 1e-5);
  EXPECT_NEAR(step(file, 0).goal(2), 1.0, 1e-5);
}

TEST_F(ReferenceOfASequence, IsWhatItSays) {
  const SequenceFile file = read({"shown", "old"}, "reference: [0, 0, 0, 1]\n");
  EXPECT_NEAR(step(file, 0).goal(2), 1.2, 1e-5);
  EXPECT_EQ(step(file, 1).reference_orientation->w(), 1.0);
  EXPECT_THAT(refused({"half"}, "reference: [0, 0, 0, 1]\n"),
              HasSubstr("task.yaml:4: key \"half\": primitive: reference orientation 0 0 0.6 0.8, "
                        "must be 0 0 0 1 (x y z w), the same for all"));
}

TEST_F(ReferenceOfASequence, IsThatOfItsPrimitiveFilesBeforeAnyDemonstration) {
  const SequenceFile file = read({"shown", "half"});
  EXPECT_EQ(step(file, 0).reference_orientation->z(), 0.6);
  EXPECT_NEAR(step(file, 0).goal(2), 1.2 - 2.0 * std::asin(0.6), 1e-5);
}

TEST_F(ReferenceOfASequence, IsOneForAllThatIsJoined) {
  EXPECT_EQ(step(read({"half", "half_minus"}), 1).reference_orientation->z(), 0.6);
  EXPECT_FALSE(step(read({"old", "old"}), 1).reference_orientation);
  EXPECT_THAT(refused({"half", "none"}),
              HasSubstr("task.yaml:8: key \"play\": sequence: primitive 2: reference orientation "
                        "0 0 0 1, must be 0 0 0.6 0.8 (x y z w), the same for all"));
  EXPECT_THAT(refused({"half", "old"}),
              HasSubstr("reference orientation unknown, must be 0 0 0.6"));
  EXPECT_THAT(refused({"old", "half"}), HasSubstr("0 0 0.6 0.8, must be unknown"));
}

TEST_F(ReferenceOfASequence, ComesBackOnce) {
  const SequenceFile file = read({"shown", "half"});
  write_sequence(folder_.path("again.yaml"), file);
  expect_same_bits(read_sequence(folder_.path("again.yaml")), file);
  const std::string text = test::read_file(folder_.path("again.yaml"));
  EXPECT_EQ(text.find("reference: "), text.rfind("reference: "));
}

// One of each shape, with and without changes, at any numbers.
std::vector<ObstacleSettings> any_couplings(std::mt19937_64& random) {
  const auto number = [&] { return std::uniform_real_distribution<double>(0.1, 0.4)(random); };
  const auto point = [&] { return Eigen::Vector3d(number(), -number(), number()); };
  std::vector<ObstacleSettings> all(4);
  for (ObstacleSettings& one : all) one.at = point();
  all[0].shape = Steering{number() * 1e3, number(), number()};
  all[1].shape = Ball{number(), number(), number()};
  all[2].shape = Box{point().cwiseAbs(), any_orientation(random), number(), number()};
  all[1].appears = Fading{number(), number()};
  all[1].vanishes = Fading{1.0 + number(), number()};
  all[2].moves = Moving{point(), -number(), number()};
  return all;
}

void expect_same_bits(const ObstacleSettings& a, const ObstacleSettings& b) {
  const auto numbers = [](const ObstacleSettings& one) {
    std::vector<double> all(one.at.begin(), one.at.end());
    const auto add = [&](std::initializer_list<double> more) { all.insert(all.end(), more); };
    if (const auto* s = std::get_if<Steering>(&one.shape))
      add({1.0, s->strength, s->sharpness, s->reach});
    if (const auto* s = std::get_if<Ball>(&one.shape)) add({2.0, s->radius, s->strength, s->reach});
    if (const auto* s = std::get_if<Box>(&one.shape)) {
      add({3.0, s->size.x(), s->size.y(), s->size.z(), s->strength, s->reach});
      all.insert(all.end(), s->orientation.coeffs().begin(), s->orientation.coeffs().end());
    }
    if (one.appears) add({4.0, one.appears->from, one.appears->over});
    if (one.vanishes) add({5.0, one.vanishes->from, one.vanishes->over});
    if (one.moves)
      add({6.0, one.moves->to.x(), one.moves->to.y(), one.moves->to.z(), one.moves->from,
           one.moves->over});
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(all.data(), Eigen::Index(all.size())));
  };
  EXPECT_TRUE(same_bits(numbers(a), numbers(b)));
}

TEST(SequenceFile, BringsCouplingsBackBitForBit) {
  const TempFolder folder;
  std::mt19937_64 random(seed + 8);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed + 8) + ", case " + std::to_string(i));
    SequenceFile file;
    Primitive reach = test::random_primitive(random, 3);
    reach.coordinates = {"x", "y", "z"};
    file.sequence.then(reach);
    file.primitives = {"reach"};
    file.couplings = any_couplings(random);
    write_sequence(folder.path("all.yaml"), file);
    const SequenceFile back = read_sequence(folder.path("all.yaml"));
    ASSERT_EQ(back.couplings.size(), file.couplings.size());
    for (std::size_t k = 0; k < file.couplings.size(); ++k)
      expect_same_bits(back.couplings[k], file.couplings[k]);
    file.couplings[1].shape = Ball{-1.0, 1.0, 1.0};
    EXPECT_EQ(test::refusal([&] { write_sequence(folder.path("bad.yaml"), file); }),
              "obstacle: radius -1 m, must be > 0");
  }
}

const std::string coupled_sequence = good_sequence + R"(couplings:
  - steer: {at: [0.4, 0, 0.3], sharpness: 5}
  - ball: {at: [0.3, 0.1, 0.2], radius: 0.05, strength: 150, reach: 0.2}
    appears: {from: 0.5}
    vanishes: {from: 2, over: 0.4}
  - box: {at: [0.5, 0, 0.1], size: [0.2, 0.1, 0.3], orientation: [0, 0, 1, 0]}
    moves: {to: [0.5, 0.3, 0.1], from: 1, over: 1.5}
)";

TEST(SequenceFile, ReadsCouplingsAsTheyAreDocumented) {
  const TempFolder folder;
  write_parts(folder);
  const SequenceFile file = read_sequence(folder.write("coupled.yaml", coupled_sequence));
  ASSERT_EQ(file.couplings.size(), 3u);
  const auto& steering = std::get<Steering>(file.couplings[0].shape);
  EXPECT_EQ(file.couplings[0].at, Eigen::Vector3d(0.4, 0.0, 0.3));
  EXPECT_EQ(steering.sharpness, 5.0);
  EXPECT_EQ(steering.strength, Steering().strength);
  const auto& ball = std::get<Ball>(file.couplings[1].shape);
  EXPECT_EQ(Eigen::Vector3d(ball.radius, ball.strength, ball.reach),
            Eigen::Vector3d(0.05, 150.0, 0.2));
  EXPECT_EQ(file.couplings[1].appears->over, Fading().over);
  EXPECT_EQ(file.couplings[1].vanishes->over, 0.4);
  const auto& box = std::get<Box>(file.couplings[2].shape);
  EXPECT_EQ(box.size, Eigen::Vector3d(0.2, 0.1, 0.3));
  EXPECT_EQ(box.orientation.z(), 1.0);
  EXPECT_EQ(file.couplings[2].moves->to.y(), 0.3);
  EXPECT_FALSE(file.couplings[2].appears);
  Sequencer sequencer(file.sequence, Join::dmp3, file.start_state());
  EXPECT_EQ(add_obstacles(file.couplings, sequencer).size(), 3u);
  EXPECT_EQ(sequencer.couplings().size(), 3u);
}

class CouplingsRefuse : public testing::TestWithParam<BadFile> {};

TEST_P(CouplingsRefuse, WithFileLineAndKey) {
  const TempFolder folder;
  write_parts(folder);
  test::expect_refused(GetParam(), coupled_sequence, folder,
                       [](const std::string& path) { read_sequence(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , CouplingsRefuse,
    testing::Values(
        BadFile{"NoShape", "- steer:", "- dodge:", ":16: key \"dodge\": not known here"},
        BadFile{"TwoShapes", "    appears", "    steer: {at: [1, 2, 3]}\n    appears",
                ":17: key \"couplings\": must have one of the keys steer, ball, box"},
        BadFile{"TwoNumbers", "[0.4, 0, 0.3]", "[0.4, 0]",
                ":16: key \"at\": 2 numbers, must be 3 (one per axis)"},
        BadFile{"NoPlace", "at: [0.3, 0.1, 0.2], ", "", ":17: key \"ball\": needs the key"},
        BadFile{"NoRadius", "radius: 0.05, ", "", ":17: key \"ball\": needs the key"},
        BadFile{"RadiusNegative", "radius: 0.05", "radius: -1", ":17: key \"radius\": -1, must be"},
        BadFile{"StrengthNegative", "strength: 150", "strength: -1", ":17: key \"strength\": -1"},
        BadFile{"NoReach", "reach: 0.2", "reach: 0",
                ":17: key \"couplings\": obstacle: reach 0 m, must be > 0"},
        BadFile{"FlatBox", "[0.2, 0.1, 0.3]", "[0.2, 0, 0.3]",
                ":20: key \"couplings\": obstacle: size 0 m, must be > 0"},
        BadFile{"NoOrientation", "[0, 0, 1, 0]", "[0, 0, 2, 0]", ":20: key \"orientation\": "},
        BadFile{"ExtraKey", "sharpness", "sharp", ":16: key \"sharp\": not known here"},
        BadFile{"ExtraChange", "appears", "appear", ":18: key \"appear\": not known here"},
        BadFile{"NoTime", "appears: {from: 0.5}", "appears: {over: 0.5}",
                ":18: key \"appears\": needs the key"},
        BadFile{"AtOnce", "over: 0.4", "over: 0", ":19: key \"over\": 0, must be"},
        BadFile{"TooFast", "over: 0.4", "over: 1e-9",
                ":17: key \"couplings\": obstacle: vanishes: must be finite"},
        BadFile{"VanishesFirst", "vanishes: {from: 2", "vanishes: {from: 0.1",
                ":17: key \"couplings\": obstacle: vanishes at 0.1 s, must be after"},
        BadFile{"MoveWithoutEnd", ", over: 1.5", "", ":21: key \"moves\": needs the key"}),
    test::by_name);

TEST(SequenceFile, RefusesCouplingsOfJoints) {
  const TempFolder folder;
  write_parts(folder);
  std::string joints = replaced(good_primitive, "\"x\", \"y\"", "\"x\", \"elbow\"");
  folder.write("parts/reach.yaml", joints);
  const std::string path = folder.write(
      "joints.yaml",
      "format: seam-sequence 1\nprimitives:\n  reach: {file: parts/reach.yaml}\nsteps:\n  - {play: "
      "reach}\ncouplings:\n  - ball: {at: [0, 0, 0], radius: 1}\n");
  EXPECT_EQ(
      test::refusal([&] { read_sequence(path); }),
      path +
          ":7: key \"couplings\": obstacle: there is no coordinate y among x, elbow, must be a "
          "tool's x y z, or x y");
}

TEST_F(ReferenceOfASequence, IsWhatAnOrientationThatIsWishedIsTurnedFrom) {
  const std::string path = write({"half"});
  const std::string text = test::read_file(path);
  const SequenceFile file = read_sequence(folder_.write(
      "wish.yaml", replaced(text, "{play: half}",
                            "{play: half, pass: [{orientation: [0, 0, 1, 0], at: 0.5}]}")));
  const Wish& wish = file.sequence.steps()[0].wishes[0];
  const double angle = M_PI - 2.0 * std::atan2(0.6, 0.8);  // about z, from the reference
  EXPECT_LE((wish.position - Eigen::Vector3d(0.0, 0.0, angle)).norm(), 1e-12);
}

class SequenceFileRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(SequenceFileRefuses, WithFileLineAndKey) {
  const TempFolder folder;
  write_parts(folder);
  test::expect_refused(GetParam(), good_sequence, folder,
                       [](const std::string& path) { read_sequence(path); });
}

INSTANTIATE_TEST_SUITE_P(
    , SequenceFileRefuses,
    testing::Values(
        BadFile{
            "NewerFormat", "sequence 1", "sequence 3",
            ":1: key \"format\": \"seam-sequence 3\", must be seam-sequence 1 to 2 (a newer seam"},
        BadFile{"ExtraKey", "start_after", "start_at",
                ":5: key \"start_at\": not known here, must be one of format, start, start_after"},
        BadFile{"NegativeDelay", "after: 0", "after: -1", ":5: key \"start_after\": -1, must be"},
        BadFile{"StartOfNoCoordinate", "{x: 0.5}", "{z: 0.5}",
                ":3: key \"z\": is not among the primitives' coordinates"},
        BadFile{"StartNotFinite", "{x: 0.5}", "{x: .nan}",
                ":3: key \"x\": \".nan\", must be a finite number"},
        BadFile{"StartWithExtraPart", "velocity", "speed", ":4: key \"speed\": not known here"},
        BadFile{"NoPrimitives", "primitives:", "primitive:", ":6: key \"primitive\": not known"},
        BadFile{"NoSteps", "steps:", "start_after:", ":10: key \"start_after\": appears twice"},
        BadFile{"NoPlaceForSteps", "steps:\n", "step:\n", ":10: key \"step\": not known here"},
        BadFile{"NoSuchFile", "reach.yaml", "rich.yaml", ":7: key \"file\": "},
        BadFile{"FileAndMore", "{file: parts/reach.yaml}", "{file: parts/reach.yaml, tau: 2}",
                ":7: key \"tau\": not known here, must be one of file"},
        BadFile{"Neither", "{file: parts/reach.yaml}", "{kernels: 3}",
                ":7: key \"reach\": needs one of the keys file, demonstration, weights"},
        BadFile{"NoSuchDemonstration", "ramp.csv", "rump.csv", ":8: key \"demonstration\": "},
        BadFile{"TooManyKernels", "kernels: 12", "kernels: 60", ":8: key \"demonstration\": "},
        BadFile{"HalfAKernel", "kernels: 12", "kernels: 1.5",
                ":8: key \"kernels\": \"1.5\", must be a whole number >= 2"},
        BadFile{"UnknownLearnSetting", "width: 0.7", "breadth: 0.7",
                ":8: key \"breadth\": not known here, must be one of demonstration"},
        BadFile{"GainsWithoutK", "{K: 150}", "{D: 150}", ":8: key \"gains\": needs the key \"K\""},
        BadFile{"UnknownPrimitive", "play: ramp", "play: romp",
                ":13: key \"play\": \"romp\", is not among the primitives"},
        BadFile{"NothingToPlay", "play: ramp, ", "", ":13: key \"steps\": needs the key \"play\""},
        BadFile{"ExtraInStep", "{play: reach}", "{play: reach, tau: 2}",
                ":14: key \"tau\": not known here, must be one of play, enter, leave, pass, hit, "
                "arrive, until"},
        BadFile{"SwitchTooEarly", "before_end: 0.4", "before_end: 1.3",
                ":11: key \"until\": sequence: primitive 1: its switch"},
        BadFile{"SwitchNotFinite", "before_end: 0.4", "before_end: inf",
                ":11: key \"before_end\": \"inf\", must be a finite number"},
        BadFile{"UnknownSwitch", "before_end: 0.4", "sometime: 0.4",
                ":11: key \"sometime\": not known here, must be one of after, before_end"},
        BadFile{"UnknownSwitchText", "{before_end: 0.4}", "never",
                ":11: key \"until\": \"never\", must be one of on_call"},
        BadFile{"TwoSwitches", "before_end: 0.4", "before_end: 0.4, after: 1",
                ":11: key \"until\": must have one of after, before_end"},
        BadFile{"CyclesOfADiscreteOne", "before_end: 0.4", "cycles: 2",
                ":11: key \"until\": sequence: primitive 1: is discrete"},
        BadFile{"EndOfARhythmicOne", "{cycles: 2}", "{before_end: 0.1}",
                ":12: key \"until\": sequence: primitive 2: is rhythmic"},
        BadFile{"UnknownEntry", "{phase: 1.5}", "anywhere",
                ":12: key \"enter\": \"anywhere\", must be one of beginning, least_correction"},
        BadFile{"EntryOfADiscreteOne", "play: ramp,", "play: ramp, enter: beginning,",
                ":13: key \"enter\": sequence: primitive 3: is discrete"},
        BadFile{"ShortReference", "start_after: 0", "reference: [0, 0, 1]",
                ":5: key \"reference\": 3 numbers, must be 4 (one per part x y z w)"},
        BadFile{"ReferenceNotUnit", "start_after: 0", "reference: [0, 0, 1, 1]",
                ":5: key \"reference\": quaternion of norm 1.414214, must be 1 within 0.001"},
        BadFile{"ReferenceOfNothing", "start_after: 0", "reference: [0, 0, 0, 1]",
                ":5: key \"reference\": the primitives have no coordinates rx, ry and rz"}),
    test::by_name);

TEST(SequenceFile, RefusesStepsThatAreNoList) {
  const TempFolder folder;
  write_parts(folder);
  const std::string text = good_sequence.substr(0, good_sequence.find("steps:"));
  for (const char* steps : {"steps: 3\n", "steps: []\n", "steps: {play: reach}\n"})
    EXPECT_THAT(test::refusal([&] { read_sequence(folder.write("bad.yaml", text + steps)); }),
                HasSubstr("bad.yaml:10: key \"steps\": must be a list with at least one entry"));
  EXPECT_THAT(test::refusal([&] { read_sequence(folder.write("bad.yaml", text)); }),
              HasSubstr("bad.yaml:1: needs the key \"steps\""));
}

TEST(SequenceFile, NamesThePlaceInTheFileThatItReads) {
  const TempFolder folder;
  write_parts(folder);
  folder.write("parts/reach.yaml", replaced(good_primitive, "tau: 1.2", "tau: none"));
  const std::string path = folder.write("good.yaml", good_sequence);
  EXPECT_EQ(test::refusal([&] { read_sequence(path); }),
            path + ":7: key \"file\": " + folder.path("parts/reach.yaml") +
                ":4: key \"tau\": \"none\", must be a finite number");
}

TEST(SequenceFile, RefusesPrimitivesOfDifferentCoordinates) {
  const TempFolder folder;
  write_parts(folder);
  folder.write("parts/wipe.yaml", replaced(good_primitive, "\"y\"", "\"z\""));
  EXPECT_THAT(
      test::refusal([&] { read_sequence(folder.write("bad.yaml", good_sequence)); }),
      HasSubstr("bad.yaml:12: key \"play\": sequence: primitive 2: its coordinates differ"));
}

// A folder `mine` with a sequence in it, and a demonstration beside.
struct Neighbours : TempFolder {
  Neighbours() {
    write_parts(*this);
    std::filesystem::create_directory(path("mine"));
    std::filesystem::create_symlink("../ramp.csv", path("mine/link.csv"));
    std::filesystem::create_directory_symlink("../parts", path("mine/parts"));
  }
  SequenceFile read(const std::string& demonstration,
                    const std::vector<std::string>& allowed = {}) const {
    const std::string text =
        "format: seam-sequence 1\nprimitives:\n  a: {demonstration: " + demonstration +
        "}\nsteps: [{play: a}]\n";
    return read_sequence(write("mine/task.yaml", text), allowed);
  }
};

TEST(SequenceFile, NamesFilesOfItsOwnFolderAlone) {
  const Neighbours folder;
  std::filesystem::create_directory(folder.path("mine/below"));
  std::filesystem::copy(folder.path("ramp.csv"), folder.path("mine/below/ramp.csv"));
  EXPECT_EQ(folder.read("below/ramp.csv").primitives.size(), 1U);
  EXPECT_EQ(folder.read("../mine/below/../below/ramp.csv").primitives.size(), 1U);
  EXPECT_EQ(folder.read(folder.path("mine/below/ramp.csv")).primitives.size(), 1U);
  for (const std::string& out :
       {std::string("../ramp.csv"), folder.path("ramp.csv"), std::string("link.csv"),
        std::string("parts/reach.yaml"), std::string("/dev/zero"), std::string("../nothing.csv"),
        std::string("..")})
    EXPECT_EQ(test::refusal([&] { folder.read(out); }),
              folder.path("mine/task.yaml") + ":3: key \"demonstration\": \"" + out +
                  "\" leads out of the file's folder, must be in it or below, or in a folder that "
                  "is allowed (seam --allow DIR)");
}

TEST(SequenceFile, NamesFilesOfFoldersThatAreAllowed) {
  const Neighbours folder;
  EXPECT_EQ(folder.read("../ramp.csv", {folder.path("")}).primitives.size(), 1U);
  EXPECT_EQ(folder.read("link.csv", {"/"}).primitives.size(), 1U);
  EXPECT_THAT(test::refusal([&] {
                folder.read("../ramp.csv", {folder.path("parts"), folder.path("ra")});
              }),
              HasSubstr("leads out of the file's folder"));
}

std::string many(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string refusal_of(const std::string& text) {
  const TempFolder folder;
  const std::string path = folder.write("bad.yaml", text);
  return test::refusal([&] { read_sequence(path); }).substr(path.size());
}

TEST(YamlFile, IsRefusedBeyondWhatAPersonWrites) {
  EXPECT_EQ(refusal_of(many("[", 5000)), ":1: more than 32 levels");
  EXPECT_EQ(refusal_of(many("- ", 5000)), ":1: more than 32 levels");
  EXPECT_EQ(refusal_of("a: [" + many("1,", 200000) + "]"), ":1: more than 200000 values");
  EXPECT_EQ(refusal_of("a: \"" + std::string(4 << 20, 'x') + "\""), ": is larger than 4 MiB");
}

TEST(YamlFile, CountsWhatAliasesRepeat) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    const std::string name = "a" + std::to_string(i);
    bomb += name + ": &" + name + " [" + many(last + ", ", 9) + last + "]\n";
  }
  EXPECT_EQ(refusal_of(bomb), ":6: more than 200000 values");
  EXPECT_EQ(refusal_of("format: &f [*f]"), ":1: an alias repeats what it is a part of");
  const TempFolder folder;
  const std::string twice =
      replaced(replaced(good_primitive, "[1.5, 20]", "&row [1.5, 20]"), "[-30, 4]", "*row");
  EXPECT_EQ(read_primitive(folder.write("a.yaml", twice)).weights(1, 1), 20.0);
}

TEST(SequenceFile, AsksForNoMoreWorkThanSeconds) {
  const Neighbours folder;
  EXPECT_THAT(test::refusal([&] { folder.read("../ramp.csv, kernels: 1001", {"/"}); }),
              EndsWith("key \"kernels\": 1001, must be <= 1000"));
  std::string rows = "time,x\n";
  for (int i = 0; i < 30000; ++i) rows += std::to_string(i) + ",0\n";
  folder.write("mine/long.csv", rows);
  EXPECT_THAT(test::refusal([&] { folder.read("long.csv, kernels: 1000"); }),
              HasSubstr("30000 samples with up to 1000 kernels are too much work"));
  EXPECT_THAT(test::refusal([&] { folder.read("long.csv, precision: 0.1"); }),
              HasSubstr("30000 samples with up to 100 kernels are too much work"));
}

}  // namespace
}  // namespace seam
