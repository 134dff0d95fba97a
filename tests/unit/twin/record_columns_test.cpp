// What the columns of a text record are: time, channels, labels, and how their numbers are written.
#include "tests/support/near.h"
#include "tests/support/record_test.h"
#include "twin/cleaning/clean_record.h"
#include "twin/records/number_style.h"
#include "twin/records/time_zone.h"
#include <cmath>
#include <functional>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr int n = 3000;

// A vibration that is not a ramp, of four digits.
double swing(const int i)
{
  return 0.01 * ((37 * i) % 101 - 50);
}

using Cell = std::function<std::string(int)>;

std::string number(const double x, const int digits = 4)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

std::string with_comma(std::string text)
{
  for (char &c : text)
    c = c == '.' ? ',' : c;
  return text;
}

std::string table(const std::string &head, const std::vector<Cell> &columns, const char separator = ';')
{
  std::string text = head + "\n";
  for (int i = 0; i < n; ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += columns[c](i) + (c + 1 < columns.size() ? separator : '\n');
  return text;
}

const Cell time_cell  = [](const int i) { return number(i / 1000.0, 3); };
const Cell swing_cell = [](const int i) { return number(swing(i)); };

class RecordColumns : public RecordTest {};
const char *digits = "digits of the file";
}  // namespace

TEST_F(RecordColumns, AxesOfASensorAreChannelsAndTheTimeIsFoundByItsUnit)
{
  const auto record =
      read("r.csv", table("x [g];time [s];y [g];z [g]", {swing_cell, time_cell, swing_cell, swing_cell}));
  ASSERT_EQ(record.channels.size(), 3u);
  EXPECT_EQ(record.channels[0].name, "x");
  EXPECT_TRUE(near(record.time[n - 1], (n - 1) / 1000.0, within(1e-12, digits)));
  ReadOptions at_rate;
  at_rate.rate = 1000;
  EXPECT_EQ(read("s.csv", table("x [g];y [g]", {swing_cell, swing_cell}), at_rate).channels.size(), 2u);
}

TEST_F(RecordColumns, AUnitBehindTheNameOfTheTimeIsItsUnit)
{
  const Cell milliseconds = [](const int i) { return number(i, 0); };
  for (const char *name : {"time_ms", "timestamp_ms", "T_ms"}) {
    const auto record = read("r.csv", table(std::string(name) + ";a [g]", {milliseconds, swing_cell}));
    ASSERT_EQ(record.time.size(), n) << name;
    EXPECT_TRUE(near(record.time[n - 1], (n - 1) / 1000.0, within(1e-12, digits))) << name;
  }
  EXPECT_EQ(read("s.csv", table("time [s];chock_ms [g]", {time_cell, swing_cell})).channels[0].name, "chock_ms");
}

TEST_F(RecordColumns, AnAxisInSecondsOfAnOscilloscopeIsTheTime)
{
  const auto record = read("r.csv", table("x-axis [s];1 [V]", {time_cell, swing_cell}));
  EXPECT_EQ(record.channels.size(), 1u);
  EXPECT_EQ(record.time.size(), n);
}

TEST_F(RecordColumns, BlanksSeparateColumnsWhereNothingElseDoes)
{
  std::string text = "time[s]   a[g]\n";
  for (int i = 0; i < n; ++i)
    text += "  " + time_cell(i) + "    " + swing_cell(i) + "  \n";
  const auto record = read("r.asc", text);
  ASSERT_EQ(record.channels.size(), 1u);
  EXPECT_TRUE(near(record.time[n - 1], (n - 1) / 1000.0, within(1e-12, digits)));
}

TEST_F(RecordColumns, ATemperatureCalledTIsNotTheTime)
{
  const auto record = read("r.csv", table("t [\u00b0C];Laufzeit [ms];a [g]",
                                          {[](const int i) { return number(40 + swing(i)); },
                                           [](const int i) { return std::to_string(i); }, swing_cell}));
  ASSERT_NE(record.find("t"), nullptr);
  EXPECT_TRUE(near(record.time[1000], 1.0, within(1e-12, digits)));
}

