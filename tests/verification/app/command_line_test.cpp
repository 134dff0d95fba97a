#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

// The program as a user meets it.
namespace fs = std::filesystem;

namespace {
nlohmann::json json_of(const std::string &file)
{
  return nlohmann::json::parse(std::ifstream(file));
}

// Results of stepped beams in place of solid rolls, for comparison.
double by_beams(const nlohmann::json &results, const std::string &name)
{
  for (const auto &check : results.at("values").at(name).at("checks"))
    if (check.at("name") == "rolls as stepped beams (4.4)-(4.10)")
      return check.at("value").get<double>();
  return std::nan("");
}

// A stand that is quick to condense: the demo case on a coarse mesh, its bearings by the standard.
const std::string coarse =
    " --set bearing.trb.roller_law=iso --set bearing.trb.rings=rigid"
    " --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2"
    " --set bite.elements_along=16 --set bite.elements_through=4 --set dynamics.output_rate='5 kHz' --cache " +
    shared_cache();

std::string run_demo(const std::string &out, const std::string &more = "")
{
  const auto outcome = millstand("run cases/four-high-1400.toml -q -o " + out + coarse + " " + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return out;
}
}  // namespace

TEST(Run, TwoCylindersAgreeWithTheClosedForm)
{
  const std::string out = scratch("cylinders");
  const auto outcome    = millstand("run cases/two-cylinders.toml -q -o " + out + " --cache " + shared_cache());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = json_of(out + "/results.json");
  EXPECT_EQ(results["status"], "ok");
  // Johnson (1985), R 200/650 mm, E 210 GPa, nu 0.3, 1000 N/mm.
  EXPECT_TRUE(
      near(value(results, "contact.line.half_width"), 1.2991e-3, within(0.01, "half width, issue's own bound")));
  EXPECT_TRUE(near(value(results, "contact.line.peak_pressure"), 490.05e6, within(0.01, "peak pressure, same")));
  EXPECT_TRUE(
      near(value(results, "contact.line.approach"), 35.931e-6, within(0.003, "energy converges with (h/b)^2")));
  EXPECT_TRUE(
      near(value(results, "contact.line.tangent"), 30146e6, within(0.01, "edge known to one of 16 nodes")));
  for (const char *file : {"resolved.toml", "results.json", "run.json", "millstand.log", "report.html",
                           "curves/contact-line.csv", "fields/contact-line-upper.vtu"})
    EXPECT_GT(fs::file_size(out + "/" + file), 0u) << file;
}

TEST(RunLong, TheDemoStandWritesEveryDocumentedFileAndName)
{
  const std::string out = run_demo(scratch("demo"));
  for (const char *file : {"resolved.toml", "results.json", "run.json", "millstand.log", "report.html",
                           "lumped_model.toml", "curves/contact-upper.csv", "curves/contact-upper-barrel.csv",
                           "curves/contact-lower.csv", "curves/bearing-trb.csv", "curves/bearing-trb-rows.csv",
                           "curves/shape-work-roll.csv", "curves/shape-backup-roll.csv", "curves/modes.csv",
                           "response/pass-1.csv", "response/pass-2.csv", "fields/contact-upper-work-roll.vtu"})
    EXPECT_TRUE(fs::exists(out + "/" + file)) << file;
  const auto results = json_of(out + "/results.json");
  std::vector<std::string> names;
  for (int i = 1; i <= 7; ++i)
    names.push_back("K" + std::to_string(i));
  for (int i = 1; i <= 6; ++i)
    names.insert(names.end(), {"M" + std::to_string(i), "f" + std::to_string(i)});
  for (int i = 1; i <= 4; ++i) {
    const std::string Kzc = "Kzc" + std::to_string(i);
    names.insert(names.end(), {Kzc, Kzc + ".tangent", Kzc + ".secant", Kzc + ".roller_secant", Kzc + ".row1_share",
                               Kzc + ".row4_share", "fh" + std::to_string(i)});
  }
  for (const char *contact : {"upper", "lower"})
    for (const char *what : {"half_width", "peak_pressure", "approach"})
      names.push_back("contact." + std::string(contact) + "." + what);
  for (const char *pass : {"pass 1", "pass 2"})
    for (const char *what :
         {"peak_g.upper_work_roll", "peak_g.lower_work_roll", "rms_g.upper_work_roll", "rms_g.lower_work_roll"})
      names.push_back(std::string(pass) + "." + what);
  names.insert(names.end(), {"K3.tangent", "K3.secant", "K5.tangent", "K5.secant", "pass 2.K3.tangent",
                             "K4.plastic_slope", "K4.flattening", "K4.combined"});
  for (const std::string &name : names) {
    ASSERT_TRUE(results["values"].contains(name)) << name;
    const auto &entry = results["values"][name];
    EXPECT_TRUE(entry["value"].is_number()) << name;
    for (const char *key : {"unit", "source", "at", "error_estimate", "inputs"})
      EXPECT_TRUE(entry.contains(key)) << name << "." << key;
  }
  // Closed-form chain of the stand, with K3 from the finite elements; published equations, tolerances of their
  // inputs.
  EXPECT_TRUE(near(value(results, "K1"), 6.31412e9, within(2e-6, "springs in series, six digits printed")));
  EXPECT_TRUE(near(value(results, "K7"), 6.88067e9, within(2e-6, "springs in series, six digits printed")));
  // The chain bends solid rolls; stepped beams are compared with them.
  EXPECT_TRUE(near(by_beams(results, "K2"), 1.02333e10,
                   within(2e-5, "bearing load is the mean of the record, 0.02 % off the mid value")));
  EXPECT_TRUE(near(by_beams(results, "M2"), 59725.0, within(1e-5, "same")));
  EXPECT_TRUE(near(by_beams(results, "M5"), 42315.97, within(1e-5, "same")));
  EXPECT_TRUE(near(by_beams(results, "M3"), 1875.25,
                   within(2e-3, "K3 of a coarse mesh enters the shape of the work roll")));
  EXPECT_LT(value(results, "K2"), by_beams(results, "K2")) << "the shoulder of a roll deflects, a beam's does not";
  EXPECT_TRUE(near(value(results, "K3.tangent"), 4.0192e10, within(0.05, "barrel ends, coarse mesh")));
  EXPECT_GT(value(results, "K3.secant"), 3.400e10) << "band of the closed forms";
  EXPECT_LT(value(results, "K3.secant"), 3.7208e10) << "band of the closed forms";
}

TEST(Run, ResolvedCaseAndCacheGiveTheSameBytes)
{
  const std::string first = run_demo(scratch("first"));
  const std::string again = run_demo(scratch("again"));
  EXPECT_EQ(mill::read_text(first + "/results.json"), mill::read_text(again + "/results.json"));
  const std::string out = scratch("resolved");
  const auto outcome    = millstand("run " + first + "/resolved.toml -q -o " + out + " --cache " + shared_cache());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  auto a = json_of(first + "/results.json"), b = json_of(out + "/results.json");
  EXPECT_EQ(a["values"], b["values"]);
  const std::string model = scratch("model");
  const auto lumped       = millstand("modes " + first + "/lumped_model.toml -q -o " + model);
  ASSERT_EQ(lumped.exit_code, 0) << lumped.err;
  const auto modes = json_of(model + "/results.json");
  for (int i = 1; i <= 6; ++i) {
    const std::string f = "f" + std::to_string(i);
    EXPECT_TRUE(near(value(modes, f), value(a, f), within(1e-12, "17 digits stored")));
  }
}

TEST(Run, ForeignFolderIsNotTouched)
{
  const std::string out = scratch("foreign");
  std::ofstream(out + "/thesis.txt") << "mine";
  const auto refused = millstand("run cases/two-cylinders.toml -o " + out);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err,
            "error: the folder " + out +
                " holds files that no run wrote; choose another with -o, or give --force-overwrite\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 1);

  const std::string other = scratch("other-case");
  ASSERT_EQ(millstand("modes cases/published-1400.toml -q -o " + other).exit_code, 0);
  const std::string before = mill::read_text(other + "/results.json");
  const auto second        = millstand("run cases/two-cylinders.toml -o " + other);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_EQ(
      second.err,
      "error: the folder " + other +
          " holds the results of the case 'published-1400'; choose another with -o, or give --force-overwrite\n");
  EXPECT_EQ(mill::read_text(other + "/results.json"), before);
}

TEST(Run, OutputThatCannotBeWrittenIsReported)
{
  const std::string blocked = scratch("blocked") + "/file";
  std::ofstream(blocked) << "x";
  const auto outcome = millstand("modes cases/published-1400.toml -q -o " + blocked);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: " + blocked + " is a file, not a folder; choose another with -o\n");
  const auto below = millstand("modes cases/published-1400.toml -q -o " + blocked + "/out");
  EXPECT_EQ(below.exit_code, 2);
  EXPECT_NE(below.err.find("cannot be created: Not a directory; choose another with -o"), std::string::npos)
      << below.err;
}

TEST(Run, KilledRunLeavesNoHalfFileAndTheNextOneFinishes)
{
  const std::string out = scratch("killed"), cache = scratch("killed-cache");
  const std::string run = "run cases/two-cylinders.toml -q --set contact.line.elements_per_half_width=2 -o " +
                          out + " --cache " + cache;
  for (const double after : {0.2, 0.4, 0.7}) {
    millstand(run + " & sleep " + std::to_string(after) + "; kill -9 $!");
    for (const char *file : {"results.json", "run.json"})
      if (fs::exists(out + "/" + file))
        EXPECT_FALSE(nlohmann::json::parse(std::ifstream(out + "/" + file), nullptr, false).is_discarded())
            << file;
  }
  const auto outcome = millstand(run);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json_of(out + "/results.json")["status"], "ok");
}

