#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

// bite.fit as a user meets it: measured values in, friction and flow stress out, and a bite that follows them.
namespace {
Outcome fit(const std::string &path, const std::string &name, const std::string &more = "")
{
  return millstand("stiffness " + path + " -q -o " + scratch(name) + " --cache " + shared_cache() +
                   " --force-overwrite --set bite.samples=3 " + more);
}

// A hot pass that finite elements roll in a second.
const std::string hot_pass = R"(schema = 1
kind   = "bite"

[work_roll]
diameter = "420 mm"

[strip]
width           = "1000 mm"
entry_thickness = "8 mm"
exit_thickness  = "5 mm"
flow_stress     = { law = "constant", k = "28 MPa" }
friction        = 0.3

[[pass]]
name         = "a"
load         = "1100 kN"
forward_slip = "6.5 %"

[bite]
fit              = ["force", "slip"]
arc              = "rigid"
strip            = "rigid-plastic"
elements_along   = 8
elements_through = 2
)";
}  // namespace

TEST(FitCommand, ThreePassesReturnTheirFrictionAndFlowStress)
{
  const auto outcome = fit("cases/cold-fit.toml", "three");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("three");
  // What the case says of how its values were made.
  EXPECT_LT(value(results, "bite.fit.friction_low"), 0.062);
  EXPECT_GT(value(results, "bite.fit.friction_high"), 0.062);
  EXPECT_LT(value(results, "bite.fit.flow_stress_factor_low"), 1.08);
  EXPECT_GT(value(results, "bite.fit.flow_stress_factor_high"), 1.08);
  EXPECT_EQ(value(results, "bite.fit.freedom"), 4);
  // The bite is that of the fitted strip: its force less the measured one, over 2 % of that, is the residual.
  for (const auto &[pass, load] : {std::pair("stand 1", 7904e3), std::pair("stand 3", 10494e3)}) {
    const std::string name = pass;
    EXPECT_TRUE(near((value(results, "bite." + name + ".force") / load - 1) / 0.02,
                     value(results, "bite.fit.residual." + name + ".force"),
                     within(1e-6, "one slab solved twice, forces converged to 1e-9", 1)));
    EXPECT_TRUE(near(value(results, "bite." + name + ".friction"), value(results, "bite.fit.friction"),
                     within(1e-12, "the same number")));
  }
  const auto inputs = results.at("values").at("K4.combined").at("inputs").get<std::vector<std::string>>();
  for (const char *key :
       {"bite.fit", "pass.2.forward_slip", "pass.1.load", "pass.0.slip_deviation", "strip.friction"})
    EXPECT_TRUE(std::count(inputs.begin(), inputs.end(), key)) << key;
  const std::string page = mill::read_text(scratch("three") + "/report.html");
  EXPECT_NE(page.find("Friction and flow stress that the measured values allow"), std::string::npos);
  EXPECT_NE(page.find("95 % interval"), std::string::npos);
}

