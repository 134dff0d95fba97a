// File names that are not UTF-8, numbers that no mill has, and nan: each verb gives an answer that can be read, or
// a sentence and exit code 2.
#include "core/base/files.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using nlohmann::json;

namespace {
const std::string e_acute = "\xe9";  // of Latin-1, no UTF-8

void write_file(const std::string &path, const std::string &text)
{
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path) << text;
}

std::string stand()
{
  std::string text = "schema = 1\nkind = \"lumped\"\n[given]\n";
  for (int i = 1; i <= 6; ++i)
    text += fmt::format("M{} = \"5000 kg\"\n", i);
  for (int i = 1; i <= 7; ++i)
    text += fmt::format("K{} = \"1e4 kN/mm\"\n", i);
  return text + "[campbell]\nwork_roll_diameter = \"400 mm\"\n";
}

/// 4 s at 2 kHz of noise; one sample, or all of them, times `factor`.
std::string record(const double factor, const bool all)
{
  std::string text    = "time [s],force [N],upper_work_roll [m/s2]\n";
  std::uint64_t state = 3;
  const auto noise    = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return double(state >> 40) / double(1 << 24) - 0.5;
  };
  for (int i = 0; i < 8000; ++i) {
    const double by = all || i == 900 ? factor : 1;
    const double F = 1e4 * noise() * by, a = noise() * by;
    text += fmt::format("{},{:.9g},{:.9g}\n", i / 2000.0, F, a);
  }
  return text;
}

void expect_sentence(const Outcome &run, const std::string &sentence)
{
  EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
  EXPECT_NE(run.err.find(sentence), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("terminate"), std::string::npos) << run.err;
}
}  // namespace

TEST(HostileValues, NamesThatAreNotUtf8PassThroughEveryVerb)
{
  const std::string folder = scratch("hostile-names"), name = "st" + e_acute;
  write_file(folder + "/" + name + ".toml", stand());
  write_file(folder + "/rec" + e_acute + "/pass" + e_acute + ".csv", record(1, true));
  struct Verb {
    std::string arguments, file;
    int exit_code;
  };
  const std::string out = "out" + e_acute;
  for (const Verb &verb :
       {Verb{"run '" + name + ".toml' -q -o '" + out + "1'", out + "1/results.json", 0},
        Verb{"analyse 'rec" + e_acute + "/pass" + e_acute + ".csv' --case '" + name + ".toml' -q -o '" + out +
                 "2'",
             out + "2/analysis.json", 0},
        Verb{"calibrate '" + name + ".toml' --measured 'rec" + e_acute + "' --free K3,zeta -q -o '" + out + "3'",
             out + "3/calibration.json", 3},
        Verb{"marks '" + name + ".toml' --spacing '30 mm' --speed '5 m/s' -q -o '" + out + "4'",
             out + "4/results.json", 0}}) {
    const Outcome run = millstand(verb.arguments, folder);
    EXPECT_EQ(run.exit_code, verb.exit_code) << verb.file << "\n" << run.err;
    const auto text = mill::text_if_readable(folder + "/" + verb.file);
    ASSERT_TRUE(text) << verb.file;
    EXPECT_TRUE(json::accept(*text)) << verb.file << " is no JSON in UTF-8";
  }
}

TEST(HostileValues, AdviceOnRecordsBeyondAnySensor)
{
  const std::string folder = scratch("hostile-advice");
  write_file(folder + "/stand.toml", stand());
  write_file(folder + "/all/pass.csv", record(1e300, true));
  write_file(folder + "/one/pass.csv", record(1e300, false));
  expect_sentence(millstand("advise stand.toml --measured all -o all-out", folder),
                  "every channel stands still or is empty");
  const Outcome one = millstand("advise stand.toml --measured one -o one-out", folder);
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out.find("nan"), std::string::npos) << one.out;
  const std::string table = mill::read_text(folder + "/one-out/advice.csv");
  for (const char *word : {",nan", ",-nan", ",inf", ",-inf"})
    EXPECT_EQ(table.find(word), std::string::npos) << word;
  EXPECT_TRUE(json::accept(mill::read_text(folder + "/one-out/advice.json")));
  expect_sentence(millstand("advise stand.toml --set given.K3='1e300 N/m' -o out", folder), "is outside");
  expect_sentence(millstand("advise stand.toml --set 'advice.band=[\"1e300 Hz\", \"2e300 Hz\"]' -o out", folder),
                  "is outside 0 Hz .. 20000 Hz");
}

TEST(HostileValues, NanIsNoNumberOfACase)
{
  const std::string folder  = scratch("hostile-nan"),
                    chatter = MILLSTAND_SOURCE_DIR "/cases/chatter-two-stands.toml";
  write_file(folder + "/stand.toml", stand());
  expect_sentence(millstand("trace stand.toml given.K3 --set given.M3=nan", folder), "given.M3 = nan has no unit");
  expect_sentence(millstand("trace stand.toml given.K3 --set 'given.M3=\"nan kg\"'", folder),
                  "does not begin with a number");
  expect_sentence(millstand("trace stand.toml nan", folder), "unknown key 'nan'");
  expect_sentence(millstand("chatter '" + chatter + "' --set analysis.map_points=nan -o out", folder),
                  "analysis.map_points = nan is not a whole number");
  expect_sentence(
      millstand("chatter '" + chatter + "' --set 'analysis.speeds=[\"nan m/s\", \"30 m/s\"]' -o out", folder),
      "does not begin with a number");
  expect_sentence(millstand("marks stand.toml --spacing '1e300 mm' --speed '5 m/s'", folder),
                  "--spacing \"1e300 mm\" is outside of what a mill has");
  expect_sentence(millstand("marks stand.toml --spacing 'nan mm' --speed '5 m/s'", folder),
                  "does not begin with a number");
}
