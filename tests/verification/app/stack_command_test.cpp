#include "core/base/files.h"
#include "core/model/roller_bearing.h"
#include "reduce/bearing/rigid_rings.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include "tests/support/run_results.h"
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

// kind = "stack" as a user meets it: cases of the tree against the independent model of
// tests/reference/stack.json.
namespace {
constexpr double mm = 1e-3, um = 1e-6, kN = 1e3;

const std::string by_beams = " --set engine.model=beams";  // the engine of the reference

struct StackRun {
  std::string folder;
  nlohmann::json results;
  double value(const std::string &name) const
  {
    return results.at("values").at(name).at("value").get<double>();
  }
  // A closed form next to the result, by the beginning of its name.
  double check(const std::string &name, const std::string &beginning) const
  {
    for (const auto &one : results.at("values").at(name).at("checks"))
      if (one.at("name").get<std::string>().rfind(beginning, 0) == 0)
        return one.at("value").get<double>();
    ADD_FAILURE() << name << " has no check " << beginning;
    return 0;
  }
};

// Each question is computed once for all tests of this file: several compare the same run.
const StackRun &stack_run(const std::string &stand, const std::string &more = "")
{
  static std::map<std::string, StackRun> runs;
  const auto [place, first] = runs.try_emplace(stand + more);
  StackRun &run             = place->second;
  if (!first)
    return run;
  run.folder            = scratch("stack-" + std::to_string(runs.size()) + "-" + stand);
  const Outcome outcome = millstand("run cases/stack-" + stand + "-high.toml -o " + run.folder + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  run.results = nlohmann::json::parse(mill::read_text(run.folder + "/results.json"));
  return run;
}

struct StackCommandCase {
  const char *entry;  // of tests/reference/stack.json
  const char *stand;
  const char *sets = "";
};

class StackCommand : public testing::TestWithParam<StackCommandCase> {};
}  // namespace

TEST_P(StackCommand, AgreesWithTheReference)
{
  const StackRun &run    = stack_run(GetParam().stand, by_beams + GetParam().sets);
  const Reference result = reference(GetParam().entry, "stack")["result"];
  const auto profile     = within(0.003, "mesh error of the reference, 0.15 um of the specification", 50 * um);
  EXPECT_TRUE(near(run.value("stack.crown"), um * double(result["crown_um"]), profile));
  EXPECT_TRUE(near(run.value("stack.edge_drop"), um * double(result["edge_drop_um"]), profile));
  EXPECT_TRUE(near(run.value("stack.wedge"), um * double(result["wedge_um"]), profile));
  EXPECT_TRUE(near(run.value("stack.opening"), mm * double(result["h_minus_S_mm"]),
                   within(1e-3, "mesh of the flattening")));
  EXPECT_TRUE(near(run.value("stack.modulus.mid"), 1e3 * double(result["tangent"]["mid_N_per_mm"]),
                   within(2e-3, "ends of open contacts lie within an element")));
}

INSTANTIATE_TEST_SUITE_P(
    All, StackCommand,
    testing::Values(
        StackCommandCase{"two-high", "two"}, StackCommandCase{"four-high", "four"},
        StackCommandCase{"four-high.bend", "four", R"( --set 'roll.0.bending_force=["100 kN", "100 kN"]')"},
        StackCommandCase{"four-high.crown", "four", " --set roll.0.crown='100 um' --set roll.1.crown='150 um'"},
        StackCommandCase{"four-high.offset", "four", " --set strip.offset='30 mm'"},
        StackCommandCase{"four-high.local", "four", " --set engine.flattening=local"},
        StackCommandCase{"six-high.all", "six"},
        StackCommandCase{"six-high.tension", "six", " --set strip.tension_modulus='2e5 MPa'"},
        StackCommandCase{"twenty-high", "twenty"}),
    [](const auto &one) {
      std::string name = one.param.entry;
      for (char &c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

namespace {
void expect_forces_of_statics(const StackRun &six, const StackRun &twenty)
{
  for (const auto &[run, pairs] :
       {std::pair{&six, std::vector<std::string>{"W-I", "I-B", "lower_W-lower_I", "lower_I-lower_B"}},
        std::pair{&twenty,
                  std::vector<std::string>{"S-O", "S-P", "O-I", "O-J", "I-A", "I-B", "J-B", "lower_J-lower_C"}}})
    for (const std::string &pair : pairs)
      EXPECT_TRUE(near(run->value("pair." + pair + ".force"), run->check("pair." + pair + ".force", "statics"),
                       within(1e-9, "residual of Newton's method")))
          << pair;
  EXPECT_TRUE(near(six.value("pair.I-B.load_centre"), 10 * mm,
                   within(1e-6, "deflections of a millimetre turn no line of force", 10 * mm)));
  EXPECT_TRUE(near(six.check("pair.I-B.load_centre", "statics"), 10 * mm, within(1e-12, "rounding")));
  EXPECT_TRUE(near(six.value("roll.B.reaction_drive"), six.check("roll.B.reaction_drive", "statics"),
                   within(1e-8, "residual of Newton's method")));
  const Reference over_force = reference("twenty-high", "stack")["resultants_over_F"];
  for (const char *pair : {"S-O", "O-I", "O-J", "I-A", "I-B", "J-B"})
    EXPECT_TRUE(near(twenty.value(std::string("pair.") + pair + ".force") / (1200 * kN), double(over_force[pair]),
                     within(3e-8, "positions of the reference have nine digits")));
}
}  // namespace

// A strip off the middle between backup rolls on unlike bearings: its load follows the gap, statics takes it
// there.
TEST(StackCommand, ComparesWithStaticsOfTheLoadWhereItIs)
{
  const StackRun &run =
      stack_run("four", by_beams + R"( --set strip.offset='150 mm' --set roll.0.thermal_crown='200 um')"
                                   R"( --set 'roll.1.bearing_stiffness=["200 kN/mm", "30000 kN/mm"]')");
  EXPECT_GT(std::abs(run.value("pair.W-B.load_centre") - 150 * mm), 5 * mm);
  for (const char *name : {"pair.W-B.load_centre", "roll.B.reaction_drive", "roll.B.reaction_operator"})
    EXPECT_TRUE(near(run.check(name, "statics"), run.value(name), within(1e-8, "residual of Newton's method")))
        << name;
}

// The other engine lies within the error, above all where a number is a small difference of large ones.
TEST(StackCommand, ErrorsReachTheOtherEngine)
{
  const StackRun &six = stack_run("six");
  for (const char *name :
       {"stack.crown", "stack.edge_drop", "stack.profile_rms", "stack.flatness.min", "stack.flatness.max",
        "roll.W.deflection", "roll.B.deflection", "pair.W-I.q_max", "influence.edge_drop.I.shift"}) {
    const double value = six.value(name), other = six.check(name, "Timoshenko");
    EXPECT_GE(six.results.at("values").at(name).at("error_estimate").get<double>() * std::abs(value) * (1 + 1e-9),
              std::abs(value - other))
        << name;
  }
}

// ST-1: no elasticity is in the resultants.  Condensed rolls of six, beams of twenty, which the reference asks for
// too.
TEST(StackCommandForces, FollowFromStaticsAlone)
{
  expect_forces_of_statics(stack_run("six"), stack_run("twenty", by_beams));
}

TEST(StackCommandForcesLong, FollowFromStaticsWithTwentyCondensedRolls)
{
  expect_forces_of_statics(stack_run("six"), stack_run("twenty"));
}

// ST-8: what does not change the stack changes no result.  The six-high stand is shifted, no side of it is like
// the other.
TEST(StackCommandForces, UnitsAndOrderOfTheRollsChangeNothing)
{
  const std::string drawn = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-six-high.toml");
  std::string metres, reordered;
  const std::regex length(R"re("(-?[0-9.]+) mm")re");
  auto from   = drawn.cbegin();
  int lengths = 0;
  for (std::smatch m; std::regex_search(from, drawn.cend(), m, length); from = m.suffix().first, ++lengths)
    metres += m.prefix().str() + fmt::format("\"{:.15g} m\"", std::stod(m[1]) / 1000);
  metres.append(from, drawn.cend());
  EXPECT_GT(lengths, 20);
  const auto first = drawn.find("[[roll]]"), last = drawn.find("[[roll]]\nname = \"B\""),
             strip = drawn.find("[strip]");
  ASSERT_LT(last, strip);
  reordered = drawn.substr(0, first) + drawn.substr(last, strip - last) + drawn.substr(first, last - first) +
              drawn.substr(strip);
  const StackRun &as_drawn = stack_run("six");
  for (const auto &[name, text] : {std::pair("metres", metres), std::pair("reordered", reordered)}) {
    const std::string file   = scratch(std::string("stack-") + name) + ".toml",
                      folder = scratch(std::string("stack-run-") + name);
    mill::write_atomically(file, text);
    const Outcome outcome = millstand("run " + file + " -o " + folder);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const StackRun other{folder, nlohmann::json::parse(mill::read_text(folder + "/results.json"))};
    int compared = 0;
    for (const auto &[result, entry] : as_drawn.results.at("values").items()) {
      if (!entry.at("value").is_number())
        continue;
      const double value = entry.at("value").get<double>();
      EXPECT_TRUE(near(other.value(result), value, within(1e-10, "rounding", std::abs(value))))
          << name << ' ' << result;
      ++compared;
    }
    EXPECT_GT(compared, 60) << name;
    EXPECT_EQ(other.results.at("values").size(), as_drawn.results.at("values").size()) << name;
    std::filesystem::remove(file);
  }
}

// The gap that a run with a force states gives that force back.
TEST(StackCommandForces, TheGapGivesTheForceBack)
{
  const StackRun &by_force = stack_run("four");
  std::string text         = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-four-high.toml");
  const std::string given  = "force = \"976.2 kN\"";
  const auto position      = text.find(given);
  ASSERT_NE(position, std::string::npos);
  char gap[64];
  std::snprintf(gap, sizeof gap, "gap = \"%.15g mm\"", 1e3 * by_force.value("stack.gap"));
  text.replace(position, given.size(), gap);
  const std::string file = scratch("stack-gap") + ".toml", folder = scratch("stack-gap-run");
  mill::write_atomically(file, text);
  const Outcome outcome = millstand("run " + file + " -o " + folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const StackRun by_gap{folder, nlohmann::json::parse(mill::read_text(folder + "/results.json"))};
  EXPECT_TRUE(near(by_gap.value("stack.force"), 976.2 * kN, within(1e-7, "steps end at 1e-9 of the opening")));
  std::filesystem::remove(file);
}

TEST(StackCommandResults, InfluencesAgreeWithTheReference)
{
  const StackRun &four = stack_run("four", by_beams), &six = stack_run("six", by_beams);
  const Reference slopes = reference("influence", "stack")["result"];
  const auto reason      = within(1e-3, "central differences of the reference and its mesh");
  const auto per         = [&](const char *name) { return double(slopes[name]); };
  EXPECT_TRUE(near(four.value("influence.crown.force"), per("four-high: d/dF um per kN") * um / kN, reason));
  EXPECT_TRUE(near(four.value("influence.crown.W.bending_force"),
                   per("four-high: d/d bending um per kN") * um / kN, reason));
  EXPECT_TRUE(
      near(four.value("influence.crown.W.crown"), per("four-high: d/d work-roll crown um per um"), reason));
  EXPECT_TRUE(near(four.value("influence.crown.B.crown"), per("four-high: d/d backup crown um per um"), reason));
  EXPECT_TRUE(
      near(six.value("influence.crown.W.bending_force"), per("six-high.all: d/d wb um per kN") * um / kN, reason));
  EXPECT_TRUE(
      near(six.value("influence.crown.I.bending_force"), per("six-high.all: d/d ib um per kN") * um / kN, reason));
  EXPECT_TRUE(near(six.value("influence.crown.I.shift"), per("six-high.all: d/d shift um per mm") * um / mm,
                   within(5e-3, "differences over other steps, and their meshes")));
}

// Condensed rolls give the results, with the beams next to each.
TEST(StackCommandResults, BothEnginesRunAndCheckEachOther)
{
  const StackRun &condensed = stack_run("four"), &beams = stack_run("four", by_beams);
  for (const char *name :
       {"stack.crown", "stack.modulus.mid", "pair.W-B.q_max", "influence.crown.W.bending_force"}) {
    EXPECT_TRUE(near(condensed.check(name, "Timoshenko"), beams.value(name), within(1e-12, "the same number")))
        << name;
    EXPECT_TRUE(near(beams.check(name, "condensed"), condensed.value(name), within(1e-12, "the same number")))
        << name;
    EXPECT_TRUE(near(condensed.value(name), beams.value(name), within(0.06, "shoulders, cross influence")))
        << name;
    EXPECT_NE(condensed.value(name), beams.value(name));
  }
}

// Bending and shift leave a small difference, in which the engines differ by more than their meshes.
TEST(StackCommandResults, ASmallDifferenceHasTheDistanceOfTheEnginesAsItsError)
{
  const StackRun &six = stack_run("six");
  for (const char *name : {"stack.crown", "stack.edge_drop"}) {
    const double error = six.results.at("values").at(name).at("error_estimate").get<double>();
    EXPECT_GE(error * six.value(name), (1 - 1e-9) * std::abs(six.value(name) - six.check(name, "Timoshenko")))
        << name;
    EXPECT_LT(error, 1) << name;
  }
  EXPECT_EQ(six.results.at("warnings").size(), 2u);
}

// The four-high whose backup rolls are held by a bearing of the case, by beams.
StackRun held_by_bearing(const std::string &name, const std::string &housing_stiffness)
{
  std::string text        = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-four-high.toml");
  const std::string given = "bearing_stiffness = [\"2070 kN/mm\", \"3030 kN/mm\"]";
  const auto position     = text.find(given);
  EXPECT_NE(position, std::string::npos);
  text.replace(position, given.size(), "bearing = \"crb\"\nhousing_stiffness = " + housing_stiffness);
  text += "\n[bearing.crb]\ntype = \"four-row cylindrical\"\nrollers_per_row = 32\nroller_length = \"110 mm\"\n"
          "roller_law = \"palmgren\"\n";
  const std::string file = scratch(name) + ".toml", folder = scratch(name + "-run");
  mill::write_atomically(file, text);
  const Outcome outcome = millstand("run " + file + " -o " + folder + by_beams);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::filesystem::remove(file);
  return {folder, nlohmann::json::parse(mill::read_text(folder + "/results.json"))};
}

// A number that is zero by symmetry is rounding in every state: a softer bearing does not move it.
TEST(StackCommandResults, AZeroBySymmetryHasNoErrorOfABearing)
{
  const StackRun held = held_by_bearing("stack-symmetric-bearing", "[\"2500 kN/mm\", \"2500 kN/mm\"]");
  for (const char *name : {"stack.wedge", "pair.W-B.load_centre", "pair.lower_W-lower_B.load_centre"}) {
    const auto &result = held.results.at("values").at(name);
    EXPECT_EQ(result.at("value").get<double>(), 0) << name;
    EXPECT_EQ(result.at("error_estimate").get<double>(), 0) << name;
  }
  EXPECT_GT(held.results.at("values").at("stack.modulus.mid").at("error_estimate").get<double>(), 1e-3)
      << "the bearing moves what is not zero";
}

// Its tangent is that of the bearing between rigid rings under half the rolling force.
TEST(StackCommandResults, ABearingOfTheCaseHoldsTheBackupRoll)
{
  const StackRun held = held_by_bearing("stack-bearing", "[\"2500 kN/mm\", \"2600 kN/mm\"]");
  mill::RollerBearing crb;
  crb.type             = mill::BearingType::four_row_cylindrical;
  crb.rollers_per_row  = 32;
  crb.roller_length    = 0.11;
  crb.roller_law       = mill::OneRollerLaw::palmgren;
  const double tangent = mill::bearing::solve_bearing(crb, 976.2 * kN / 2).tangent;
  for (const char *roll : {"roll.B.bearing_stiffness", "roll.lower_B.bearing_stiffness"})
    EXPECT_TRUE(near(held.value(roll), tangent, within(1e-4, "cubic between the loads of a curve"))) << roll;
  const StackRun &stiff = stack_run("four", by_beams + " --set \"roll.1.bearing_stiffness=1e7 kN/mm\"");
  const double softer   = 1 / held.value("stack.modulus.mid") - 1 / stiff.value("stack.modulus.mid");
  EXPECT_TRUE(near(softer, 1 / tangent + 0.5 / 2.5e9 + 0.5 / 2.6e9, within(1e-3, "1e7 kN/mm are not rigid")));
  // Two bearings of either backup roll in parallel, both rolls in series.
  const auto error_of = [&](const char *name) {
    return held.results.at("values").at(name).at("error_estimate").get<double>();
  };
  const double by_bearings = error_of("roll.B.bearing_stiffness") * held.value("stack.modulus.mid") / tangent;
  EXPECT_GT(by_bearings, 1e-3);
  // The distance of the engines is in both; the bearings do not move the crown, since both chocks of a roll move
  // alike.
  const auto apart_of = [&](const char *name) {
    return std::abs(1 - held.check(name, "condensed") / held.value(name));
  };
  EXPECT_TRUE(near(error_of("stack.modulus.mid"), std::hypot(by_bearings, apart_of("stack.modulus.mid")),
                   within(0.02, "derivative over an error of some permille, as a quotient")));
  EXPECT_TRUE(near(error_of("stack.crown"), apart_of("stack.crown"), within(1e-3, "chocks that move alike")));
}

// A crown that leaves the ends of the contact open, a soft steel, a strip nearly as wide as the barrel.
TEST(StackWarnings, NameContactPressureAndEdge)
{
  const StackRun &run =
      stack_run("four", by_beams + " --set strip.width='1370 mm' --set steel.yield_stress='100 MPa'"
                                   " --set roll.0.crown='0.4 mm'");
  const auto open = warning_with(run.results, "contact-partly-open"),
             soft = warning_with(run.results, "contact-yield"),
             edge = warning_with(run.results, "strip-at-barrel-end");
  ASSERT_TRUE(open.is_object() && soft.is_object() && edge.is_object()) << run.results.at("warnings");
  std::smatch share;
  const std::string fact = open.at("fact");
  ASSERT_TRUE(std::regex_match(fact, share, std::regex("contact W-B is open on (\\d+) % of its length"))) << fact;
  EXPECT_GT(std::stoi(share[1]), 5) << "0.4 mm of crown under 1 kN/mm";
  EXPECT_EQ(soft.at("subject"), "contact W-B");
  EXPECT_EQ(soft.at("fact"), fmt::format("the peak pressure of {:.0f} MPa is above five times the yield stress of "
                                         "roll W",
                                         run.value("pair.W-B.peak_pressure") / 1e6));
  EXPECT_EQ(edge.at("fact"),
            "the edge of the strip is 15 mm from the end of the barrel of roll W, less than twice "
            "the length of contact");
}

// 1400 mm of barrel, 1000 mm of strip, 200 mm off the middle: the edges meet, and rounding is not printed.
TEST(StackWarnings, SayZeroWhereStripAndBarrelEndTogether)
{
  const StackRun &run = stack_run("four", by_beams + " --set strip.offset='200 mm'");
  const auto edge     = warning_with(run.results, "strip-at-barrel-end");
  ASSERT_TRUE(edge.is_object()) << run.results.at("warnings");
  EXPECT_EQ(edge.at("fact"),
            "the edge of the strip is 0 mm from the end of the barrel of roll W, less than twice the length of "
            "contact");
}

// Under 8 MN without bending and shift the reference has a crown of 149 um: a strip of 120 um cannot have it.
TEST(StackWarnings, NameAProfileThatTheStripCannotHave)
{
  const StackRun &run =
      stack_run("six", by_beams + " --set strip.entry_thickness='0.2 mm'"
                                  " --set strip.exit_thickness='0.12 mm' --set roll.1.shift='0 mm'"
                                  " --set roll.0.bending_force='[\"0 kN\", \"0 kN\"]'"
                                  " --set roll.1.bending_force='[\"0 kN\", \"0 kN\"]'");
  EXPECT_GT(run.value("stack.crown"), 120 * um);
  for (const char *name : {"stack.flatness.min", "stack.flatness.max"})
    EXPECT_EQ(run.results.at("values").count(name), 0u) << name;
  bool named = false;
  for (const auto &warning : run.results.at("warnings"))
    named = named || warning.get<std::string>().find("the loaded gap closes") != std::string::npos;
  EXPECT_TRUE(named) << run.results.at("warnings");
}

// An engine that only judges the results may fail: they are there, without its check.
TEST(StackCommandResults, StayWhereTheOtherEngineHasNoAnswer)
{
  const StackRun &run = stack_run("four", by_beams + " --set roll.0.bending_force='[\"20000 kN\", \"20000 kN\"]'");
  EXPECT_LT(run.value("stack.crown"), 0) << "bent far beyond what the force opens";
  bool compared = false, named = false;
  for (const auto &check : run.results.at("values").at("stack.crown").value("checks", nlohmann::json::array()))
    compared = compared || check.at("name").get<std::string>().rfind("condensed", 0) == 0;
  for (const auto &warning : run.results.at("warnings"))
    named = named || warning.get<std::string>().find("no answer by condensed rolls") != std::string::npos;
  EXPECT_NE(compared, named) << run.results.at("warnings");
}
