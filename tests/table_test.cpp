#include <random>

#include <gmock/gmock.h>

#include "tests/support.hpp"
#include <seam/table.hpp>

namespace seam {
namespace {

using test::refusal;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Table, GivesBackTheSameBits) {
  const TempFolder folder;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1e3, 1e3);
  Table table{{"time", "a", "b"},
              Eigen::MatrixXd::NullaryExpr(50, 3, [&] { return uniform(random); })};
  table.values(0, 0) = 0.1;
  table.values(1, 1) = 5e-324;
  table.values(2, 2) = -1.7976931348623157e308;
  table.write(folder.path("t.csv"));
  const Table back = Table::read(folder.path("t.csv"));
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_TRUE((back.values.array() == table.values.array()).all());
}

TEST(Table, AcceptsBlanksWindowsLineEndsAndAByteOrderMark) {
  const TempFolder folder;
  const Table table =
      Table::read(folder.write("t.csv", "\xEF\xBB\xBFtime , a\r\n0, +1\r\n0.5,\t-2e-1 \r\n\r\n"));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"time", "a"}));
  EXPECT_EQ(table.values(1, 1), -0.2);
  EXPECT_EQ(table.values(0, 1), 1.0);
}

struct BadTable {
  const char* name;
  const char* content;
  const char* message;  // after the path
};

class TableRefuses : public testing::TestWithParam<BadTable> {};

TEST_P(TableRefuses, WithFileLineAndColumn) {
  const TempFolder folder;
  const std::string path = folder.write("bad.csv", GetParam().content);
  EXPECT_EQ(refusal([&] { Table::read(path); }), path + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    , TableRefuses,
    testing::Values(
        BadTable{"Empty", "", ":1: no header"}, BadTable{"Blank", "\n\n", ":1: no header"},
        BadTable{"HeaderAlone", "time,a\n", ": no rows below the header"},
        BadTable{"NamelessColumn", "time,,a\n0,0,0\n", ":1: column 2 has no name"},
        BadTable{"ColumnTwice", "time,a,a\n0,0,0\n", ":1: column \"a\" appears twice"},
        BadTable{"TooFewFields", "time,a\n0,1\n1\n", ":3: 1 fields, must be 2 as in the header"},
        BadTable{"TooManyFields", "time,a\n0,1,2\n", ":2: 3 fields, must be 2 as in the header"},
        BadTable{"BlankLineInside", "time,a\n0,1\n\n1,2\n",
                 ":3: 1 fields, must be 2 as in the header"},
        BadTable{"NotANumber", "time,a\n0,nan\n",
                 ":2: column \"a\": \"nan\", must be a finite number"},
        BadTable{"TooLarge", "time,a\n0,1e999\n",
                 ":2: column \"a\": \"1e999\", must be a finite number"},
        BadTable{"Trailing", "time,a\n0,1.5x\n",
                 ":2: column \"a\": \"1.5x\", must be a finite number"},
        BadTable{"EmptyField", "time,a\n0,\n", ":2: column \"a\": \"\", must be a finite number"}),
    [](const auto& bad) { return bad.param.name; });

TEST(Table, RefusesWhatIsNotAFile) {
  const TempFolder folder;
  EXPECT_THAT(refusal([&] { Table::read(folder.path("none.csv")); }),
              EndsWith("No such file or directory"));
  EXPECT_THAT(refusal([&] { Table::read(folder.path("")); }), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace seam
