#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

// kind = "bite" and K4 of a stand as a user meets them.
namespace fs = std::filesystem;

namespace {
const std::string demo_pass = R"(schema = 1
kind   = "bite"

[steel]
youngs_modulus = "210 GPa"
poisson_ratio  = 0.28

[work_roll]
diameter = "420 mm"

[strip]
width           = "1000 mm"
entry_thickness = "8 mm"
exit_thickness  = "5 mm"
flow_stress     = { law = "constant", k = "28 MPa" }
friction        = 0.2

[[pass]]
name = "demo"
)";

std::string write_case(const std::string &name, const std::string &text)
{
  const std::string path = scratch(name) + ".toml";
  std::ofstream(path) << text;
  return path;
}

Outcome stiffness(const std::string &path, const std::string &name, const std::string &more)
{
  return millstand("stiffness " + path + " -q -o " + scratch(name) + " --cache " + shared_cache() +
                   " --force-overwrite " + more);
}

}  // namespace

// The pass of the demo stand: slope and closed forms by slab theory, compared with finite elements.
TEST(BiteCommand, TheFourQuantitiesCalledK4AreAllResults)
{
  const std::string path = write_case("demo", demo_pass);
  const auto outcome     = stiffness(path, "demo", "--set bite.elements_along=24 --set bite.elements_through=6");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = results_of("demo");
  EXPECT_TRUE(
      near(value(results, "K4.plastic_slope"), 225e6, within(0.03, "coarse elements, reference 225 +- 3")));
  const double R = 0.21, A = 2 * (1 - 0.28 * 0.28) / (M_PI * 210e9);
  const double flattened = value(results, "bite.demo.flattened_radius"), l = std::sqrt(flattened * 3e-3);
  EXPECT_GT(flattened, 1.005 * R);
  EXPECT_TRUE(near(value(results, "K4.flattening"), 1 / (A * (std::log(8 * R / l) - 0.5)),
                   within(1e-9, "closed form (8.12) on the flattened arc, width 1 m")));
  const auto error_of = [&](const char *name) {
    return results.at("values").at(name).at("error_estimate").get<double>();
  };
  for (const char *name : {"force", "torque", "forward_slip", "plastic_slope"}) {  // the slab theory is counted
    const std::string key  = std::string("bite.demo.") + name;
    const bool slope       = std::string(name) == "plastic_slope";
    const double by_flow   = value(results, slope ? "K4.plastic_slope" : key);
    const double by_slices = value(results, std::string("bite.demo.karman.") + name);
    EXPECT_GE(error_of(slope ? "K4.plastic_slope" : key.c_str()), std::abs(by_slices / by_flow - 1) * (1 - 1e-9))
        << name;
  }
  EXPECT_NE(error_of("K4.combined"), error_of("K4.plastic_slope"));
  EXPECT_TRUE(near(value(results, "bite.demo.exit_thickness"), 5e-3,
                   within(1e-5, "a rigid-plastic strip leaves with the gap of the rolls")));
  EXPECT_TRUE(near(value(results, "bite.demo.karman.plastic_slope"), 247.253e6,
                   within(0.01, "printed for a rigid roll; here its arc is flattened by 0.7 %")));
  const double slope = value(results, "K4.plastic_slope"), flat = value(results, "K4.flattening");
  EXPECT_TRUE(near(value(results, "K4.combined"), 1 / (1 / slope + 2 / flat), within(1e-9, "springs in series")));
  EXPECT_GT(value(results, "K4.path_plateau"), 0.0);
  for (const char *file :
       {"bite-demo.fe.csv", "bite-demo.karman.csv", "bite-demo.orowan.csv", "bite-demo.bland-ford.csv",
        "bite-demo.roll.csv", "bite-demo.field.csv", "bite-k4-reduction.csv", "bite-k4-tension.csv",
        "bite-k4-friction.csv", "bite-aspect.csv"})
    EXPECT_TRUE(fs::is_regular_file(scratch("demo") + "/curves/" + file)) << file;
  EXPECT_TRUE(fs::is_regular_file(scratch("demo") + "/fields/bite-demo.vtu"));
  EXPECT_TRUE(fs::is_regular_file(scratch("demo") + "/report.html"));
}

