// Records of a folder for a calibration: who names a column, and the rate that they share.
#include "app/twin/calibrate/record_set.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace fs = std::filesystem;
using namespace mill;

namespace {
const std::vector<std::string> places{"upper_work_roll", "lower_work_roll"};

// Four seconds, by its rate in Hz; a third tone keeps the peaks apart, which would be taken for clipping.
void write_record(const std::string &path, const double rate)
{
  std::string text = "time [s],force [kN],A1 [m/s2]\n";
  for (int k = 0; k < int(4 * rate); ++k) {
    const double t = k / rate;
    text += fmt::format("{:.9f},{:.6f},{:.6f}\n", t, 900 + std::sin(2 * M_PI * 70 * t + 0.1 * k * k),
                        std::sin(2 * M_PI * 90 * t + 0.2 * k * k) + 0.3 * std::sin(2 * M_PI * 31 * t));
  }
  write_atomically(path, text);
}

std::string folder_of(const std::string &name, const std::vector<double> &rates, const std::string &channels)
{
  std::string folder = scratch(name), entries;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    write_record(fmt::format("{}/{}.csv", folder, i), rates[i]);
    entries += fmt::format("[[record]]\nfile = \"{}.csv\"\n{}", i, channels);
  }
  write_atomically(folder + "/records.toml", entries);
  return folder;
}
}  // namespace

TEST(RecordSet, TheNearestPlaceNamesAColumn)
{
  const auto sensors = [](const std::string &channels, const std::map<std::string, std::string> &of_command) {
    const RecordSet set = read_record_set(folder_of("record-set-names", {1000}, channels));
    twin::ReadOptions options;
    options.channels = of_command;
    return measured_pieces(set, places, options, {{"A1", "upper_work_roll"}}).sensors;
  };
  const std::string lower = "channels = { \"A1\" = \"lower_work_roll\" }\n";
  EXPECT_EQ(sensors("", {}), std::vector<std::string>{"upper_work_roll"}) << "of the case";
  EXPECT_EQ(sensors(lower, {}), std::vector<std::string>{"lower_work_roll"}) << "of the record";
  EXPECT_EQ(sensors(lower, {{"A1", "upper_work_roll"}}), std::vector<std::string>{"upper_work_roll"})
      << "of the command line";
}

TEST(RecordSet, RecordsOfOtherRatesAreRefused)
{
  const auto refusal = [](const double rate) -> std::string {
    const RecordSet set = read_record_set(folder_of("record-set-rates", {1000, rate}, ""));
    try {
      measured_pieces(set, places, {}, {{"A1", "upper_work_roll"}});
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(1000.75).find("samples per second"), std::string::npos)
      << "0.075 %, by which each frequency would be off";
  EXPECT_EQ(refusal(1000.02), "") << "two clocks that differ by 2e-5";
}
