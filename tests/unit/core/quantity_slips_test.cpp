// Quantities as other drawings and sheets write them: refused with the line that is right.
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/case/quantity_slips.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <filesystem>
#include <map>

using namespace mill;

namespace {
// SI value of one: NIST Special Publication 811 (2008), appendix B.8, seven digits; not from the product.
const std::map<std::string, double> one_of{{"in mm", 2.54e-2},
                                           {"inch mm", 2.54e-2},
                                           {"inches mm", 2.54e-2},
                                           {"\" mm", 0.0254},
                                           {"'' mm", 0.0254},
                                           {"\u2033 mm", 0.0254},
                                           {"ft mm", 3.048e-1},
                                           {"mil mm", 2.54e-5},
                                           {"cm mm", 1e-2},
                                           {"dm mm", 1e-1},
                                           {"micron um", 1e-6},
                                           {"lb kg", 4.535924e-1},
                                           {"lbs kg", 4.535924e-1},
                                           {"ton kg", 1e3},
                                           {"tons kg", 1e3},
                                           {"tonne kg", 1e3},
                                           {"ton kN", 9.80665e3},
                                           {"tons kN", 9.80665e3},
                                           {"t kN", 9.80665e3},
                                           {"tonf kN", 9.80665e3},
                                           {"tf kN", 9.80665e3},
                                           {"kgf kN", 9.80665},
                                           {"kp kN", 9.80665},
                                           {"daN kN", 10},
                                           {"lbf kN", 4.448222},
                                           {"kip kN", 4.448222e3},
                                           {"kgf/mm2 MPa", 9.80665e6},
                                           {"kp/mm2 MPa", 9.80665e6},
                                           {"kg/mm2 MPa", 9.80665e6},
                                           {"kgf/cm2 MPa", 9.80665e4},
                                           {"kp/cm2 MPa", 9.80665e4},
                                           {"psi MPa", 6.894757e3},
                                           {"ksi MPa", 6.894757e6},
                                           {"tf/mm kN/mm", 9.80665e6},
                                           {"tonf/mm kN/mm", 9.80665e6},
                                           {"t/mm kN/mm", 9.80665e6},
                                           {"ton/mm kN/mm", 9.80665e6},
                                           {"kgf/mm kN/mm", 9.80665e3},
                                           {"lbf/in kN/mm", 1.751268e2},
                                           {"mpm m/s", 1.666667e-2},
                                           {"fpm m/s", 5.08e-3},
                                           {"ft/min m/s", 5.08e-3},
                                           {"km/h m/s", 2.777778e-1},
                                           {"1/min rpm", 1.666667e-2},
                                           {"r/min rpm", 1.666667e-2},
                                           {"U/min rpm", 1.666667e-2},
                                           {"\u00b0 deg", 1.745329e-2},
                                           {"cP Pa s", 1e-3},
                                           {"hp kW", 7.456999e2},
                                           {"PS kW", 7.354988e2},
                                           {"Nm kN m", 1},
                                           {"kNm kN m", 1e3},
                                           {"kgf m kN m", 9.80665},
                                           {"g/cm3 kg/m3", 1e3},
                                           {"kg/dm3 kg/m3", 1e3},
                                           {"lb/in3 kg/m3", 2.767990e4}};

constexpr Range lengths{200, 2500};

class Slips : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_slips_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  std::string of_line(const std::string &line)
  {
    write_atomically(path, "[work_roll]\n" + line + "\n");
    return refusal([&] { read_case_file(path); });
  }
};
}  // namespace

TEST(ForeignUnits, EveryRowHasTheIndependentFactor)
{
  EXPECT_EQ(foreign_units().size(), one_of.size());
  for (const ForeignUnit &u : foreign_units()) {
    const std::string name = std::string(u.spelling) + " " + u.like;
    ASSERT_TRUE(one_of.count(name)) << name;
    EXPECT_TRUE(near(u.factor, one_of.at(name), within(5e-7, "half of the last of seven digits"))) << name;
    EXPECT_NE(find_unit(u.like), nullptr) << name;
    const Unit *known_unit = find_unit(u.spelling);
    EXPECT_TRUE(!known_unit || !(known_unit->dimension == unit(u.like).dimension))
        << name << " is read, and needs no remedy";
  }
}

TEST(QuantityRemedy, UnderstandsWhatDrawingsWrite)
{
  EXPECT_EQ(quantity_remedy("57 1/16 in", "mm", lengths),
            "has a fraction of an inch; 57 1/16 in = 57.0625 in: write \"1449.39 mm\"");
  EXPECT_EQ(quantity_remedy("37 3/8\"", "mm", lengths),
            "has a fraction of an inch; 37 3/8\" = 37.375 in: write \"949.325 mm\"");
  EXPECT_EQ(quantity_remedy("37.4\"", "mm", lengths), "is in inches; 37.4 \" = 949.96 mm: write \"949.96 mm\"");
  for (const char *text : {"\u00f8 950 mm", "\u00d8950 mm", "950 \u00b11 mm", "950 mm \u00b1 1 mm", "950+/-0.5 mm",
                           "~950 mm", "dia. 950 mm"})
    EXPECT_EQ(quantity_remedy(text, "mm", lengths), "has more than a number and a unit; write \"950 mm\"") << text;
  EXPECT_EQ(quantity_remedy("28 %", "1", {0, 0.5}), "is a percentage; write 0.28");
  EXPECT_EQ(quantity_remedy("80 %", "1", {0, 0.5}), "") << "outside of the range it is no remedy";
  EXPECT_EQ(quantity_remedy("60 rpm", "m/s", {0, 100}),
            "is a number of turns in a time; the speed of the surface is needed, pi x diameter x turns per "
            "second: a roll of 1 m has "
            "3.14159 m/s");
  for (const char *plain : {"1/16", "950 mm", "a/b in", "1/0 in", "\u00b1", "~"})
    EXPECT_EQ(quantity_remedy(plain, "mm", lengths), "") << plain;
}

