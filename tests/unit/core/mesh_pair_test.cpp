// The one rule for errors that two meshes give.
#include "core/numerics/mesh_pair.h"
#include "tests/support/near.h"

using namespace mill;

// A value of order p, 7 + 0.3 h^p: the estimate is the true error with the factor of safety.
TEST(MeshPair, EstimateIsTheErrorTimesItsSafety)
{
  for (const double order : {1., 2., 4.})
    for (const double ratio : {1.2, 2., 3.}) {
      const auto value        = [&](const double h) { return 7 + 0.3 * std::pow(h, order); };
      const double true_error = 0.3 * std::pow(0.1, order) / value(0.1);
      EXPECT_TRUE(near(mesh_pair_error(value(0.1), value(0.1 * ratio), std::pow(ratio, order)),
                       mesh_pair_safety * true_error, within(1e-9, "rounding of a small difference")))
          << order << " " << ratio;
    }
  EXPECT_EQ(mesh_pair_error(-4, -5, 2), mesh_pair_safety / 4)
      << "without a known order the error is the whole difference";
}
