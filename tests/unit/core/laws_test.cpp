#include "core/base/errors.h"
#include "core/model/strip.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
template <class Law, class Constants> void expect_rows_in_order(const Constants &constants)
{
  Law law;
  const auto places = places_of_constants(law);
  ASSERT_EQ(places.size(), constants.size());
  for (std::size_t i = 0; i < constants.size(); ++i)
    EXPECT_EQ(places[i], &(law.*constants[i].member)) << constants[i].key;
}

template <class Parse> std::string refusal(const Parse &parse)
{
  try {
    parse("tresca");
  } catch (const InputError &error) {
    return error.problems.at(0).message;
  }
  return "accepted";
}
}  // namespace

TEST(Laws, ConstantsAreInTheOrderOfTheirRows)
{
  expect_rows_in_order<Friction>(friction_constants());
  expect_rows_in_order<FlowStress>(flow_stress_constants());
}

TEST(Laws, NamesAreReadBack)
{
  ASSERT_GE(friction_laws().size(), 4u);
  for (const FrictionLaw law : friction_laws())
    EXPECT_EQ(friction_law(name_of(law)), law);
  ASSERT_GE(flow_stress_laws().size(), 7u);
  for (const FlowStressLaw law : flow_stress_laws())
    EXPECT_EQ(flow_stress_law(name_of(law)), law);
  EXPECT_EQ(refusal(friction_law), "strip.friction.law = \"tresca\" is not known; coulomb, factor, speed or film");
  EXPECT_EQ(refusal(flow_stress_law), "strip.flow_stress.law = \"tresca\" is not known; constant, swift, ludwik, "
                                      "voce, power, reduction-power or table");
}

TEST(Laws, TractionSlidesUpToItsLimit)
{
  Friction coulomb;
  coulomb.coefficient = 0.2;
  coulomb.shear_limit = 0.8;
  const auto slide    = bite::traction_of(coulomb, 0.2);
  EXPECT_EQ(bite::traction_limit(slide, 1.0, 2.0, 1), 0.2);
  EXPECT_EQ(bite::traction_limit(slide, 10.0, 2.0, -1), 0.8);
  coulomb.shear_limit = NAN;
  EXPECT_EQ(bite::traction_limit(bite::traction_of(coulomb, 0.2), 10.0, 2.0, 1), 2.0);
  Friction factor;
  factor.law          = FrictionLaw::factor;
  factor.entry_factor = 0.5;
  factor.exit_factor  = 0.25;
  const auto stick    = bite::traction_of(factor, 0.0);
  EXPECT_EQ(bite::traction_limit(stick, 1.0, 4.0, 1), 1.0);
  EXPECT_EQ(bite::traction_limit(stick, 1.0, 4.0, -1), 0.5);
  EXPECT_EQ(bite::traction_limit(stick, 1.0, 4.0, 0.0), 0.75);  // smoothed, in the middle
}