TEST(QuantityRemedy, NamesTheConvertedNumber)
{
  EXPECT_EQ(quantity_remedy("57.1 in", "mm", lengths), "is in inches; 57.1 in = 1450.34 mm: write \"1450.34 mm\"");
  EXPECT_EQ(quantity_remedy("4.75 ft", "mm", lengths), "is in feet; 4.75 ft = 1447.8 mm: write \"1447.8 mm\"");
  EXPECT_EQ(quantity_remedy("1200 tonf", "kN", {1, 1e5}),
            "is in metric tons of force; 1200 tonf = 11768 kN: write \"11768 kN\"");
  EXPECT_EQ(quantity_remedy("1200 t", "kN", {1, 1e5}),
            "is in metric tons of force; 1200 t = 11768 kN: write \"11768 kN\"");
  EXPECT_EQ(quantity_remedy("24 kgf/mm2", "MPa", {1, 1e4}),
            "is in kilograms of force per mm2; 24 kgf/mm2 = 235.36 MPa: write \"235.36 MPa\"");
  EXPECT_EQ(quantity_remedy("30000 psi", "MPa", {1, 1e4}),
            "is in pounds of force per square inch; 30000 psi = 206.843 MPa: write \"206.843 MPa\"");
  EXPECT_EQ(quantity_remedy("30 ksi", "MPa", {1, 1e4}),
            "is in kilopounds of force per square inch; 30 ksi = 206.843 MPa: write \"206.843 MPa\"");
  EXPECT_EQ(quantity_remedy("420 inch", "mm", lengths),
            "is in inches; 420 inch = 10668 mm, which is outside 200 mm .. 2500 mm");
  EXPECT_EQ(quantity_remedy("5 lbf", "mm", lengths), "is in pounds of force, a force; a length is needed");
  EXPECT_EQ(quantity_remedy("5 furlongs", "mm", lengths), "");
}

TEST(QuantityRemedy, NamesTheNumberWithAPoint)
{
  EXPECT_EQ(quantity_remedy("1450,5 mm", "mm", lengths), "has a comma in its number; write \"1450.5 mm\"");
  EXPECT_EQ(quantity_remedy("1.450,5 mm", "mm", lengths), "has a comma in its number; write \"1450.5 mm\"");
  EXPECT_EQ(quantity_remedy("1 450 mm", "mm", lengths), "has a separator in its number; write \"1450 mm\"");
  EXPECT_EQ(quantity_remedy("1'450 mm", "mm", lengths), "has a separator in its number; write \"1450 mm\"");
  EXPECT_EQ(quantity_remedy("57,1 in", "mm", lengths), "has a comma in its number; write \"1450.34 mm\"");
  EXPECT_EQ(quantity_remedy("0,28", "1", {0, 0.5}), "has a comma in its number; write 0.28");
  EXPECT_EQ(quantity_remedy("-4,0e4 kN/mm", "kN/mm", {-1e9, 1e9}),
            "has a comma in its number; write \"-4.0e4 kN/mm\"");
}

// Of "1,450 mm" the range decides where it can.
TEST(QuantityRemedy, AnAmbiguousCommaIsReported)
{
  EXPECT_EQ(quantity_remedy("1,450 mm", "mm", lengths), "has a comma in its number; write \"1450 mm\"");
  EXPECT_EQ(quantity_remedy("1,450 mm", "mm", {}), "has a comma that may stand for a decimal point or for "
                                                   "thousands; write \"1.450 mm\" or \"1450 mm\"");
}

TEST(QuantityRemedy, UnknownUnitsGetNoRemedy)
{
  for (const char *text : {"420 mm", "wide", "", ",", "1,", "5 kg x", "2e-8 1/Pa"})
    EXPECT_EQ(quantity_remedy(text, "kN", {}), "") << text;
}

TEST_F(Slips, ACommaThatBreaksTomlGetsTheRepairedLine)
{
  EXPECT_EQ(of_line("friction = 0,2"),
            "a number is written with a decimal point and no other separator: friction = 0.2");
  EXPECT_EQ(of_line("barrel_diameter = 1450,5 mm"),
            "a value with a unit is written in quotes, its number with a decimal point and no other separator: "
            "barrel_diameter = \"1450.5 mm\"");
  EXPECT_EQ(of_line("barrel_diameter = 57.1 in"),
            "a value with a unit is written in quotes: barrel_diameter = \"57.1 in\"");
}
