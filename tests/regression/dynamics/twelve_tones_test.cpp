// Response of eight parameter sets to one polyline force, against a record computed outside this program
// (reference file, entries regression.*).
#include "dynamics/response/response.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"

using namespace mill;
using namespace mill::dynamics;

TEST(TwelveTones, EveryParameterSetRespondsAsTheReference)
{
  const ForceRecord force = twelve_tones();
  EXPECT_TRUE(near(force.force[0], reference("regression.force").at("F0"), within(1e-12, "same formula")));
  EXPECT_TRUE(
      near(force.force.maxCoeff() - force.force.minCoeff(), 6639, within(1e-9, "amplitude chosen for it")));
  for (const std::string set : {"P1", "P2", "P3", "P4", "Q1", "R1", "R2", "R3"}) {
    const auto chosen       = parameter_set(set);
    const auto expected     = reference("regression." + set + ".response");
    const Response response = mill_response(mill_model(chosen.stand, chosen.dynamics), force, 10e3);
    const auto sample       = expected.at("sample").get<std::vector<Eigen::Index>>();
    const char *history[]   = {"y3", "y4"};
    for (int roll = 0; roll < 2; ++roll) {
      const Eigen::VectorXd computed = response.acceleration.col(upper_work_roll + roll);
      ASSERT_EQ(computed.size(), 20001);
      const double peak         = expected.at("peak")[std::size_t(roll)];
      const Tolerance tolerance = within(1e-7, "rounding carried over 20000 steps, of the peak", peak);
      EXPECT_TRUE(near(level(computed).peak, peak, tolerance)) << set;
      EXPECT_TRUE(near(level(computed).rms, expected.at("rms")[std::size_t(roll)], tolerance)) << set;
      for (std::size_t i = 0; i < sample.size(); ++i)
        EXPECT_TRUE(near(computed[sample[i]], expected.at(history[roll])[i], tolerance))
            << set << " sample " << sample[i];
    }
  }
}
