// millstand analyse as one calls it: a folder with findings and a page, and what is wrong word for word.
#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace {
// A line of 120 Hz and a little of everything below it, 4 s at 2 kHz.
std::string small_record(const std::string &folder, const std::string &name)
{
  std::ofstream out(folder + "/" + name);
  out << "time [s],AI_07 [g]\n";
  std::uint64_t state = 7;
  for (int i = 0; i < 8000; ++i) {
    double noise = 0;
    for (int k = 0; k < 4; ++k) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      noise += double(state >> 40) / double(1 << 24) - 0.5;
    }
    out << i / 2000.0 << "," << 0.5 * std::sin(2 * M_PI * 120 * i / 2000.0) + 0.02 * noise << "\n";
  }
  return name;
}
}  // namespace

TEST(Analyse, LeavesFindingsTablesAndAPage)
{
  const std::string folder = scratch("analyse");
  small_record(folder, "pass.csv");
  const Outcome run =
      millstand("analyse pass.csv --channel AI_07=upper_work_roll --severity \"2.3 mm/s\" -q", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string out = folder + "/out/pass-analysis/";
  const auto json       = nlohmann::json::parse(mill::read_text(out + "analysis.json"));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_TRUE(json["values"].contains("upper_work_roll.velocity_rms"));
  ASSERT_EQ(json["findings"].size(), 2u);
  EXPECT_EQ(json["findings"][0]["kind"], "line");
  EXPECT_TRUE(near(json["findings"][0]["frequency"].get<double>(), 120,
                   within_absolute(0.02, "a fiftieth of a hertz, as TW-03")));
  EXPECT_TRUE(near(json["findings"][0]["amplitude"].get<double>(), 0.5 * 9.80665,
                   within_absolute(0.02, "0.4 % of the amplitude: line between two bins and noise")));
  EXPECT_EQ(json["findings"][1]["owner"], "zone B of the zones that were given");
  for (const char *file : {"spectrum.csv", "waterfall.csv", "modes.csv", "candidates.csv", "report.html"})
    EXPECT_TRUE(fs::exists(out + file)) << file;
  const std::string page = mill::read_text(out + "report.html");
  EXPECT_NE(page.find("What the record shows"), std::string::npos);
  fs::remove(out + "report.html");
  EXPECT_EQ(millstand("report out/pass-analysis", folder).exit_code, 0);
  EXPECT_TRUE(fs::exists(out + "report.html"));
  // the same record against itself
  const Outcome again = millstand(
      "analyse pass.csv --channel AI_07=upper_work_roll --baseline out/pass-analysis -o again -q", folder);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto held = nlohmann::json::parse(mill::read_text(folder + "/again/analysis.json"));
  EXPECT_DOUBLE_EQ(held["values"]["upper_work_roll.velocity_rms_ratio"]["value"].get<double>(), 1);
  EXPECT_EQ(held["baseline"]["folder"], "out/pass-analysis");
  const Outcome compared = millstand("report out/pass-analysis again", folder);
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const std::string comparison = mill::read_text(out + "comparison.html");
  EXPECT_NE(comparison.find("velocity in the"), std::string::npos);
  EXPECT_NE(comparison.find("+0 %"), std::string::npos) << "a record compared with itself";
  const Outcome spoken = millstand("analyse pass.csv --channel AI_07=upper_work_roll -o spoken", folder);
  EXPECT_LE(std::count(spoken.out.begin(), spoken.out.end(), '\n'), 25) << spoken.out;
  EXPECT_NE(spoken.out.find("largest peak 120.0"), std::string::npos) << spoken.out;
}

TEST(Analyse, Refusals)
{
  const std::string folder = scratch("analyse-refusals");
  small_record(folder, "pass.csv");
  const auto refused = [&](const std::string &arguments, const std::string &message) {
    const Outcome run = millstand("analyse " + arguments, folder);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(message), std::string::npos) << arguments << "\n" << run.err;
  };
  refused("absent.csv", "error: there is no file absent.csv");
  refused("pass.csv --rate -3", "error: --rate -3 is not above zero");
  refused("pass.csv --rate \"3 m\"",
          "error: --rate \"3 m\": a frequency above zero is needed, for example --rate \"20000 Hz\"");
  refused("pass.csv --speed 4",
          "error: --speed \"4\": a speed above zero is needed, for example --speed \"4 m/s\"");
  refused("pass.csv --channel AI_07",
          "error: --channel \"AI_07\": a name and what it stands for are needed, for example "
          "--channel AI_07=upper_work_roll");
  refused("pass.csv --baseline nowhere",
          "error: the baseline nowhere holds no analysis.json; name the folder of an earlier millstand analyse");
  std::ofstream(folder + "/text.csv") << "time [s],a [g]\n0,1\n1,x\n2,3\n3,4\n";
  refused("text.csv",
          "text.csv:3:3: error: 'x' in column 'a' is not a number; leave the cell empty where there is no value");
  fs::create_directories(folder + "/mine");
  std::ofstream(folder + "/mine/notes.txt") << "mine";
  refused("pass.csv -o mine",
          "error: the folder mine holds files that no analysis wrote; choose another with -o, or give "
          "--force-overwrite");
}
