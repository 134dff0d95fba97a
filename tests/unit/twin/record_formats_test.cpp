// Records in the formats of other programs, made here byte by byte, and the sentence for each that is refused.
#include "tests/support/near.h"
#include "tests/support/record_files.h"
#include "tests/support/record_test.h"
#include "twin/records/inflate.h"
#include <cmath>

using namespace mill;
using namespace mill::twin;
using namespace mill::record_files;

namespace {
constexpr int n = 3000;

std::vector<double> swings(const double scale = 1)
{
  std::vector<double> values(n);
  for (int i = 0; i < n; ++i)
    values[std::size_t(i)] = scale * 0.01 * ((37 * i) % 101 - 50);
  return values;
}

ReadOptions in_g(const std::vector<std::string> &columns)
{
  ReadOptions options;
  for (const std::string &column : columns) {
    options.units[column] = "g";
    options.asked.push_back(column);
  }
  return options;
}

constexpr double g       = 9.80665;  // m/s2
const char *doubles_kept = "doubles are kept to the last bit but for the factor of the unit";

class RecordFormats : public RecordTest {
protected:
  void expect_swing(const RawRecord &record, const std::string &name, const double scale = 1)
  {
    const RawChannel *channel = record.find(name);
    ASSERT_NE(channel, nullptr) << name;
    ASSERT_EQ(channel->value.size(), n);
    for (const int i : {0, 1, n - 1})
      EXPECT_TRUE(near(channel->value[i], scale * g * swings()[std::size_t(i)], within(1e-12, doubles_kept)));
  }
};

// Data set 58 in text.
struct UffSet {
  std::string id1 = "NONE", id5 = "NONE", entity = "NONE", unit = "m/s2", axis_unit = "s", axis = "Time";
  int node = 1, direction = 3, function = 1, axis_kind = 17;
  std::string numbers;
  int type = 2, even = 1;
  double step = 1e-3;
};

std::string uff(const UffSet &set)
{
  char head[400];
  std::snprintf(head, sizeof head, "%5d%10d%5d%10d %-10s%10d%4d %-10s%10d%4d\n%10d%10d%10d%13.5E%13.5E%13.5E\n",
                set.function, 0, 0, 0, set.entity.c_str(), set.node, set.direction, "NONE", 0, 0, set.type, n,
                set.even, 0.0, set.step, 0.0);
  const auto axis = [](const int kind, const std::string &label, const std::string &unit) {
    char line[200];
    std::snprintf(line, sizeof line, "%10d%5d%5d%5d %-20s %-20s\n", kind, 0, 0, 0, label.c_str(), unit.c_str());
    return std::string(line);
  };
  return "    -1\n    58\n" + set.id1 + "\nNONE\nNONE\nNONE\n" + set.id5 + "\n" + head +
         axis(set.axis_kind, set.axis, set.axis_unit) + axis(12, "Acceleration", set.unit) +
         axis(0, "NONE", "NONE") + axis(0, "NONE", "NONE") + set.numbers + "    -1\n";
}

std::string printed(const char *form, const double x)
{
  char text[64];
  std::snprintf(text, sizeof text, form, x);
  return text;
}

std::string even_numbers()
{
  std::string text;
  const auto values = swings();
  for (int i = 0; i < n; ++i)
    text += printed("%13.5E", values[std::size_t(i)]) + (i % 6 == 5 || i + 1 == n ? "\n" : "");
  return text;
}

// Pairs of time and value, so many on a line.
std::string pairs(const char *abscissa, const char *ordinate, const int on_a_line)
{
  std::string text;
  const auto values = swings();
  for (int i = 0; i < n; ++i)
    text += printed(abscissa, i / 2000.0) + printed(ordinate, values[std::size_t(i)]) +
            (i % on_a_line == on_a_line - 1 || i + 1 == n ? "\n" : "");
  return text;
}
}  // namespace

TEST_F(RecordFormats, CompressedVariablesOfMatlabAreRead)
{
  const auto record =
      read("r.mat", mat_file(mat_compressed(mat_array("a", swings())) + mat_compressed(mat_array("fs", {1000}))),
           in_g({"a"}));
  expect_swing(record, "a");
  EXPECT_EQ(record.rate, 1000);
}