TEST(Run, WorkingLoadOutsideTheSweepNamesTheKey)
{
  const auto outcome = millstand("run cases/four-high-1400.toml -q -o " + scratch("outside") + coarse +
                                 " --set 'contact.upper.loads=[\"100 kN\", \"500 kN\"]'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find(
                "contact.upper.loads = 100 kN .. 500 kN does not hold the working load of 976 kN; a curve is "
                "never extrapolated, widen the range"),
            std::string::npos)
      << outcome.err;
}

TEST(New, TemplatesRunAsTheyAre)
{
  const std::string folder = scratch("templates");
  for (const char *kind : {"two-cylinders", "lumped"}) {
    const std::string file = folder + "/" + kind + ".toml";
    ASSERT_EQ(millstand(std::string("new ") + kind + " -o " + file).exit_code, 0);
    const std::string mesh = kind == std::string("lumped") ? "" : " --set contact.line.elements_per_half_width=3";
    const auto outcome =
        millstand("run " + file + " -q -o " + folder + "/out-" + kind + mesh + " --cache " + shared_cache());
    EXPECT_EQ(outcome.exit_code, 0) << kind << ": " << outcome.err;
  }
  const std::string file = folder + "/four-high.toml";
  ASSERT_EQ(millstand("new four-high -o " + file).exit_code, 0);
  // The demo stand's range of loads, so that its rolls come from the cache.
  const auto outcome = millstand("run " + file + " -q -o " + folder + "/out-four-high" + coarse +
                                 " --set bite.method=slab --set bite.arc=rigid"
                                 " --set 'contact.upper.loads=[\"100 kN\", \"2000 kN\"]'"
                                 " --set 'contact.lower.loads=[\"100 kN\", \"2000 kN\"]'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto twice = millstand("new four-high -o " + file);
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_EQ(twice.err, "error: the file " + file + " exists; choose another with -o, or give --force-overwrite\n");
}

// An error in the input leaves what --force-overwrite would have replaced, and a sentence says so.
TEST(ForceOverwrite, AnErrorInTheInputLeavesTheOldFiles)
{
  const std::string folder = scratch("overwrite"), file = folder + "/mine.toml", out = folder + "/out";
  std::ofstream(file) << "mine\n";
  std::ofstream(folder + "/sheet.csv") << "work_roll.colour,red\n";
  const auto from_sheet = millstand("new four-high --from " + folder + "/sheet.csv --force-overwrite -o " + file);
  EXPECT_EQ(from_sheet.exit_code, 2);
  EXPECT_NE(from_sheet.err.find("\nnothing was written; " + file + " is unchanged\n"), std::string::npos)
      << from_sheet.err;
  EXPECT_EQ(mill::read_text(file), "mine\n");

  ASSERT_EQ(millstand("new lumped -o " + folder + "/stand.toml").exit_code, 0);
  ASSERT_EQ(millstand("run " + folder + "/stand.toml -q -o " + out).exit_code, 0);
  const std::string before = mill::read_text(out + "/results.json");
  for (const auto &[verb, wrong] :
       {std::pair("run ", " --set given.M1='1 mm'"), {"simulate ", " --force no-such-record.csv"}}) {
    const auto outcome = millstand(verb + folder + "/stand.toml -q --force-overwrite -o " + out + wrong);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("nothing was written; " + out + " is unchanged\n"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(mill::read_text(out + "/results.json"), before);
  }
}

// What a run of a case with such names leaves: results by their parts, files by their letters, the page as
// written.
TEST(Names, MayHoldPointsAndSlashes)
{
  const std::string folder = scratch("names"), out = folder + "/out";
  ASSERT_EQ(millstand("new lumped -o " + folder + "/stand.toml").exit_code, 0);
  const std::string more = " --set 'pass.0.name=\"2.0 mm/A\"' -q -o " + out;
  const auto outcome     = millstand("simulate " + folder + "/stand.toml" + more);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(out + "/response/2-0-mm-a.csv"));
  EXPECT_NE(mill::read_text(out + "/results.json").find("\"2%2E0 mm%2FA.peak_g.upper_work_roll\""),
            std::string::npos);
  const std::string page = mill::read_text(out + "/report.html");
  EXPECT_NE(page.find("2.0 mm/A"), std::string::npos);
  EXPECT_EQ(page.find("%2E"), std::string::npos) << page.substr(page.find("%2E") - 200, 300);
  const auto table = millstand("simulate " + folder + "/stand.toml --set 'pass.0.name=\"2.0 mm/A\"' -o " + out);
  EXPECT_NE(table.out.find("2.0 mm/A.peak_g"), std::string::npos) << table.out;
}

TEST(Run, ARunRemovesOldResultsAndAFailedRunChangesNothing)
{
  const std::string out = scratch("stale");
  ASSERT_EQ(millstand("run cases/published-1400.toml -q -o " + out).exit_code, 0);
  const std::string before = mill::read_text(out + "/resolved.toml") + mill::read_text(out + "/results.json");
  const std::string record = scratch("records") + "/short.csv";
  std::ofstream(record) << "time [s],force [kN]\n0,976\n0.00004,977\n";
  const auto refused = millstand("simulate cases/published-1400.toml -q -o " + out +
                                 " --set 'given.K1=1e3 kN/mm' --force " + record);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(
      refused.err.find(
          "pass 1: the force record lasts 4e-05 s, which is 0.8 samples at dynamics.output_rate = 20 kHz; at "
          "least 16 are needed, give a longer record or a higher rate"),
      std::string::npos)
      << refused.err;
  EXPECT_EQ(mill::read_text(out + "/resolved.toml") + mill::read_text(out + "/results.json"), before);
  ASSERT_EQ(millstand("modes cases/published-1400.toml -q -o " + out).exit_code, 0);
  EXPECT_FALSE(fs::exists(out + "/response/pass-1.csv")) << "histories of the earlier run";
  for (const auto &entry : fs::directory_iterator(out))
    EXPECT_NE(entry.path().filename().string().substr(0, 5), ".run-");
}

TEST(Run, TwoRunsAtOnceLeaveWholeResults)
{
  const std::string out = scratch("twice"), one = "modes cases/published-1400.toml -q -o " + out;
  for (int trial = 0; trial < 4; ++trial) {
    const auto second = millstand(one + " & '" MILLSTAND_PROGRAM "' " + one + "; code=$?; wait $! && exit $code");
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(json_of(out + "/results.json")["status"], "ok");
    EXPECT_TRUE(fs::exists(out + "/curves/modes.csv"));
  }
}

TEST(Run, PassesThatShareAFileNameAreRefused)
{
  const auto outcome = millstand("check cases/published-1400.toml --set pass.1.name=Pass-1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("pass.name = \"Pass-1\" and \"pass 1\" both write response/pass-1.csv; rename one of them"),
      std::string::npos)
      << outcome.err;
}

