#include "report/plot/number.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill::report;

TEST(Number, SignificantDigitsGroupsAndPowers)
{
  EXPECT_EQ(significant(40191.8, 5), "40\u202f192");
  EXPECT_EQ(significant(753399, 5), "753\u202f400");
  EXPECT_EQ(significant(0.97941, 4), "0.9794");
  EXPECT_EQ(significant(38.907, 3), "38.9");
  EXPECT_EQ(significant(9.9996, 4), "10.00") << "rounding may carry into the next decade";
  EXPECT_EQ(significant(-1234.5, 5), "\u22121234.5");
  EXPECT_EQ(significant(1.24e-5, 3), "1.24 \u00d7 10\u207b\u2075");
  EXPECT_EQ(significant(4.0192e10, 5), "4.0192 \u00d7 10\u00b9\u2070");
  EXPECT_EQ(significant(0), "0");
}

TEST(Number, AValueHasTheDigitsThatItsErrorAllows)
{
  EXPECT_EQ(known_digits(60.3838, 0.64), "60");
  EXPECT_EQ(known_digits(39948.2, 0.004), "39\u202f950") << "error 160, two digits of it";
  EXPECT_EQ(known_digits(39948.2, 0.01), "39\u202f900") << "error 400, one digit of it";
  EXPECT_EQ(known_digits(218.34, 0.001), "218.3") << "error 0.22 allows two decimals, four digits are asked";
  EXPECT_EQ(known_digits(218.34, 0.001, 6), "218.34");
  EXPECT_EQ(known_digits(-218.34, 0.02), "\u2212218") << "error 4.4";
  EXPECT_EQ(known_digits(0.029, 3.0), "0.03") << "an error above the value leaves one digit";
  EXPECT_EQ(known_digits(4.0192e10, 0.004), "4.019 \u00d7 10\u00b9\u2070");
}

TEST(Number, WithoutAnErrorAllDigitsAreShown)
{
  EXPECT_EQ(known_digits(60.3838, NAN), "60.38");
  EXPECT_EQ(known_digits(60.3838, 0, 5), "60.384");
  EXPECT_EQ(known_digits(0, 0.1), "0");
  EXPECT_EQ(known_digits(NAN, 0.1), "\u2013");
}

TEST(Number, AFrequencyHasAtMostOneDecimal)
{
  EXPECT_EQ(frequency_text(60.3838, NAN), "60.4");
  EXPECT_EQ(frequency_text(60.3838, 0.64), "60");
  EXPECT_EQ(frequency_text(1234.56, 1e-5), "1234.6");
  EXPECT_EQ(frequency_text(0.0421, NAN), "0.04");
  EXPECT_EQ(frequency_text(0, NAN), "0.0");
}

TEST(Number, AnAccuracyHasTwoDigits)
{
  EXPECT_EQ(accuracy(0.64), "\u00b164\u00a0%");
  EXPECT_EQ(accuracy(-0.0041), "\u00b10.41\u00a0%");
  EXPECT_EQ(accuracy(1.234), "\u00b1120\u00a0%");
  EXPECT_EQ(accuracy(1e-9), "\u00b10\u00a0%");
  EXPECT_EQ(accuracy(NAN), "\u2013");
}

TEST(Number, ADashStandsForNaNAndInfinity)
{
  EXPECT_EQ(significant(NAN), "\u2013");
  EXPECT_EQ(fixed(INFINITY, 2), "\u2013");
  EXPECT_EQ(percent(NAN), "\u2013");
}

TEST(Number, FixedGroupsAndHasNoNegativeZero)
{
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(fixed(1234567.891, 2), "1\u202f234\u202f567.89");
  EXPECT_EQ(fixed(999, 0), "999");
}

TEST(Number, PercentCarriesItsSign)
{
  EXPECT_EQ(percent(0.0123), "+1.2\u00a0%");
  EXPECT_EQ(percent(-0.5), "\u221250.0\u00a0%");
  EXPECT_EQ(percent(0.004), "+0.40\u00a0%");
  EXPECT_EQ(percent(0), "0\u00a0%");
  EXPECT_EQ(percent(17.7), "+1770\u00a0%");
}

TEST(Number, EngineeringUnitsOfEveryRow)
{
  const struct {
    double si;
    const char *unit;
    double shown;
    const char *shown_unit;
  } rows[] = {{4.0192e10, "N/m", 40192, "kN/mm"},
              {2.87e10, "N/m2", 28700, "kN/mm per m"},
              {1.9e5, "N s/m", 190, "kN s/m"},
              {976217.5, "N", 976.2175, "kN"},
              {394.1e6, "Pa", 394.1, "MPa"},
              {9.80665, "m/s2", 1, "g"},
              {26.24e-6, "m", 26.24, "\u00b5m"},
              {1.1265e-3, "m", 1.1265, "mm"},
              {12.0, "m", 12.0, "m"},
              {38.9, "Hz", 38.9, "Hz"},
              {0.25, "1", 0.25, ""},
              {7700, "kg/m3", 7700, "kg/m\u00b3"}};
  for (const auto &row : rows) {
    const Shown shown = engineering(row.si, row.unit);
    EXPECT_TRUE(near(shown.value, row.shown, within(1e-14, "one multiplication"))) << row.unit;
    EXPECT_EQ(shown.unit, row.shown_unit);
  }
}
