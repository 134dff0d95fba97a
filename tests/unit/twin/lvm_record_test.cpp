// LabVIEW measurement files, made here line by line.
#include "tests/support/record_format_test.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
// Runs of 1500 samples without a column of times, each with its own step and start.
std::string lvm_runs(const std::string &time, const std::vector<std::pair<std::string, std::string>> &runs)
{
  std::string text =
      "LabVIEW Measurement\nX_Columns\tNo\nDate\t2026/03/14\nTime\t" + time + "\n***End_of_Header***\n";
  for (const auto &[start, step] : runs) {
    text += "Channels\t1\nY_Unit_Label\tg\nX0\t" + start + "\nDelta_X\t" + step +
            "\n***End_of_Header***\nX_Value\tchock\n";
    for (int i = 0; i < n / 2; ++i)
      text += "\t" + printed("%.6f", 0.01 * ((37 * i) % 101 - 50)) + "\n";
  }
  return text;
}

class LvmRecord : public RecordFormatTest {};
}  // namespace

TEST_F(LvmRecord, FilesOfLabViewAreRead)
{
  const auto lvm = [](const std::string &x_columns, const char decimal, const std::string &separator) {
    const std::string s = separator == "Comma" ? "," : "\t";
    std::string text    = "LabVIEW Measurement" + s + "\nWriter_Version" + s + "2\nSeparator" + s + separator +
                       "\nDecimal_Separator" + s + decimal + "\nX_Columns" + s + x_columns + "\nDate" + s +
                       "2026/03/14\nTime" + s + "10:00:00.123456789\n***End_of_Header***\n\nChannels" + s + "2" +
                       s + "\nSamples" + s + "3000" + s + "3000\nY_Unit_Label" + s + "g" + s + "kN\nX_Dimension" +
                       s + "Time" + s + "Time\nX0" + s + "0" + s + "0\nDelta_X" + s + "0.001" + s +
                       "0.001\n***End_of_Header***" + s + s + "\nX_Value" + s + "chock" + s + "force" + s +
                       "Comment\n";
    for (int i = 0; i < n; ++i) {
      std::string row = (x_columns == "No" ? "" : printed("%.6f", i / 1000.0)) + s +
                        printed("%.6f", 0.01 * ((37 * i) % 101 - 50)) + s + printed("%.6f", 1.5 * (i % 7));
      for (char &c : row)
        c = c == '.' ? decimal : c;
      text += row + "\n";
    }
    for (auto position = text.find("0.001"); decimal == ',' && position != std::string::npos;
         position      = text.find("0.001"))
      text.replace(position, 5, "0,001");
    return text;
  };
  for (const auto &[x_columns, decimal, separator] :
       {std::tuple("One", '.', "Tab"), std::tuple("No", '.', "Comma"), std::tuple("One", ',', "Tab")}) {
    const auto record = read("r.lvm", lvm(x_columns, decimal, separator));
    ASSERT_EQ(record.channels.size(), 2u) << x_columns;
    EXPECT_EQ(record.n_samples(), n);
    EXPECT_TRUE(near(record.find("chock")->value[1], -0.13 * g, within(1e-9, "six digits"))) << x_columns;
    EXPECT_TRUE(near(record.find("force")->value[1], 1500, within(1e-9, "six digits"))) << x_columns;
    EXPECT_TRUE(near(record.time.size() > 0 ? 1 / record.time[1] : record.rate, 1000, within(1e-9, "six digits")));
  }
}

TEST_F(LvmRecord, TimesOfLabViewMayHaveNoFraction)
{
  ReadOptions options;
  options.zone     = "UTC";
  const auto start = [&](const std::string &time) {
    return read("r.lvm", lvm_runs(time, {{"0", "0.001"}, {"0", "0.001"}}), options).start.value_or(0);
  };
  EXPECT_EQ(start("10:23:45"), 1773483825.0);  // date -u -d 2026-03-14T10:23:45Z +%s
  EXPECT_TRUE(near(start("10:23:45.123456789"), 1773483825.123456,
                   within_absolute(1e-6, "a double of 2e9 s resolves 2e-7 s")));
}

TEST_F(LvmRecord, RunsOfLabViewThatDoNotFollowEachOtherAreRefused)
{
  const auto answer = [&](const std::vector<std::pair<std::string, std::string>> &runs) {
    return refusal("r.lvm", lvm_runs("10:00:00", runs));
  };
  EXPECT_EQ(answer({{"0", "0.001"}, {"0", "0.001"}}), "accepted");
  EXPECT_EQ(answer({{"0", "0.001"}, {"1.5", "0.001"}}), "accepted");
  EXPECT_EQ(answer({{"0", "0.001"}, {"0", "5E-5"}}),
            "this run has a step of 5e-05 s, the one before it of 0.001 s; export each run as a file of its own");
  EXPECT_EQ(answer({{"0", "0.001"}, {"3600", "0.001"}}),
            "this run begins at 3600 s, where the one before it ends at 1.5 s, and no column says the times; "
            "export each run as a file of its own");
}

namespace {
// Two channels with a time each, of which the second has another step and start.
std::string two_clocks(const double step, const double start)
{
  std::string text =
      "LabVIEW Measurement\nX_Columns\tMulti\n***End_of_Header***\nChannels\t2\nY_Unit_Label\tg\tg\n"
      "Delta_X\t0.001\t0.001\n***End_of_Header***\nX_Value\tone\tX_Value\ttwo\n";
  for (int i = 0; i < n; ++i)
    text += printed("%.6f", i * 1e-3) + "\t" + printed("%.6f", swings()[std::size_t(i)]) + "\t" +
            printed("%.6f", start + i * step) + "\t" + printed("%.6f", i % 7) + "\n";
  return text;
}
}  // namespace

TEST_F(LvmRecord, ChannelsOfLabViewHaveOneClock)
{
  EXPECT_EQ(refusal("r.lvm", two_clocks(1e-3, 0)), "accepted");
  EXPECT_EQ(refusal("r.lvm", two_clocks(1e-3, 4e-4)), "accepted") << "read in turn, within a step";
  EXPECT_EQ(refusal("r.lvm", two_clocks(1e-3, 0.25)),
            "channel 2 has the time 0.25 s, channel 1 0 s; export channels that were recorded together");
  EXPECT_EQ(refusal("r.lvm", two_clocks(2e-3, 0)),
            "channel 2 has the time 0.002 s, channel 1 0.001 s; export channels that were recorded together");
  std::string starts = lvm_runs("10:00:00", {{"0\t0.5", "0.001\t0.001"}, {"0\t0.5", "0.001\t0.001"}});
  for (auto position = starts.find("Channels\t1"); position != std::string::npos;
       position      = starts.find("Channels\t1"))
    starts.replace(position, 10, "Channels\t2");
  EXPECT_EQ(refusal("r.lvm", starts),
            "channel 2 begins at 0.5 s, channel 1 0 s; export channels that were recorded together");
}