TEST(FitCommand, ForceAloneDeterminesOneNumberAndIsReported)
{
  const auto outcome = fit("cases/cold-fit.toml", "force", "--set 'bite.fit=[\"force\"]'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("force");
  EXPECT_EQ(results.at("values").at("bite.fit.friction").at("source"),
            "given: kept, for the measured values do not tell it");
  EXPECT_FALSE(results.at("values").contains("bite.fit.friction_low"));
  EXPECT_TRUE(results.at("values").contains("bite.fit.flow_stress_factor_low"));
  EXPECT_EQ(value(results, "bite.fit.freedom"), 2);
  const auto warning = warning_with(results, "fit-one-number");
  EXPECT_EQ(warning.at("subject"), "fit of the bite");
  EXPECT_EQ(warning.at("fact"), "the force alone gives one number");
  const std::string detail = warning.at("detail");
  EXPECT_EQ(detail.find("friction stays 0.08, for friction +10 % with flow_stress -"), 0u) << detail;
  EXPECT_EQ(warning.at("remedy"), "add \"slip\" to bite.fit and forward_slip to the passes");
}

// One force and one slip, two numbers: the model of the run itself ends on both.
TEST(FitCommand, FiniteElementsOfTheFittedStripReproduceTheMeasuredValues)
{
  const std::string path = scratch("hot") + ".toml";
  std::ofstream(path) << hot_pass;
  const auto outcome = fit(path, "hot");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("hot");
  EXPECT_TRUE(near(value(results, "bite.a.force"), 1100e3,
                   within(0.0005, "rounds end when no value moves by a hundredth of its 2 %, 2e-4")));
  EXPECT_TRUE(
      near(value(results, "bite.a.forward_slip"), 0.065,
           within(0.0001 / 0.065, "rounds end when no value moves by a hundredth of its 0.3 points, 3e-5")));
  EXPECT_TRUE(warning_with(results, "bite-force").is_null());
  const auto &checks = results.at("values").at("bite.fit.friction").at("checks");
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].at("name"), "by Karman's slab alone");
  EXPECT_NE(checks[0].at("value").get<double>(), value(results, "bite.fit.friction"));
}

namespace {
// Rolls a strip by Bland and Ford's theory and by what `method` of the bite adds, and fits the friction to that
// force.
void expect_friction_found_again(const std::string &method)
{
  const auto write = [&method](const std::string &name, const std::string &friction, const std::string &load,
                               const std::string &bite) {
    const std::string path = scratch(name) + ".toml";
    std::ofstream(path)
        << "schema = 1\nkind = \"bite\"\n[work_roll]\ndiameter = \"420 mm\"\n[strip]\nwidth = \"1000 "
           "mm\"\nentry_thickness = \"2 mm\"\nexit_thickness = \"1.4 mm\"\nflow_stress = { law = "
           "\"constant\", k = \"60 MPa\" }\nfriction = "
        << friction << "\n[[pass]]\nname = \"a\"\n"
        << load
        << "[bite]\ntheory = \"bland-ford\"\narc = \"rigid\"\nelements_along = 8\n"
           "elements_through = 2\nmethod = \""
        << method << "\"\n"
        << bite;
    return path;
  };
  ASSERT_EQ(fit(write("made", "0.276", "", ""), "made").exit_code, 0);
  const double force = value(results_of("made"), "bite.a.force");
  const auto outcome = fit(write("refound", "0.2", "load = \"" + std::to_string(force) + " N\"\n",
                                 "fit = [\"force\"]\nfit_for = [\"friction\"]\n"),
                           "refound");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("refound");
  EXPECT_TRUE(near(value(results, "bite.fit.friction"), 0.276,
                   within(1e-3, "rounds end when the force moves by a hundredth of its 2 %")));
  EXPECT_TRUE(near(value(results, "bite.a.force"), force,
                   within(5e-4, "rounds end when the force moves by a hundredth of its 2 %")));
}
}  // namespace

TEST(FitCommand, BlandAndFordsForceGivesBackTheFrictionThatMadeIt)
{
  expect_friction_found_again("slab");
}

// The slab and Bland and Ford's theory depend on friction very differently where the strip nearly sticks.  Rounds
// with finite elements have a short form: FiniteElementsOfTheFittedStripReproduceTheMeasuredValues.
TEST(FitCommandLong, BlandAndFordsTheoryFitsTheFrictionOfFiniteElements)
{
  expect_friction_found_again("fe");
}

TEST(FitCommand, ValuesThatContradictEachOtherAreNamed)
{
  const auto outcome = fit("cases/cold-fit.toml", "contrary", "--set 'pass.1.load=\"14000 kN\"'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("contrary");
  EXPECT_FALSE(warning_with(results, "fit-scatter").is_null());
  EXPECT_FALSE(warning_with(results, "bite-force").is_null()) << "force and load differ on page one";
}
