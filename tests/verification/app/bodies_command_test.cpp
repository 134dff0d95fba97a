#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

// Two bodies of revolution as a user meets them: cases against references that stand in their comments, and the
// engine against the closed form.
namespace {
nlohmann::json run(const std::string &what, const std::string &name, const std::string &more = "")
{
  const std::string out = scratch(name);
  const auto outcome    = millstand("run " + what + " -q -o " + out + " --cache " + shared_cache() + " " + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(std::ifstream(out + "/results.json")).at("values");
}

const std::string few = "--set contact.space.samples=5 ";
}  // namespace

TEST(Bodies, AnEllipticContactIsHertz)
{
  const auto values = run("cases/elliptic-contact.toml", "ellipse", few);
  // contact.md 8.3, H3; the fit of a half width on 12 rectangles and the mean pressure of one decide.
  EXPECT_TRUE(near(of(values, "contact.space.half_width"), 0.356034e-3, within(0.005, "12 rectangles, by a fit")));
  EXPECT_TRUE(
      near(of(values, "contact.space.loaded_length"), 2 * 0.5646e-3, within(0.005, "12 rectangles, by a fit")));
  EXPECT_TRUE(near(of(values, "contact.space.peak_pressure"), 2375.252e6, within(0.002, "by a fit")));
  EXPECT_TRUE(near(of(values, "contact.space.approach"), 14.3073e-6, within(2e-4, "second order")));
  EXPECT_TRUE(near(of(values, "contact.space.tangent"), 104.841e6, within(0.001, "parabola through nine loads")));
  EXPECT_TRUE(near(check_of(values, "contact.space.approach", "Hertz, ellipse (10.5)"), 14.3073e-6,
                   within(1e-5, "printed with six digits")));
  for (const char *name : {"half_width", "peak_pressure", "approach", "tangent"}) {
    const std::string full = std::string("contact.space.") + name;
    EXPECT_GE(of(values, full, "error_estimate"),
              std::abs(of(values, full) / check_of(values, full, "Hertz, ellipse (10.5)") - 1) * 0.99)
        << full;
  }
}

TEST(Bodies, ASphereInPartialSlipIsMindlin)
{
  const auto values = run("cases/partial-slip.toml", "slip", few);
  // contact.md 8.5, Q/(mu P) = 0.5.
  EXPECT_TRUE(near(of(values, "contact.space.stick_half_width"), 0.793701 * 0.402073e-3,
                   within(0.01, "16 rectangles on the radius, by a fit")));
  EXPECT_TRUE(
      near(of(values, "contact.space.tangential_displacement"), 2.17921e-6, within(0.005, "16 on a radius")));
  EXPECT_TRUE(near(of(values, "contact.space.tangential_stiffness"), 76.412e6, within(0.01, "singular rim")));
}

TEST(Bodies, ARollerAgreesWithLundbergAndWarnsOfASharpEnd)
{
  // contact.md 8.7.
  const auto log = run("cases/tilted-roller.toml", "log",
                       few + "--set contact.space.tilt='0 mrad' --set upper.profile_load='20000 N'");
  EXPECT_TRUE(near(of(log, "contact.space.approach"), 17.1535e-6, within(0.003, "asked of case roller-log")));
  EXPECT_TRUE(near(of(log, "contact.space.line_load_ratio"), 1.023,
                   within(0.015, "1.021 .. 1.025, and grids differ by a percent")));
  const auto sharp =
      run("cases/tilted-roller.toml", "sharp",
          few + "--set contact.space.tilt='0 mrad' --set upper='{diameter = \"25 mm\", length = \"40 "
                "mm\"}'");
  EXPECT_TRUE(near(of(sharp, "contact.space.approach"), 16.12e-6, within(0.003, "asked of case roller-sharp")));
  EXPECT_FALSE(sharp.contains("contact.space.edge_factor")) << "the largest pressure there is the grid's";
  EXPECT_FALSE(sharp.contains("contact.space.line_load_ratio"));
}

// The largest line load lies where the rounding begins, in the middle of rows that grow towards mid-length.
TEST(BodiesLong, ARoundedRollersEdgeFactorsHoldTheirErrorEstimates)
{
  const std::string rounded = few +
                              "--set contact.space.tilt='0 mrad' --set upper='{diameter = \"25 mm\", length = "
                              "\"40 mm\", profile = \"arc\", profile_length = \"2 mm\", profile_drop = \"20 "
                              "um\"}' ";
  const auto by_default = run("cases/tilted-roller.toml", "rounded", rounded),
             fine = run("cases/tilted-roller.toml", "rounded-fine", rounded + "--set contact.space.rectangles=24");
  for (const char *name : {"contact.space.line_load_ratio", "contact.space.edge_factor"}) {
    EXPECT_LE(std::abs(of(by_default, name) / of(fine, name) - 1), of(by_default, name, "error_estimate")) << name;
    EXPECT_LT(of(by_default, name, "error_estimate"), 0.05) << name;
  }
}

TEST(Bodies, ATiltedCrownMovesItsContact)
{
  const auto values = run("cases/elliptic-contact.toml", "rolled", few + "--set contact.space.tilt='10 mrad'");
  EXPECT_TRUE(
      near(of(values, "contact.space.moment"), 1000 * 0.010 * 0.020, within(1e-4, "P theta R, grid moved along")));
  EXPECT_TRUE(near(of(values, "contact.space.approach"), 14.3073e-6, within(2e-4, "the same contact elsewhere")));
}

TEST(Bodies, ARollOnARigidPlateIsHalfOfTwo)
{
  // contact.md 8.4, disc R 50 between rigid plates, q 1000 N/mm: both plates 30.0268 um.
  const auto values = run("cases/two-cylinders.toml", "plate",
                          "--set upper.diameter='100 mm' --set lower='{shape = \"plane\", rigid = true}' --set "
                          "contact.line.samples=8");
  EXPECT_TRUE(
      near(of(values, "contact.line.approach"), 0.5 * 30.0268e-6, within(0.003, "asked of case disc-r50")));
  EXPECT_TRUE(near(of(values, "contact.line.half_width"), 0.525232e-3, within(0.005, "asked of case disc-r50")));
  EXPECT_TRUE(near(of(values, "contact.line.peak_pressure"), 1212.074e6, within(0.005, "asked of case disc-r50")));
  EXPECT_TRUE(near(check_of(values, "contact.line.approach", "half planes, boundary elements (sec. 33.2)"),
                   0.5 * 30.0268e-6, within(5e-4, "second order")));
}

TEST(Bodies, UnlikeCylindersDifferFromCattaneo)
{
  const std::string material =
      "--set upper='{diameter = \"400 mm\", youngs_modulus = \"310 GPa\", poisson_ratio = 0.24}' ";
  const auto values =
      run("cases/two-cylinders.toml", "unlike",
          material + "--set contact.line.friction=0.3 --set contact.line.tangential_load='150 N/mm' "
                     "--set contact.line.samples=8");
  for (const char *name : {"half_width", "peak_pressure"})
    EXPECT_TRUE(
        near(of(values, std::string("contact.line.") + name),
             check_of(values, std::string("contact.line.") + name, name[0] == 'h' ? "Hertz (3.2)" : "Hertz (3.3)"),
             within(0.005, "as of equal cylinders")));
  EXPECT_TRUE(near(of(values, "contact.line.approach"),
                   check_of(values, "contact.line.approach", "Johnson, axis to axis (3.4)"),
                   within(0.003, "as of equal cylinders")));
  EXPECT_TRUE(near(of(values, "contact.line.stick_half_width"),
                   check_of(values, "contact.line.stick_half_width", "Cattaneo (33.5)"),
                   within(0.06, "unlike materials couple pressure and shear: beta about 0.03; strips of b/64")));
  const mill::Table width = mill::read_table(scratch("unlike") + "/curves/contact-line-width.csv");
  ASSERT_TRUE(width.column("shear") && width.column("friction_limit"));
  EXPECT_LE((*width.column("shear") - *width.column("friction_limit")).maxCoeff(), 1.0)
      << "Pa: never above the limit";
  const double step = (*width.column("x"))[1] - (*width.column("x"))[0];
  EXPECT_TRUE(near(width.column("shear")->sum() * step, 150e3, within(1e-9, "shear carries the tangential load")));
}

// A face that is hollow at mid-length carries at its ends.
TEST(Bodies, WhatIsNotLoadedAtMidLengthHasNoPressureThere)
{
  const std::string name = scratch("hollow-case") + "/hollow.toml";
  std::ofstream(name) << R"(schema = 1
kind = "two-cylinders"
title = "hollow roller"
[upper]
diameter = "25 mm"
length = "40 mm"
profile = "table"
profile_table = [["0 mm", "0 um"], ["20 mm", "-10 um"]]
[lower]
shape = "plane"
[contact.space]
loads = ["200 N", "4000 N"]
at = "2000 N"
)";
  const auto values = run(name, "hollow", few);
  EXPECT_FALSE(values.contains("contact.space.peak_pressure"));
  EXPECT_FALSE(values.contains("contact.space.half_width"));
  EXPECT_LT(of(values, "contact.space.loaded_length"), 0.04);
  std::ifstream file(scratch("hollow") + "/results.json");
  const auto remarks = nlohmann::json::parse(file).at("assumptions").dump();
  EXPECT_NE(remarks.find("nothing is carried at mid-length"), std::string::npos) << remarks;
}

TEST(Bodies, AContactAsWideAsItsBodyIsWarnedOf)
{
  const std::string out = scratch("wide");
  const auto outcome =
      millstand("run cases/elliptic-contact.toml -q -o " + out + " " + few +
                "--set contact.space.loads='[\"100 N\", \"90000 N\"]' --set contact.space.at='80000 N'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = nlohmann::json::parse(std::ifstream(out + "/results.json"));
  EXPECT_NE(results.dump().find("contact.space: the half width is 0.15 of the relative radius"), std::string::npos)
      << results.dump().substr(0, 400);
}

TEST(Bodies, ATiltThatLiftsHalfTheFaceOffIsRefused)
{
  const auto outcome = millstand("check cases/tilted-roller.toml --set contact.space.tilt='20 mrad'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("contact.space.tilt = 20 mrad lifts the faces off over more than half of the contact at "
                       "5000 N, the least of loads ("),
      std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("mm carry); lower it, or raise loads"), std::string::npos) << outcome.err;
}
