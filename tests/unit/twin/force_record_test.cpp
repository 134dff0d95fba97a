// Recorded forces as they come from real recorders, and each way in which they are wrong.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "tests/support/near.h"
#include "twin/records/force_record.h"
#include <filesystem>
#include <fstream>
#include <random>

using namespace mill;

namespace {
class ForceCsv : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_force_test.csv").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  ForceRecord record(const std::string &text)
  {
    std::filesystem::remove(path);  // a new file, and no wait for the disk: this runs thousands of times
    std::ofstream(path, std::ios::binary) << text;
    return twin::read_force(path);
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

TEST_F(ForceCsv, CommaSemicolonAndTab)
{
  expect_three_samples("time [s], force [kN]\n0,976.2\n0.001,975.5\n0.0025,-1\n");
  expect_three_samples("time [s];force [kN]\n0;976.2\n0.001;975.5\n0.0025;-1");
  expect_three_samples("time [s]\tforce [kN]\n0\t976.2\n0.001\t975.5\n0.0025\t-1\n");
}

TEST_F(ForceCsv, ValuesAreInTheUnitsOfTheHeader)
{
  expect_three_samples("time [ms],force [N]\n0,976200\n1,975500\n2.5,-1e3\n");
  expect_three_samples("force [MN];speed [m/s];time [us]\n0.9762;1;0\n0.9755;1;1000\n-0.001;1;2500\n");
}

TEST_F(ForceCsv, DecimalComma)
{
  expect_three_samples("time [s];force [kN]\n0;976,2\n0,001;975,5\n0,0025;-1\n");
  const auto notes = record("time [s];force [kN]\n0;976,2\n0,001;975,5\n").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "decimal commas were read as decimal points");
}

TEST_F(ForceCsv, ByteOrderMarkCrlfBlankAndCommentLines)
{
  expect_three_samples("\xEF\xBB\xBF# made by a recorder\r\ntime [s], force [kN]\r\n\r\n0,976.2\r\n0.001,975.5\r\n"
                       "0.0025,-1\r\n\r\n");
  const auto notes = record("\xEF\xBB\xBFtime [s],force [kN]\n0,1\n\n1,2\n").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "1 blank line was skipped");
}

TEST_F(ForceCsv, QuotedCells)
{
  expect_three_samples("\"time [s]\";\"force [kN]\"\n\"0\";\"976,2\"\n0,001;\"975,5\"\n0,0025;-1\n");
}

// RFC 4180, 2.6 and 2.7: a cell with the separator or a quote stands in quotes, a quote in it is doubled.
TEST_F(ForceCsv, QuotedHeadersWithSeparatorsAndQuotes)
{
  expect_three_samples(
      "\"time [s]\",\"a,b \"\"c\"\" [m]\", \"force [kN]\"\n0,1,976.2\n0.001,1,975.5\n0.0025,1,-1\n");
  expect_three_samples("time [s],\"x;y [m]\",force [kN]\n0,1,976.2\n0.001,1,975.5\n0.0025,1,-1\n");
}

TEST_F(ForceCsv, AMutilatedFileIsEitherReadOrRefused)
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

