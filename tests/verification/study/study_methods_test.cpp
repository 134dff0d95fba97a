#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// Surrogate, optimum, linear estimate and the files of samples, by the program.
namespace {
namespace fs = std::filesystem;

const std::string chain = "study new cases/published-1400.toml --set 'given.K3=4.0192e10 N/m' --set "
                          "'given.K5=4.0192e10 N/m' --set 'given.K4=0 N/m' --set dynamics.force_meaning=measured "
                          "--model quick -q ";

nlohmann::json report_of(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/report.json"));
}

void expect_done(const std::string &arguments)
{
  const Outcome outcome = millstand(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
}

// All inputs of the reference, "--vary 'given.M1~normal(2 %)' ..".
std::string inputs_of_chain()
{
  std::string keys;
  const auto lumped = reference("lumped", "study");
  const auto names  = lumped["names"].get<std::vector<std::string>>();
  const auto sd     = lumped["sd"].get<std::vector<double>>();
  for (std::size_t k = 0; k < names.size(); ++k)
    keys += " --vary 'given." + names[k] + "~normal(" + std::to_string(100 * sd[k]) + " %)'";
  return keys;
}

TEST(StudyMethods, ThePolynomialHasTheIndicesOfTheReferenceFromFewRows)
{
  const std::string folder = scratch("study-chaos") + "/study";
  expect_done(chain + "--method chaos --samples 256 --watch f1 --watch f2 --watch f5" + inputs_of_chain() +
              " -o " + folder);
  expect_done("study run " + folder + " -q");
  expect_done("study report " + folder + " -q");
  const auto report = report_of(folder);
  EXPECT_EQ(report["rows"], 256 + 64) << "a quarter is held out";
  const auto lumped = reference("lumped", "study");
  const std::size_t frequencies[]{0, 1, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &chaos = report["results"][i]["chaos"];
    const auto S      = lumped["S"][frequencies[i]].get<std::vector<double>>();
    EXPECT_LT(chaos["held_out"].get<double>(), 0.01) << "rows that took no part in the fit";
    EXPECT_TRUE(near(chaos["sd"].get<double>(), lumped["sd_f"][frequencies[i]].get<double>(),
                     within(0.02, "wanted of the standard deviation")));
    for (std::size_t k = 0; k < S.size(); ++k)
      EXPECT_TRUE(near(chaos["first"][k].get<double>(), S[k], within_absolute(0.02, "wanted of the indices")))
          << k;
    // Derivatives at the means are exact: the reference has nine digits.
    EXPECT_TRUE(near(report["results"][i]["linear"]["sd"].get<double>(),
                     lumped["sd_linear"][frequencies[i]].get<double>(),
                     within(2e-4, "the reference takes one-sided steps; error of its differences")));
  }
  const std::string page = mill::read_text(folder + "/report.html");
  EXPECT_NE(page.find("Polynomial in place of the model"), std::string::npos);
}

// f1 grows with the stiffness of the upper housing and falls with the mass of the backup roll.
TEST(StudyMethods, TheOptimumIsFoundAlsoAfterKills)
{
  const std::string folder = scratch("study-optimum");
  const std::string study  = chain +
                            "--method optimise --maximise f1 --samples 12 --vary 'given.K1~uniform(4, 8) "
                            "MN/mm' --vary 'given.M2~uniform(50, 70) t' -o " +
                            folder;
  expect_done(study + "/whole");
  expect_done(study + "/killed");
  expect_done("study run " + folder + "/whole -q");
  expect_done("study report " + folder + "/whole -q");
  for (int i = 0; i < 4; ++i)
    shell("timeout -s KILL 0." + std::to_string(2 + i) + " '" MILLSTAND_PROGRAM "' study run " + folder +
              "/killed -q",
          MILLSTAND_SOURCE_DIR);
  expect_done("study run " + folder + "/killed -q");
  expect_done("study report " + folder + "/killed -q");
  EXPECT_EQ(mill::read_text(folder + "/killed/results.csv"), mill::read_text(folder + "/whole/results.csv"));
  const auto optimum = report_of(folder + "/whole")["optimum"];
  EXPECT_TRUE(optimum["at_bound"][0].get<bool>()) << "f1 grows with K1";
  EXPECT_TRUE(near(optimum["inputs"][0].get<double>(), 8, within(1e-12, "the bound itself")));
  EXPECT_TRUE(near(optimum["inputs"][1].get<double>(), 50, within(1e-12, "and falls with M2")));
  ASSERT_EQ(optimum["valley"].size(), 2u);
  double before = 0;  // along K1 the best f1 grows
  for (const auto &point : optimum["valley"][0]) {
    EXPECT_GT(point["value"].get<double>(), before);
    before = point["value"];
  }
  const Outcome run =
      millstand("modes cases/published-1400.toml --set 'given.K3=4.0192e10 N/m' --set "
                "'given.K5=4.0192e10 N/m' --set 'given.K4=0 N/m' --set "
                "dynamics.force_meaning=measured --set 'given.K1=8 MN/mm' --set 'given.M2=50 t' -q -o " +
                folder + "/run");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results = nlohmann::json::parse(mill::read_text(folder + "/run/results.json"));
  EXPECT_TRUE(near(optimum["value"].get<double>(), results["values"]["f1"]["value"].get<double>(),
                   within(1e-9, "the run of the same case; closed forms of the chain")));
  EXPECT_NE(mill::read_text(folder + "/whole/report.html").find("Valley of the optimum"), std::string::npos);
}

TEST(StudyMethods, CorrelatedInputsWidenTheLinearEstimate)
{
  const std::string folder = scratch("study-correlated");
  const std::string study  = chain +
                            "--samples 64 --vary 'given.K1~normal(10 %)' --vary 'given.K7~normal(10 %)' "
                            "--watch f1 -o " +
                            folder;
  for (const std::string correlate : {"", " --correlate given.K1,given.K7=0.9"}) {
    const std::string there = folder + (correlate.empty() ? "/independent" : "/joined");
    expect_done(study + (correlate.empty() ? "/independent" : "/joined") + correlate);
    expect_done("study run " + there + " -q");
    expect_done("study report " + there + " -q");
  }
  const auto alone  = report_of(folder + "/independent")["results"][0],
             joined = report_of(folder + "/joined")["results"][0];
  // Of two derivatives a and b: a2 + b2 + 2 r a b over a2 + b2.
  const double a2 = alone["linear"]["shares"][0], b2 = alone["linear"]["shares"][1];
  EXPECT_TRUE(near(std::pow(joined["linear"]["sd"].get<double>() / alone["linear"]["sd"].get<double>(), 2),
                   1 + 2 * 0.9 * std::sqrt(a2 * b2), within(1e-9, "closed form")));
  EXPECT_TRUE(near(joined["statistics"]["sd"]["value"].get<double>(), joined["linear"]["sd"].get<double>(),
                   within(0.27, "three standard errors of 64 rows: 3 / sqrt(2 x 64)")));
}

TEST(StudyMethods, RowsOfKindStackVaryPairsAndASampleHoldsItsResults)
{
  const std::string folder = scratch("study-stack") + "/study";
  expect_done(
      "study new cases/stack-two-high.toml --method grid --vary 'roll.0.crown=0,50 um' --watch stack.crown -q "
      "-o " +
      folder);
  expect_done("study run " + folder + " -q --keep --cache-limit 1GB");
  expect_done("study merge " + folder);
  std::size_t files = 0;
  for (const char *row : {"/samples/row-000001", "/samples/row-000002"}) {
    EXPECT_TRUE(fs::exists(folder + row + "/results.json")) << row;
    for (const auto &file : fs::recursive_directory_iterator(folder + row))
      files += file.is_regular_file();
  }
  EXPECT_GT(files, 2u) << "--keep keeps curves as well";
  const auto sample = nlohmann::json::parse(mill::read_text(folder + "/samples/row-000002/results.json"));
  EXPECT_TRUE(sample["values"].contains("stack.profile_rms")) << "results that are not watched are there, too";
  const Outcome bend =
      millstand("sweep cases/stack-six-high.toml --model quick --vary 'roll.0.bending_force=0..200 "
                "kN:3' --watch stack.crown --watch stack.profile_rms -q -o " +
                scratch("sweep-pair") + "/sweep");
  ASSERT_EQ(bend.exit_code, 0) << bend.err;
  const auto table = nlohmann::json::parse(mill::read_text(scratch("sweep-pair") + "/sweep/sweep.json"));
  const auto crown = [&](const int row) { return table["rows"][row]["results"][0].get<double>(); };
  EXPECT_EQ(table["rows"][1]["values"][0], "[\"100 kN\", \"100 kN\"]");
  EXPECT_TRUE(near(crown(0) - crown(1), crown(1) - crown(2),
                   within(0.05, "bending acts almost linearly while the rolls touch everywhere")));
}

// Saddles are keys of their own roll, a bearing and its housing those of theirs; the law of the strip is a word.
TEST(StudyMethods, KeysOfSaddlesBearingsAndTheLawOfAStackVary)
{
  const auto rows = [](const std::string &file, const std::string &key, const std::string &watched) {
    const std::string folder = scratch("sweep-keys") + "/sweep";
    const Outcome done = millstand("sweep " + file + " --model quick --vary '" + key + "' --watch " + watched +
                                   " --watch stack.crown -q -o " + folder);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return nlohmann::json::parse(mill::read_text(folder + "/sweep.json"))["rows"];
  };
  const auto saddles =
      rows("cases/stack-twenty-high.toml", "roll.7.saddles.shaft_diameter=100 mm,130 mm", "stack.modulus.mid");
  EXPECT_LT(saddles[0]["results"][0], saddles[1]["results"][0]) << "a thinner backing shaft gives way more";
  std::string text        = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-four-high.toml");
  const std::string given = "bearing_stiffness = [\"2070 kN/mm\", \"3030 kN/mm\"]";
  ASSERT_NE(text.find(given), std::string::npos);
  text.replace(text.find(given), given.size(), "bearing = \"crb\"\nhousing_stiffness = \"2500 kN/mm\"");
  text += "friction = 0.05\n\n[strip.flow_stress]\nlaw = \"constant\"\nk = \"300 MPa\"\n\n"
          "[bearing.crb]\ntype = \"four-row cylindrical\"\nrollers_per_row = 32\nroller_length = \"110 mm\"\n"
          "roller_law = \"palmgren\"\n";
  const std::string file = scratch("stack-keys") + ".toml";
  mill::write_atomically(file, text);
  const auto housing = rows(file, "roll.1.housing_stiffness=2000 kN/mm,3000 kN/mm", "stack.opening");
  EXPECT_TRUE(near(housing[0]["results"][0].get<double>() - housing[1]["results"][0].get<double>(),
                   976.2e3 * (1 / 2e9 - 1 / 3e9), within(1e-6, "half the force on each side, both halves")));
  const auto rollers = rows(file, "bearing.crb.rollers_per_row=24,32", "roll.B.bearing_stiffness");
  EXPECT_LT(rollers[0]["results"][0], rollers[1]["results"][0]);
  EXPECT_TRUE(near(rollers[0]["results"][1].get<double>(), rollers[1]["results"][1].get<double>(),
                   within(1e-7, "both chocks move alike")));
  const auto laws = rows(file, "strip.law=modulus,bite", "stack.modulus.mid");
  EXPECT_NE(laws[0]["results"][1], laws[1]["results"][1]) << "the slopes of the bite are others";
  fs::remove(file);
}
}  // namespace
