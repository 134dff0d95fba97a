#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
nlohmann::json json_of(const std::string &path)
{
  return nlohmann::json::parse(mill::read_text(path));
}

TEST(SweepCommand, EachRowIsTheRunWithItsValuesSet)
{
  const std::string folder = scratch("sweep-lumped");
  const Outcome swept =
      millstand("sweep cases/published-1400.toml --vary 'given.K3=3.0e10,4.0e10 N/m' --vary 'given.M2=58,60 t' "
                "--watch f3 --watch f4 -o " +
                folder + "/sweep");
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  const auto table = json_of(folder + "/sweep/sweep.json");
  ASSERT_EQ(table["rows"].size(), 4u);
  EXPECT_EQ(table["work"], "modes");
  EXPECT_EQ(table["rows"][2]["values"], (std::vector<std::string>{"4e+10 N/m", "58 t"}))
      << "the last key is inner";
  const Outcome run =
      millstand("modes cases/published-1400.toml --set 'given.K3=4.0e10 N/m' --set 'given.M2=58 t' -q "
                "-o " +
                folder + "/run");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results = json_of(folder + "/run/results.json");
  for (const int i : {0, 1}) {
    const std::string name = i == 0 ? "f3" : "f4";
    EXPECT_TRUE(near(table["rows"][2]["results"][i].get<double>(), results["values"][name]["value"].get<double>(),
                     within(1e-14, "the same functions on the same numbers")))
        << name;
  }
  const std::string csv = mill::read_text(folder + "/sweep/results.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "row,given.K3 [N/m],given.M2 [t],f3 [Hz],f4 [Hz],failure");
  const std::string page = mill::read_text(folder + "/sweep/report.html");
  EXPECT_NE(page.find("4 rows, all computed"), std::string::npos);
  EXPECT_NE(page.find("given.M2 = 58 t"), std::string::npos) << "a line for each value of the other key";
  EXPECT_EQ(millstand("report " + folder + "/sweep").exit_code, 0);
  EXPECT_EQ(mill::read_text(folder + "/sweep/report.html"), page) << "the page again from what is stored";
}

TEST(SweepCommand, ARollOnItsBearingsGoesWithTheRootOfTheStiffness)
{
  const std::string folder = scratch("sweep-root");
  const Outcome swept      = millstand("sweep cases/published-1400.toml --model quick --vary "
                                            "'given.Kzc1=1e10..4e10 N/m:4' --watch fh1 --watch fh2 -q -o " +
                                       folder + "/sweep");
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  const auto table = json_of(folder + "/sweep/sweep.json");
  const double M2  = 59716.884;  // kg, the upper backup roll on its two bearings
  for (int row = 0; row < 4; ++row) {
    const double exact = std::sqrt(2 * (1 + row) * 1e10 / M2) / (2 * M_PI);
    double nearest     = 0;  // of both horizontal frequencies: their order changes with the stiffness
    for (const auto &frequency : table["rows"][row]["results"])
      if (std::abs(frequency.get<double>() - exact) < std::abs(nearest - exact))
        nearest = frequency;
    EXPECT_TRUE(near(nearest, exact, within(1e-9, "one mass on two springs, closed form")));
  }
}

TEST(SweepCommand, RefusesARowBeforeAnythingIsComputed)
{
  const std::string folder = scratch("sweep-refused");
  const Outcome swept =
      millstand("sweep cases/four-high-1400.toml --vary 'backup_roll.crown=0,50,3000 um' -o " + folder + "/sweep");
  EXPECT_EQ(swept.exit_code, 2);
  EXPECT_NE(swept.err.find("row 3 (backup_roll.crown = 3000 um): backup_roll.crown"), std::string::npos)
      << swept.err;
  EXPECT_FALSE(std::filesystem::exists(folder + "/sweep"));
}

TEST(SweepCommand, RefusesANameThatIsNotAResult)
{
  const Outcome swept =
      millstand("sweep cases/published-1400.toml --vary 'given.K3=3e10,4e10 N/m' --watch f33 -o " +
                scratch("sweep-name") + "/sweep");
  EXPECT_EQ(swept.exit_code, 2);
  EXPECT_NE(
      swept.err.find("--watch f33: cases/published-1400.toml gives no result of this name; did you mean 'f3'?"),
      std::string::npos)
      << swept.err;
}
}  // namespace
