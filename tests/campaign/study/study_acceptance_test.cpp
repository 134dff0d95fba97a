#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

// Long form of the studies: ctest -C long -R study_acceptance.  Figures of a run are in docs/scaling.md.
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

const std::string chain = "study new cases/published-1400.toml --set 'given.K3=4.0192e10 N/m' --set "
                          "'given.K5=4.0192e10 N/m' --set 'given.K4=0 N/m' --set dynamics.force_meaning=measured "
                          "--model quick -q ";

void expect_done(const std::string &arguments)
{
  const Outcome outcome = millstand(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
}

json report_of(const std::string &folder)
{
  return json::parse(mill::read_text(folder + "/report.json"));
}

double seconds_of(const std::string &arguments)
{
  const auto start = std::chrono::steady_clock::now();
  expect_done(arguments);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// 229 376 rows: spread and indices of the chain, all frequencies.
TEST(StudyAcceptance, SobolIndicesOfTheChainAtTwoToTheFourteen)
{
  const std::string folder = scratch("acceptance-chain") + "/study";
  const auto lumped        = reference("lumped", "study");
  const auto names         = lumped["names"].get<std::vector<std::string>>();
  const auto sd            = lumped["sd"].get<std::vector<double>>();
  std::string keys;
  for (std::size_t k = 0; k < names.size(); ++k)
    keys += " --vary 'given." + names[k] + "~normal(" + std::to_string(100 * sd[k]) + " %)'";
  std::string watch;
  for (int f = 1; f <= 6; ++f)
    watch += " --watch f" + std::to_string(f);
  expect_done(chain + "--method sobol --samples 16384" + watch + keys + " -o " + folder);
  expect_done("study run " + folder + " -q --jobs 2");
  expect_done("study report " + folder + " -q");
  const auto report = report_of(folder);
  for (std::size_t f = 0; f < 6; ++f) {
    const auto &result = report["results"][f];
    EXPECT_TRUE(near(result["statistics"]["sd"]["value"].get<double>(), lumped["sd_f"][f].get<double>(),
                     within(0.02, "wanted")))
        << f;
    EXPECT_TRUE(near(result["linear"]["sd"].get<double>(), lumped["sd_linear"][f].get<double>(),
                     within(2e-4, "differences of the reference")))
        << f;
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_TRUE(near(result["sobol"]["first"][k].get<double>(), lumped["S"][f][k].get<double>(),
                       within_absolute(0.02, "wanted")))
          << f << " " << names[k];
  }
}

// Least rms of the exit thickness of the six-high between the bounds of its reference.
TEST(StudyAcceptance, OptimumOfTheSixHighIsThatOfTheReference)
{
  const std::string folder = scratch("acceptance-six-high") + "/study";
  expect_done(
      "study new cases/stack-six-high.toml --model quick --method optimise --minimise stack.profile_rms "
      "--vary 'roll.0.bending_force~uniform(-200, 400) kN' --vary 'roll.1.bending_force~uniform(0, 500) kN' "
      "--vary 'roll.1.shift~uniform(0, 200) mm' -q -o " +
      folder);
  expect_done("study run " + folder + " -q");
  expect_done("study report " + folder + " -q");
  const auto optimum  = report_of(folder)["optimum"];
  const auto wanted   = reference("six-high optimum", "study");
  const double rms_um = 1e6 * optimum["value"].get<double>();
  EXPECT_LT(rms_um, 1.01 * wanted["rms_um"].get<double>()) << "wanted";
  EXPECT_TRUE(near(optimum["inputs"][0].get<double>(), wanted["wb_kN"].get<double>(),
                   within(0.03, "the valley is flat: 1 % of the objective")));
  EXPECT_TRUE(optimum["searched_valley"].get<bool>());
  // Every shift of the reference's valley, searched again there.
  for (std::size_t i = 0; i < wanted["valley_shift_mm"].size(); ++i) {
    const auto &point = optimum["valley"][2][i];
    ASSERT_TRUE(near(point["inputs"][2].get<double>(), wanted["valley_shift_mm"][i].get<double>(),
                     within_absolute(1e-9, "ten equal steps")));
    EXPECT_LT(1e6 * point["value"].get<double>(), 1.01 * wanted["valley_rms_um"][i].get<double>()) << i;
  }
}

// Blocks, commits and files against the rows alone, by the same processor: a sweep has no store.
TEST(StudyAcceptance, AHundredThousandQuickRowsAndAMillionFinishedOnes)
{
  const std::string folder = scratch("acceptance-rows");
  expect_done(chain + "--method monte-carlo --samples 100000 --vary 'given.K1~normal(10 %)' --watch f1 -o " +
              folder + "/study");
  const double seconds = seconds_of("study run " + folder + "/study -q --jobs 2");
  std::printf("100000 rows by two processes: %.1f s\n", seconds);
  const Outcome memory = shell("/usr/bin/time -f %M '" MILLSTAND_PROGRAM "' study run '" + folder + "/study' -q",
                               MILLSTAND_SOURCE_DIR);
  std::printf("memory of a resume over 100000 finished rows: %s kB\n", memory.err.c_str());
  EXPECT_LT(seconds_of("study run " + folder + "/study -q"), 5) << "all rows are finished";
}

// One and two processors, 64 rows of a roll stack by its run.  Needs the processors for itself.
TEST(StudyAcceptance, TwoProcessorsHalveTheTimeWithEachEngine)
{
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  if (std::thread::hardware_concurrency() < 2 || load > 0.5)
    GTEST_SKIP() << "two processors without other work are needed; load " << load;
  const std::string folder = scratch("acceptance-strong");
  for (const auto &[engine, wanted] : {std::pair("here", 1.9), std::pair("parallel", 1.8)}) {
    double seconds[2] = {};
    for (const int jobs : {1, 2}) {
      const std::string there = folder + "/" + engine + std::to_string(jobs);
      expect_done("study new cases/stack-twenty-high.toml --method monte-carlo --samples 64 --vary "
                  "'strip.force~normal(2 %)' --watch stack.crown -q -o " +
                  there);
      seconds[jobs - 1] = seconds_of("study run " + there + " -q --threads 1 --engine " + engine + " --jobs " +
                                     std::to_string(jobs));
    }
    std::printf("%s: 64 rows in %.1f s by one, %.1f s by two\n", engine, seconds[0], seconds[1]);
    EXPECT_GE(seconds[0] / seconds[1], wanted) << engine;
  }
}

// The same drawn rows of the demo stand by closed forms and by finite elements, some 40 s of a processor for each
// row of the latter.
TEST(StudyAcceptance, IntervalsOfTheDemoStandAgreeBetweenTheModels)
{
  const std::string folder = scratch("acceptance-demo");
  const std::string inputs =
      " --method monte-carlo --samples 40 --vary 'work_roll.barrel_diameter~tolerance(0.5 mm)' "
      "--vary 'backup_roll.barrel_diameter~tolerance(0.5 mm)' --vary "
      "'bearing.trb.radial_clearance~tolerance(0 mm, 0.03 mm)' --vary "
      "'steel.youngs_modulus~normal(1 %)'";
  for (const std::string model : {"quick", "full"}) {
    const std::string there = folder + "/" + model;
    expect_done("study new cases/four-high-1400.toml --model " + model + inputs + " --watch " +
                (model == "quick" ? "K3" : "K3.tangent") +
                " --watch f1 --watch f2 --watch f3 --watch f4 --watch f5 "
                "--watch f6 -q -o " +
                there);
    expect_done("study run " + there + " -q --cache-limit 3GB");
    expect_done("study report " + there + " -q");
  }
  const auto quick = report_of(folder + "/quick"), full = report_of(folder + "/full");
  for (std::size_t r = 0; r < 7; ++r) {
    const auto &q = quick["results"][r], &f = full["results"][r];
    const auto value = [](const json &result, const char *name) {
      return result["statistics"][name]["value"].get<double>();
    };
    const double difference = std::abs(f["base"].get<double>() - q["base"].get<double>());
    for (const char *end : {"q025", "q975"})
      EXPECT_TRUE(near(value(f, end), value(q, end),
                       within_absolute(0.02 * value(f, "sd") + difference,
                                       "wanted: 2 % of the standard deviation and the difference of the models")))
          << f["name"];
  }
}

// GNU parallel and its workers are killed at twenty moments.
TEST(StudyAcceptance, TwentyKillsOfParallelAndItsWorkersChangeNoByte)
{
  if (shell("command -v parallel", "/").exit_code != 0)
    GTEST_SKIP() << "GNU parallel is not installed (scripts/install-deps tests)";
  const std::string folder = scratch("acceptance-kills");
  for (const char *name : {"/whole", "/killed"})
    expect_done(chain +
                "--method monte-carlo --samples 4000 --vary 'given.K1~normal(10 %)' --watch f1 --watch f2 -o " +
                folder + name);
  expect_done("study run " + folder + "/whole -q");
  for (int i = 0; i < 20; ++i) {
    const std::string who = i % 2 == 0 ? "study work .*acceptance-kills.*/killed" : "parallel .*acceptance-kills";
    shell("'" MILLSTAND_PROGRAM "' study run '" + folder +
              "/killed' --engine parallel --jobs 2 -q & run=$!; sleep 0." + std::to_string(20 + 7 * i) +
              "; pgrep -f '" + who + "' | xargs -r kill -9; wait $run",
          MILLSTAND_SOURCE_DIR);
  }
  expect_done("study run " + folder + "/killed -q");
  for (const char *name : {"/whole", "/killed"})
    expect_done("study merge " + folder + name);
  const std::string whole = mill::read_text(folder + "/whole/results.csv");
  EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 4001);
  EXPECT_EQ(mill::read_text(folder + "/killed/results.csv"), whole);
}

TEST(StudyAcceptance, TwentyOneCrownsTakeThreeSecondsWarm)
{
  const std::string folder = scratch("acceptance-crowns");
  const std::string sweep  = "sweep cases/four-high-1400.toml --vary 'backup_roll.crown=0..200 um:21' --watch "
                             "K3.tangent -q --cache " +
                            shared_cache() + " -o " + folder + "/sweep";
  seconds_of(sweep);
  const double warm = seconds_of(sweep);
  std::printf("21 crowns, warm: %.2f s\n", warm);
  EXPECT_LE(warm, 3);
  const auto table = json::parse(mill::read_text(folder + "/sweep/sweep.json"));
  ASSERT_EQ(table["rows"].size(), 21u);
  for (const auto &row : table["rows"])
    EXPECT_TRUE(std::isfinite(row["results"][0].get<double>())) << row["failure"];
}
}  // namespace
