#include "core/base/operating_point.h"
#include "tests/support/near.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(OperatingPoint, QuantitiesAreShownInTheirUnitAndKeptInSI)
{
  const OperatingPoint point("pass 1, {} -> {}, {}",
                             {{8e-3, "mm", ".4g"}, {5e-3, "mm", ".4g"}, {989.5e3, "kN", ".1f"}});
  EXPECT_EQ(point.text(), "pass 1, 8 mm -> 5 mm, 989.5 kN");
  ASSERT_EQ(point.values().size(), 3U);
  EXPECT_EQ(point.values()[0].value, 8e-3);
  EXPECT_EQ(point.values()[0].unit, "m");
  EXPECT_EQ(point.values()[2].value, 989.5e3);
  EXPECT_EQ(point.values()[2].unit, "N");
}

TEST(OperatingPoint, PartsAreAddedAtTheEnd)
{
  OperatingPoint point = at_force(1e6);
  point.add(", tilted by {}", {{1e-3, "mrad"}});
  EXPECT_EQ(point.text(), "1000 kN, tilted by 1 mrad");
  EXPECT_EQ(point.values().back().unit, "rad");
}

TEST(OperatingPoint, WhatAUserWroteStaysWordForWord)
{
  const OperatingPoint one = operating_point_of("976.20 kN");
  EXPECT_EQ(one.text(), "976.20 kN");
  ASSERT_EQ(one.values().size(), 1U);
  EXPECT_TRUE(near(one.values()[0].value, 976200, within(1e-15, "one multiplication")));
  for (const char *words : {"", "idle {}", "about 5 kN", "12"}) {
    EXPECT_EQ(operating_point_of(words).text(), words);
    EXPECT_TRUE(operating_point_of(words).values().empty()) << words;
  }
  EXPECT_TRUE(OperatingPoint().empty());
}
