#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include "tests/support/run_results.h"
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

// kind = "cluster" as a user meets it: what is refused and with which words, names of results, forces by the laws
// of the case, traces.
namespace {
using Changes = std::vector<std::pair<std::string, std::string>>;

const std::string z_mill = "cases/z-mill.toml";

// Without friction the strip is not drawn in, and no finite elements are solved: this tests the stack.
const Changes stack_alone{
    {"[strip.friction]  # a3 < 0: friction falls with speed\nlaw = \"speed\"\nscale = 1\nat_unit_speed = "
     "0.066723\nper_log_speed = -0.00662\n",
     ""}};

// A copy of the case with pieces of its text replaced.
class ChangedCase {
public:
  explicit ChangedCase(const Changes &changes) : path_(scratch("cluster") + ".toml")
  {
    std::string text = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/" + z_mill);
    for (const auto &[from, to] : changes) {
      const auto position = text.find(from);
      EXPECT_NE(position, std::string::npos) << from;
      text.replace(position, from.size(), to);
    }
    mill::write_atomically(path_, text);
  }
  ~ChangedCase()
  {
    std::filesystem::remove(path_);
  }
  const std::string &path() const
  {
    return path_;
  }

private:
  std::string path_;
};

bool holds(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

// The first line of what `check` says of a case, without the file: "43:1: error: ..".
std::string refused(const std::string &more, const Changes &changes = {})
{
  const ChangedCase changed(changes);
  const Outcome run = millstand("check " + changed.path() + more);
  EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
  const auto begin = run.err.find(".toml:");
  EXPECT_NE(begin, std::string::npos) << run.err;
  return run.err.substr(begin + 6, run.err.find('\n') - begin - 6);
}

nlohmann::json results_in(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/results.json"));
}
}  // namespace

TEST(ClusterCommand, NamesContactsThatDoNotCloseAndRollsThatOverlap)
{
  EXPECT_EQ(refused(" --set 'roll.1.position=[\"0 mm\", \"139.6 mm\"]'"),
            "43:1: error: contact W-I does not close: the axes are 104.8000 mm apart, the radii make 104.7750 mm; "
            "the rolls stand apart by 0.0250 mm; move one of them, or leave its position to the contacts");
  EXPECT_EQ(refused(" --set 'contact.3.direction=100 deg'"),
            "34:1: error: rolls I and L overlap by 48.8918 mm and have no [[contact]]; move one of them, or say "
            "that they touch");
}

TEST(ClusterCommand, NamesTheMotionThatNothingHolds)
{
  EXPECT_EQ(refused("", {{"[[support]]  # no bearing, only held sideways; assumed\nroll = \"I\"\ntype = "
                          "\"guide\"\nstiffness = \"5e8 N/m\"\n",
                          ""}}),
            "26:1: error: nothing holds roll I along x; add a [[support]] of it, for example type = \"guide\", or "
            "a [[contact]] that acts in this direction");
}

TEST(ClusterCommand, RefusesFitsWithMoreUnknownsThanData)
{
  EXPECT_EQ(refused(" --set 'variant.0.modes=[\"E vertical\"]'"),
            "204:12: error: variant.0.unknowns = [\"support.E.stiffness\", \"support.R.stiffness\"] are 2 numbers "
            "for 1 frequencies; a fit needs at least as many frequencies as unknowns");
  const ChangedCase dotted({{"name = \"N\"", "name = \"N.1\""}});
  EXPECT_EQ(millstand("check " + dotted.path()).exit_code, 0) << "names may hold dots";
}

TEST(ClusterCommand, RefusesAFitOfTheBite)
{
  const auto with = [](const std::string &line) {
    return refused("", {{"[strip.friction]", "[bite]\n" + line + "\n[strip.friction]"}});
  };
  EXPECT_TRUE(holds(
      with("fit = [\"force\"]"),
      "error: bite.fit = [\"force\"] is not solved in kind = \"cluster\": each pass with a load has its flow "
      "stress fitted to that load without it; remove it, or fit friction and flow stress of the same passes in "
      "a case of kind = \"bite\""));
  EXPECT_TRUE(holds(with("fit_for = [\"friction\"]"), "error: bite.fit_for = [\"friction\"] is not solved"));
}

TEST(ClusterCommand, RefusesForcesThatTheLawsDoNotGive)
{
  EXPECT_EQ(refused("", {{"load = \"1148 kN\"\nentry_thickness", "entry_thickness"}, {"k = \"1604 MPa\"\n", ""}}),
            "90:7: error: strip.flow_stress.law = \"power\" needs 'k'");
  EXPECT_TRUE(holds(refused(" --set 'strip.flow_stress.k=4 GPa'", {{"load = \"1459 kN\"\n", ""}}),
                    "131:1: error: pass \"pass 4\": roll bite: no flattened radius: R'/R = "));
}

TEST(ClusterCommand, ABuckledStackEndsWithTheForceAndTheGuideItNeeds)
{
  const ChangedCase stack(stack_alone);
  const Outcome run =
      millstand("modes " + stack.path() + " -q -o " + scratch("buckled") + " --set 'support.1.stiffness=1e6 N/m'");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err, "pass \"pass 1\": the stack buckles under 1148 kN\n")) << run.err;
  EXPECT_TRUE(holds(run.err, "I x on W-I, I-E grows: its eigenvalue is -")) << run.err;
  EXPECT_TRUE(holds(run.err, "with guide I of at least 1.51e+07 N/m the stack is stable")) << run.err;
}