TEST_F(RecordFormats, FieldsOfStructuresAreChannels)
{
  const std::string run = mat_structure("run", {{"a", mat_array("", swings())}, {"fs", mat_array("", {1000})}});
  expect_swing(read("r.mat", mat_file(run), in_g({"a"})), "a");
  // two structures with the same fields keep their names
  const std::string other = mat_structure("later", {{"a", mat_array("", swings())}});
  expect_swing(read("s.mat", mat_file(run + other), in_g({"run.a", "later.a"})), "later.a");
}

TEST_F(RecordFormats, ColumnsOfAMatrixAreChannels)
{
  auto both        = swings();
  const auto twice = swings(2);
  both.insert(both.end(), twice.begin(), twice.end());
  const std::string file = mat_file(mat_array("run", both, 2) + mat_array("fs", {1000}));
  const auto record      = read("r.mat", file, in_g({"run_1", "run_2"}));
  expect_swing(record, "run_1");
  expect_swing(record, "run_2", 2);
  EXPECT_TRUE(has_note(record, "the 2 columns of the matrix 'run' are called run_1 to run_2"));
  EXPECT_EQ(refusal("s.mat", file),
            "no column of this record has a known unit; its columns are 'run_1', 'run_2'; name "
            "the units, for example: millstand analyse s.mat --unit run_1=g --unit run_2=g");
}

TEST_F(RecordFormats, XYAndZWithARateAreAxesOfASensor)
{
  const auto record =
      read("r.mat", mat_file(mat_array("x", swings()) + mat_array("y", swings()) + mat_array("fs", {1000})),
           in_g({"x", "y"}));
  EXPECT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.rate, 1000);
}

TEST_F(RecordFormats, TheSamplingRateIsOneOfItsNamesAndRateAloneIsNot)
{
  const auto rate_of = [&](const std::vector<std::pair<std::string, double>> &numbers) {
    std::string variables = mat_array("a", swings());
    for (const auto &[name, value] : numbers)
      variables += mat_array(name, {value});
    return read("r.mat", mat_file(variables), in_g({"a"})).rate;
  };
  for (const char *name : {"Fs", "fs", "sr", "SR", "SampleRate", "sample_rate", "SamplingRate", "fs_Hz"})
    EXPECT_EQ(rate_of({{name, 2048}}), 2048) << name;
  for (const char *name : {"dt", "Ts", "ts", "delta_t", "SampleTime"})
    EXPECT_EQ(rate_of({{name, 1.0 / 2048}}), 2048) << name;
  EXPECT_EQ(rate_of({{"sr", 2048}, {"rate", 16.5}, {"load", 150}}), 2048);
  EXPECT_EQ(rate_of({{"rate", 1500}, {"Fs", 2048}, {"dt", 1.0 / 2048}}), 2048);
  const auto refused = [&](const std::string &variables) {
    return refusal("r.mat", mat_file(mat_array("a", swings()) + variables), in_g({"a"}));
  };
  EXPECT_EQ(
      refused(mat_array("Fs", {2048}) + mat_array("SampleRate", {4096})),
      "r.mat: the sampling rate is 2048 Hz by 'Fs' = 2048 and 4096 Hz by 'SampleRate' = 4096, which disagree; say "
      "which one is right: millstand analyse r.mat --rate 2048");
  EXPECT_EQ(
      refused(mat_array("rate", {16.5})),
      "r.mat: the sampling rate is missing: there is neither a vector 'time' in seconds nor a number Fs, sr, "
      "SampleRate, dt or Ts, and 'rate' = 16.5 is not taken for it; the vectors are 'a'; give the samples per "
      "second: millstand analyse r.mat --rate 20000");
  std::vector<double> times(n);
  for (int i = 0; i < n; ++i)
    times[std::size_t(i)] = i / 2000.0;
  EXPECT_EQ(refused(mat_array("t", times) + mat_array("Fs", {1000})),
            "r.mat: the sampling rate is 1000 Hz by 'Fs' = 1000 and 2000 Hz by the step of 't', which disagree; "
            "say which "
            "one is right: millstand analyse r.mat --rate 1000");
}

