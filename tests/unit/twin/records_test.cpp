// Records as other programs write them (tests/reference/records, ORIGIN.md), and each way in which one is wrong.
#include "tests/support/near.h"
#include "twin/records/raw_record.h"
#include "twin/records/time_zone.h"
#include <cstring>
#include <filesystem>
#include <fstream>

using namespace mill;
using namespace mill::twin;

namespace {
const std::string samples = MILLSTAND_SOURCE_DIR "/tests/reference/records/";
constexpr double g        = 9.80665;  // m/s2

// The two channels of make_samples.py.
double force_at(const int i)
{
  return 1e3 * (976.2 + 0.1 * (i % 7));
}
double acceleration_at(const int i)
{
  return g * 0.01 * ((37 * i) % 101 - 50);
}

void expect_sample(const RawRecord &record, const std::string &force, const std::string &acceleration,
                   const double tolerance, const double force_scale = 1, const double acceleration_scale = 1)
{
  const RawChannel *f = record.find(force), *a = record.find(acceleration);
  ASSERT_TRUE(f && a) << record.file;
  ASSERT_EQ(f->value.size(), 40) << record.file;
  ASSERT_EQ(a->value.size(), 40) << record.file;
  for (int i = 0; i < 40; ++i) {
    EXPECT_TRUE(near(f->value[i], force_scale * force_at(i), within(tolerance, "digits of the file")))
        << record.file;
    EXPECT_TRUE(near(a->value[i], acceleration_scale * acceleration_at(i),
                     within(tolerance, "digits of the file", 5 * acceleration_scale)))
        << record.file;
  }
  if (record.time.size() > 0)
    for (int i = 0; i < 40; ++i)
      EXPECT_TRUE(near(record.time[i], i / 20000.0, within_absolute(1e-9, "digits of the file: a nanosecond")))
          << record.file;
  else
    EXPECT_DOUBLE_EQ(record.rate, 20000) << record.file;
}

class Records : public testing::Test {
protected:
  std::string folder = testing::TempDir() + "millstand_records_test";
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
  std::string file(const std::string &name, const std::string &text)
  {
    std::ofstream(folder + "/" + name, std::ios::binary) << text;
    return folder + "/" + name;
  }
  RawRecord csv(const std::string &text, const ReadOptions &options = {})
  {
    return read_csv_record(file("r.csv", text), options);
  }
  /// "line:column: message" of the refusal, the folder left out.
  std::string refusal(const std::string &name, const std::string &text, const ReadOptions &options = {})
  {
    const std::string path = file(name, text);
    try {
      read_record(path, options);
    } catch (const InputError &error) {
      const Place &place = error.problems.at(0).place;
      std::string message =
          (place.line > 0 ? std::to_string(place.line) + ":" + std::to_string(place.column) + ": " : "") +
          error.problems.at(0).message;
      for (auto position = message.find(folder + "/"); position != std::string::npos;
           position      = message.find(folder + "/"))
        message.erase(position, folder.size() + 1);
      return message;
    }
    return "accepted";
  }
  std::string rows(const std::string &head, const int n = 2100)
  {
    std::string text = head + "\n";
    for (int i = 0; i < n; ++i)
      text += std::to_string(i) + "e-4," + std::to_string(i % 13) + "\n";
    return text;
  }
};
}  // namespace

TEST_F(Records, CsvOfOtherPrograms)
{
  expect_sample(read_csv_record(samples + "numpy-savetxt.csv", {}), "force", "upper_work_roll", 1e-12);
  expect_sample(read_csv_record(samples + "spreadsheet-english.csv", {}), "force", "upper_work_roll", 1e-12);
  expect_sample(read_csv_record(samples + "spreadsheet-german.csv", {}), "force", "upper_work_roll", 1e-12);
  ReadOptions german;
  german.channels = {{"Kraft", "force"}, {"Beschleunigung", "upper_work_roll"}};
  for (const char *name : {"excel-german-1252.csv", "excel-unicode.txt"})
    expect_sample(read_csv_record(samples + name, german), "force", "upper_work_roll", 2e-6);
}

