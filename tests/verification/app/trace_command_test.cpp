#include "tests/support/program.h"
#include <gtest/gtest.h>

TEST(TraceCommand, TraceCommandPrintsTheTableAndHasItsExitCodes)
{
  const auto good = millstand("trace cases/two-cylinders.toml lower.diameter -q");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.out.rfind("lower.diameter = 1300 mm  (cases/two-cylinders.toml:17)\n", 0), 0u) << good.out;
  EXPECT_EQ(good.out.find("Elasticities"), std::string::npos) << "-q leaves the notes out";
  const auto set = millstand("trace cases/two-cylinders.toml lower.diameter --set 'lower.diameter=1200 mm'");
  EXPECT_EQ(set.out.rfind("lower.diameter = 1200 mm  (--set lower.diameter=1200 mm)\n", 0), 0u) << set.out;
  const auto unknown = millstand("trace cases/two-cylinders.toml lower.diametre");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'lower.diameter'?"), std::string::npos) << unknown.err;
  EXPECT_EQ(millstand("trace cases/two-cylinders.toml").exit_code, 2) << "a key is needed";
}
