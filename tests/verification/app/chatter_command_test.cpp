#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

// kind = "chatter" and the verb as a user meets them.
namespace fs = std::filesystem;

namespace {
Outcome chatter(const std::string &path, const std::string &name, const std::string &more)
{
  return millstand("chatter " + path + " -o " + scratch(name) + " --cache " + shared_cache() +
                   " --force-overwrite --set analysis.map_points=0 --set analysis.duration='0.2 s' " + more);
}

bool has(const nlohmann::json &results, const std::string &name)
{
  return results.at("values").contains(name);
}

const std::string published = "cases/chatter-tandem.toml";

std::string published_text()
{
  std::ifstream in(published);
  return {(std::istreambuf_iterator<char>(in)), {}};
}

std::string written(const std::string &name, const std::string &text)
{
  const std::string path = scratch(name) + ".toml";
  std::ofstream(path) << text;
  return path;
}

// The text without its third condition, and without the first one too: what one condition says costs a third.
std::string with_two_conditions(std::string text)
{
  const auto third = text.rfind("[[condition]]"), analysis = text.find("[analysis]");
  return text.erase(third, analysis - third);
}
std::string with_condition_2(const std::string &text)
{
  std::string two  = with_two_conditions(text);
  const auto first = two.find("[[condition]]"), second = two.find("[[condition]]", first + 1);
  return two.erase(first, second - first);
}
const std::string &condition_2()
{
  static const std::string path = written("condition-2", with_condition_2(published_text()));
  return path;
}
// Condition 2 with Coulomb's friction on a stand that nothing damps.
std::string undamped_with_coulomb()
{
  std::string text = with_condition_2(published_text());
  text.erase(text.find("[oil]"), text.find("# Bodies from the top") - text.find("[oil]"));
  text.insert(text.find("[strip]") + 7, "\nfriction = 0.0283");
  const auto dampings = text.find("dampings");
  text.replace(dampings, text.find(']', dampings) + 1 - dampings,
               "dampings = [\"0 N s/m\", \"0 N s/m\", \"0 N s/m\", \"0 N s/m\", \"0 N s/m\", \"0 N s/m\"]");
  return written("undamped", text);
}
const auto search = within(1e-5, "root finding and the settled bite are far below the digits of the reference");
}  // namespace

// The published conditions: computed values beside the printed ones, in results, files and on the console.
TEST(ChatterCommand, PrintsThePublishedTable)
{
  const auto outcome =
      chatter(published, "published", "--set analysis.map_points=8 --set analysis.duration='0.6 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char *text : {"condition  quantity", "critical speed", "rolling force", "friction",
                           "condition 2: unstable above 18.207 m/s (128.1 Hz)"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << "\n" << outcome.out;
  const auto results = results_of("published");
  EXPECT_TRUE(near(value(results, "chatter.1.critical_speed"), 18.646221249626493, search));
  EXPECT_TRUE(near(value(results, "chatter.2.critical_speed"), 18.207252873709336, search));
  EXPECT_TRUE(near(value(results, "chatter.2.frequency"), 128.11380277994402, search));
  EXPECT_TRUE(near(value(results, "bite.2.force"), 8736293.890034175, search));
  EXPECT_TRUE(near(value(results, "bite.2.friction"), 0.02832038583977992, search));
  EXPECT_TRUE(near(value(results, "chatter.2.variant.B.critical_speed"), 18.195786551768776, search));
  EXPECT_TRUE(near(value(results, "chatter.2.scheme.consistent.critical_speed"), 19.22846269597016, search));
  EXPECT_TRUE(near(value(results, "chatter.2.speed_slope.oil.viscosity"), -0.26938348159049597,
                   within(2e-3, "the reference is a difference over 2 %")));
  EXPECT_TRUE(has(results, "chatter.3.critical_speed"));
  for (const char *file :
       {"curves/chatter-2.json", "curves/chatter-2-speed.csv", "curves/chatter-2-locus.csv",
        "curves/chatter-2-map-reduction.csv", "curves/chatter-2-map-tension.csv",
        "curves/chatter-2-map-viscosity.csv", "response/chatter-2-below.csv", "response/chatter-2-at.csv",
        "response/chatter-2-above.csv", "response/chatter-2-limit-cycle.csv", "report.html"})
    EXPECT_TRUE(fs::is_regular_file(scratch("published") + "/" + file)) << file;
  // Oil so thin that the flattening diverges: one cell is empty, and a sentence names the reason.
  std::ifstream map(scratch("published") + "/curves/chatter-2-map-viscosity.csv");
  int n_empty = 0;
  for (std::string line; std::getline(map, line);) {
    EXPECT_EQ(line.find("nan"), std::string::npos) << line;
    n_empty += line.find(",,") != std::string::npos;
  }
  EXPECT_NE(
      results.at("assumptions")
          .dump()
          .find("condition 2: map of speed and viscosity of the oil: " + std::to_string(n_empty) +
                " of 64 cells are empty because the bite has no steady state there (the rolls flatten faster "
                "than the gap closes"),
      std::string::npos)
      << results.at("assumptions").dump();
}

// What resolved.toml holds runs again to the same numbers.
TEST(ChatterCommand, TheResolvedCaseGivesTheSameResults)
{
  ASSERT_EQ(chatter(condition_2(), "first", "-q").exit_code, 0);
  ASSERT_EQ(chatter(scratch("first") + "/resolved.toml", "again", "-q").exit_code, 0);
  EXPECT_EQ(results_of("first").at("values"), results_of("again").at("values"));
}

// A range without a crossing says so, with the margin, and is not a failure.
TEST(ChatterCommand, AStableRangeHasNoCriticalSpeedButAMargin)
{
  const auto outcome = chatter(condition_2(), "stable", R"(--set 'analysis.speeds=["8 m/s", "15 m/s"]')");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("condition 2: stable"), std::string::npos) << outcome.out;
  const auto results = results_of("stable");
  EXPECT_FALSE(has(results, "chatter.2.critical_speed"));
  EXPECT_LT(value(results, "chatter.2.margin"), 0.0);
}

