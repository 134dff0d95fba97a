// Recorded forces as they come from real recorders, and each way in which they are wrong.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include <filesystem>
#include <fstream>
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
  ForceRecord record(const std::string &text)
  {
    std::filesystem::remove(path);  // a new file, and no wait for the disk: this runs thousands of times
    std::ofstream(path, std::ios::binary) << text;
    return read_force(path);
  }
  /// "line:column: message" of the refusal.
  std::string refusal(const std::string &text)
  {
    try {
      record(text);
    } catch (const InputError &error) {
      const Place &place = error.problems.at(0).place;
      EXPECT_EQ(place.file, path);
      return std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + error.problems.at(0).message;
    }
    return "accepted";
  }
  void expect_three_samples(const std::string &text)
  {
    const ForceRecord r = record(text);
    ASSERT_EQ(r.time.size(), 3) << text;
    EXPECT_EQ(r.time[0], 0) << text;
    EXPECT_EQ(r.time[1], 0.001) << text;
    EXPECT_EQ(r.time[2], 0.0025) << text;
    EXPECT_EQ(r.force[0], 976200) << text;
    EXPECT_EQ(r.force[1], 975500) << text;
    EXPECT_EQ(r.force[2], -1000) << text;
  }
};
}  // namespace

TEST_F(Csv, CommaSemicolonAndTab)
{
  expect_three_samples("time [s], force [kN]\n0,976.2\n0.001,975.5\n0.0025,-1\n");
  expect_three_samples("time [s];force [kN]\n0;976.2\n0.001;975.5\n0.0025;-1");
  expect_three_samples("time [s]\tforce [kN]\n0\t976.2\n0.001\t975.5\n0.0025\t-1\n");
}

TEST_F(Csv, ValuesAreInTheUnitsOfTheHeader)
{
  expect_three_samples("time [ms],force [N]\n0,976200\n1,975500\n2.5,-1e3\n");
  expect_three_samples("force [MN];speed [m/s];time [us]\n0.9762;1;0\n0.9755;1;1000\n-0.001;1;2500\n");
}

TEST_F(Csv, DecimalComma)
{
  expect_three_samples("time [s];force [kN]\n0;976,2\n0,001;975,5\n0,0025;-1\n");
  const auto notes = record("time [s];force [kN]\n0;976,2\n0,001;975,5\n").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "decimal commas were read as decimal points");
}

TEST_F(Csv, ByteOrderMarkCrlfBlankAndCommentLines)
{
  expect_three_samples("\xEF\xBB\xBF# made by a recorder\r\ntime [s], force [kN]\r\n\r\n0,976.2\r\n0.001,975.5\r\n"
                       "0.0025,-1\r\n\r\n");
  const auto notes = record("\xEF\xBB\xBFtime [s],force [kN]\n\n0,1\n1,2\n").notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "a byte-order mark at the beginning of the file was ignored");
  EXPECT_EQ(notes[1], "1 blank line was skipped");
}

TEST_F(Csv, QuotedCells)
{
  expect_three_samples("\"time [s]\";\"force [kN]\"\n\"0\";\"976,2\"\n0.001;975.5\n0.0025;-1\n");
}

// RFC 4180, 2.6 and 2.7: a cell with the separator or a quote stands in quotes, a quote in it is doubled.
TEST_F(Csv, QuotedHeadersWithSeparatorsAndQuotes)
{
  expect_three_samples(
      "\"time [s]\",\"a,b \"\"c\"\" [m]\", \"force [kN]\"\n0,1,976.2\n0.001,1,975.5\n0.0025,1,-1\n");
  expect_three_samples("time [s],\"x;y [m]\",force [kN]\n0,1,976.2\n0.001,1,975.5\n0.0025,1,-1\n");
  EXPECT_EQ(refusal("time [s],\"force [kN]\n0,976\n1,976\n"), "1:10: this quote is not closed on its line");
  EXPECT_EQ(refusal("time [s],\"force\" [kN]\n0,976\n1,976\n"),
            "1:18: something follows a closing quote; a quote inside quotes is doubled");
}

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