TEST_F(Records, OscilloscopesCountVolts)
{
  expect_sample(read_csv_record(samples + "oscilloscope-tektronix.csv", {}), "CH1", "CH2", 6e-6, 1e-6, 1 / g);
  const RawRecord keysight = read_csv_record(samples + "oscilloscope-keysight.csv", {});
  expect_sample(keysight, "1", "2", 6e-6, 1e-6, 1 / g);
  EXPECT_EQ(keysight.channels[0].quantity, Quantity::voltage);
  ASSERT_FALSE(keysight.notes.empty());
  EXPECT_EQ(keysight.notes[0], "units were taken from line 2, below the names");
  ReadOptions calibrated;
  calibrated.units = {{"2", "g"}};
  EXPECT_TRUE(near(read_csv_record(samples + "oscilloscope-keysight.csv", calibrated).find("2")->value[1],
                   acceleration_at(1), within_absolute(1e-4, "digits of the file")));
}

TEST_F(Records, ArraysOfNumpy)
{
  const RawRecord record = read_npy_record(samples + "numpy-structured.npy", {});
  expect_sample(record, "force", "upper_work_roll", 6e-8);  // float32
  ASSERT_TRUE(record.start);
  EXPECT_EQ(*record.start, 1767607200.0);  // date -u -d 2026-01-05T10:00:00Z +%s
  expect_sample(read_npy_record(samples + "numpy-big-endian.npy", {}), "force", "upper_work_roll", 1e-15);
  expect_sample(read_npy_record(samples + "numpy-fortran.npy", {}), "force", "upper_work_roll", 1e-15);
}

TEST_F(Records, UniversalFiles)
{
  for (const char *name : {"uff58-text.uff", "uff58b-little.uff", "uff58b-big.uff"})
    expect_sample(read_uff_record(samples + name, {}), "force", "upper_work_roll", 1e-11);
}

TEST_F(Records, MatlabFiles)
{
  ReadOptions options;
  options.units          = {{"force", "kN"}, {"upper_work_roll", "g"}};
  const RawRecord record = read_mat_record(samples + "scipy-v5.mat", options);
  expect_sample(record, "force", "upper_work_roll", 1e-14);
  EXPECT_EQ(record.channels.size(), 2u) << "the text and the matrix are not channels";
  expect_sample(read_mat_record(samples + "scipy-compressed.mat", options), "force", "upper_work_roll", 1e-14);
}

TEST_F(Records, TimesInSeveralForms)
{
  const auto third = [&](const std::string &text, const ReadOptions &options = {}) {
    const RawRecord record = csv(text, options);
    EXPECT_EQ(record.time.size(), 3) << text;
    return record.time[2];
  };
  EXPECT_TRUE(near(third("t [ms];a [g]\n100,0;1\n100,5;2\n101,0;3\n"), 1e-3,
                   within_absolute(1e-12, "rounding of a time in s")));
  EXPECT_TRUE(
      near(third("a [g],Time (us)\n1,0\n2,50\n3,100\n"), 1e-4, within_absolute(1e-15, "rounding of a time in s")));
  EXPECT_TRUE(near(third("time,a [g]\n2026-01-05T10:00:00Z,1\n2026-01-05T10:00:00.5Z,2\n2026-01-05T10:00:01Z,3\n"),
                   1, within_absolute(0, "exact: whole seconds and binary fractions")));
  EXPECT_TRUE(near(
      third("Zeitstempel;a [g]\n05.01.2026 10:00:00,25;1\n05.01.2026 10:00:00,5;2\n05.01.2026 10:00:00,75;3\n",
            {{}, "Europe/Berlin"}),
      0.5, within_absolute(0, "exact: whole seconds and binary fractions")));
  EXPECT_TRUE(near(
      third("Date,Time,a [g]\n2026-01-05,23:59:59,1\n2026-01-06,00:00:00,2\n2026-01-06,00:00:01,3\n", {{}, "UTC"}),
      2, within_absolute(0, "exact: whole seconds and binary fractions")));
  const RawRecord dated = csv("time,a [g]\n2026-01-05T11:00:00+01:00,1\n2026-01-05T11:00:01+01:00,2\n");
  ASSERT_TRUE(dated.start);
  EXPECT_EQ(*dated.start, 1767607200.0);
}

