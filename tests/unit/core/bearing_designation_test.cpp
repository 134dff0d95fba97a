// Bearings that a case names by their designation: what the catalogue fills in, what is estimated, what is
// refused.
#include "core/model/bearing_ratings.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>
#include <fstream>

using namespace mill;
namespace fs = std::filesystem;

namespace {
constexpr double degree_d = M_PI / 180;

class Designation : public testing::Test {
protected:
  fs::path folder = fs::path(testing::TempDir()) / "millstand_designation_test";
  void SetUp() override
  {
    fs::create_directories(folder);
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  void file(const std::string &name, const std::string &text)
  {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  Case read(const std::string &bearing, const std::string &load = "radial = \"500 kN\"")
  {
    file("case.toml", "schema = 1\nkind = \"bearing\"\ntitle = \"x\"\n[bearing.trb]\n" + bearing +
                          "\n[load]\nbearing = \"trb\"\n" + load + "\n");
    return read_case((folder / "case.toml").string());
  }
  RollerBearing bearing(const std::string &text)
  {
    return std::get<BearingCase>(read(text).spec).bearings.at(0);
  }
  /// "line:column: message" of each refusal, a line each.
  std::string refused(const std::string &text, const std::string &load = "radial = \"500 kN\"")
  {
    try {
      read(text, load);
    } catch (const InputError &error) {
      std::string out;
      for (const Problem &p : error.problems)
        out += (out.empty() ? "" : "\n") + fs::path(p.place.file).filename().string() + ":" +
               std::to_string(p.place.line) + ":" + std::to_string(p.place.column) + ": " + p.message;
      return out;
    }
    return "accepted";
  }
};
}  // namespace

TEST_F(Designation, ADesignationAloneDefinesABearing)
{
  const RollerBearing b = bearing("designation = \"LM761649D\"");
  EXPECT_EQ(b.type, BearingType::four_row_tapered);
  EXPECT_EQ(b.bore, 0.343052);
  EXPECT_EQ(b.outside_diameter, 0.457098);
  EXPECT_EQ(b.width, 0.254);
  EXPECT_EQ(b.rows, 4);
  EXPECT_EQ(b.dynamic_rating, 2370e3);
  EXPECT_EQ(b.roller_law, OneRollerLaw::fe);
  EXPECT_EQ(b.estimated,
            (std::vector<std::string>{"rollers_per_row", "roller_diameter", "roller_length", "cup_angle"}));
  // What was estimated gives the ratings it was estimated from, and fits.
  const Ratings r = ratings(b);
  EXPECT_TRUE(near(r.dynamic, b.dynamic_rating, within(1e-10, "bisection to rounding")));
  EXPECT_TRUE(near(r.static_rating, b.static_rating, within(1e-10, "closed form")));
  EXPECT_TRUE(near(b.cup_angle / degree_d, 15, within(1e-13, "degrees to radians and back: rounding")));
  EXPECT_GT(b.roller_cone_angle, 0);
  EXPECT_TRUE(near(closing_cup_angle(b), b.cup_angle, within(1e-6, "the apex closes")));
  EXPECT_LT(b.roller_length * std::cos(b.cup_angle), b.width / 4);
  EXPECT_GE(b.candidates.size(), 5u);
  EXPECT_LT(stiffness_spread(b.candidates), 0.05);
  EXPECT_GT(axial_spread(b.candidates), 0.3);  // 12 .. 18 deg
  EXPECT_EQ(
      b.filled.at(0),
      "bearing.trb: LM761649D/LM761610/LM761610D in the catalogue has 343.05 mm x 457.1 mm x 254 mm, 4 rows, C "
      "2370 kN, C0 6910 kN (NTN 2250, B-188; C0 from kgf; width from memory (inch series))");
  EXPECT_EQ(b.filled.at(1).substr(0, 83),
            "bearing.trb.rollers_per_row, roller_diameter, roller_length, cup_angle: estimated, ");
}

// The echo leaves open what was estimated, and runs to the same bearing.
TEST_F(Designation, TheResolvedCaseGivesTheSameBearing)
{
  for (const char *text : {"designation = \"LM761649D\"", "designation = \"4R10704\"",
                           "designation = \"LM761649D\"\nrollers_per_row = 42\nroller_cone_angle = \"2 deg\"",
                           "designation = \"LM451349D\"\nrollers_per_row = 39\nroller_length = \"33.4 mm\"\n"
                           "roller_diameter = \"21.5 mm\"\nroller_cone_angle = \"2.5 deg\""}) {
    const Case first = read(text);
    file("again.toml", first.resolved);
    const Case again = read_case((folder / "again.toml").string());
    const auto &a    = std::get<BearingCase>(first.spec).bearings[0],
               &b    = std::get<BearingCase>(again.spec).bearings[0];
    EXPECT_EQ(a.rollers_per_row, b.rollers_per_row) << text;
    EXPECT_EQ(a.roller_diameter, b.roller_diameter);
    EXPECT_EQ(a.roller_length, b.roller_length);
    EXPECT_EQ(a.cup_angle, b.cup_angle);
    EXPECT_EQ(a.roller_cone_angle, b.roller_cone_angle);
    EXPECT_EQ(a.estimated, b.estimated);
    EXPECT_EQ(a.type, b.type);
  }
}

TEST_F(Designation, GivenKeysReplaceTheCatalogueAndMustAgree)
{
  const RollerBearing b = bearing("designation = \"LM761649D\"\nrollers_per_row = 44\ncup_angle = \"17 deg\"");
  EXPECT_EQ(b.rollers_per_row, 44);
  EXPECT_TRUE(near(b.cup_angle / degree_d, 17, within(1e-13, "degrees to radians and back: rounding")));
  EXPECT_EQ(b.candidates.size(), 1u);
  EXPECT_EQ(stiffness_spread(b.candidates), 0);
  EXPECT_EQ(
      refused("designation = \"LM761649D\"\nbore = \"340 mm\"\ntype = \"four-row cylindrical\""),
      "case.toml:6:8: bearing.trb.bore = \"340 mm\" is not that of the designation, for which the catalogue has "
      "343.05 mm\n"
      "case.toml:7:8: bearing.trb.type = \"four-row cylindrical\" is not that of the designation, for which the "
      "catalogue has \"four-row tapered\"");
}

TEST_F(Designation, UnknownDesignationsAreRefusedWithTheNearest)
{
  EXPECT_EQ(refused("designation = \"LM761694D\""),
            "case.toml:5:15: bearing.trb.designation = \"LM761694D\" is not in the catalogue; nearest: "
            "LM761649D/LM761610/LM761610D, LM451349D/LM451310/LM451310D, LM778549D/LM778510/LM778510DG2");
  EXPECT_EQ(refused("designation = \"\""),
            "case.toml:5:15: bearing.trb.designation = \"\" is empty; leave it out");
  EXPECT_EQ(
      refused("designation = \"LM451349D\""),
      "case.toml:5:15: bearing.trb.designation = \"LM451349D\": the catalogue has no ratings of it, from which "
      "rollers could be estimated; give rollers_per_row, roller_diameter and roller_length, or dynamic_rating and "
      "static_rating");
  EXPECT_EQ(refused("designation = \"LM451349D\"\ndynamic_rating = \"20 kN\"\nstatic_rating = \"90000 kN\""),
            "case.toml:5:15: bearing.trb.designation = \"LM451349D\": no rollers of 266.7 mm x 355.6 mm give C 20 "
            "kN and "
            "C0 90000 kN by ISO 281 and ISO 76; give rollers_per_row, roller_diameter and roller_length");
}

TEST_F(Designation, AnOwnCatalogueIsSearchedFirst)
{
  const std::string header = "designation,type,d [mm],D [mm],B [mm],rows,C [kN],C0 [kN],source,e\n";
  file("own.csv", header + "LM761649D,four-row tapered,343.052,457.098,254,4,2500,7000,\"our drawing\",0.42\n");
  const RollerBearing b = bearing("designation = \"LM761649D\"\ncatalogue = \"own.csv\"");
  EXPECT_EQ(b.dynamic_rating, 2500e3);
  EXPECT_EQ(b.catalogue_source, "our drawing");
  EXPECT_TRUE(near(std::tan(b.cup_angle), 0.28, within(1e-12, "e / 1.5")));
  EXPECT_EQ(bearing("designation = \"4R10704\"\ncatalogue = \"own.csv\"").type, BearingType::four_row_cylindrical);
  const std::string path = (folder / "own.csv").string();
  EXPECT_EQ(refused("designation = \"X\"\ncatalogue = \"own.csv\""),
            "case.toml:5:15: bearing.trb.designation = \"X\" is neither in " + path +
                " nor in the catalogue of the program; nearest: 4R10704, 4R15201, M757449D/M757410/M757410D");
  file("own.csv", header + "X,four-row tapered,343.052,457.098,254,four,2500,7000,me,0.42\n");
  EXPECT_EQ(refused("designation = \"X\"\ncatalogue = \"own.csv\""),
            "own.csv:2:40: 'four' in column 'rows' is not a finite number");
  EXPECT_EQ(refused("designation = \"X\"\ncatalogue = \"none.csv\"").substr(0, 15), "case.toml:6:13:");
  EXPECT_NE(refused("catalogue = \"own.csv\"").find("has no effect without a designation; leave it out"),
            std::string::npos);
}

TEST_F(Designation, YieldPressureFollowsFromAFlowStress)
{
  const std::string sized = "designation = \"LM761649D\"\n";
  // K. L. Johnson, Contact Mechanics, 6.2: p_0 = 3.1 k = 1.79 Y by von Mises, Poisson's ratio 0.3.
  EXPECT_TRUE(near(bearing(sized + "raceway_flow_stress = \"2000 MPa\"").yield_pressure, 1.79 * 2000e6,
                   within(5e-3, "printed with three digits")));
  EXPECT_TRUE(near(
      bearing(sized + "raceway_flow_stress = \"2000 MPa\"\nraceway_flow_state = \"plane-strain\"").yield_pressure,
      3.1 * 1000e6, within(2e-2, "printed with two digits")));
  EXPECT_EQ(bearing(sized).yield_pressure, 4e9);
  EXPECT_EQ(refused(sized + "raceway_flow_stress = \"2000 MPa\"\nyield_pressure = \"4000 MPa\"").substr(0, 128),
            "case.toml:7:18: bearing.trb.yield_pressure = \"4000 MPa\" differs from the 3587 MPa "
            "that follow from raceway_flow_stress; give one");
}

TEST_F(Designation, ABearingNeedsALoadOfAnyKind)
{
  const std::string sized = "designation = \"LM761649D\"";
  EXPECT_EQ(refused(sized, "radial = \"0 kN\"\naxial = \"50 kN\""), "accepted");
  EXPECT_EQ(refused(sized, "radial = \"0 kN\"\nmoment = \"50 kN m\""), "accepted");
  EXPECT_EQ(refused(sized, "radial = \"0 kN\"\naxial_displacement = \"20 um\""), "accepted");
  EXPECT_EQ(
      refused(sized, "radial = \"0 kN\""),
      "case.toml:8:10: load.radial = \"0 kN\" leaves the bearing without a load; give axial, axial_displacement, "
      "moment or tilt");
  EXPECT_EQ(
      refused(sized, "radial = \"0 kN\"\naxial = \"50 kN\"\naxial_displacement = \"20 um\"\ntilt = \"1 mrad\"\n"
                     "moment = \"3 kN m\"\nloads = [\"1 kN\", \"2 kN\"]"),
      "case.toml:10:22: load.axial_displacement = \"20 um\" is given together with an axial load; give one of the "
      "two\n"
      "case.toml:12:10: load.moment = \"3 kN m\" is given together with a tilt; give one of the two\n"
      "case.toml:13:9: load.loads = [\"1 kN\", \"2 kN\"] sweeps a radial load, which this case does not have; "
      "leave it out");
}

// Acceptance PL-11: C and C0 of the demo bearing, inverted.
TEST(RollerCandidates, RollerCandidatesIncludeTheDemoBearing)
{
  RollerBearing b;
  b.bore               = 0.2667;
  b.outside_diameter   = 0.3556;
  b.width              = 0.230188;
  b.cup_angle          = 19.66 * degree_d;
  RollerBearing real   = b;
  real.rollers_per_row = 39;
  real.roller_diameter = 0.0215;
  real.roller_length   = 0.0334;
  b.dynamic_rating     = ratings(real).dynamic;
  b.static_rating      = ratings(real).static_rating;
  bool listed          = false;
  for (const RollerCandidate &c : roller_candidates(b)) {
    EXPECT_GE(c.filling, least_filling);
    EXPECT_LE(c.filling, largest_filling);
    if (c.rollers_per_row != 39)
      continue;
    listed = true;
    EXPECT_TRUE(near(c.roller_diameter, 0.0215, within(1e-12, "inverse of the formula")));
    EXPECT_TRUE(near(c.roller_length, 0.0334, within(1e-12, "inverse of the formula")));
  }
  EXPECT_TRUE(listed);
  KnownRollers known;
  known.roller_length = 0.0334;
  EXPECT_EQ(roller_candidates(b, known).at(0).rollers_per_row, 39);
  b.static_rating = not_given;
  EXPECT_EQ(refusal([&] { roller_candidates(b); }),
            "bearing.: rollers that give the ratings need C, C0, rows and a pitch diameter");
}
