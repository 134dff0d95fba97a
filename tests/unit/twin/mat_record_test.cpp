// MATLAB files of level 5, made here byte by byte.
#include "tests/support/record_format_test.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
class MatRecord : public RecordFormatTest {};
}  // namespace

TEST_F(MatRecord, CompressedVariablesOfMatlabAreRead)
{
  const auto record =
      read("r.mat", mat_file(mat_compressed(mat_array("a", swings())) + mat_compressed(mat_array("fs", {1000}))),
           in_g({"a"}));
  expect_swing(record, "a");
  EXPECT_EQ(record.rate, 1000);
}

TEST_F(MatRecord, FieldsOfStructuresAreChannels)
{
  const std::string run = mat_structure("run", {{"a", mat_array("", swings())}, {"fs", mat_array("", {1000})}});
  expect_swing(read("r.mat", mat_file(run), in_g({"a"})), "a");
  // two structures with the same fields keep their names
  const std::string other = mat_structure("later", {{"a", mat_array("", swings())}});
  expect_swing(read("s.mat", mat_file(run + other), in_g({"run.a", "later.a"})), "later.a");
}

TEST_F(MatRecord, ColumnsOfAMatrixAreChannels)
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

TEST_F(MatRecord, XYAndZWithARateAreAxesOfASensor)
{
  const auto record =
      read("r.mat", mat_file(mat_array("x", swings()) + mat_array("y", swings()) + mat_array("fs", {1000})),
           in_g({"x", "y"}));
  EXPECT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.rate, 1000);
}

TEST_F(MatRecord, TheSamplingRateIsOneOfItsNamesAndRateAloneIsNot)
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

TEST_F(MatRecord, AClockWithoutANameIsPointedOutWhereTheRateIsMissing)
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

// MATLAB keeps the values of its objects in an array of bytes without a name, often longer than the channels.
TEST_F(MatRecord, ObjectsOfMatlabAreNamedAndLeftOut)
{
  const std::string behind = mat_array("", std::vector<double>(5000, 1));
  const auto record        = read("r.mat",
                                  mat_file(mat_object("run", "table") + mat_object("when", "datetime") +
                                           mat_array("a", swings()) + mat_array("fs", {1000}) + behind),
                                  in_g({"a"}));
  expect_swing(record, "a");
  EXPECT_EQ(record.channels.size(), 1u);
  EXPECT_TRUE(
      has_note(record, "not used, because not an array of real numbers: 'run' (table), 'when' (datetime)"));
  EXPECT_EQ(refusal("s.mat", mat_file(mat_object("run", "table") + behind)),
            "s.mat holds no numeric vector; it holds 'run' (table); save the channels as vectors of numbers");
}