TEST_F(RecordFormats, AClockWithoutANameIsPointedOutWhereTheRateIsMissing)
{
  std::vector<double> both(2 * n);
  for (int i = 0; i < n; ++i) {
    both[std::size_t(i)]     = i / 2000.0;
    both[std::size_t(n + i)] = swings()[std::size_t(i)];
  }
  ReadOptions options = in_g({"data_2"});
  EXPECT_EQ(refusal("r.mat", mat_file(mat_array("data", both, 2)), options),
            "r.mat: the sampling rate is missing; 'data_1' rises by the same step from sample to sample: if it is "
            "the time "
            "in seconds, millstand analyse r.mat --unit data_1=s, else give the samples per second with --rate");
  options.units["data_1"] = "s";
  EXPECT_EQ(read("s.mat", mat_file(mat_array("data", both, 2)), options).time[2000], 1.0);
}

TEST_F(RecordFormats, ArchivesOfNumpyAreRead)
{
  const std::string archive = zip({{"a.npy", npy(swings(), "(3000,)")},
                                   {"fs.npy", npy({1000}, "()")},
                                   {"both.npy", npy(std::vector<double>(6000, 1), "(3000, 2)")}});
  const auto record         = read("r.npz", archive, in_g({"a"}));
  expect_swing(record, "a");
  EXPECT_EQ(record.rate, 1000);
  EXPECT_NE(record.find("both_2"), nullptr);
  file("s.json", R"({"rate": 500, "units": {"a": "g"}})");
  EXPECT_EQ(read("s.npz", zip({{"a.npy", npy(swings(), "(3000,)")}})).rate, 500);
  EXPECT_EQ(refusal("t.npz", archive.substr(0, 1000)),
            "t.npz is not a whole zip archive; it was cut off while it was written or copied");
}

// t_ms of 0, 1, 2 .. once gave a rate of 1 Hz.
TEST_F(RecordFormats, AUnitBehindTheNameOfATimeIsItsUnit)
{
  std::vector<double> milliseconds(3000);
  for (std::size_t i = 0; i < milliseconds.size(); ++i)
    milliseconds[i] = double(i);
  const auto record =
      read("r.npz", zip({{"a.npy", npy(swings(), "(3000,)")}, {"t_ms.npy", npy(milliseconds, "(3000,)")}}),
           in_g({"a"}));
  EXPECT_TRUE(near(record.time[2999], 2.999, within(1e-12, "whole milliseconds, rounded once")));
}

TEST_F(RecordFormats, SoundFilesHaveAScale)
{
  std::vector<int> samples(n);
  for (int i = 0; i < n; ++i)
    samples[std::size_t(i)] = (37 * i) % 101 - 50;
  const std::string file = wav(48000, {samples, samples});
  ReadOptions scaled;
  scaled.scales[""] = "50 mV/g";
  const auto record = read("r.wav", file, scaled);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.rate, 48000);
  EXPECT_TRUE(near(record.find("ch2")->value[1], (37 - 50) / 32768.0 / 0.05 * g, within(1e-12, doubles_kept)));
  EXPECT_TRUE(has_note(record, "full scale of the file was taken as 1 V"));
  scaled.scales[""] = "20 g";
  EXPECT_TRUE(near(read("s.wav", file, scaled).find("ch1")->value[0], -50 / 32768.0 * 20 * g,
                   within(1e-12, doubles_kept)));
  EXPECT_EQ(refusal("t.wav", file),
            "t.wav holds 2 channels (ch1 to ch2) in units of full scale; say what they mean, for "
            "example: millstand analyse t.wav --scale '50 mV/g'");
  scaled.scales[""] = "50 mV per g";
  EXPECT_EQ(refusal("u.wav", file, scaled), "--scale \"50 mV per g\" is not a sensitivity; write for example "
                                            "--scale \"50 mV/g\", --scale \"10 g/V\", or "
                                            "what full scale stands for, --scale \"20 g\"");
}

TEST_F(RecordFormats, VoltagesOfAnyFormatTakeAScale)
{
  std::string text = "time [s],a [mV],b [g]\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(i) + "e-3," + std::to_string((37 * i) % 101) + "," + std::to_string(i % 13) + "\n";
  ReadOptions scaled;
  scaled.scales["a"] = "100 mV/g";
  const auto record  = read("r.csv", text, scaled);
  EXPECT_TRUE(near(record.find("a")->value[1], 0.37 * g, within(1e-12, doubles_kept)));
  EXPECT_TRUE(near(record.find("b")->value[1], g, within(1e-12, doubles_kept)));
}

TEST_F(RecordFormats, FilesOfLabViewAreRead)
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

