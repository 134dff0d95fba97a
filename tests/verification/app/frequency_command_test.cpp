#include "core/base/files.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cmath>
#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>

// Frequency response and Campbell diagram as a user of a lumped model meets them.
namespace {
const std::string lumped = "cases/published-1400.toml";

nlohmann::json values(const std::string &name)
{
  return nlohmann::json::parse(mill::read_text(scratch(name) + "/results.json")).at("values");
}

const std::string turning =
    " --set campbell.work_roll_diameter='420 mm' --set campbell.backup_roll_diameter='1450 mm'"
    " --set campbell.speeds='[\"0 m/s\", \"20 m/s\"]' --set campbell.working_speeds='[\"4 m/s\", \"8 m/s\"]'";

// The published stand with errors of all its springs and masses, run once.
const std::string &stand()
{
  static const std::string name = [] {
    std::string sets = " --set 'frequency_response.damping_tolerance=20 %'";
    for (const char *key : {"M1", "M2", "M3", "M4", "M5", "M6", "K1", "K2", "K3", "K4", "K5", "K6", "K7"})
      sets += std::string(" --set 'given.") + key + "_tolerance=5 %'";
    const auto outcome = millstand("modes " + lumped + " -q -o " + scratch("frequency") + sets + turning);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return std::string("frequency");
  }();
  return name;
}

double distance_to(const mill::Table &table, const std::string &place, const double frequency, const double value)
{
  const auto &f = *table.column("frequency"), &re = *table.column(place + "_real"),
             &im       = *table.column(place + "_imag");
  Eigen::Index highest = 0;
  (f.array() - frequency).abs().minCoeff(&highest);
  return std::abs(std::hypot(re[highest], im[highest]) / value - 1);
}
}  // namespace

TEST(FrequencyCommand, PeaksHaveASecondSolutionAnErrorAndTheirCurve)
{
  const auto all      = values(stand());
  const auto response = mill::read_table(scratch(stand()) + "/curves/frf-six-mass-bite.csv");
  int pairs           = 0;
  for (const char *force : {"bite", "upper_work_roll", "lower_backup_roll"})
    for (const char *place : {"upper_backup_roll", "upper_work_roll", "lower_work_roll", "lower_backup_roll"}) {
      const std::string name = std::string("frf.") + force + "." + place;
      if (!all.contains(name + ".peak"))
        continue;
      ++pairs;
      const auto &peak   = all.at(name + ".peak");
      const double value = peak.at("value"), frequency = all.at(name + ".frequency").at("value");
      EXPECT_TRUE(near(peak.at("checks")[0].at("value").get<double>(), value,
                       within(1e-9, "two solutions of one equation at a resonance of 1 %")))
          << name;
      EXPECT_GT(peak.at("error_estimate").get<double>(), 0.15) << "damping known to 20 %";
      EXPECT_LT(peak.at("error_estimate").get<double>(), 0.5) << name;
      EXPECT_EQ(peak.at("unit"), "1/kg");
      if (force == std::string("bite")) {
        std::string column = place;
        std::replace(column.begin(), column.end(), '_', '-');
        EXPECT_LT(distance_to(response, column, frequency, value), 0.05) << "the table holds the resonance";
      }
    }
  EXPECT_EQ(pairs, 6) << "four places for the bite, two driving points";
  // With the published reading K4 carries the bite: the highest frequencies are the work rolls against it.
  const auto band = mill::read_table(scratch(stand()) + "/curves/frf-six-mass-bite-band.csv");
  EXPECT_TRUE((band.column("upper-work-roll_high")->array() >= band.column("upper-work-roll_low")->array()).all());
}

TEST(FrequencyCommand, PeaksWithoutAToleranceNameTheMissingKey)
{
  const auto outcome = millstand("modes " + lumped + " -q -o " + scratch("no-tolerance"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lacks = values("no-tolerance").at("frf.bite.upper_work_roll.peak").at("error_lacks");
  EXPECT_NE(std::find(lacks.begin(), lacks.end(), "given.K3_tolerance"), lacks.end());
  EXPECT_NE(std::find(lacks.begin(), lacks.end(), "frequency_response.damping_tolerance"), lacks.end());
  EXPECT_FALSE(std::filesystem::exists(scratch("no-tolerance") + "/campbell.csv")) << "no speed, no diagram";
}

TEST(FrequencyCommand, CampbellListsTheCrossings)
{
  const auto all = values(stand());
  int n_found    = 0;
  for (const auto &[name, entry] : all.items()) {
    if (name.rfind("campbell.", 0) != 0 || name.find(".speed") == std::string::npos)
      continue;
    ++n_found;
    const std::string mode = name.substr(9, name.rfind('.') - 9), method = entry.at("source");
    const double f = all.at("mode." + mode + ".frequency").at("value"), v = entry.at("value");
    const double per_turn = std::stod(method.substr(method.find('(') + 1));
    const double diameter = method.find("per turn of the backup roll") != std::string::npos ? 1.45 : 0.42;
    EXPECT_TRUE(near(per_turn * v / (M_PI * diameter), f, within(1e-4, "the order is printed with five digits")))
        << name;
    const double wanted = v < 4 ? v / 4 - 1 : v > 8 ? v / 8 - 1 : 0;
    EXPECT_TRUE(near(all.at("campbell." + mode + ".distance").at("value").get<double>(), wanted,
                     within(1e-12, "definition", 1)));
  }
  EXPECT_GT(n_found, 0);
  const std::string csv = mill::read_text(scratch(stand()) + "/campbell.csv");
  EXPECT_EQ(csv.rfind("mode,frequency [Hz],line,shaft,per turn,speed [m/s],distance to working range [-]\n", 0),
            0u);
}

TEST(FrequencyCommand, ATooFineResolutionIsRefused)
{
  const auto outcome = millstand("modes " + lumped + " -q -o " + scratch("fine") +
                                 " --set 'frequency_response.resolution=0.001 Hz'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("frequency_response.resolution = 0.001 Hz asks for"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("at most 20000 are computed, raise it or give a range"), std::string::npos);
}
