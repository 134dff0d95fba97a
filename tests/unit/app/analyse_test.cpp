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
  EXPECT_EQ(json["findings"][1]["owner"], "zone B of the zones that were given")
      << "one limit has two zones: none is higher, though the band of 2 kHz ends at 781 Hz";
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

TEST(Analyse, ARecordOfTheSameNameDoesNotReplaceAnotherOne)
{
  const std::string folder = scratch("analyse-names");
  for (const char *day : {"day1", "day2"}) {
    fs::create_directories(folder + "/" + day);
    small_record(folder, std::string(day) + "/rec.csv");
  }
  const Outcome both = millstand("analyse day1/rec.csv day2/rec.csv -q -o an", folder);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("the records day1/rec.csv and day2/rec.csv would both write to the folder an/rec"),
            std::string::npos)
      << both.err;
  EXPECT_FALSE(fs::exists(folder + "/an"));
  ASSERT_EQ(millstand("analyse day1/rec.csv -q", folder).exit_code, 0);
  const std::string json = folder + "/out/rec-analysis/analysis.json", first = mill::read_text(json);
  const Outcome second = millstand("analyse day2/rec.csv -q", folder);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("the folder out/rec-analysis holds the analysis of another record, "),
            std::string::npos)
      << second.err;
  EXPECT_EQ(mill::read_text(json), first);
  EXPECT_EQ(millstand("analyse ../" + fs::path(folder).filename().string() + "/day1/rec.csv -q", folder).exit_code,
            0)
      << "the same record by another path";
  fs::rename(folder + "/day1/rec.csv", folder + "/rec.csv");
  EXPECT_EQ(millstand("analyse rec.csv -q", folder).exit_code, 0) << "the record has been moved";
  EXPECT_EQ(millstand("analyse day2/rec.csv -q --force-overwrite", folder).exit_code, 0);
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

namespace {
// Impacts that ring at 3 kHz, so many in a second, in noise: 15 s at 10 kHz.
void write_impacts(const std::string &path, const double rate_of_impacts)
{
  constexpr double rate = 10000;
  std::ofstream out(path);
  out << "time [s],upper_work_roll [m/s2]\n";
  std::uint64_t state = 11;
  for (int i = 0; i < 150000; ++i) {
    state              = state * 6364136223846793005ull + 1442695040888963407ull;
    const double noise = double(state >> 40) / double(1 << 24) - 0.5, t = i / rate,
                 since = t - std::floor(t * rate_of_impacts) / rate_of_impacts;
    out << t << "," << noise + 5 * std::exp(-since * 600) * std::sin(2 * M_PI * 3000 * since) << "\n";
  }
}
}  // namespace

// Ten balls of 20 mm on a circle of 90 mm at 60 deg: gamma = 1/9, so that 40/9 balls pass a point of the outer
// ring in a turn of the roll, whose harmonics are not those of the turns; 4 m/s on 400 mm are 3.183 turns in a
// second.
TEST(Analyse, NamesTheFaultOfABallBearing)
{
  const std::string folder = scratch("analyse-balls");
  const double turn        = 4 / (M_PI * 0.4);
  write_impacts(folder + "/pass.csv", 40. / 9 * turn);
  const auto write_case = [&](const std::string &campbell) {
    std::ofstream out(folder + "/stand.toml");
    out << "schema = 1\nkind = \"lumped\"\n[given]\n";
    for (int i = 1; i <= 6; ++i)
      out << "M" << i << " = \"5000 kg\"\n";
    for (int i = 1; i <= 7; ++i)
      out << "K" << i << " = \"1e4 kN/mm\"\n";
    out << campbell
        << "[[monitoring.ball_bearing]]\nname = \"axial\"\nballs = 10\nball_diameter = \"20 mm\"\n"
           "pitch_diameter = \"90 mm\"\ncontact_angle = \"60 deg\"\n";
  };
  write_case("[campbell]\nwork_roll_diameter = \"400 mm\"\n");
  const Outcome run = millstand("analyse pass.csv --case stand.toml --speed \"4 m/s\" -o found -q", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(mill::read_text(folder + "/found/analysis.json"));
  bool named      = false;
  for (const auto &finding : json["findings"])
    if (finding["owner"].get<std::string>().rfind("BPFO of bearing axial at the work_roll: ", 0) == 0) {
      named = true;
      EXPECT_TRUE(near(finding["frequency"].get<double>(), 40. / 9 * turn,
                       within(0.01, "slip that is searched, two bins")));
    }
  EXPECT_TRUE(named) << json["findings"].dump(1);
  write_case("");
  const Outcome without = millstand("analyse pass.csv --case stand.toml --speed \"4 m/s\" -o without", folder);
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(mill::read_text(folder + "/without/analysis.json")
                .find("bearing axial: not computed, the case states no diameter of the work roll"),
            std::string::npos);
}
