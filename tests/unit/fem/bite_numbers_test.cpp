// Error estimates of the results of the bite: from two meshes and from the theories that they are compared with.
#include "fem/strip/bite_numbers.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using fem::bite_error;
using fem::BiteAnswer;
using fem::BiteStudy;
using fem::spring_numbers;

namespace {
BiteAnswer answer(const std::string &key, const double force, const double slope, const double radius)
{
  BiteAnswer a;
  a.key                     = key;
  a.state.force             = force;
  a.state.flattened_radius  = radius;
  a.state.arc_length        = 0.025;
  a.stiffness.plastic_slope = slope;
  a.stiffness.flattening    = 20 * slope;
  a.stiffness.combined      = 1 / (1 / slope + 2 / a.stiffness.flattening);
  return a;
}

double force_of(const BiteAnswer &a)
{
  return a.state.force;
}

// Finite elements at 100 N, 98 N on the coarse mesh, slab theories at 107 and 104 N.
BiteStudy by_elements(const double ratio = 1)
{
  BiteStudy s;
  s.question.bite         = demo_pass();
  s.question.setup.method = BiteMethod::fe;
  s.question.setup.arc    = BiteArc::hitchcock;
  const double R          = ratio * s.question.bite.roll_radius;
  s.answers = {answer("karman", 107, 1100, R), answer("orowan", 104, 1080, R), answer("fe", 100, 1000, R)};
  s.flow.emplace();
  s.flow->coarsening   = 2;
  s.flow->coarse_force = 98;
  s.flow->coarse_slope = 990;
  return s;
}
const auto exact = within(1e-12, "relative differences");
}  // namespace

TEST(BiteNumbers, TheErrorIncludesTheSlabTheoryAndTheMeshes)
{
  BiteStudy s = by_elements();
  EXPECT_TRUE(near(bite_error(s, 100, 98, force_of), 0.07, exact));
  EXPECT_TRUE(near(bite_error(s, 100, 88, force_of), 1.25 * 0.12, exact)) << "two meshes, theory.md (1.5)";
  EXPECT_TRUE(std::isnan(bite_error(s, 100, not_given, force_of))) << "no second mesh: not known";
  s.answers[0].refused = "no flattened radius";
  EXPECT_TRUE(near(bite_error(s, 100, 98, force_of), 0.04, exact)) << "the next theory is the comparison";
  s.answers[1].refused = "no flattened radius";
  EXPECT_TRUE(std::isnan(bite_error(s, 100, 98, force_of))) << "nothing independent: not known";
}

// A force with an error of the first order, 100 + 3 h, on elements h = 1 and on larger ones: the estimate is the
// true error with its safety, however much larger they are.
TEST(BiteNumbers, TheMeshesEnterWithTheRatioOfTheirElements)
{
  for (const double ratio : {1.5, 1.6, 2., 3.}) {
    BiteStudy s        = by_elements();
    s.answers          = {answer("karman", 103, 1100, 0.21), answer("fe", 103, 1000, 0.21)};
    s.flow->coarsening = ratio;
    EXPECT_TRUE(near(bite_error(s, 103, 100 + 3 * ratio, force_of), 1.25 * 3 / 103, within(1e-9, "differences")))
        << ratio;
  }
}

TEST(BiteNumbers, BeyondHitchcocksRangeTheErrorNeedsAFreeArc)
{
  BiteStudy s = by_elements(5.5);
  EXPECT_TRUE(std::isnan(bite_error(s, 100, 98, force_of)));
  EXPECT_TRUE(std::isnan(spring_numbers(s).plastic_slope_error));
  EXPECT_TRUE(std::isnan(spring_numbers(s).combined_error));
  s.answers.push_back(answer("karman-elastic-arc", 130, 1400, 5.5 * 0.21));
  EXPECT_TRUE(near(bite_error(s, 100, 98, force_of), 0.3, exact));
}

TEST(BiteNumbers, TheSectionOfTheRollEntersByItsEffectOnTheResult)
{
  BiteStudy s             = by_elements();
  s.question.setup.method = BiteMethod::slab;
  s.question.setup.arc    = BiteArc::elastic;
  s.answers               = {answer("karman-elastic-arc", 100, 1000, 0.3), answer("karman", 101, 1010, 0.3)};
  EXPECT_TRUE(near(bite_error(s, 100, not_given, force_of), 0.01, exact));
  s.softer = answer("karman-elastic-arc", 102.5, 1000, 0.3);
  EXPECT_TRUE(near(bite_error(s, 100, not_given, force_of), 0.025, exact));
}

TEST(BiteNumbers, TheSeriesOfSlopeAndFlatteningHasASeparateError)
{
  const auto numbers = spring_numbers(by_elements());
  EXPECT_TRUE(near(numbers.plastic_slope_error, 0.1, exact));
  // 1/(1/1000 + 2/20000) against 1/(1/1100 + 2/22000): in proportion here; the mesh alone is 0.9 %.
  EXPECT_TRUE(near(numbers.combined_error, 0.1, exact));
  EXPECT_TRUE(std::isnan(numbers.flattening_error)) << "no section of the roll: nothing to compare with";
  EXPECT_FALSE(numbers.path) << "nor a path";
}

// A section that deflects evenly by U under an even pressure: force over U is the stiffness of its sum form.
TEST(BiteNumbers, TheSectionOfTheRollJudgesTheFlattening)
{
  constexpr int n      = 41;
  constexpr double arc = 0.025, pressure = 400e6, U = 50e-6;
  BiteStudy s             = by_elements();
  auto &state             = s.flow->fine.state;
  state.position          = Eigen::VectorXd::LinSpaced(n, -arc, 0);
  state.pressure          = Eigen::VectorXd::Constant(n, pressure);
  s.flexibility.position  = state.position;
  s.flexibility.influence = Eigen::MatrixXd::Constant(n, n, U / (n * pressure));
  const double F          = pressure * arc * s.question.bite.strip.width;
  for (BiteAnswer &a : s.answers)
    a.stiffness.flattening = 0.8 * F / U;
  const auto numbers = spring_numbers(s);
  ASSERT_TRUE(numbers.path);
  EXPECT_TRUE(near(numbers.path->sum, F / U, within(1e-9, "even pressure and deflection, rounding")));
  EXPECT_TRUE(near(numbers.flattening_error, 0.25, within(1e-9, "1/0.8 - 1, rounding")));
  auto rigid        = s;
  rigid.flexibility = {};
  const auto &k     = s.chosen().stiffness;
  EXPECT_TRUE(near(numbers.combined_error - spring_numbers(rigid).combined_error,
                   0.25 * 2 * k.combined / k.flattening, within(1e-9, "share of both rolls in the series")));
}
