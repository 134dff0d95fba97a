// Universal files, data set 58 and 58b, made here line by line.
#include "tests/support/record_format_test.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
// Pairs of time and value, so many on a line.
std::string pairs(const char *abscissa, const char *ordinate, const int on_a_line, const double stretch = 1,
                  const double later = 0)
{
  std::string text;
  const auto values = swings();
  for (int i = 0; i < n; ++i)
    text += printed(abscissa, later + stretch * i / 2000.0) + printed(ordinate, values[std::size_t(i)]) +
            (i % on_a_line == on_a_line - 1 || i + 1 == n ? "\n" : "");
  return text;
}

class UffRecord : public RecordFormatTest {};
}  // namespace

TEST_F(UffRecord, ChannelsOfUniversalFilesHaveDistinctNames)
{
  const auto names_of = [&](const UffSet &one, const UffSet &two) {
    std::string text;
    for (UffSet set : {one, two}) {
      set.numbers = even_numbers();
      text += uff(set);
    }
    const auto record = read("r.uff", text);
    return record.channels[0].name + " | " + record.channels[1].name;
  };
  UffSet a, b;
  a.id1 = b.id1 = "logger 7";
  a.id5         = "stand_1";
  b.id5         = "stand_2";
  EXPECT_EQ(names_of(a, b), "stand_1 | stand_2");
  a.id5 = b.id5 = "NONE";
  a.entity      = "In_01";
  b.entity      = "In_02";
  EXPECT_EQ(names_of(a, b), "In_01 | In_02");
  b.entity    = "In_01";
  b.direction = -1;
  EXPECT_EQ(names_of(a, b), "In_01 +Z | In_01 -X");
  a.entity = b.entity = "NONE";
  b.direction         = 3;
  b.node              = 7;
  EXPECT_EQ(names_of(a, b), "node 1 +Z | node 7 +Z");
  a.id1 = "upper";
  b.id1 = "lower";
  EXPECT_EQ(names_of(a, b), "upper | lower");
}

TEST_F(UffRecord, UniversalFilesSayTheUnitOfTheirTimeAndTheirValues)
{
  UffSet set;
  set.numbers   = even_numbers();
  set.entity    = "chock";
  set.axis_unit = "ms";
  set.step      = 0.5;
  EXPECT_EQ(read("r.uff", uff(set)).rate, 2000);
  set.axis_unit = "s";
  set.step      = 5e-4;
  set.unit      = "m/s\xB2";  // Latin-1
  EXPECT_EQ(read("s.uff", uff(set)).channels[0].unit, "m/s2");
  set.unit     = "m/s2";
  set.function = 0;  // general, over a time
  EXPECT_EQ(read("t.uff", uff(set)).rate, 2000);
  set.axis_kind = 18;  // frequency
  set.axis      = "Frequency";
  set.axis_unit = "Hz";
  EXPECT_NE(refusal("u.uff", uff(set)).find("no data set 58 of this file is a real time response"),
            std::string::npos);
}

TEST_F(UffRecord, UnevenUniversalFilesAreReadInEveryWidth)
{
  for (const auto &[abscissa, ordinate, on_a_line] :
       {std::tuple("%13.5E", "%20.12E", 2), std::tuple("%20.12E", "%20.12E", 1),
        std::tuple("%20.12E", "%20.12E", 2), std::tuple("%20.12E", "%13.5E", 2)}) {
    UffSet set;
    set.numbers       = pairs(abscissa, ordinate, on_a_line);
    set.type          = 4;
    set.even          = 0;
    set.step          = 0;
    const auto record = read("r.uff", uff(set));
    EXPECT_TRUE(near(record.time[n - 1], (n - 1) / 2000.0, within(1e-5, "six digits"))) << abscissa << ordinate;
    EXPECT_TRUE(near(record.channels[0].value[1], -0.13, within(1e-5, "six digits"))) << abscissa << ordinate;
  }
}

TEST_F(UffRecord, BytesOfABinaryUniversalFileEndWithTheFile)
{
  const auto binary = [](const std::string &n_bytes, const std::size_t n_there) {
    UffSet set;
    set.entity      = "chock";
    set.numbers     = std::string(n_there, '\0') + "\n";
    std::string all = uff(set);
    return all.replace(all.find("    58\n"), 7,
                       "    58b     1     2          11" + std::string(12 - n_bytes.size(), ' ') + n_bytes + "\n");
  };
  const auto record = read("r.uff", binary("12000", 4 * n));
  ASSERT_EQ(record.n_samples(), n);
  EXPECT_EQ(record.channels[0].value[n - 1], 0);
  for (const auto &[written, shown] : {std::pair("1e300", "1e+300"), std::pair("inf", "inf")})
    EXPECT_EQ(refusal("s.uff", binary(written, 4)),
              "the file ends inside the " + std::string(shown) + " byte of numbers that follow here");
}

// The times of the first data set held for all of them.
TEST_F(UffRecord, ChannelsOfUniversalFilesHaveTheTimesOfTheFirst)
{
  const auto uneven = [](const double stretch, const double later) {
    UffSet set;
    set.numbers = pairs("%20.12E", "%20.12E", 2, stretch, later);
    set.type    = 4;
    set.even    = 0;
    set.step    = 0;
    return set;
  };
  const auto answer = [&](UffSet one, UffSet two, const ReadOptions &options = {}) {
    one.id1 = "one";
    two.id1 = "two";
    return refusal("r.uff", uff(one) + uff(two), options);
  };
  const std::string together = "; one file holds channels that were recorded together";
  EXPECT_EQ(answer(uneven(1, 0), uneven(1, 0)), "accepted");
  EXPECT_EQ(answer(uneven(1, 0), uneven(1.3, 0)), "'two' has other times than 'one' before it" + together);
  EXPECT_EQ(answer(uneven(1, 0), uneven(1, 0.4)),
            "'two' has other times than 'one' before it, it begins at 0.4 s and not at 0 s" + together);
  UffSet even;
  even.numbers = even_numbers();
  UffSet later = even, in_milliseconds = even;
  later.first               = 3;
  in_milliseconds.axis_unit = "ms";
  EXPECT_EQ(answer(even, even), "accepted");
  EXPECT_EQ(answer(even, later),
            "'two' has other times than 'one' before it, it begins at 3 s and not at 0 s" + together);
  EXPECT_EQ(answer(even, in_milliseconds), "'two' has other times than 'one' before it" + together);
  ReadOptions given;
  given.rate = 1000;
  EXPECT_EQ(answer(even, later, given), "accepted") << "who gives the rate says what holds";
}

// 1e300 as a code is a number that no integer holds.
TEST_F(UffRecord, CodesOfUniversalFilesMayBeAnyNumber)
{
  UffSet set;
  set.numbers      = even_numbers();
  std::string text = uff(set);
  for (const char *code : {"1e300", "-1e99", "  inf", "  nan"}) {
    text.replace(text.find("         0    0         0 NONE") - 5, 5, code);
    EXPECT_NE(refusal("r.uff", text).find("no data set 58 of this file is a real time response"),
              std::string::npos)
        << code;
  }
}