TEST_F(Csv, RefusalsNameThePlaceAndTheReason)
{
  EXPECT_EQ(refusal(""), "1:1: the file is empty; a header such as \"time [s], force [kN]\" and data are needed");
  EXPECT_EQ(refusal("\n\n"),
            "1:1: the file is empty; a header such as \"time [s], force [kN]\" and data are needed");
  EXPECT_EQ(refusal("time [s], force [kN]\n"), "1:1: no sample after this header; at least two are needed");
  EXPECT_EQ(refusal("time [s], force [kN]\n0,976\n"),
            "1:1: only one sample after this header; at least two are needed");
  EXPECT_EQ(refusal("time [s], force\n0,976\n1,976\n"),
            "1:11: column 'force' has no unit; a force is needed, for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s], force [kg]\n0,976\n1,976\n"),
            "1:11: column 'force' has the unit 'kg', a mass; a force is needed, for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s], force [lbf]\n0,976\n1,976\n"),
            "1:11: column 'force' has the unknown unit 'lbf'; a force is needed, for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s], F [kN]\n0,976\n1,976\n"),
            "1:1: no column 'force' in the header, which has 'time', 'F'; write for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n1,abc\n"), "3:3: 'abc' in column 'force' is not a finite number");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,NaN\n1,976\n"), "2:3: 'NaN' in column 'force' is not a finite number");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,inf\n1,976\n"), "2:3: 'inf' in column 'force' is not a finite number");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,\n1,976\n"),
            "2:3: the cell of column 'force' is empty; a number is needed");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n2,976\n1,976\n"),
            "4:1: time 1 s comes after 2 s; sort the lines by time");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n1,976\n1,975\n"),
            "4:1: time 1 s appears twice; keep one of the two lines");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976,2\n1,976\n"),
            "2:1: this line has 3 cells, the header has 2; a decimal comma needs ';' or tab between the columns");
  EXPECT_EQ(refusal("time [s];force [kN]\n0;1.976,2\n1;976\n"),
            "2:3: '1.976,2' in column 'force' is not a finite number");
}

TEST_F(Csv, AMissingFileIsNamed)
{
  EXPECT_THROW(read_force("no/such/file.csv"), InputError);
  EXPECT_THROW(read_measured("no/such/file.csv"), InputError);
}

TEST_F(Csv, MeasuredAccelerationsInG)
{
  write_atomically(path, "time [s],upper_work_roll [g],lower_work_roll [m/s2]\n0,1,2\n1,-0.5,3\n");
  const MeasuredRecord r = read_measured(path);
  EXPECT_EQ(r.upper_work_roll[0], 9.80665);
  EXPECT_EQ(r.upper_work_roll[1], -0.5 * 9.80665);
  EXPECT_EQ(r.lower_work_roll[1], 3);
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

TEST_F(Csv, AMutilatedFileIsEitherReadOrRefused)
{
  std::string good = "time [s];force [kN]\n";
  for (int i = 0; i < 30; ++i)
    good += std::to_string(i) + ",5;97" + std::to_string(i) + ".25\n";
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  int n_refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (unsigned n = 1 + random() % 3; n > 0 && !text.empty(); --n)
      switch (const std::size_t position = random() % text.size(); random() % 4) {
      case 0:
        text[position] = char(random() % 256);
        break;
      case 1:
        text.erase(position, 1 + random() % 20);
        break;
      case 2:
        text.insert(position, 1, ";,\t\n\r\"[]#-e.\0"[random() % 13]);
        break;
      default:
        text.resize(position);
      }
    try {
      const ForceRecord r = record(text);
      ASSERT_EQ(r.time.size(), r.force.size());
      ASSERT_TRUE(r.time.allFinite() && r.force.allFinite()) << "seed " << seed << ", draw " << i;
    } catch (const InputError &) {
      ++n_refused;
    }  // any other exception fails the test
  }
  // most mutations break a line of this short file; if hardly any did, the mutations would not be ones
  EXPECT_GT(n_refused, 500) << "seed " << seed;
}