TEST(Run, VerbThatDoesNotFitTheKindIsRefused)
{
  const auto outcome = millstand("modes cases/two-cylinders.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: millstand modes has nothing to compute for kind = \"two-cylinders\" "
                         "(cases/two-cylinders.toml); use millstand run\n");
}

TEST(CommandLine, HelpVersionAndErrorsHaveTheirExitCodes)
{
  EXPECT_EQ(millstand("--help").exit_code, 0);
  const auto version = millstand("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_NE(version.out.find("GPL-3.0-or-later"), std::string::npos);
  EXPECT_EQ(millstand("").exit_code, 2);
  EXPECT_EQ(millstand("fly cases/two-cylinders.toml").exit_code, 2);
  EXPECT_EQ(millstand("run").exit_code, 2);
  EXPECT_EQ(millstand("run no-such-case.toml").exit_code, 2);
  EXPECT_EQ(millstand("report " + scratch("empty")).exit_code, 2);
  const auto check = millstand("check cases/four-high-1400.toml");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_EQ(
      check.out.rfind("cases/four-high-1400.toml: no errors (four-high \"1400 four-high, demo stand\")\n", 0), 0u);
  // The strip of the first pass is fitted to its force, not that of the second.
  EXPECT_NE(check.out.find(": warning: pass 2: by the slab theory this strip takes a rolling force of "),
            std::string::npos);
  EXPECT_NE(check.out.find(" kN, the load is 738.2 kN (+"), std::string::npos) << check.out;
  const std::string facts =
      "bearing.trb: the apex condition closes at a cup angle of 19.66 deg; cup_angle is 19.66 deg\n"
      "bearing.trb: arrangement is not given; +-+-, pairs back to back: two double cups (TQI) is "
      "assumed\n"
      "pass 1: the force record lasts 10 s, 100001 samples at 10 kHz, mean 976 kN\n"
      "pass 2: the force record lasts 10 s, 100001 samples at 10 kHz, mean 738.2 kN\n";
  EXPECT_EQ(check.out.substr(check.out.size() - std::min(facts.size(), check.out.size())), facts);
}

TEST(CommandLine, MistypedVerbsAndOptionsGetTheNearest)
{
  EXPECT_EQ(millstand("chekc cases/two-cylinders.toml").err,
            "error: unknown verb 'chekc'; did you mean 'check'?\n");
  EXPECT_EQ(millstand("run cases/two-cylinders.toml --freshh").err,
            "error: millstand run has no option --freshh; did you mean '--fresh'?\n");
  EXPECT_EQ(millstand("check cases/two-cylinders.toml --outptu x").exit_code, 2);
}

TEST(CommandLine, ASheetFillsATemplateThatIsChecked)
{
  const std::string folder = scratch("sheet");
  std::ofstream(folder + "/stand.csv") << "key;value;unit\nwork_roll.barrel_diameter;425,5;mm\n";
  ASSERT_EQ(millstand("new four-high --from " + folder + "/stand.csv -o " + folder + "/stand.toml").exit_code, 0);
  EXPECT_NE(mill::read_text(folder + "/stand.toml").find("barrel_diameter = \"425.5 mm\"  # roll drawing: "),
            std::string::npos);
  const auto check = millstand("check " + folder + "/stand.toml");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("warning: "), std::string::npos) << "what is left of the template";
}