TEST_F(RecordColumns, ACountOfSecondsThatStandsStillIsNotTheTime)
{
  const auto record =
      read("r.csv", table("cycle [ms];time [s];a [g]", {[](int) { return "0.25"; }, time_cell, swing_cell}));
  EXPECT_TRUE(near(record.time[500], 0.5, within(1e-12, digits)));
  EXPECT_NE(record.find("cycle"), nullptr);
}

TEST_F(RecordColumns, UnknownUnitsInARowOfUnitsAreNamedAndNotConverted)
{
  for (const std::string unit : {"A", "1/min", "Nm", "U/min", "l/min", "kWh", "m^3/h", "Anteil"}) {
    const auto record = read("r.csv", table("time;top;force;process\ns;m/s2;kN;" + unit,
                                            {time_cell, swing_cell, swing_cell, swing_cell}));
    ASSERT_EQ(record.channels.size(), 3u) << unit;
    EXPECT_EQ(record.channels[2].name, "process");
    EXPECT_EQ(record.channels[2].unit, unit);
    EXPECT_TRUE(near(record.channels[1].value[1], 1000 * swing(1), within(1e-12, digits))) << unit;
    EXPECT_TRUE(has_note(record, "process: unit '" + unit + "' not converted")) << unit;
  }
}

TEST_F(RecordColumns, RowsOfUnitsInWindowsCodeAreRead)
{
  const auto record =
      read("r.csv", table("Zeit\ttop\tKraft\ns\tm/s\xB2\tkN", {time_cell, swing_cell, swing_cell}, '\t'));
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.channels[0].unit, "m/s2");
  EXPECT_EQ(record.channels[1].unit, "N");
  EXPECT_TRUE(has_note(record, "Windows-1252"));
}

TEST_F(RecordColumns, AmericanUnitsBecomeSI)
{
  struct Case {
    const char *unit, *si;
    double factor;
  };
  for (const Case &c :
       {Case{"in/s", "m/s", 0.0254}, Case{"ips", "m/s", 0.0254}, Case{"in/s2", "m/s2", 0.0254},
        Case{"in/s^2", "m/s2", 0.0254}, Case{"in/s\u00b2", "m/s2", 0.0254}, Case{"mil", "m", 25.4e-6},
        Case{"mils", "m", 25.4e-6}, Case{"in", "m", 0.0254}, Case{"ft", "m", 0.3048},
        Case{"lbf", "N", 4.4482216152605}, Case{"psi", "Pa", 6894.757293168}, Case{"um", "m", 1e-6},
        Case{"mm/s", "m/s", 1e-3}, Case{"MPa", "Pa", 1e6}}) {
    const auto record = read("r.csv", table(std::string("time [s];v [") + c.unit + "]", {time_cell, swing_cell}));
    EXPECT_EQ(record.channels[0].unit, c.si) << c.unit;
    EXPECT_TRUE(near(record.channels[0].value[7], c.factor * swing(7), within(1e-9, digits))) << c.unit;
  }
}

TEST_F(RecordColumns, TextsAreLabelsOfSpans)
{
  for (const auto &pair : {std::pair("K20417", "K20418"), std::pair("OK", "OVERLOAD"), std::pair("TRUE", "FALSE"),
                           std::pair("4711", "K4712")}) {
    const auto record =
        read("r.csv", table("time [s];top [g];coil", {time_cell, swing_cell, [&](const int i) {
                                                        return std::string(i < 2000 ? pair.first : pair.second);
                                                      }}));
    ASSERT_EQ(record.channels.size(), 1u) << pair.first;
    ASSERT_EQ(record.labels.size(), 2u) << pair.first;
    EXPECT_EQ(record.labels[0].text, pair.first);
    EXPECT_EQ(record.labels[1].begin, 2000);
    EXPECT_EQ(record.labels[1].end, n);
    EXPECT_TRUE(has_note(record, "column 'coil' holds texts and was kept as labels")) << pair.first;
    const CleanRecord clean = clean_record(RawRecord(record));
    EXPECT_TRUE(near(clean.labels[1].from, 2.0, within(1e-9, digits)));
  }
}

TEST_F(RecordColumns, ALabelThatBeginsLateIsFoundInTheWholeColumn)
{
  const auto record = read("r.csv", table("time [s];top [g];coil", {time_cell, swing_cell, [](const int i) {
                                                                      return i < 1000
                                                                                 ? std::string()
                                                                                 : "K" + std::to_string(i / 1500);
                                                                    }}));
  ASSERT_EQ(record.labels.size(), 2u);
  EXPECT_EQ(record.labels[0].begin, 1000);
}