TEST(ChatterCommand, AnUnstableRangeHasAPositiveMargin)
{
  const auto outcome = chatter(condition_2(), "unstable", R"(--set 'analysis.speeds=["22 m/s", "30 m/s"]')");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("condition 2: unstable"), std::string::npos) << outcome.out;
  EXPECT_GT(value(results_of("unstable"), "chatter.2.margin"), 0.0);
}

// At low speed the film breaks down and the flattening has no root: said, and the search goes on elsewhere.
TEST(ChatterCommand, WarnsOfAWorkingSpeedWithoutABite)
{
  const auto outcome = chatter(condition_2(), "slow",
                               "--set condition.0.speed='1 m/s' --set analysis.speeds='[\"1 m/s\", \"30 m/s\"]'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("condition 2 has no steady bite at its working speed of 1 m/s"), std::string::npos)
      << outcome.out;
  const auto results = results_of("slow");
  EXPECT_FALSE(has(results, "bite.2.force"));
  EXPECT_TRUE(near(value(results, "chatter.2.critical_speed"), 18.207252873709336, search));
  EXPECT_GT(value(results, "chatter.2.lowest_speed_with_bite"), 1.0);
}

TEST(ChatterCommand, NoBiteAnywhereIsAFailureOfTheSolver)
{
  const auto outcome = chatter(condition_2(), "nowhere", "--set analysis.speeds='[\"0.5 m/s\", \"1 m/s\"]'");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("has no steady bite at any speed of the range searched"), std::string::npos)
      << outcome.err;
}

TEST(ChatterCommand, TensionAboveTheFlowStress)
{
  for (const char *verb : {"check", "chatter"}) {
    const auto outcome =
        millstand(std::string(verb) + " " + published + " --set condition.1.exit_tension='800 MPa'");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(
        outcome.err.find("condition.1.exit_tension = 800 MPa would stretch the strip outside the bite, whose flow "
                         "stress is 780.498 MPa there; lower the tension"),
        std::string::npos)
        << outcome.err;
  }
}

TEST(ChatterCommand, FilmOutsideItsRange)
{
  const auto known = chatter(condition_2(), "film", "--set oil.film_range='[\"0.1 um\", \"0.5 um\"]'");
  ASSERT_EQ(known.exit_code, 0) << known.err;
  EXPECT_NE(
      known.out.find("condition 2: the oil film of 0.89 um is outside 0.1 .. 0.5 um, over which the friction was "
                     "measured (oil.film_range)"),
      std::string::npos)
      << known.out;
  const auto thick =
      chatter(condition_2(), "thick", "--set oil.viscosity='9 mPa s' --set condition.0.speed='28 m/s'");
  ASSERT_EQ(thick.exit_code, 0) << thick.err;
  EXPECT_NE(thick.out.find("where the friction law still depends on the film"), std::string::npos) << thick.out;
}

