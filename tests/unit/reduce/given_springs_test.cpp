// A given K2 or K6 in the place of parts that are not drawn, theory (34.2).
#include "core/base/files.h"
#include "core/model/case.h"
#include "reduce/stand/lumped_stand.h"
#include "tests/support/given_stand.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>

using namespace mill;

namespace {
Parameter spring_of(const double value)
{
  Parameter p;
  p.value = value;
  p.unit  = "N/m";
  return p;
}

// The stand of which everything is given, with one spring in place of another.
reduce::LumpedStand chain_of(const std::vector<std::string> &sets = {})
{
  const std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_given_springs.toml").string();
  write_atomically(path, given_stand());
  const auto stand = std::get<FourHigh>(read_case(path, sets).spec);
  std::filesystem::remove(path);
  reduce::ChainInputs in;
  in.K3 = in.K5 = spring_of(4e10);
  in.K4         = spring_of(1.9e11);
  in.K_Zy_upper = in.K_Zy_lower = spring_of(1.02e11);
  in.Kzc                        = {spring_of(5.1e10), spring_of(2e10), spring_of(2e10), spring_of(5.1e10)};
  in.at                         = "976.0 kN";
  return reduce::lumped_stand(stand, in);
}
}  // namespace

TEST(GivenSprings, PartsThatAreNotDrawnShareTheRest)
{
  Frame f;
  f.oil_column_stiffness = f.cylinder_body_stiffness = not_given;
  f.upper_chock_stiffness                            = 1e11;
  f.lower_chock_stiffness                            = not_given;
  const reduce::PathSprings path{1e11, 1e11, 5e10};
  const Frame made = reduce::with_given_springs(f, path, 1e10, 2e10);
  // 1/K2 = 10e-11; bearings, bending and chock take 1e-11 + 2e-11 + 1e-11: 3e-11 for each of two.
  EXPECT_TRUE(near(made.oil_column_stiffness, 1 / 3e-11, within(1e-12, "sums of reciprocals")));
  EXPECT_TRUE(near(made.cylinder_body_stiffness, 1 / 3e-11, within(1e-12, "sums of reciprocals")));
  EXPECT_EQ(made.upper_chock_stiffness, 1e11) << "drawn";
  EXPECT_TRUE(near(made.lower_chock_stiffness, 1 / 2e-11, within(1e-12, "5e-11 less 3e-11")));
  EXPECT_EQ(
      refusal([&] { reduce::with_given_springs(f, path, 4e10, 2e10); }),
      "given.K2 = 4e+04 kN/mm is stiffer than bearings and bending of the backup roll in it, which have 2.5e+04 "
      "kN/mm; give a softer one, or K_Zy and K_ZW as well");
}

TEST(GivenSprings, TheLoadPathEndsAtTheGivenValues)
{
  const auto stand = chain_of();
  EXPECT_TRUE(
      near(stand.flexibility.roll_upper, 1 / 6.3086e9 + 1 / 1.0e10, within(1e-9, "(4.2) over given springs")));
  EXPECT_TRUE(
      near(stand.flexibility.roll_lower, 1 / 6.8789e9 + 1 / 2.6e10, within(1e-9, "(4.2) over given springs")));
  const double M[] = {9320, 59720, 1889, 3095, 42200, 4663};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(stand.model.M[i].value, M[i]);
  for (const Parameter &K : stand.model.K)
    EXPECT_TRUE(std::isfinite(K.value));
  EXPECT_TRUE(std::isfinite(stand.f1_upper.value[0]));
}