// What a file holds stands behind a point, which no name of a pass brings into a file name.
TEST(BiteCommand, PassesWithSimilarNamesKeepTheirOwnFiles)
{
  std::string text = demo_pass;
  const std::vector<std::string> names{"x", "x-karman", "x-karman-rigid", "k4", "k4-reduction", "x-roll"};
  text.replace(text.find("\"demo\""), 6, "\"x\"");
  for (std::size_t i = 1; i < names.size(); ++i)
    text += "\n[[pass]]\nname = \"" + names[i] + "\"\nexit_thickness = \"5." + std::to_string(i) + " mm\"\n";
  const std::string path = write_case("alike", text + "\n[bite]\nmethod = \"slab\"\n");
  const auto outcome     = stiffness(path, "alike", "");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto files   = nlohmann::json::parse(std::ifstream(scratch("alike") + "/run.json")).at("files");
  const auto results = results_of("alike");
  std::set<std::string> sums;
  for (const std::string &name : names)
    for (const std::string model : {"karman", "karman-rigid", "orowan", "bland-ford"}) {
      EXPECT_GT(value(results, "bite." + name + "." + model + ".force"), 0.0);
      sums.insert(files.at("curves/bite-" + name + "." + model + ".csv").get<std::string>());
    }
  EXPECT_EQ(sums.size(), 4 * names.size()) << "each with what is its own";
  for (const char *file : {"bite-k4-reduction.csv", "bite-k4-friction.csv"})
    EXPECT_TRUE(files.contains(std::string("curves/") + file)) << file;
  const std::string page = mill::read_text(scratch("alike") + "/report.html");
  EXPECT_EQ(page.find("cannot be read and is left out"), std::string::npos);
}

// An impossible pass is refused at its place, before anything is computed and by check as well.
TEST(BiteCommand, PassesThatCannotBeRolledAreRefused)
{
  const std::string path = write_case("refused", demo_pass);
  const auto message_of  = [&](const std::string &set) {
    const auto outcome = millstand("check " + path + " " + set);
    EXPECT_EQ(outcome.exit_code, 2) << set;
    return outcome.err;
  };
  const std::string cannot = message_of("--set strip.friction=0.02");
  EXPECT_NE(cannot.find("pass \"demo\""), std::string::npos) << cannot;
  EXPECT_NE(cannot.find("0.02"), std::string::npos) << cannot;
  EXPECT_NE(cannot.find("0.1196 rad"), std::string::npos) << cannot;
  EXPECT_NE(message_of("--set strip.exit_thickness='9 mm'").find("is not smaller than the entry thickness"),
            std::string::npos);
  EXPECT_NE(message_of("--set strip.exit_tension='30.8 MPa'").find("would stretch the strip outside the bite"),
            std::string::npos);
}

// Foil behind the pass of the paper: rolls of 69.6 mm flatten by more than 10 um.  What the finite elements of the
// first pass took a minute for stays.
TEST(BiteCommandLong, APassThatNoArcCarriesLeavesTheResultsOfThePassBeforeIt)
{
  std::string text = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/cases/cold-strip.toml");
  text.insert(text.find("[bite]"), "[[pass]]\nname = \"foil\"\nspeed = \"178 m/min\"\nload = \"1148 kN\"\n"
                                   "entry_thickness = \"30 um\"\nexit_thickness = \"20 um\"\n\n");
  const auto outcome = stiffness(write_case("foil-behind", text), "foil-behind", "");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.err.find("bite of foil: no arc of these rolls carries its own force"), std::string::npos)
      << outcome.err;
  const auto results = results_of("foil-behind");
  EXPECT_GT(value(results, "bite.pass 1.force"), 0.0);
  EXPECT_EQ(results.at("values").count("bite.foil.force"), 0u);
}
