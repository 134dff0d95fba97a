// Error estimates of the results of the bite: from two meshes and from the theories that they are compared with.
#include "app/stages/bite/bite_accuracy.h"
#include "app/stages/bite/bite_results.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

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
  s.flow->coarse_force = 98;
  s.flow->coarse_slope = 990;
  return s;
}
const auto exact = within(1e-12, "relative differences");
}  // namespace

TEST(BiteAccuracy, TheErrorIncludesTheSlabTheoryAndTheMeshes)
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

TEST(BiteAccuracy, BeyondHitchcocksRangeTheErrorNeedsAFreeArc)
{
  BiteStudy s = by_elements(5.5);
  EXPECT_TRUE(std::isnan(bite_error(s, 100, 98, force_of)));
  EXPECT_TRUE(std::isnan(bite_spring(s).plastic_slope.error_estimate));
  EXPECT_TRUE(std::isnan(bite_spring(s).combined.error_estimate));
  s.answers.push_back(answer("karman-elastic-arc", 130, 1400, 5.5 * 0.21));
  EXPECT_TRUE(near(bite_error(s, 100, 98, force_of), 0.3, exact));
}

TEST(BiteAccuracy, TheSectionOfTheRollEntersByItsEffectOnTheResult)
{
  BiteStudy s             = by_elements();
  s.question.setup.method = BiteMethod::slab;
  s.question.setup.arc    = BiteArc::elastic;
  s.answers               = {answer("karman-elastic-arc", 100, 1000, 0.3), answer("karman", 101, 1010, 0.3)};
  EXPECT_TRUE(near(bite_error(s, 100, not_given, force_of), 0.01, exact));
  s.softer = answer("karman-elastic-arc", 102.5, 1000, 0.3);
  EXPECT_TRUE(near(bite_error(s, 100, not_given, force_of), 0.025, exact));
}

TEST(BiteAccuracy, TheSeriesOfSlopeAndFlatteningHasASeparateError)
{
  const BiteStudy s       = by_elements();
  const BiteSpring spring = bite_spring(s);
  EXPECT_TRUE(near(spring.plastic_slope.error_estimate, 0.1, exact));
  // 1/(1/1000 + 2/20000) against 1/(1/1100 + 2/22000): in proportion here; the mesh alone is 0.9 %.
  EXPECT_TRUE(near(spring.combined.error_estimate, 0.1, exact));
  EXPECT_TRUE(std::isnan(spring.flattening.error_estimate)) << "no section of the roll: nothing to compare with";
}