TEST_F(Records, LocalTimesOfSummerAndWinter)
{
  const TimeZone berlin("Europe/Berlin", "/usr/share/zoneinfo");
  // date -u -d ... +%s: clocks go forward on 2026-03-29 at 01:00 UTC and back on 2026-10-25 at 01:00 UTC
  const auto winter = time_of_text("2026-01-05T11:00:00"), skipped = time_of_text("2026-03-29 02:30:00"),
             twice = time_of_text("25.10.2026 02:30:00"), summer = time_of_text("2026/07/01 12:00");
  ASSERT_TRUE(winter && skipped && twice && summer);
  EXPECT_EQ(berlin.utc_of(winter->local_seconds), std::vector<std::int64_t>{1767607200});
  EXPECT_TRUE(berlin.utc_of(skipped->local_seconds).empty());
  EXPECT_EQ(berlin.utc_of(twice->local_seconds).size(), 2u);
  EXPECT_EQ(berlin.utc_of(summer->local_seconds), std::vector<std::int64_t>{1782900000});
  EXPECT_FALSE(time_of_text("01/05/2026 10:00:00")) << "May or January";
  EXPECT_FALSE(time_of_text("2026-02-30T10:00:00"));
}

// Counts near 2^32 in the head of a file of rules, of which lengths wrap around.
TEST_F(Records, AFileOfTimeZonesWithCountsLargerThanItselfIsRefused)
{
  const std::string folder = testing::TempDir();
  std::string bytes        = "TZif2" + std::string(39, '\0');
  for (std::size_t i = 20; i < 44; ++i)
    bytes[i] = char(i % 4 == 3 ? 0xF0 : 0xFF);
  std::ofstream(folder + "/damaged_zone", std::ios::binary) << bytes << bytes;
  EXPECT_THROW(TimeZone("damaged_zone", folder), InputError);
  std::filesystem::remove(folder + "/damaged_zone");
}

TEST_F(Records, WhatIsMissingIsNoNumber)
{
  const RawRecord record = csv("time [s];a [g];b [mm/s]\n0;1;\n0,1;NaN;2\n0,2;;n/a\n0,3;4;3");
  ASSERT_EQ(record.n_samples(), 4);
  EXPECT_TRUE(std::isnan(record.find("a")->value[1]));
  EXPECT_TRUE(std::isnan(record.find("a")->value[2]));
  EXPECT_TRUE(std::isnan(record.find("b")->value[0]));
  EXPECT_DOUBLE_EQ(record.find("b")->value[1], 2e-3);
  EXPECT_EQ(record.find("b")->quantity, Quantity::velocity);
}

TEST_F(Records, ALastLineThatIsCutOffIsSaid)
{
  const RawRecord record = csv("time [s],a [g],b [g]\n0,1,2\n0.1,3,4\n0.2,5");
  EXPECT_EQ(record.n_samples(), 2);
  EXPECT_EQ(record.notes.back(), "line 4, the last, is cut off and was not used");
}

TEST_F(Records, LinesMayEndWithACarriageReturnAlone)
{
  const RawRecord record = csv("time [s],a [g]\r0,1\r0.1,3\r0.2,5\r");
  ASSERT_EQ(record.n_samples(), 3);
  EXPECT_DOUBLE_EQ(record.find("a")->value[2], record.find("a")->value[0] * 5);
}

