#include "core/case/stand_rows.h"
#include "tests/support/near.h"
#include "tests/support/quick_stand.h"
#include <algorithm>
#include <cmath>
#include <filesystem>

// Equivalent masses, their errors and the mill modulus as a user meets them.
namespace fs = std::filesystem;
using namespace quick_stand;

namespace {
// Every mass and stiffness of the frame within 1 %.
std::string frame_tolerances()
{
  std::string sets;
  for (const auto &row : mill::frame_rows())
    if (row.fallback.kind == mill::Fallback::Kind::required)
      sets += " --set 'frame." + mill::tolerance_key(row.key) + "=1 %'";
  return sets;
}
}  // namespace

TEST(Masses, BothMethodsAgreeWithThePublishedValues)
{
  const auto results = json_of(demo_masses() + "/results.json");
  for (const char *mass : {"M2", "M3", "M4", "M5"}) {
    const auto &entry = results.at("values").at(mass);
    int roads         = 0;
    for (const auto &check : entry.at("checks")) {
      const std::string name = check.at("name");
      if (name.find("finite") == std::string::npos)
        continue;
      ++roads;
      EXPECT_TRUE(near(check.at("value").get<double>(), entry.at("value").get<double>(),
                       within(0.03, "what shoulder, rotation and a solid roll do to the shape")))
          << mass << ": " << name;
    }
    EXPECT_EQ(roads, 2) << mass;
  }
  const auto shown = loud_run("masses", demo, "loud");
  for (const char *text : {"closed form", "FE, integral", "FE, all", "published", "59716.9", "42200.6"})
    EXPECT_NE(shown.out.find(text), std::string::npos) << text << "\n" << shown.out;
}

TEST(Masses, FiniteElementsGiveTheMassesWhenAsked)
{
  ASSERT_EQ(run("masses", demo, "solid", "--set dynamics.mass_source=fe" + frame_tolerances()).exit_code, 0);
  const auto entry = json_of(scratch("solid") + "/results.json").at("values").at("M5");
  EXPECT_NE(entry.at("source").get<std::string>().find("finite-element shape"), std::string::npos);
  const auto closed = json_of(demo_masses() + "/results.json").at("values").at("M5");
  const auto &all   = closed.at("checks");
  const auto solid  = std::find_if(all.begin(), all.end(), [](const auto &check) {
    return check.at("name").template get<std::string>().find("all points") == 0;
  });
  ASSERT_NE(solid, all.end());
  EXPECT_EQ(entry.at("value"), solid->at("value")) << "the same number by both settings";
  EXPECT_GT(entry.at("error_estimate").get<double>(), 0.005) << "what the integral and all points differ by";
}

// K_ZW of the demo roll by an independent finite-element program on meshes of its own: 6.14 to 6.17e10 N/m.
TEST(Masses, BackupRollsBendLikeSolids)
{
  const auto solid = json_of(demo_masses() + "/results.json").at("values").at("K_ZW");
  const double e   = solid.at("error_estimate");
  EXPECT_TRUE(
      near(solid.at("value").get<double>(), 6.155e10, within(5e-3, "range of the other program, our mesh")));
  EXPECT_LE(solid.at("value").get<double>() * (1 - e), 6.17e10);
  EXPECT_GE(solid.at("value").get<double>() * (1 + e), 6.14e10);
  EXPECT_LT(e, 0.01);
  EXPECT_TRUE(
      near(solid.at("checks").at(0).at("value").get<double>(), 6.81232e10, within(1e-5, "closed form, printed")));
  ASSERT_EQ(run("masses", demo, "beams", "--set backup_roll.bending_model=beam").exit_code, 0);
  const auto beam = json_of(scratch("beams") + "/results.json").at("values");
  EXPECT_TRUE(near(beam.at("K_ZW").at("value").get<double>(), 6.81232e10, within(1e-5, "closed form, printed")));
  EXPECT_GE(beam.at("K_ZW").at("error_estimate").get<double>(), 0.0947)
      << "its distance to the solid, and that one's error";
  const double K6 = quick_value("demo", "K6"), K6_beam = quick_value("beams", "K6");
  EXPECT_TRUE(near(1 / K6 - 1 / K6_beam, 1 / quick_value("demo", "K_ZW") - 1 / 6.81232e10,
                   within(1e-4, "one of the springs in series, printed value")));
}

