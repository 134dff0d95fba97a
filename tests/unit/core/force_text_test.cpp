#include "core/base/force_text.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(ForceText, AGivenLoadIsShownAsItWasGiven)
{
  EXPECT_EQ(force_text(976.2e3), "976.2 kN");
  EXPECT_EQ(force_text(18e6), "18000 kN");
  EXPECT_EQ(force_text(1148.5e3), "1148.5 kN");
  EXPECT_EQ(force_text(950e3), "950 kN");
  EXPECT_EQ(force_text(400), "0.4 kN");
  EXPECT_EQ(force_text(0), "0 kN");
  EXPECT_EQ(force_text(-12.5e3), "-12.5 kN");
}

TEST(ForceText, AComputedOneHasFourDigits)
{
  EXPECT_EQ(force_text(976213.748), "976.2 kN");
  EXPECT_EQ(force_text(11943434.5), "11943 kN") << "whole kN stay";
  EXPECT_EQ(force_text(98765.4321), "98.77 kN");
  EXPECT_EQ(force_text(999.99999e3), "1000 kN");
  EXPECT_EQ(force_text(1.23456789), "0.001235 kN");
  EXPECT_STREQ(force_form(976213.748), ".1f");
}