TEST_F(RecordColumns, ATextInAColumnWithAUnitIsRefused)
{
  EXPECT_EQ(refusal("r.csv",
                    table("time [s];top [g]",
                          {time_cell,
                           [](const int i) { return i == 2500 ? std::string("OVERLOAD") : number(swing(i)); }})),
            "'OVERLOAD' in column 'top' is not a number; leave the cell empty where there is no value");
}

TEST_F(RecordColumns, ThousandsAreToldFromDecimalsByTheWholeColumn)
{
  const auto grouped = [](const double x, const char group, const char decimal) {
    std::string text = number(x, 1);
    std::string out;
    const auto point = text.find('.');
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (i > 0 && i < point && (point - i) % 3 == 0)
        out += group;
      out += text[i] == '.' ? decimal : text[i];
    }
    return out;
  };
  const auto force        = [](const int i) { return 8.5e6 + 1000.5 * (i % 7); };
  const auto expect_force = [&](const RawRecord &record) {
    for (const int i : {0, 1, 59, 61, n - 1})
      EXPECT_TRUE(near(record.find("force")->value[i], force(i), within(1e-12, digits))) << i;
  };
  expect_force(read(
      "us.csv",
      table("time [s],top [g],force [N]",
            {time_cell, swing_cell, [&](const int i) { return '"' + grouped(force(i), ',', '.') + '"'; }}, ',')));
  expect_force(read(
      "de.csv", table("time [s];top [g];force [N]", {[](const int i) { return with_comma(number(i / 1000.0, 3)); },
                                                     [](const int i) { return with_comma(number(swing(i))); },
                                                     [&](const int i) { return grouped(force(i), '.', ','); }})));
  expect_force(read("ch.csv", table("time [s];top [g];force [N]", {time_cell, swing_cell, [&](const int i) {
                                                                     return grouped(force(i), '\'', '.');
                                                                   }})));
  expect_force(read("fr.csv",
                    table("time [s];top [g];force [N]", {time_cell, swing_cell, [&](const int i) {
                                                           std::string text = grouped(force(i), ' ', ',');
                                                           for (auto blank                        = text.find(' ');
                                                                blank != std::string::npos; blank = text.find(' '))
                                                             text.replace(blank, 1, "\u00a0");
                                                           return text;
                                                         }})));
}

TEST_F(RecordColumns, ACellFarBelowDecidesHowTheColumnIsRead)
{
  // 1,234 alone could be either; one cell in the middle has two separators
  const auto record =
      read("r.csv", table("time [s];force [N]", {time_cell, [](const int i) {
                                                   return i == 1700 ? std::string("1,234,567")
                                                                    : "1," + std::to_string(100 + i % 800);
                                                 }}));
  EXPECT_EQ(record.find("force")->value[0], 1100);
  EXPECT_EQ(record.find("force")->value[1700], 1234567);
  EXPECT_EQ(
      refusal("s.csv", table("time [s];force [N]",
                             {time_cell, [](const int i) { return std::string(i % 2 ? "1.234,5" : "12.5"); }})),
      "the numbers of column 'force' are written in two ways: '.' or ',' separates thousands in one cell and "
      "decimals in another; export it in one way");
}

TEST_F(RecordColumns, OtherColumnsDecideWhatAnAmbiguousCommaIs)
{
  const Cell ambiguous = [](const int i) { return "1," + std::to_string(100 + i % 800); };
  const auto points    = read("p.csv", table("time [s];top [g];force [N]", {time_cell, swing_cell, ambiguous}));
  EXPECT_EQ(points.find("force")->value[5], 1105);
  const auto commas = read("c.csv", table("time [s];top [g];force [N]",
                                          {[](const int i) { return with_comma(number(i / 1000.0, 3)); },
                                           [](const int i) { return with_comma(number(swing(i))); }, ambiguous}));
  EXPECT_TRUE(near(commas.find("force")->value[5], 1.105, within(1e-12, digits)));
  ReadOptions at_rate;
  at_rate.rate = 1000;
  EXPECT_TRUE(has_note(
      read("g.csv", table("force [N];nr", {ambiguous, [](const int i) { return std::to_string(i); }}), at_rate),
      "the comma was read as a decimal comma, because no cell of the file shows which of the two it is"));
}