TEST(Masses, NeedNoCurvesOfTheBite)
{
  for (const auto &entry : fs::directory_iterator(demo_masses() + "/curves"))
    EXPECT_EQ(entry.path().filename().string().find("bite-k4"), std::string::npos) << entry.path();
}

// The lower bearings carry what the lower rolls' offset adds; Palmgren's tangent goes with load^0.1.
TEST(Masses, LowerAndUpperMassesDiffer)
{
  const double e = 0.4, between = (0.420 + 1.450) / 2;
  ASSERT_EQ(run("masses", demo, "offset", "--set 'contact.lower.axis_offset=400 mm'").exit_code, 0);
  EXPECT_TRUE(near(quick_value("offset", "K_Zy_lower") / quick_value("offset", "K_Zy"),
                   std::pow(1 + e * e / between / between, 0.05),
                   within(1e-6, "power law; equilibrium solved to 1e-9")));
  EXPECT_EQ(quick_value("offset", "K2"), quick_value("demo", "K2"));
  EXPECT_GT(quick_value("offset", "K6"), quick_value("demo", "K6"));
}

// An unknown error is not zero: a frequency has one when all its springs and masses do, else it says which do not.
TEST(Modes, AFrequencyNamesTheKeysThatItsErrorNeeds)
{
  const std::string published = "cases/published-1400.toml";
  ASSERT_EQ(millstand("modes " + published + " -q -o " + scratch("bare")).exit_code, 0);
  const auto bare = json_of(scratch("bare") + "/results.json").at("values");
  EXPECT_TRUE(bare.at("f1").at("error_estimate").is_null());
  EXPECT_TRUE(lacks(bare.at("f1"), "given.K1_tolerance"));
  EXPECT_TRUE(bare.at("fh1").at("error_estimate").is_null()) << "the vertical mass stands in";
  EXPECT_EQ(bare.at("C").at("value"), 1.91141e5);
  std::string sets;
  for (int i = 1; i <= 7; ++i)
    sets += " --set 'given.K" + std::to_string(i) + "_tolerance=2 %'" +
            (i < 7 ? " --set 'given.M" + std::to_string(i) + "_tolerance=4 %'" : "");
  ASSERT_EQ(millstand("modes " + published + sets + " -q -o " + scratch("tolerances")).exit_code, 0);
  const auto stated = json_of(scratch("tolerances") + "/results.json").at("values");
  for (int i = 1; i <= 6; ++i)
    EXPECT_TRUE(near(stated.at("f" + std::to_string(i)).at("error_estimate").get<double>(), (0.02 + 0.04) / 2,
                     within(1e-4, "shares of springs and of masses add up to one, those below 1e-5 left out")));
  const std::string modes = mill::read_text(scratch("bare") + "/curves/modes.csv");
  EXPECT_EQ(modes.find("damping"), std::string::npos) << "undamped modes";
  EXPECT_EQ(mill::read_text(scratch("bare") + "/curves/poles.csv").substr(0, 27), "pole,frequency [Hz],damping");
}

TEST(Modes, LevelsStateNoErrorWhereItIsNotKnown)
{
  ASSERT_EQ(run("simulate", demo, "levels").exit_code, 0);
  const auto values = json_of(scratch("levels") + "/results.json").at("values");
  for (const char *level : {"pass 1.peak_g.upper_work_roll", "pass 2.rms_g.lower_work_roll"}) {
    EXPECT_TRUE(values.at(level).at("error_estimate").is_null());
    EXPECT_TRUE(lacks(values.at(level), "dynamics.modal_damping"));
  }
  EXPECT_TRUE(values.at("f1").at("error_estimate").is_null());
  EXPECT_TRUE(lacks(values.at("craig-bampton.f1"), "frame.oil_column_stiffness_tolerance"));
}