TEST(CommandLine, ARunEndsWithASummary)
{
  const auto outcome = millstand("run cases/published-1400.toml -o " + scratch("verdict"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 25) << outcome.out;
  EXPECT_EQ(outcome.out.rfind("published-1400: finished with ", 0), 0u) << outcome.out;
  EXPECT_NE(outcome.out.find("/report.html\n"), std::string::npos);
  const auto table = millstand("run cases/published-1400.toml -v -o " + scratch("verdict"));
  EXPECT_NE(table.out.find("\nM1 "), std::string::npos) << table.out;
}

// The elasticity of a key in a section whose name holds separators.
TEST(Names, AKeyOfABearingWithSuchANameIsTraced)
{
  const std::string folder = scratch("traced-name"), file = folder + "/stand.toml";
  std::string text = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/bearing-266.toml");
  for (const auto &[from, to] :
       {std::pair("[bearing.trb]", "[bearing.\"TRB 1.5/a\"]"), {"\"trb\"", "\"TRB 1.5/a\""}}) {
    const auto place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, std::string(from).size(), to);
  }
  std::ofstream(file) << text;
  const auto named = millstand("trace " + file + " 'bearing.\"TRB 1.5/a\".roller_length'");
  const auto plain = millstand("trace cases/bearing-266.toml bearing.trb.roller_length");
  ASSERT_EQ(named.exit_code, 0) << named.err;
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_NE(named.out.find("bearing.TRB 1.5/a.roller_length = "), std::string::npos) << named.out;
  const auto n_lines = [](const std::string &t) { return std::count(t.begin(), t.end(), '\n'); };
  EXPECT_EQ(n_lines(named.out), n_lines(plain.out)) << named.out << plain.out;
  EXPECT_NE(named.out.find(" % per %"), std::string::npos) << named.out;
}