TEST_F(RecordColumns, AmericanTimeStampsAreRead)
{
  const auto record = read("r.csv",
                           table("Timestamp,a [g]",
                                 {[](const int i) {
                                    char text[64];
                                    const int second = 43200 - 1 + i;  // over noon
                                    std::snprintf(text, sizeof text, "3/14/2026 %d:%02d:%02d %s",
                                                  second / 3600 % 12 == 0 ? 12 : second / 3600 % 12,
                                                  second / 60 % 60, second % 60, second < 43200 ? "AM" : "PM");
                                    return std::string(text);
                                  },
                                  swing_cell},
                                 ','),
                           {{}, "UTC"});
  EXPECT_EQ(record.time[n - 1], n - 1);
  EXPECT_EQ(*record.start, 1773489599.0);  // date -u -d '2026-03-14T11:59:59Z' +%s
  EXPECT_EQ(time_of_text("12:00:00 am")->local_seconds, 0);
  EXPECT_EQ(time_of_text("5/1/2026 1:02:03 p.m.")->local_seconds,
            time_of_text("2026-05-01 13:02:03")->local_seconds);
  EXPECT_EQ(time_of_text("13/05/2026 10:00:00")->local_seconds,
            time_of_text("2026-05-13 10:00:00")->local_seconds);
  EXPECT_FALSE(time_of_text("13:00:00 PM"));
  EXPECT_TRUE(has_two_readings("01/05/2026 10:00:00"));
}

TEST_F(RecordColumns, CountersRampsConstantsAndSetValuesAreDescribed)
{
  const auto raw =
      read("r.csv", table("nr;time [s];top [g];ramp [mm];level [bar];set [kN];bit;speed [m/s]",
                          {[](const int i) { return std::to_string(i); }, time_cell, swing_cell,
                           [](const int i) { return number(1e-3 * i * i, 3); }, [](int) { return "45"; },
                           [](const int i) { return std::to_string(100 + i / 1000); },
                           [](const int i) { return std::to_string(i / 3 % 2); }, [](int) { return "2.5"; }}));
  const CleanRecord clean = clean_record(RawRecord(raw));
  ASSERT_EQ(clean.described.size(), 5u);
  EXPECT_EQ(clean.described[0].sentence, "counter, step 1, from 0 to 2999");
  EXPECT_EQ(clean.described[1].kind, "ramp");
  EXPECT_EQ(clean.described[2].sentence, "constant, 4.5e+06 Pa");
  EXPECT_EQ(clean.described[3].kind, "set value");
  EXPECT_EQ(clean.described[4].kind, "switch");
  EXPECT_NE(clean.find("top"), nullptr);
  EXPECT_NE(clean.find("speed"), nullptr) << "a mill may run at one speed";
  EXPECT_EQ(clean.find("nr"), nullptr);
}

TEST_F(RecordColumns, ACounterThatBeginsAgainIsACounter)
{
  const auto raw =
      read("r.csv", table("time [s];top [g];nr;angle [deg]",
                          {time_cell, swing_cell, [](const int i) { return std::to_string(i % 1000); },
                           [](const int i) { return number(0.36 * (i % 1000), 2); }}));
  const CleanRecord clean = clean_record(RawRecord(raw));
  ASSERT_EQ(clean.described.size(), 2u);
  EXPECT_EQ(clean.described[0].sentence, "counter, step 1, from 0 to 999, with 2 other steps");
  EXPECT_EQ(clean.described[1].kind, "counter");
}

TEST_F(RecordColumns, NoVibrationIsTakenForACounter)
{
  // noise on a large offset, slow and fast sines, coarse quantisation
  for (const double offset : {0.0, 9e6})
    for (const double step : {1e-6, 0.1})
      for (const double turns : {0.003, 0.11, 0.45}) {
        RawChannel channel;
        channel.name  = "a";
        channel.value = Eigen::VectorXd(n);
        for (int i = 0; i < n; ++i)
          channel.value[i] = offset + step * std::round((std::sin(2 * M_PI * turns * i) + 0.3 * swing(i)) / step);
        EXPECT_FALSE(described(channel)) << offset << " " << step << " " << turns;
      }
}