TEST_F(RecordFormats, ChannelsOfUniversalFilesHaveDistinctNames)
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

TEST_F(RecordFormats, UniversalFilesSayTheUnitOfTheirTimeAndTheirValues)
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

TEST_F(RecordFormats, UnevenUniversalFilesAreReadInEveryWidth)
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

// Three numbers in a field make a row longer than its field names say.
TEST_F(RecordFormats, FieldsOfSeveralNumbersInArraysOfNumpyAreRefused)
{
  std::string head =
      "{'descr': [('t', '<f8'), ('a [g]', '<f4', (3,))], 'fortran_order': False, 'shape': (3000,), }";
  head.resize(117, ' ');
  const std::string array =
      "\x93NUMPY" + std::string("\1\0\x76\0", 4) + head + "\n" + std::string(3000 * (8 + 3 * 4), '\1');
  const std::string reason = "holds several numbers in one field of a structured array; save a field for each";
  file("r.json", R"({"rate": 1000})");
  EXPECT_EQ(refusal("r.npy", array), "r.npy " + reason);
  // an archive is read without it
  const std::string archive =
      zip({{"a.npy", npy(swings(), "(3000,)")}, {"fs.npy", npy({1000}, "()")}, {"run.npy", array}});
  EXPECT_EQ(refusal("s.npz", archive, in_g({"a"})), "accepted");
  EXPECT_NE(refusal("s.npz", archive, in_g({"a", "run.t"})), "accepted");
}

TEST_F(RecordFormats, BytesOfABinaryUniversalFileEndWithTheFile)
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

TEST_F(RecordFormats, SoundFilesOfMoreThan4GiBSayTheirSizeElsewhere)
{
  const std::string usual = wav(48000, {std::vector<int>(n, 7)});
  const std::string form = usual.substr(12, 24), samples = usual.substr(44);
  const std::string behind = "LIST" + little(400, 4) + std::string(400, 'x');
  const auto large         = [&](const std::size_t size) {
    const std::string chunks = "WAVEds64" + little(28, 4) + little(72 + size + behind.size(), 8) +
                               little(size, 8) + little(n, 8) + little(0, 4) + form + "data" +
                               little(0xFFFFFFFF, 4);
    return "RF64" + little(0xFFFFFFFF, 4) + chunks + samples + behind;
  };
  ReadOptions scaled;
  scaled.scales[""] = "1 g/V";
  const auto record = read("r.wav", large(samples.size()), scaled);
  EXPECT_EQ(record.n_samples(), n);
  EXPECT_FALSE(has_note(record, "the head says more samples than the file holds"));
  EXPECT_EQ(record.channels[0].value.minCoeff(), record.channels[0].value.maxCoeff());
  // a recorder that was switched off has not written the size yet
  EXPECT_TRUE(has_note(read("s.wav", large(0), scaled), "the head says more samples than the file holds"));
}

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
}  // namespace

TEST_F(RecordFormats, TimesOfLabViewMayHaveNoFraction)
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

TEST_F(RecordFormats, RunsOfLabViewThatDoNotFollowEachOtherAreRefused)
{
  const auto answer = [&](const std::vector<std::pair<std::string, std::string>> &runs) {
    return refusal("r.lvm", lvm_runs("10:00:00", runs));
  };
  EXPECT_EQ(answer({{"0", "0.001"}, {"0", "0.001"}}), "accepted");
  EXPECT_EQ(answer({{"0", "0.001"}, {"1.5", "0.001"}}), "accepted");
  EXPECT_EQ(answer({{"0", "0.001"}, {"0", "5E-5"}}),
            "this run has a step of 5e-05 s, the one before it of 0.001 s, and no column says the times; export "
            "each run as a file of its own, or with X_Columns One");
  EXPECT_EQ(answer({{"0", "0.001"}, {"3600", "0.001"}}),
            "this run begins at 3600 s, where the one before it ends at 1.5 s, and no column says the times; "
            "export each run as a file of its own, or with X_Columns One");
}