// Bad input of section 1, word for word.
TEST_F(Records, RefusalsOfCsv)
{
  EXPECT_EQ(refusal("r.csv", ""),
            "1:1: the file is empty; a line such as \"time [s], force [kN], upper_work_roll [g]\" "
            "and numbers are needed");
  EXPECT_EQ(
      refusal("r.csv", rows("time [s],level")),
      "1:10: no column of this record has a known unit; its columns are 'level'; write the unit behind the name, "
      "for example \"upper_work_roll [g]\", or: millstand analyse r.csv --unit level=g");
  EXPECT_EQ(refusal("r.csv", rows("time [s],a [g]", 100)),
            "1:1: the record has 100 samples; at least 2048 are needed for a spectrum");
  EXPECT_EQ(refusal("r.csv", "time [s],a [g]\n0,1\n0.2,2\n0.1,3\n"),
            "4:1: the time goes backwards here, by 0.1 s; sort the lines by time, or split the file where the "
            "recorder started again");
  EXPECT_EQ(refusal("r.csv", "time [s],a [g],a [g]\n0,1,1\n0.2,2,2\n"),
            "1:16: the channel 'a' appears twice in this record; rename one of the two columns");
  EXPECT_EQ(
      refusal("r.csv", "a [g],b [g]\n0,1\n0.2,2\n"),
      "1:1: no column holds the time; the columns are 'a', 'b'; name one, for example \"time [s]\", or give the "
      "samples per second: millstand analyse r.csv --rate 20000");
  EXPECT_EQ(refusal("r.csv", "time,a [g]\n0,1\n0.2,2\n"),
            "1:1: column 'time' has no unit; write for example \"time [s]\", or: millstand analyse r.csv --unit "
            "time=s");
  EXPECT_EQ(
      refusal("r.csv", "time [mm],a [g]\n0,1\n0.2,2\n"),
      "1:1: column 'time' has the unit 'mm'; a time in s, ms, us, min or h is needed, or the samples per second: "
      "millstand analyse r.csv --rate 20000");
  EXPECT_EQ(
      refusal("r.csv", "0,1\n0.2,2\n"),
      "1:1: the columns have no names; put a line such as \"time [s], force [kN], upper_work_roll [g]\" before "
      "the numbers");
  EXPECT_EQ(refusal("r.csv", "some text\nmore text\n"), "1:1: no row of numbers among the first 2 lines; columns "
                                                        "are separated by ';', tab, ',' or blanks; a decimal "
                                                        "comma needs one of the first two");
  EXPECT_EQ(refusal("r.csv", "time [s],a [g]\n0,1\n0.2,2\n0.3,overload\n"),
            "4:5: 'overload' in column 'a' is not a number; leave the cell empty where there is no value");
  EXPECT_EQ(refusal("r.csv", "time [s],a [g]\n0,1\n0.2,2\n0,3,3\n0.4,1\n"),
            "4:1: this line has 3 cells, the columns are 2; a decimal comma needs ';' or tab between the columns");
  EXPECT_EQ(refusal("r.csv", "time,a [g]\n2026-01-05T10:00:00,1\n2026-01-05T10:00:01,2\n"),
            "2:1: the time '2026-01-05T10:00:00' has no offset from UTC; write it with one, for example "
            "2026-01-05T10:00:00+01:00, or name its zone with --zone Europe/Berlin");
  EXPECT_EQ(
      refusal("r.csv", "time,a [g]\n2026-10-25T02:30:00,1\n2026-10-25T02:30:01,2\n", {{}, "Europe/Berlin"}),
      "2:1: the clocks of Europe/Berlin show the time '2026-10-25T02:30:00' twice (summer time ends); write the "
      "times with their offset from UTC");
  EXPECT_EQ(refusal("r.csv", "time,a [g]\n2026-03-29T02:30:00,1\n2026-03-29T02:30:01,2\n", {{}, "Europe/Berlin"}),
            "2:1: the clocks of Europe/Berlin skip the time '2026-03-29T02:30:00' (summer time begins); write the "
            "times with their offset from UTC");
  EXPECT_EQ(refusal("r.csv", rows("time [s],a [g]"), {{}, "Europe/Birlen"}),
            "there is no time zone 'Europe/Birlen'; name one such as Europe/Berlin or UTC");
  EXPECT_EQ(refusal("r.csv", rows("time [s],a [g]"), {-5}), "--rate -5 is not above zero");
  EXPECT_EQ(
      refusal("r.tdms", "TDSm"),
      "r.tdms: records are .csv, .txt, .tsv, .asc, .dat in text, .npy with .json, .npz, .uff, .unv, .mat, .wav or "
      ".lvm; export others (ibaPDA, TDMS, Parquet) as CSV");
}

// Several recorders call their texts .dat, others their binary files.
TEST_F(Records, DatFilesAreReadWhereTheyAreTexts)
{
  const std::string text = rows("time [s],a [g]");
  EXPECT_EQ(refusal("r.dat", text), "accepted");
  EXPECT_TRUE(is_record_file(folder + "/r.dat"));
  EXPECT_TRUE(is_csv_record(folder + "/r.dat"));
  EXPECT_EQ(refusal("r.dat", std::string("PDA2\0\0\1\2", 8)),
            "r.dat: this .dat file is not a text; export it as CSV in the program of its recorder (ibaPDA: "
            "ibaAnalyzer)");
  EXPECT_FALSE(is_record_file(folder + "/r.dat")) << "a folder of records may hold it";
}