TEST_F(ForceCsv, RefusalsNameThePlaceAndTheReason)
{
  EXPECT_EQ(refusal(""), "1:1: the file is empty; a line such as \"time [s], force [kN], upper_work_roll [g]\" "
                         "and numbers are needed");
  EXPECT_EQ(refusal("time [s], force [kN]\n"),
            "1:1: no row of numbers in the first line; columns are separated by ';', tab, ',' or blanks; a "
            "decimal comma needs one of the first two");
  EXPECT_EQ(refusal("time [s], force [kN]\n0,976\n"), "1:1: the record has 1 sample; at least 2 are needed");
  EXPECT_EQ(refusal("time [s], force\n0,976\n1,976\n"),
            "1:11: no column of this record has a known unit; its columns are 'force'; write the unit behind the "
            "name, for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s], force [kg]\n0,976\n1,976\n"),
            "1:11: the unit of column 'force' is 'kg'; a force is needed, for example \"force [kN]\"");
  EXPECT_EQ(refusal("time [s], x [m]\n0,976\n1,976\n"),
            "1:11: no column of this record holds a force; its columns are 'x'; name the one of the rolling force "
            "\"force [kN]\"");
  EXPECT_EQ(refusal("time [s], F1 [kN], F2 [kN]\n0,976,1\n1,976,1\n"),
            "1:11: 2 columns of this record hold forces, and none has the name 'force'; its columns are 'F1', "
            "'F2'; name the one of the whole rolling force \"force [kN]\"");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n1,abc\n2,976\n"),
            "3:3: 'abc' in column 'force' is not a number; leave the cell empty where there is no value");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n2,976\n1,976\n"),
            "4:1: the time goes backwards here, by 1 s; sort the lines by time, or split the file where the "
            "recorder started again");
  EXPECT_EQ(refusal("time [s],force [kN]\n0,976\n1,976\n1,975\n"),
            "1:1: 1 of 3 samples have the time of their neighbour, the last at 1 s; keep one of each, or export "
            "the time with more digits");
  EXPECT_EQ(refusal("force [kN]\n976\n975\n"),
            "1:1: no column holds the time; the columns are 'force'; name one, for example \"time [s]\"");
  EXPECT_EQ(refusal("time,force [kN]\n0,976\n1,975\n"),
            "1:1: column 'time' has no unit; write for example \"time [s]\"");
}

TEST_F(ForceCsv, TheOnlyForceNeedsNoSpecialName)
{
  expect_three_samples("Zeit [s];Walzkraft [kN];v [m/s]\n0;976,2;1\n0,001;975,5;1\n0,0025;-1;1\n");
  expect_three_samples("time (s),Force OS (lbf),force (kN)\n0,1,976.2\n0.001,1,975.5\n0.0025,1,-1\n");
  const ForceRecord pounds = record("time [s], force [lbf]\n0,1000\n1,2000\n2,1000\n");
  EXPECT_TRUE(near(pounds.force[0], 4448.2216152605, within(1e-12, "definition of the pound-force")));
}

TEST_F(ForceCsv, OneOrTwoSamplesWithoutAValueAreFilledLinearly)
{
  const ForceRecord r = record("time [s],force [kN]\n5,100\n5.1,NaN\n5.2,\n5.3,130\n5.4,120\n");
  const auto rounding = within(1e-14, "one subtraction and addition of the times");
  ASSERT_EQ(r.time.size(), 5);
  EXPECT_TRUE(near(r.time[1], 5.1, rounding));
  EXPECT_TRUE(near(r.force[1], 110e3, rounding));
  EXPECT_TRUE(near(r.force[2], 120e3, rounding));
  EXPECT_EQ(r.force[3], 130e3);
  EXPECT_EQ(r.notes.back(), "2 samples have no value; straight lines between the neighbours take their place");
  const ForceRecord gap = record("time [s],force [kN]\n0,100\n1,\n2,\n3,\n4,130\n5,120\n6,\n");
  ASSERT_EQ(gap.time.size(), 3) << "a longer gap is seen in the times";
  EXPECT_EQ(gap.time[1], 4);
}

TEST_F(ForceCsv, TimesThatDoNotBeginAtZeroStay)
{
  const ForceRecord r = record("time [ms],force [kN]\n250,100\n251,101\n252,102\n");
  EXPECT_EQ(r.time[0], 0.25);
  EXPECT_FALSE(r.start);
  const ForceRecord dated = record(
      "time,force [kN]\n2026-01-05T10:00:00.000Z,1\n2026-01-05T10:00:00.001Z,2\n2026-01-05T10:00:00.002Z,3\n");
  EXPECT_EQ(dated.time[0], 0);
  ASSERT_TRUE(dated.start);
  EXPECT_EQ(*dated.start, 1767607200);
}

TEST_F(ForceCsv, MeasuredAccelerationsInG)
{
  write_atomically(path, "time [s],upper_work_roll [g],lower_work_roll [m/s2]\n0,1,2\n1,-0.5,3\n2,0,1\n");
  const MeasuredRecord r = twin::read_measured(path);
  EXPECT_EQ(r.upper_work_roll[0], 9.80665);
  EXPECT_EQ(r.upper_work_roll[1], -0.5 * 9.80665);
  EXPECT_EQ(r.lower_work_roll[1], 3);
  EXPECT_THROW(twin::read_measured("no/such/file.csv"), InputError);
}
