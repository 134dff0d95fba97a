// Every row of the closed list of units against factors written down independently, and the way back to text.
#include "core/base/units.h"
#include "tests/support/near.h"
#include <cmath>
#include <map>
#include <random>

using namespace mill;

namespace {
// SI value of the number 1 in each unit, from the SI brochure (2019) and CGPM 1901 for g; not from the product.
const std::map<std::string, double> one_in_si{{"1", 1.0},
                                              {"%", 0.01},
                                              {"m", 1.0},
                                              {"mm", 0.001},
                                              {"um", 0.000001},
                                              {"m2", 1.0},
                                              {"mm2", 0.000001},
                                              {"kg", 1.0},
                                              {"t", 1000.0},
                                              {"s", 1.0},
                                              {"ms", 0.001},
                                              {"us", 0.000001},
                                              {"min", 60.0},
                                              {"K", 1.0},
                                              {"degC", 274.15},
                                              {"rad", 1.0},
                                              {"mrad", 0.001},
                                              {"deg", 0.017453292519943295},
                                              {"Hz", 1.0},
                                              {"kHz", 1000.0},
                                              {"rpm", 0.016666666666666666},
                                              {"rad/s", 1.0},
                                              {"m/s", 1.0},
                                              {"mm/s", 0.001},
                                              {"m/min", 0.016666666666666666},
                                              {"m/s2", 1.0},
                                              {"g", 9.80665},
                                              {"N", 1.0},
                                              {"kN", 1000.0},
                                              {"MN", 1000000.0},
                                              {"N/m", 1.0},
                                              {"N/um", 1000000.0},
                                              {"kN/mm", 1000000.0},
                                              {"MN/m", 1000000.0},
                                              {"kN/um", 1000000000.0},
                                              {"MN/mm", 1000000000.0},
                                              {"GN/m", 1000000000.0},
                                              {"N/mm", 1000.0},
                                              {"kN/m", 1000.0},
                                              {"N s/m", 1.0},
                                              {"kN s/m", 1000.0},
                                              {"N s/mm", 1000.0},
                                              {"kN s/mm", 1000000.0},
                                              {"Pa", 1.0},
                                              {"kPa", 1000.0},
                                              {"MPa", 1000000.0},
                                              {"GPa", 1000000000.0},
                                              {"N/m2", 1.0},
                                              {"N/mm2", 1000000.0},
                                              {"kN/mm2", 1000000000.0},
                                              {"bar", 100000.0},
                                              {"1/Pa", 1.0},
                                              {"1/MPa", 0.000001},
                                              {"1/GPa", 0.000000001},
                                              {"1/m", 1.0},
                                              {"1/mm", 1000.0},
                                              {"1/um", 1000000.0},
                                              {"kg/m3", 1.0},
                                              {"t/m3", 1000.0},
                                              {"Pa s", 1.0},
                                              {"mPa s", 0.001},
                                              {"J", 1.0},
                                              {"kJ", 1000.0},
                                              {"N m", 1.0},
                                              {"kN m", 1000.0},
                                              {"J/kg K", 1.0},
                                              {"W", 1.0},
                                              {"kW", 1000.0},
                                              {"MW", 1000000.0}};

// Dimension from the symbol: base units of each part, so that a wrong vector in the list fails.
Dimension dimension_of(const std::string &symbol)
{
  static const std::map<std::string, Dimension> parts{{"1", {}},
                                                      {"%", {}},
                                                      {"m", {1}},
                                                      {"mm", {1}},
                                                      {"um", {1}},
                                                      {"m2", {2}},
                                                      {"mm2", {2}},
                                                      {"m3", {3}},
                                                      {"kg", {0, 1}},
                                                      {"t", {0, 1}},
                                                      {"s", {0, 0, 1}},
                                                      {"ms", {0, 0, 1}},
                                                      {"us", {0, 0, 1}},
                                                      {"s2", {0, 0, 2}},
                                                      {"min", {0, 0, 1}},
                                                      {"K", {0, 0, 0, 1}},
                                                      {"degC", {0, 0, 0, 1}},
                                                      {"rad", {0, 0, 0, 0, 1}},
                                                      {"mrad", {0, 0, 0, 0, 1}},
                                                      {"deg", {0, 0, 0, 0, 1}},
                                                      {"Hz", {0, 0, -1}},
                                                      {"kHz", {0, 0, -1}},
                                                      {"rpm", {0, 0, -1}},
                                                      {"g", {1, 0, -2}},
                                                      {"N", {1, 1, -2}},
                                                      {"kN", {1, 1, -2}},
                                                      {"MN", {1, 1, -2}},
                                                      {"GN", {1, 1, -2}},
                                                      {"Pa", {-1, 1, -2}},
                                                      {"mPa", {-1, 1, -2}},
                                                      {"kPa", {-1, 1, -2}},
                                                      {"MPa", {-1, 1, -2}},
                                                      {"GPa", {-1, 1, -2}},
                                                      {"bar", {-1, 1, -2}},
                                                      {"J", {2, 1, -2}},
                                                      {"kJ", {2, 1, -2}},
                                                      {"W", {2, 1, -3}},
                                                      {"kW", {2, 1, -3}},
                                                      {"MW", {2, 1, -3}}};
  Dimension sum;
  int sign          = 1;
  std::size_t begin = 0;
  while (begin <= symbol.size()) {
    const std::size_t end = std::min(symbol.find_first_of(" /", begin), symbol.size());
    const Dimension d     = parts.at(symbol.substr(begin, end - begin));
    sum.length += sign * d.length;
    sum.mass += sign * d.mass;
    sum.time += sign * d.time;
    sum.temperature += sign * d.temperature;
    sum.angle += sign * d.angle;
    if (end < symbol.size() && symbol[end] == '/')
      sign = -1;
    begin = end + 1;
  }
  return sum;
}
}  // namespace

