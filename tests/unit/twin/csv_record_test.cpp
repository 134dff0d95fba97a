// Text records that are not tables, and the estimate of their lines.
#include "tests/support/record_format_test.h"
#include "twin/records/line_source.h"
#include <algorithm>

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
class CsvRecord : public RecordFormatTest {};

std::string rows(const std::string &head, const std::string &behind)
{
  std::string text = head;
  for (int i = 0; i < n; ++i)
    text += printed("%.3f", i * 1e-3) + "," + printed("%.2f", swings()[std::size_t(i)]) + behind + "\n";
  return text;
}
}  // namespace

TEST_F(CsvRecord, ACellThatGoesOnInTheNextLineIsRefused)
{
  const std::string reason =
      "this quote is not closed on its line; each row of a record is one line, also that of the names";
  EXPECT_EQ(refusal("r.csv", rows("time [s],\"upper\nwork roll [g]\"\n", "")), reason);
  EXPECT_EQ(refusal("r.csv", rows("\"time\n[s]\",a [g]\n", "")), reason);
  EXPECT_EQ(refusal("r.csv", rows("time [s],a [g],note\n", ",\"two\nlines\"")), reason);
  EXPECT_EQ(refusal("r.csv", rows("time [s],\"upper, \"\"work\"\" roll [g]\"\n", "")), "accepted");
}

TEST_F(CsvRecord, BinaryFilesAreRefusedAsSuch)
{
  const std::string reason =
      "this is not a text: it holds bytes of value zero; export the record as CSV in UTF-8, or in "
      "UTF-16 with a byte-order mark";
  std::string wide;
  for (const char c : rows("time [s],a [g]\n", ""))
    wide += std::string{c, '\0'};
  EXPECT_EQ(refusal("r.csv", wide), reason);
  EXPECT_EQ(refusal("r.csv", zip({{"xl/workbook.xml", std::string(1000, '<')}})), reason);
  EXPECT_EQ(refusal("r.csv", "\xFF\xFE" + wide), "accepted");
}

// Exponents of Fortran: the whole column became labels, and the record had no channel.
TEST_F(CsvRecord, TextsInAColumnWithAUnitAreAnError)
{
  EXPECT_EQ(refusal("r.csv", rows("time [s],a [g]\n", "D-01")),
            "'-0.50D-01' in column 'a' is not a number; leave the cell empty where there is no value");
  const std::string message = refusal("r.csv", rows("time [s],a [g]\n", std::string(5000, 'x')));
  EXPECT_LT(message.size(), 500u) << "a cell of any length is shown by its beginning";
}

// The first rows of a recorder that waits are all zeros, much shorter than those of the mill.
TEST_F(CsvRecord, LinesAreEstimatedFromTheWholeFile)
{
  std::string text = "time;a;b;c\n0;0;0;0\n";
  const int many   = 200000;
  for (int i = 0; i < many; ++i)
    text += std::to_string(1000000 + i) + ";-1.234567890123;-1.234567890123;-1.234567890123\n";
  EXPECT_TRUE(near(expected_lines(file("long.csv", text)), many + 2,
                   within(0.01, "looks of 64 KiB end inside a line of 60 byte")));
  std::string cr = text.substr(0, 100000);
  EXPECT_EQ(expected_lines(file("short.csv", cr)), 1 + double(std::count(cr.begin(), cr.end(), '\n')));
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  EXPECT_EQ(expected_lines(file("short.csv", cr)), 1 + double(std::count(cr.begin(), cr.end(), '\r')));
  EXPECT_EQ(expected_lines(file("empty.csv", "")), 0);
}