TEST_F(RecordFormats, NamesThatAreNotUtf8AreMadeValidInEveryFormat)
{
  const auto expect_name = [&](const RawRecord &record) { EXPECT_EQ(record.channels[0].name, "Kr\u00e4fte"); };
  ReadOptions options    = in_g({"Kr\u00e4fte"});
  expect_name(read("r.mat",
                   mat_file(mat_array("Kr\xE4"
                                      "fte",
                                      swings()) +
                            mat_array("fs", {1000})),
                   options));
  expect_name(read("r.npz",
                   zip({{"Kr\xE4"
                         "fte.npy",
                         npy(swings(), "(3000,)")},
                        {"fs.npy", npy({1000}, "()")}}),
                   options));
  UffSet set;
  set.numbers = even_numbers();
  set.id1     = "Kr\xE4"
                "fte";
  expect_name(read("r.uff", uff(set), options));
  std::string text = "Zeit [s];Kr\xE4"
                     "fte [kN]\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(i) + "e-3;" + std::to_string((37 * i) % 101) + "\n";
  const auto record = read("Walzger\xFC"
                           "st.csv",
                           text);
  expect_name(record);
  EXPECT_EQ(record.file, folder + "/Walzger\u00fcst.csv");
}

TEST_F(RecordFormats, ArchivesThatUnpackWithoutEndAreRefused)
{
  const std::string million(1 << 20, 'a');
  EXPECT_EQ(inflated(zlib_stream(million), Deflated::zlib, million.size()).value_or(""), million);
  EXPECT_FALSE(inflated(zlib_stream(million), Deflated::zlib, 1000)) << "more than was announced";
  EXPECT_FALSE(inflated(zlib_stream(million), Deflated::zlib, 2 << 20)) << "less than was announced";
  EXPECT_FALSE(inflated("\x78\x01nonsense", Deflated::zlib, 10));
  // a variable that announces 4 GiB and holds nothing
  const std::string packed = zlib_stream(little(14, 4) + little(0xFFFFFFF0, 4) + "short");
  EXPECT_NE(refusal("r.mat", mat_file(little(15, 4) + little(packed.size(), 4) + packed)), "accepted");
}

// Hostile bytes: whatever a file holds, it is read or refused, and what is read is valid UTF-8.
TEST_F(RecordFormats, DamagedFilesOfEveryFormatAreReadOrRefused)
{
  UffSet set;
  set.numbers     = even_numbers();
  std::string csv = "time [s];a [g];coil\n",
              lvm = "LabVIEW Measurement\nX_Columns\tOne\n***End_of_Header***\nChannels\t1\n"
                    "Delta_X\t0.001\n***End_of_Header***\nX_Value\tchock\n";
  for (int i = 0; i < n; ++i) {
    csv += std::to_string(i) + "e-3;" + std::to_string((37 * i) % 101) + ";K" + std::to_string(i / 1000) + "\n";
    lvm += std::to_string(i) + "e-3\t" + std::to_string((37 * i) % 101) + "\n";
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {"d.mat", mat_file(mat_structure("run", {{"a", mat_array("", swings())}, {"fs", mat_array("", {1000})}}))},
      {"e.mat", mat_file(mat_compressed(mat_array("a", swings())))},
      {"d.npz", zip({{"a.npy", npy(swings(), "(3000,)")}, {"fs.npy", npy({1000}, "()")}})},
      {"d.wav", wav(1000, {std::vector<int>(n, 7)})},
      {"d.uff", uff(set)},
      {"d.csv", csv},
      {"d.lvm", lvm}};
  std::uint64_t state = 20261127;
  const auto random   = [&](const std::uint64_t below) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state % below;
  };
  int read_ones = 0, refused = 0;
  for (const auto &[name, whole] : files)
    for (int i = 0; i < 60; ++i) {
      std::string bytes = whole;
      for (std::uint64_t k = 0; k <= random(6); ++k)  // most of them in the head
        bytes[random(random(2) ? std::min<std::size_t>(bytes.size(), 400) : bytes.size())] = char(random(256));
      if (random(4) == 0)
        bytes.resize(random(bytes.size()) + 1);
      ReadOptions options;
      options.scales[""] = "50 mV/g";
      if (random(2))
        options.rate = 1000;
      try {
        const auto record = read(name, bytes, options);
        EXPECT_GE(record.n_samples(), 2048);
        ++read_ones;
      } catch (const InputError &) {
        ++refused;
      }
    }
  EXPECT_EQ(read_ones + refused, int(60 * files.size()));
  EXPECT_GT(read_ones, 40);
  EXPECT_GT(refused, 40);
}