TEST(Units, EveryRowHasTheIndependentFactor)
{
  EXPECT_EQ(all_units().size(), one_in_si.size());
  for (const Unit &u : all_units()) {
    ASSERT_TRUE(one_in_si.count(u.symbol)) << u.symbol;
    EXPECT_TRUE(near(to_si(1, u), one_in_si.at(u.symbol), within(2.3e-16, "one rounding of the factor")))
        << u.symbol;
  }
}

TEST(Units, EveryRowHasTheDimensionOfItsSymbol)
{
  for (const Unit &u : all_units())
    EXPECT_TRUE(u.dimension == dimension_of(u.symbol)) << u.symbol;
}

TEST(Units, EveryRowIsFoundByItsSymbolAndNamesItsQuantity)
{
  for (const Unit &u : all_units()) {
    EXPECT_EQ(find_unit(u.symbol), &u) << u.symbol;
    const std::string words = u.quantity;
    EXPECT_TRUE(words.rfind("a ", 0) == 0 || words.rfind("an ", 0) == 0) << words;
  }
}

TEST(Units, AUnitHasSeveralSpellings)
{
  const Unit *damping = find_unit("N s/m");
  for (const char *spelling : {"N.s/m", "N*s/m", "N\u00b7s/m", " N  s/m "})
    EXPECT_EQ(find_unit(spelling), damping) << spelling;
  EXPECT_EQ(find_unit("\u00b5m"), find_unit("um"));
  EXPECT_EQ(find_unit("\u03bcm"), find_unit("um"));
  EXPECT_EQ(find_unit("m/s^2"), find_unit("m/s2"));
  EXPECT_EQ(find_unit("Mm"), nullptr);
  EXPECT_EQ(find_unit("KG"), nullptr);
  EXPECT_EQ(find_unit(""), nullptr);
}

TEST(Units, QuantitiesAreReadAsWritten)
{
  EXPECT_EQ(parse_quantity("1450 mm").value(), 1.45);
  EXPECT_EQ(parse_quantity("420mm").value(), 0.42);
  EXPECT_EQ(parse_quantity("4.0e4 kN/mm").value(), 4e10);
  EXPECT_EQ(parse_quantity("2 %").value(), 0.02);
  EXPECT_EQ(parse_quantity("+18.2 m/s").value(), 18.2);
  EXPECT_EQ(parse_quantity("-3 um").value(), -3e-6);
  EXPECT_EQ(parse_quantity("2e-8 1/Pa").value(), 2e-8);
  EXPECT_EQ(parse_quantity("2.43 1/um").value(), 2.43e6);
  EXPECT_EQ(parse_quantity("0.005 Pa s").value(), 0.005);
  EXPECT_EQ(parse_quantity("20 degC").value(), 293.15);
}

TEST(Units, TextThatIsNotAQuantityIsRefusedWithTheReason)
{
  using Fault = ParsedQuantity::Fault;
  for (const char *text : {"", "mm", "big mm", "nan mm", "inf mm", "1e999 mm", "1e305 GPa", ". mm", "+-1 mm"})
    EXPECT_EQ(parse_quantity(text).fault, Fault::no_number) << text;
  for (const char *text : {"420", " 420 ", "4e2"})
    EXPECT_EQ(parse_quantity(text).fault, Fault::no_unit) << text;
  for (const char *text : {"420 inch", "1 450 mm", "1,450 mm", "420 mm x", "0x10 mm"})
    EXPECT_EQ(parse_quantity(text).fault, Fault::unknown_unit) << text;
}

TEST(Units, OneDimensionHasSeveralNames)
{
  EXPECT_TRUE(unit("N/mm").dimension == unit("kN/mm").dimension);
  EXPECT_STREQ(unit("N/mm").quantity, "a line load");
  EXPECT_STREQ(unit("kN/mm").quantity, "a stiffness");
  EXPECT_EQ(units_like(unit("kg")), "kg, t");
}

TEST(Units, TextReadsBackAsTheSameDouble)
{
  EXPECT_EQ(quantity_text(0.42, unit("mm")), "420 mm");
  EXPECT_EQ(quantity_text(4.02e10, unit("kN/mm")), "40200 kN/mm");
  EXPECT_EQ(quantity_text(0.01, unit("%")), "1 %");
  EXPECT_EQ(quantity_text(19.66 * 3.14159265358979323846 / 180, unit("deg")), "19.66 deg");
  const unsigned seed = 20240917;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-12, 12);
  for (int i = 0; i < 20000; ++i) {
    const Unit &u      = all_units()[std::size_t(i) % all_units().size()];
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const auto parsed  = parse_quantity(quantity_text(value, u));
    ASSERT_EQ(parsed.fault, ParsedQuantity::Fault::none) << quantity_text(value, u);
    ASSERT_EQ(parsed.value(), value) << u.symbol << ", seed " << seed << ", draw " << i;
    double number = 0;
    ASSERT_TRUE(parse_number(number_text(value), number));
    ASSERT_EQ(number, value) << "seed " << seed << ", draw " << i;
  }
}