// PL-1: all springs from results.json.
TEST(Modulus, IsTheSeriesOfTheSpringsOfTheResults)
{
  const auto values   = json_of(demo_masses() + "/results.json").at("values");
  const auto value_of = [&](const std::string &name) { return values.at(name).at("value").get<double>(); };
  double path         = 0;
  for (const char *spring : {"K1", "K2", "K3", "K5", "K6", "K7"})
    path += 1 / value_of(spring);
  const auto series = within(1e-12, "sum of reciprocals in another order");
  EXPECT_TRUE(near(value_of("stand.modulus.kiss"), 1 / (path + 1 / value_of("stand.K_ww.tangent")), series));
  EXPECT_TRUE(near(value_of("stand.modulus.tangent"),
                   1 / (path + 2 / value_of("K4.flattening") + 1 / value_of("stand.K_bend")), series));
  const double M = value_of("stand.modulus.tangent"), Q = value_of("K4.plastic_slope");
  EXPECT_TRUE(near(value_of("stand.screw_sensitivity"), M / (M + Q), series));
  EXPECT_TRUE(near(value_of("stand.thickness_by.entry_thickness"),
                   value_of("bite.pass 1.force_by_entry_thickness") / (M + Q), series));
  double later = 1 / value_of("stand.pass 2.K_ww.tangent");
  for (const char *spring : {"K1", "K2", "K3", "K5", "K6", "K7"})
    later += 1 / value_of(std::string("pass 2.") + spring);
  EXPECT_TRUE(near(value_of("stand.pass 2.modulus.kiss"), 1 / later, series));
  EXPECT_LT(value_of("stand.pass 2.modulus.kiss"), value_of("stand.modulus.kiss"))
      << "738 kN in place of 976 kN: softer contacts";
  EXPECT_LT(value_of("stand.pass 2.modulus.secant"), value_of("stand.pass 2.modulus.tangent"))
      << "the foot of the curve";
}

TEST(Modulus, TheModulusIsComparedWithOtherModelsAndDifferences)
{
  const auto values       = json_of(demo_masses() + "/results.json").at("values");
  const auto expect_check = [&](const std::string &name, const std::string &check, const Tolerance &tolerance) {
    int n_found = 0;
    for (const auto &c : values.at(name).at("checks"))
      if (c.at("name").get<std::string>().rfind(check, 0) == 0) {
        ++n_found;
        EXPECT_TRUE(near(c.at("value").get<double>(), values.at(name).at("value").get<double>(), tolerance))
            << name;
      }
    EXPECT_EQ(n_found, 1) << name << ": " << check;
  };
  const auto distributed = within(0.05, "the contact of the other models is distributed along bending rolls");
  expect_check("stand.modulus.tangent", "rolls as reduced finite elements", distributed);
  expect_check("stand.modulus.tangent", "rolls as beams", distributed);
  // On this coarse contact the fitted tangents of K3 and K5 are known to no more than their stated error.
  const auto number  = [&](const char *name, const char *what) { return values.at(name).at(what).get<double>(); };
  const double share = 2 * number("stand.modulus.tangent", "value") / number("K3", "value");
  const auto differences =
      within(share * number("K3", "error_estimate"), "share of K3 and K5 in the stretch times their error");
  expect_check("stand.modulus.tangent", "differences of the stretch", differences);
  expect_check("stand.modulus.kiss", "differences of the stretch", differences);
  expect_check("stand.modulus.secant", "tangents summed over the force", differences);
  // One rigid arc and one theory in the bite and as its comparison: what is left is the slope of the stretch.
  for (const char *name :
       {"stand.screw_sensitivity", "stand.thickness_by.entry_thickness", "stand.thickness_by.exit_tension"})
    expect_check(name, "differences of the coupled solution",
                 within(0.01, "the slab's force is not the load of the pass, at which the modulus is read"));
  for (const auto &[name, result] : values.items())
    if (name.rfind("stand.", 0) == 0 || name.rfind("mode.", 0) == 0)
      EXPECT_FALSE(result.at("inputs").empty()) << name;
}