TEST_F(Records, RefusalsOfBinaryFiles)
{
  EXPECT_EQ(refusal("r.npy", "no array"), "r.npy is not an array that numpy saved (.npy, version 1 to 3)");
  std::filesystem::copy_file(samples + "numpy-structured.npy", folder + "/alone.npy");
  try {
    read_npy_record(folder + "/alone.npy", {});
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems[0].message, folder + "/alone.json is needed next to " + folder +
                                             "/alone.npy: {\"rate\": 20000, \"units\": {\"force\": \"kN\", "
                                             "\"upper_work_roll\": \"g\"}}");
  }
  EXPECT_EQ(refusal("r.uff", "no universal file\n"),
            "1:1: this is not a universal file: no line with -1 begins a data set");
  EXPECT_EQ(
      refusal("r.uff", "    -1\n    15\n 1 2 3\n    -1\n"),
      "1:1: no data set 58 of this file is a real time response (function type 1, or 0 over a time); export the "
      "time records, not spectra");
  EXPECT_EQ(refusal("r.mat", "MATLAB 7.3 MAT-file"),
            "r.mat is a MATLAB file of version 7.3; save it in MATLAB with save('record.mat', '-v7')");
  EXPECT_EQ(refusal("r.mat", "nothing"),
            "r.mat is not a MATLAB file of level 5; save it in MATLAB with save('record.mat', '-v7')");
  std::string empty(128, ' ');
  empty[126] = 'I';
  empty[127] = 'M';
  EXPECT_EQ(refusal("r.mat", empty),
            "r.mat holds no numeric vector; it holds nothing; save the channels as vectors of numbers");
}

// What section 1 of the description calls bad, in the formats that are not text: TW-35.
TEST_F(Records, RefusalsOfEveryFormat)
{
  const auto little = [](const double x) {
    std::string bytes(8, ' ');
    std::memcpy(bytes.data(), &x, 8);
    return bytes;
  };
  // numpy: a plain array of n rows and as many columns as there are units
  const auto npy = [&](const int n, const std::string &units, const int columns) {
    file("r.json", "{\"rate\": 1000, \"units\": " + units + "}");
    std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(n) + ", " +
                       std::to_string(columns) + "), }";
    head.resize(117, ' ');
    std::string bytes = "\x93NUMPY" + std::string("\1\0", 2) + std::string("\x76\0", 2) + head + "\n";
    for (int i = 0; i < n * columns; ++i)
      bytes += little(i % 7);
    return refusal("r.npy", bytes);
  };
  EXPECT_EQ(
      npy(3000, R"({"a": "", "b": "level"})", 2),
      "no column of this record has a known unit; its columns are 'a', 'b'; write them into \"units\" of r.json, "
      "or: millstand analyse r.npy --unit a=g --unit b=g");
  EXPECT_EQ(npy(100, R"({"a": "g"})", 1), "the record has 100 samples; at least 2048 are needed for a spectrum");
  EXPECT_EQ(npy(3000, R"({"a": "g", "b": "g"})", 1),
            "r.npy holds 1 column, its sidecar names 2 units; one for each column, in their order, is needed");
  // universal file: channels of the same name, without units, of few samples
  const auto uff = [&](const int n, const std::vector<std::string> &names, const std::string &unit) {
    std::string text;
    for (const std::string &name : names) {
      char line[200];
      text += "    -1\n    58\n" + name + "\nNONE\nNONE\nNONE\nNONE\n" +
              "    1         0    0         0 NONE                0   0 NONE                0   0\n";
      std::snprintf(line, sizeof line, "%10d%10d%10d%13.5E%13.5E%13.5E\n", 4, n, 1, 0.0, 1e-3, 0.0);
      text += line;
      text += "        17    0    0    0 TIME                 s                   \n";
      text += "        12    0    0    0 Acceleration         " + unit + "\n";
      text += "         0    0    0    0 NONE                 NONE\n         0    0    0    0 NONE                "
              " NONE\n";
      for (int i = 0; i < n; ++i) {
        std::snprintf(line, sizeof line, "%20.12E%s", double(i % 7), i % 4 == 3 || i + 1 == n ? "\n" : "");
        text += line;
      }
      text += "    -1\n";
    }
    return refusal("r.uff", text);
  };
  EXPECT_EQ(uff(3000, {"a"}, "NONE"), "2:1: no column of this record has a known unit; its columns are 'a'; "
                                      "export the label of the ordinate's unit, for example g or m/s2, or: "
                                      "millstand analyse r.uff --unit a=g");
  EXPECT_EQ(uff(100, {"a"}, "g"), "1:1: the record has 100 samples; at least 2048 are needed for a spectrum");
  EXPECT_EQ(uff(2100, {"a", "a"}, "g"),
            "541:1: the channel 'a' appears twice in this record; rename one of the two columns");
}

