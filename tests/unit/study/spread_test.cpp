#include "app/study/spread.h"
#include "app/study/study_statistics.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

namespace {
using namespace mill;

const Case &demo()
{
  static const Case the_case = read_case(MILLSTAND_SOURCE_DIR "/cases/four-high-1400.toml");
  return the_case;
}

UncertainKey read(const std::string &written)
{
  return uncertain_key(demo(), {}, written);
}

std::string refusal(const std::string &written)
{
  try {
    read(written);
  } catch (const InputError &e) {
    return e.problems.empty() ? e.what() : e.problems.front().message;
  }
  return "accepted";
}

TEST(Spread, NumbersAreInTheUnitBehindTheBracket)
{
  const UncertainKey key = read("frame.upper_beam_stiffness~normal(7.3, 0.2) MN/mm");
  EXPECT_EQ(key.key.unit, "MN/mm");
  EXPECT_EQ(key.spread.mean, 7.3);
  EXPECT_EQ(key.spread.sd, 0.2);
  EXPECT_EQ(set_value(key, 7.25), "7.25 MN/mm");
}

TEST(Spread, ThePercentageIsOfTheMeanOfTheCase)
{
  const UncertainKey key = read("steel.youngs_modulus~normal(1 %)");
  EXPECT_TRUE(near(key.spread.mean, 210, within(1e-14, "the value of the case, 210 GPa")));
  EXPECT_TRUE(near(key.spread.sd, 2.1, within(1e-14, "1 % of 210 GPa")));
}

TEST(Spread, AToleranceIsThreeStandardDeviationsToEachSide)
{
  const UncertainKey key = read("work_roll.barrel_diameter~tolerance(0.5 mm)");
  EXPECT_EQ(key.spread.low, 419.5);
  EXPECT_EQ(key.spread.high, 420.5);
  EXPECT_TRUE(near(key.spread.sd, 0.5 / 3, within(1e-14, "a third of the half width")));
  // Cut at three standard deviations, 1 - 2 x 3 phi(3) / (2 Phi(3) - 1) of the variance stays.
  const double phi = 0.00443184841194, inside = 0.99730020393674;  // tables of the normal law
  EXPECT_TRUE(near(deviation_of(key.spread) / key.spread.sd, std::sqrt(1 - 6 * phi / inside),
                   within(1e-10, "digits of the tables")));
}

TEST(Spread, DeviationOfUniformAndTriangular)
{
  EXPECT_TRUE(near(deviation_of(read("strip.width~uniform(940, 1060) mm").spread), 120 / std::sqrt(12.0),
                   within(1e-14, "closed form")));
  EXPECT_TRUE(near(deviation_of(read("strip.width~triangular(940, 1000, 1060) mm").spread), 60 / std::sqrt(6.0),
                   within(1e-12, "closed form of the symmetric one")));
}

TEST(Spread, RefusalsNameTheFaultAndTheRemedy)
{
  EXPECT_EQ(refusal("strip.width~uniform(1060, 940) mm"),
            "--vary \"strip.width~uniform(1060, 940) mm\": the interval is reversed; write the lower end first");
  EXPECT_EQ(refusal("strip.width~normal(1000, 0) mm"),
            "--vary \"strip.width~normal(1000, 0) mm\": the spread must be above zero");
  EXPECT_EQ(
      refusal("strip.width~normal(1000, 20)"),
      "--vary \"strip.width~normal(1000, 20)\": 1000 has no unit; a length is needed, for example \"1000 mm\"");
  EXPECT_EQ(refusal("strip.width~normal(1000, 20) kg"),
            "--vary \"strip.width~normal(1000, 20) kg\": 1000 kg is a mass; "
            "a length is needed, for example \"1000 mm\"");
  EXPECT_EQ(refusal("strip.width~norml(1000, 20) mm"),
            "--vary \"strip.width~norml(1000, 20) mm\": 'norml' is not a distribution; did you mean 'normal'?");
  EXPECT_EQ(refusal("strip.width~triangular(1000, 20) kg").find("--vary"), 0u);
  const std::string outside = refusal("work_roll.barrel_diameter~normal(420, 100) mm");
  EXPECT_NE(outside.find("of this distribution is outside of"), std::string::npos) << outside;
  EXPECT_NE(outside.find("truncated(mean, sd, low, high)"), std::string::npos) << outside;
}

TEST(Spread, APercentageIsNotAMean)
{
  const std::string remedy =
      "100 % would be of the mean, which it stands for; write the mean as a value, or leave "
      "it out to take that of the case";
  for (const std::string written :
       {"strip.friction~normal(100 %, 5 %)", "strip.width~tolerance(100 %, 5 %)",
        "strip.friction~triangular(0.05, 100 %, 0.15)", "strip.friction~truncated(100 %, 5 %, 0.05, 0.15)"})
    EXPECT_EQ(refusal(written), "--vary \"" + written + "\": " + remedy);
  for (const std::string written : {"strip.friction~uniform(90 %, 110 %)", "strip.width~uniform(900 mm, 110 %)"})
    EXPECT_NE(
        refusal(written).find("uniform has no mean that a percentage would be of; write both ends as values"),
        std::string::npos)
        << refusal(written);
}

TEST(Spread, ShareOutsideIsThatOfTheNormalLaw)
{
  Spread spread;
  spread.kind = Spread::Kind::normal;
  spread.mean = 10, spread.sd = 2;
  EXPECT_TRUE(near(share_outside(spread, 6, std::numeric_limits<double>::infinity()), 0.022750131948,
                   within(1e-9, "Phi(-2) of tables")));
  spread.kind = Spread::Kind::uniform;
  spread.low = -5, spread.high = 5;
  EXPECT_TRUE(near(share_outside(spread, 1, 100), 0.6, within(1e-12, "closed form")));
}

TEST(Spread, ARemedyFitsTheDistribution)
{
  const std::string uniform = refusal("work_roll.barrel_diameter~uniform(-5, 420) mm");
  EXPECT_NE(uniform.find("move its ends inside"), std::string::npos) << uniform;
  EXPECT_EQ(uniform.find("truncate"), std::string::npos) << uniform;
}
}  // namespace