TEST(ClusterCommand, AForceThatNothingCarriesNamesItsPass)
{
  const Outcome run = millstand("stiffness " + z_mill + " -q -o " + scratch("carried") +
                                " --set 'pass.1.horizontal_force=400 kN'");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_TRUE(holds(run.err,
                    "pass \"pass 2\", 1878 kN, 400 kN across: stack: no equilibrium under the loads of the "
                    "pass\n"))
      << run.err;
}

TEST(ClusterCommand, NamesTheSupportWhosePreloadIsLost)
{
  const ChangedCase stack(stack_alone);
  const std::string folder = scratch("preload");
  const Outcome run =
      millstand("stiffness " + stack.path() + " -q -o " + folder + " --set 'pass.0.horizontal_force=40 kN'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto warning     = warning_with(results_in(folder), "support-preload");
  const std::string fact = warning.at("fact");
  EXPECT_EQ(warning.at("place").at("line"), 69);
  EXPECT_EQ(warning.at("subject"), "pass \"pass 1\"");
  EXPECT_EQ(fact.find("the preload of support L is lost, its rollers carry "), 0u) << fact;
  EXPECT_TRUE(holds(fact, " and 0 N")) << fact;
  EXPECT_EQ(warning.at("detail"), "the roll is not held by all of its rollers");
}

// CL-28: every pass, fits L and G; nothing of the column is tuned in them but what they name.
TEST(ClusterCommand, ResultsKeepTheCaseOfNamesAndFitsStateTheirNumbers)
{
  const ChangedCase stack(stack_alone);
  const std::string folder = scratch("cluster-modes");
  const Outcome run        = millstand("modes " + stack.path() + " -q -o " + folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto all    = results_in(folder).at("values");
  const auto wanted = reference("stack.N.per_pass", "cluster");
  for (const std::size_t pass : {1u, 3u}) {
    const std::string name = "cluster.pass " + std::to_string(pass + 1) + ".mode.E vertical";
    ASSERT_TRUE(all.contains(name));
    EXPECT_TRUE(near(all.at(name).at("value").get<double>(), double(wanted[pass][0]),
                     within(1e-5, "supports fitted in pass 1, passes 2 and 4 follow")));
  }
  EXPECT_EQ(all.at("cluster.fit.G.contact.W-I.stiffness").at("source").get<std::string>(),
            "computed: fit of 4 numbers to 4 frequencies (38.25)");
  EXPECT_TRUE(all.at("cluster.fit.G.contact.W-I.stiffness").at("error_estimate").is_null());
  EXPECT_GT(all.at("cluster.fit.L.contact.W-R.direction").at("error_estimate").get<double>(), 0);
  const auto force_of = [&](const char *name) {
    return all.at(std::string("cluster.pass 1.") + name).at("value").get<double>();
  };
  EXPECT_TRUE(
      near((force_of("roller_load.R.1") + force_of("roller_load.R.2")) * std::cos(36 * M_PI / 180),
           force_of("W-R.force"),
           within(1e-6, "horizontal balance of roll R; the contact turns by 0.1 mm over 60 mm, second order")));
  const auto &inputs = all.at("cluster.pass 1.f1").at("inputs");
  const auto enters  = [&](const char *key) {
    return std::find(inputs.begin(), inputs.end(), key) != inputs.end();
  };
  EXPECT_TRUE(enters("roll.1.barrel_diameter") && enters("support.3.preload") && enters("pass.0.load"));
  EXPECT_FALSE(enters("pass.1.load") || enters("support.0.fitted") || enters("stack.flattening_modulus") ||
               enters("pass.0.loss_factor"));
  EXPECT_TRUE(holds(mill::read_text(folder + "/report.html"), "E vertical"));
  const std::string laws = all.at("cluster.pass 1.W-I.approach").at("checks").dump();
  EXPECT_TRUE(holds(laws, "Johnson (38.5)")) << laws;
  EXPECT_FALSE(holds(laws, "Palmgren (38.4)")) << "its own law says nothing of it: " << laws;
}

// A law that begins at zero has no stress at the entry of the first pass; that of the exit is taken, (39.4).
TEST(ClusterCommand, APassWithoutLoadTakesTheForceOfItsLaws)
{
  const std::string folder = scratch("computed-load");
  const ChangedCase computed(Changes{{"load = \"1148 kN\"\nentry_thickness", "entry_thickness"}});
  const std::string theory = " --set bite.theory=bland-ford";
  const Outcome run        = millstand("stiffness " + computed.path() + " -q -o " + folder + theory);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto all    = results_in(folder).at("values");
  const auto &force = all.at("cluster.pass 1.force");
  const auto record = nlohmann::json::parse(mill::read_text(folder + "/curves/schedule.json"));
  EXPECT_TRUE(near(force.at("value").get<double>(), record.at("passes")[0].at("law_force").get<double>(),
                   within(1e-9, "one theory with one stress, computed by two stages")));
  EXPECT_EQ(force.at("source").get<std::string>(),
            "computed: Bland-Ford slab, Hitchcock's arc with the flow stress at the exit (39.4)");
  // Y = 802 MPa, n = 0.290 of section 3.8: 1185 kN.
  EXPECT_TRUE(near(force.at("value").get<double>(), 1185e3, within(2e-3, "three digits of Y and n")));
}

// The load is not the one of the given flow stress: the sentence on the given values must not follow it.
TEST(ClusterCommand, TheForceOfTheGivenFlowStressDoesNotFollowTheLoad)
{
  const std::string folder = scratch("given-stress");
  const Outcome run =
      millstand("simulate " + z_mill + " -q -o " + folder + " --set bite.method=slab --set 'pass.0.load=900 kN'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results       = results_in(folder);
  const std::string notes  = results.at("warnings").dump() + results.at("assumptions").dump();
  const std::string stress = "pass \\\"pass 1\\\": strip.flow_stress, ",
                    before = " MPa at the exit, and strip.friction give ";
  const auto named = notes.find(stress), begin = notes.find(before, named);
  ASSERT_NE(named, std::string::npos) << notes;
  ASSERT_NE(begin, std::string::npos) << notes;
  // Y = 802 MPa, n = 0.290 of section 3.8: 1185 kN.
  EXPECT_TRUE(near(std::stod(notes.substr(begin + before.size())), 1185, within(2e-3, "three digits of Y and n")));
  EXPECT_TRUE(near(std::stod(notes.substr(named + stress.size())), 1604 * std::pow(std::log(0.26 / 0.18), 0.29),
                   within(1e-3, "k e^n of the case at the exit, four digits")));
  EXPECT_TRUE(holds(notes, "the load of the pass is 900 kN, +32 %")) << notes;
}

TEST(ClusterCommand, TraceReachesStackBiteAndFits)
{
  const auto traced = [](const std::string &key) {
    const Outcome run = millstand("trace " + z_mill + " " + key + " -o " + scratch("no-run"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  const std::string diameter = traced("roll.0.barrel_diameter");
  EXPECT_TRUE(holds(diameter, "cluster.pass 1.f7")) << diameter;
  EXPECT_TRUE(holds(diameter, "cluster.pass 3.flow_stress")) << diameter;
  const std::string loss = traced("pass.0.loss_factor");
  EXPECT_TRUE(holds(loss, "cluster.pass 1.velocity.W.y")) << loss;
  EXPECT_TRUE(holds(loss, "cluster.pass 1.acceleration.W.y")) << loss;
  EXPECT_TRUE(holds(traced("support.3.preload"), "cluster.pass 1.roller_load.L.1"));
  EXPECT_TRUE(holds(traced("mode.0.frequency"), "cluster.fit.N.support.E.stiffness"));
  const std::string guide = traced("support.1.stiffness");
  EXPECT_TRUE(holds(guide, "cluster.pass 1.f1")) << guide;
  EXPECT_FALSE(holds(guide, "cluster.pass 1.I.x")) << "rounding on the line of symmetry: " << guide;
}

TEST(ClusterCommand, CoupledSpinWarnsOfTheMissingHistory)
{
  const ChangedCase stack(stack_alone);
  const std::string folder = scratch("coupled");
  const Outcome run = millstand("simulate " + stack.path() + " -q -o " + folder + " --set stack.spin=coupled");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results = results_in(folder);
  const auto warning = warning_with(results, "coupled-stack");
  EXPECT_EQ(warning.at("fact"), "stack.spin = \"coupled\" has no history and no frequency over amplitude");
  EXPECT_EQ(warning.at("remedy"), "spin = \"free\" gives all three");
  const auto &velocity = results.at("values").at("cluster.pass 1.velocity.W.y");
  EXPECT_GT(velocity.at("value").get<double>(), 0);
  EXPECT_FALSE(velocity.contains("checks")) << "there is no history to compare with";
  const auto &acceleration = results.at("values").at("cluster.pass 1.acceleration.W.y");
  EXPECT_EQ(acceleration.at("unit").get<std::string>(), "m/s2");
  EXPECT_EQ(acceleration.at("inputs"), velocity.at("inputs"));
  EXPECT_TRUE(near(acceleration.at("value").get<double>(), 2 * M_PI * 610 * velocity.at("value").get<double>(),
                   within(1e-13, "a harmonic motion at the frequency of the dynamic force: one product")));
  EXPECT_FALSE(std::filesystem::exists(folder + "/curves/cluster-pass-1.history.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/curves/cluster-pass-1.response.csv"));
}

// The compact mill is one half; six-high and twenty-high are both.
TEST(ClusterCommand, ChatterFindsTheModeThatBecomesUnstableAndNamesItsFlowStress)
{
  const std::string folder = scratch("cluster-chatter");
  const Outcome run = millstand("chatter cases/six-high.toml -q -o " + folder + " --set analysis.map_points=0");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results = results_in(folder);
  const auto &all    = results.at("values");
  ASSERT_TRUE(all.contains("chatter.pass 1.critical_speed")) << run.out;
  EXPECT_GT(all.at("chatter.pass 1.critical_speed").at("value").get<double>(), 0);
  EXPECT_TRUE(holds(results.at("assumptions").dump(), "MPa, fitted to the load of the pass"))
      << results.at("assumptions");
  // The strip carries the load, and the bite of the search returns it.
  EXPECT_TRUE(near(all.at("cluster.pass 1.strip.force").at("value").get<double>(), 8e6, within(1e-9, "given")));
  EXPECT_TRUE(
      near(all.at("bite.pass 1.force").at("value").get<double>(), 8e6, within(1e-6, "fit of the flow stress")));
  // What becomes unstable is a gap mode of the rolling stack.
  const double f = all.at("chatter.pass 1.frequency").at("value").get<double>();
  double nearest = 1;
  for (const auto &[name, result] : all.items())
    if (name.rfind("mode.gap_", 0) == 0 && holds(name, ".frequency"))
      nearest = std::min(nearest, std::abs(result.at("value").get<double>() / f - 1));
  EXPECT_LT(nearest, 0.15);
}

TEST(ClusterCommand, AdviceRatesActionsOnTheSpeedThatChatterFinds)
{
  const std::string folder = scratch("cluster-advice"), searched = scratch("cluster-searched");
  const Outcome run = millstand("advise cases/six-high.toml -q -o " + folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto advice = nlohmann::json::parse(mill::read_text(folder + "/advice.json"));
  ASSERT_EQ(millstand("chatter cases/six-high.toml -q -o " + searched + " --set analysis.map_points=0").exit_code,
            0);
  EXPECT_TRUE(near(advice.at("values").at("advice.critical_speed").at("value").get<double>(),
                   results_in(searched).at("values").at("chatter.pass 1.critical_speed").at("value").get<double>(),
                   within(1e-6, "both solve for the root of the growth")));
  EXPECT_TRUE(holds(advice.at("actions").dump(), "stiffness of support housing_lower x 1.1"));
  EXPECT_TRUE(holds(advice.at("what_ifs").dump(), "damping of the stack x 2"));
}

TEST(ClusterCommand, APassWithoutSpeedSaysSo)
{
  std::string text       = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/six-high.toml");
  const auto line        = text.find("speed = \"10 m/s\"\n");
  const std::string path = scratch("no-speed") + ".toml";
  mill::write_atomically(path, text.erase(line, std::string("speed = \"10 m/s\"\n").size()));
  const Outcome run = millstand("chatter " + path + " -q -o " + scratch("no-speed"));
  std::filesystem::remove(path);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err, "pass \"pass 1\": its critical speed needs pass.0.speed")) << run.err;
}

TEST(ClusterCommand, AStripContactThatCarriesNothingIsRefused)
{
  const Outcome run = millstand("check cases/six-high.toml --set 'stack.strip_stiffness=0 kN/mm'");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err,
                    "stack.strip_stiffness = 0 kN/mm: the strip between the work rolls carries nothing; give "
                    "K4 of the bite, above zero, or leave the key out"))
      << run.err;
}

TEST(ClusterCommand, ExportsStateSpaceAndUnit)
{
  const std::string folder = scratch("cluster-statespace");
  const Outcome matrices   = millstand("export statespace cases/twenty-high.toml -q -o " + folder);
  EXPECT_EQ(matrices.exit_code, 0) << matrices.err;
  const std::string unit = scratch("cluster-unit") + ".fmu";
  const Outcome exported = millstand("export fmu " + z_mill + " -q -o " + unit);
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_TRUE(std::filesystem::exists(unit));
}