TEST_F(Records, RefusalsOfMatlabFiles)
{
  // level 5, little-endian: a head of 128 byte, then one array after the other
  const auto word = [](const std::uint32_t x) {
    return std::string{char(x & 0xFF), char(x >> 8 & 0xFF), char(x >> 16 & 0xFF), char(x >> 24)};
  };
  const auto array = [&](const std::string &name, const std::vector<double> &values) {
    std::string padded = name;
    padded.resize((name.size() + 7) / 8 * 8, '\0');
    std::string body = word(6) + word(8) + word(6) + word(0) + word(5) + word(8) +
                       word(std::uint32_t(values.size())) + word(1) + word(1) + word(std::uint32_t(name.size())) +
                       padded + word(9) + word(std::uint32_t(8 * values.size()));
    for (const double x : values) {
      char bytes[8];
      std::memcpy(bytes, &x, 8);
      body.append(bytes, 8);
    }
    return word(14) + word(std::uint32_t(body.size())) + body;
  };
  std::string head(128, ' ');
  head[124] = '\0';
  head[125] = '\1';
  head[126] = 'I';
  head[127] = 'M';
  std::vector<double> many(3000), backwards(3000), few(100);
  for (std::size_t i = 0; i < many.size(); ++i) {
    many[i]      = double(i % 7);
    backwards[i] = i == 1000 ? 0.5 : 1e-3 * double(i);
  }
  const auto mat = [&](const std::string &arrays, const ReadOptions &options = {}) {
    return refusal("r.mat", head + arrays, options);
  };
  ReadOptions in_g;
  in_g.units = {{"a", "g"}, {"b", "g"}};
  EXPECT_EQ(mat(array("fs", {1000}) + array("a", many), in_g), "accepted");
  EXPECT_EQ(
      mat(array("fs", {1000}) + array("a", many)),
      "no column of this record has a known unit; its columns are 'a'; name the units, for example: millstand "
      "analyse r.mat --unit a=g");
  EXPECT_EQ(
      mat(array("a", many), in_g),
      "r.mat: the sampling rate is missing: there is neither a vector 'time' in seconds nor a number Fs, sr, "
      "SampleRate, dt or Ts; the vectors are 'a'; give the samples per second: millstand analyse r.mat --rate "
      "20000");
  EXPECT_EQ(mat(array("fs", {1000}) + array("a", few), in_g),
            "the record has 100 samples; at least 2048 are needed for a spectrum");
  EXPECT_EQ(
      mat(array("time", backwards) + array("a", many), in_g),
      "the time goes backwards at sample 1001, by 0.499 s; sort the samples by time, or split the record where "
      "the recorder started again");
  EXPECT_EQ(mat(array("fs", {1000}) + array("a", many) + array("a", many), in_g),
            "the channel 'a' appears twice in this record; rename one of the two columns");
  EXPECT_EQ(mat(array("fs", {1000})),
            "r.mat holds no numeric vector; it holds 'fs' (1 x 1); save the channels as vectors of numbers");
}

// Whatever a file holds, it is read or refused.
TEST_F(Records, DamagedFilesAreReadOrRefused)
{
  std::uint64_t state = 20260105;
  const auto random   = [&](const std::uint64_t n) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state % n;
  };
  int read = 0, refused = 0;
  for (const auto &entry : std::filesystem::directory_iterator(samples)) {
    const std::string ending = entry.path().extension();
    if (ending == ".py" || ending == ".md" || ending == ".json")
      continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    const auto sidecar = std::filesystem::path(entry.path()).replace_extension(".json");
    if (std::filesystem::exists(sidecar))
      std::filesystem::copy_file(sidecar, folder + "/damaged.json",
                                 std::filesystem::copy_options::overwrite_existing);
    for (int i = 0; i < 15; ++i) {
      std::string bytes = whole;
      for (std::uint64_t k = 0; k <= random(4); ++k)
        bytes[random(bytes.size())] = char(random(256));
      if (random(3) == 0)
        bytes.resize(random(bytes.size()) + 1);
      try {
        read_record(file("damaged" + ending, bytes), {});
        ++read;
      } catch (const InputError &) {
        ++refused;
      }
    }
  }
  EXPECT_GE(read + refused, 150);
  EXPECT_GT(refused, 50) << "40 samples are too few for an analysis";
}
