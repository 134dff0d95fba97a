// Tables as this program writes and reads them.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/csv.h"
#include "core/records/csv_cell.h"
#include "tests/support/near.h"
#include <filesystem>
#include <random>

using namespace mill;

namespace {
class Csv : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_csv_test.csv").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
};
}  // namespace

TEST_F(Csv, NamesOfATableComeBackWhateverTheyHold)
{
  Table table;
  for (const char *name :
       {"housing,_screw", "a;b", "\"quoted\"", "tab\there", "# no comment", "[x]", "K [given]", "\u00e4"})
    table.add(name, "g", Eigen::Vector2d(1, 2)).add(name, "", Eigen::Vector2d(3, 4));
  const std::string text = csv_text(table);
  EXPECT_EQ(text.substr(0, text.find("a;b")), "\"housing,_screw [g]\",\"housing,_screw\",\"");
  write_atomically(path, text);
  const Table back = read_table(path);
  EXPECT_EQ(back.names, table.names);
  EXPECT_EQ(back.units, table.units);
  EXPECT_EQ(back.columns[3][1], 4);
}

TEST_F(Csv, CharactersThatATerminalObeysAreWrittenOut)
{
  Table table;
  table.add("\x1b[2Jforce", "kN", Eigen::Vector2d(1, 2));
  table.add("\xe2\x80\xae"
            "x",
            "", Eigen::Vector2d(3, 4));
  EXPECT_EQ(csv_text(table), "\\x1b[2Jforce [kN],\\u202ex\n1,3\n2,4\n");
  EXPECT_FALSE(reads_back(table));
  EXPECT_EQ(quoted_cell("a\tb\n\x07\""), "\"a\tb\n\\x07\"\"\"");
  EXPECT_EQ(csv_cell("pass 1; 2"), "pass 1; 2");
  EXPECT_EQ(csv_cell("pass\x1b[2J 1"), "\"pass\\x1b[2J 1\"");
}

TEST_F(Csv, ATableComesBackWithAllDigits)
{
  const unsigned seed = 77;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 1e6);
  Table table{{"load", "ratio"}, {"N", ""}, {Eigen::VectorXd(500), Eigen::VectorXd(500)}};
  for (int i = 0; i < 500; ++i) {
    table.columns[0][i] = normal(random);
    table.columns[1][i] = normal(random) * 1e-20;
  }
  table.columns[1][7]    = std::numeric_limits<double>::quiet_NaN();
  const std::string text = csv_text(table);
  EXPECT_EQ(text.substr(0, text.find('\n')), "load [N],ratio");
  write_atomically(path, text);
  const Table back = read_table(path);
  EXPECT_EQ(back.names, table.names);
  EXPECT_EQ(back.units, table.units);
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(back.columns[0][i], table.columns[0][i]) << "seed " << seed;
    if (i != 7) {
      ASSERT_EQ(back.columns[1][i], table.columns[1][i]) << "seed " << seed;
    }
  }
  EXPECT_TRUE(std::isnan(back.columns[1][7]));
  EXPECT_EQ(back.column("load")->size(), 500);
  EXPECT_EQ(back.column("none"), nullptr);
}

TEST_F(Csv, NumbersThatAreNotFiniteAreEmptyCells)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Table table;
  table.add("speed", "m/s", Eigen::Vector3d(1, 2, 3)).add("growth_rate", "1/s", Eigen::Vector3d(nan, -inf, 0.5));
  EXPECT_EQ(csv_text(table), "speed [m/s],growth_rate [1/s]\n1,\n2,\n3,0.5\n");
  write_atomically(path, csv_text(table));
  EXPECT_TRUE(std::isnan(read_table(path).columns[1][0]));
  EXPECT_EQ(csv_text(Table().add("a", "", Eigen::Vector2d(nan, 1))), "a\n\"\"\n1\n") << "a line, not a blank one";
}

// Whoever still has a table need not read its file where both are the same to the bit.
TEST_F(Csv, ATableThatChangesInItsFileIsDetected)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto column = [](const std::string &name, const std::string &unit, const double value) {
    return Table().add(name, unit, Eigen::VectorXd::Constant(2, value));
  };
  for (const Table &same :
       {column("load", "N", 1e15), column("a, b", "N or N m per m", -1e-300), column("#x", "", nan)}) {
    EXPECT_TRUE(reads_back(same)) << same.names[0];
    write_atomically(path, csv_text(same));
    const Table back = read_table(path);
    EXPECT_EQ(back.names, same.names);
    EXPECT_EQ(back.units, same.units);
    EXPECT_TRUE(back.columns[0] == same.columns[0] || std::isnan(same.columns[0][0])) << same.names[0];
  }
  for (const Table &other : {column("load", "N", inf), column("load", "N", 1.1e15), column("load [N]", "", 1),
                             column(" load", "N", 1), column("a\nb", "", 1), column("a\"b", "", 1),
                             column("", "", 1), Table(), Table().add("load", "N", Eigen::VectorXd())})
    EXPECT_FALSE(reads_back(other)) << (other.names.empty() ? "no column" : other.names[0]);
}