// Constant friction instead of a film: an older model of the same mill.
TEST(ChatterCommand, ConstantFriction)
{
  std::string text = with_two_conditions(published_text());
  const auto oil = text.find("[oil]"), stand = text.find("# Bodies from the top");
  ASSERT_NE(oil, std::string::npos);
  text.erase(oil, stand - oil);
  text.insert(text.find("initial_thickness"), "friction = 0.04\n");
  const auto outcome = chatter(written("constant", text), "constant", "-q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("constant");
  EXPECT_TRUE(near(value(results, "chatter.1.critical_speed"), 21.201916245263902, search));
  EXPECT_TRUE(near(value(results, "chatter.2.critical_speed"), 19.738938604434455, search));
  const auto &friction = results.at("values").at("bite.1.friction");
  EXPECT_EQ(friction.at("value").get<double>(), 0.04);
  EXPECT_TRUE(friction.at("error_estimate").is_null()) << "a given coefficient is the same in every theory";
  EXPECT_EQ(friction.dump().find("Bland and Ford"), std::string::npos) << friction.dump();
}

// The stand of a lumped model, by its path.
TEST(ChatterCommand, StandFromALumpedModel)
{
  const std::string model = scratch("model") + ".toml";
  std::ofstream(model)
      << "schema = 1\nkind = \"lumped\"\n[given]\n"
         "M1 = \"119 t\"\nM2 = \"75 t\"\nM3 = \"9.2 t\"\nM4 = \"9.2 t\"\nM5 = \"75 t\"\nM6 = \"36.5 t\"\n"
         "K1 = \"6.9e10 N/m\"\nK2 = \"3.0e10 N/m\"\nK3 = \"6.06e10 N/m\"\nK4 = \"1e9 N/m\"\n"
         "K5 = \"6.06e10 N/m\"\nK6 = \"4.4e10 N/m\"\nK7 = \"10.1e10 N/m\"\n"
         "[dynamics]\nmodal_damping = \"1 %\"\n";
  std::string text = with_condition_2(published_text());
  const auto from = text.find("masses "), to = text.find("# published digits");
  text.erase(from, to - from);
  text.insert(from, "from = \"" + fs::path(model).filename().string() + "\"\n");
  const auto variants = text.find("# Other models"), conditions = text.find("[[condition]]");
  text.erase(variants, conditions - variants);
  const std::string path = fs::path(model).parent_path().string() + "/from-model.toml";
  std::ofstream(path) << text;
  const auto outcome = chatter(path, "from", "-q");  // its dampers are those of the case
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(near(value(results_of("from"), "chatter.2.critical_speed"), 18.207252873709336, search));

  const auto lumped = millstand("chatter " + model);
  EXPECT_EQ(lumped.exit_code, 2);
  EXPECT_NE(lumped.err.find("a lumped model alone cannot chatter: it has no strip"), std::string::npos)
      << lumped.err;
}

// Two stands: the critical speed of the tandem and those of its stands.
TEST(ChatterCommand, TwoStands)
{
  const auto outcome = chatter("cases/chatter-two-stands.toml", "two", "");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("tandem: "), std::string::npos) << outcome.out;
  const auto results = results_of("two");
  EXPECT_TRUE(near(value(results, "chatter.4.critical_speed"), 18.207252873709336, search))
      << "the published condition";
  EXPECT_TRUE(fs::is_regular_file(scratch("two") + "/curves/chatter-tandem.json"));
  EXPECT_TRUE(fs::is_regular_file(scratch("two") + "/curves/chatter-tandem-speed.csv"));
}

TEST(ChatterCommand, OtherVerbsHaveNothingToCompute)
{
  const auto outcome = millstand("stiffness " + published);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("millstand stiffness has nothing to compute for kind = \"chatter\""),
            std::string::npos)
      << outcome.err;
}

// The template runs as it is.
TEST(ChatterCommand, TheTemplateRuns)
{
  const std::string path = scratch("template") + ".toml";
  fs::remove(path);
  ASSERT_EQ(millstand("new chatter -o " + path).exit_code, 0);
  const auto outcome = chatter(path, "template", "-q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(value(results_of("template"), "chatter.2.critical_speed"), 5.0);
}

TEST(ChatterCommand, AnUndampedStandUnderCoulombsFrictionHasOnlyWhatIsDefinedThere)
{
  const auto outcome = chatter(undamped_with_coulomb(), "undamped", "-q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("undamped");
  for (const auto &check : results.at("values").at("chatter.2.unstable_roots").at("checks"))
    EXPECT_GE(check.at("value").get<double>(), 0) << check.dump();  // Nyquist's curve meets a pole there
  const auto &critical = results.at("values").at("chatter.2.critical_speed");
  const auto &routh    = critical.at("checks").at(0);
  ASSERT_EQ(routh.at("name"), "Routh's array in extended precision") << critical.dump();
  EXPECT_TRUE(near(routh.at("value").get<double>(), critical.at("value").get<double>(),
                   within_absolute(1e-6, "tolerance of the search by Routh's array")));
  // Durations of 1, 2 and 4 s are tried.
  const std::string assumptions = results.at("assumptions").dump();
  EXPECT_NE(assumptions.find("has not settled after 4 s"), std::string::npos) << assumptions;
  std::ifstream in(scratch("undamped") + "/curves/chatter-2.json");
  const auto conclusions = nlohmann::json::parse(in).at("conclusions");
  EXPECT_EQ(conclusions.at(0).at("text"), "There is a critical speed");
  EXPECT_EQ(conclusions.at(1).at("text"), "The critical speed");
  for (const auto &one : conclusions) {
    EXPECT_NE(one.at("text"), "Friction follows the force") << "a constant coefficient has no phase";
    EXPECT_EQ(one.at("detail").get<std::string>().find("nan"), std::string::npos) << one.dump();
  }
}