TEST_F(RecordColumns, OptionsForColumnsThatAreNotThereAreRefused)
{
  ReadOptions options;
  options.units   = {{"stand_xs", "g"}};
  options.asked   = {"stand_xs"};
  const auto text = table("time [s];stand_ds;stand_os", {time_cell, swing_cell, swing_cell});
  EXPECT_EQ(refusal("r.csv", text, options),
            "there is no column 'stand_xs' in this record; its columns are 'stand_ds', 'stand_os'");
  options.asked = {"time"};
  options.units = {{"stand_ds", "g"}, {"time", "s"}};
  EXPECT_EQ(refusal("r.csv", text, options), "accepted");
}

TEST_F(RecordColumns, ImpossibleRatesAndValuesAreRefusedOrTakenAsMissing)
{
  ReadOptions fast;
  fast.rate = 1e19;
  EXPECT_EQ(refusal("r.csv", table("a [g]", {swing_cell}), fast),
            "--rate: 1e+19 samples per second are not possible; 0.001 to 1e+08 are read");
  EXPECT_NE(refusal("r.csv",
                    table("time [s];a [g]", {[](const int i) { return std::to_string(i) + "e-300"; }, swing_cell}))
                .find("samples per second are not possible"),
            std::string::npos);
  file("r.json", R"({"rate": 1e308, "units": {"a": "g"}})");
  EXPECT_NE(refusal("r.npy", "\x93NUMPY" + std::string("\1\0\x76\0", 4) +
                                 "{'descr': '<f8', 'fortran_order': False, 'shape': (3000,), }" +
                                 std::string(57, ' ') + "\n" + std::string(24000, '\0'))
                .find("samples per second are not possible"),
            std::string::npos);
  const auto record = read("v.csv", table("time [s];a [g]", {time_cell, [](const int i) {
                                                               return i == 7   ? std::string("1e300")
                                                                      : i == 8 ? "-1e30"
                                                                               : number(swing(i));
                                                             }}));
  EXPECT_TRUE(std::isnan(record.channels[0].value[7]) && std::isnan(record.channels[0].value[8]));
  EXPECT_TRUE(has_note(record, "a: 2 values are infinite or beyond 1e15 and taken as missing"));
}

TEST_F(RecordColumns, StepsThatNoGridHoldsAreRefused)
{
  const auto raw = read(
      "r.csv",
      table("time [s];a [g]",
            {[](const int i) { return i < n / 2 ? std::to_string(i) + "e-12" : std::to_string(i); }, swing_cell}));
  EXPECT_THROW(clean_record(RawRecord(raw)), InputError);
}

TEST_F(RecordColumns, ABinaryFileCalledCsvIsRefusedBeforeItFillsTheMemory)
{
  EXPECT_NE(refusal("r.csv", std::string(40 << 20, '\0')).find("this line is longer than 16 MiB"),
            std::string::npos);
  const std::string path = file("sparse.csv", "");
  std::filesystem::resize_file(path, std::uintmax_t(8) << 40);
  EXPECT_THROW(read_record(path, {}), InputError);
  const std::string mat = file("sparse.mat", "");
  std::filesystem::resize_file(mat, std::uintmax_t(8) << 40);
  try {
    read_record(mat, {});
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_NE(error.problems[0].message.find("has 8.8e+03 GB; reading it takes"), std::string::npos)
        << error.problems[0].message;
  }
}

TEST(NumberStyle, EveryStyleReadsWhatItWrites)
{
  double number = 0;
  EXPECT_TRUE(read_number("-1.234.567,5", {',', '.'}, number) && number == -1234567.5);
  EXPECT_FALSE(read_number("1.23.567,5", {',', '.'}, number));
  EXPECT_FALSE(read_number("0.123", {',', '.'}, number)) << "no group begins with 0";
  EXPECT_TRUE(read_number("\u2212"
                          "12,5",
                          {',', 0}, number) &&
              number == -12.5);
  EXPECT_EQ(styles_of("inf"), 0u);
  EXPECT_EQ(styles_of("12-"), 0u);
  EXPECT_EQ(styles_of("12"), every_style);
}
