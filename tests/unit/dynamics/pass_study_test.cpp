// Levels and spectra of a pass: by hand, and of an exact hold at two output rates.
#include "dynamics/response/pass_study.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

TEST(PassStudy, LevelsOfAResponseByHand)
{
  Response response;
  response.force        = Eigen::VectorXd::Constant(5, 1e6);
  response.acceleration = Eigen::MatrixXd::Zero(5, 6);
  response.acceleration.col(upper_work_roll) << 1, -5, 2, 4, 3;
  response.acceleration.col(lower_work_roll) << 0, 7, 0, 7, 0;
  const auto study = pass_study(response, 1e3);
  EXPECT_EQ(study.level[0].peak, 5);
  EXPECT_TRUE(near(study.level[0].rms, std::sqrt(55. / 5), within(1e-12, "five numbers")));
  EXPECT_EQ(study.half_rate[0].peak, 3);
  EXPECT_TRUE(near(study.half_rate[0].rms, std::sqrt(14. / 3), within(1e-12, "three numbers")));
  EXPECT_EQ(study.level[1].peak, 7);
  EXPECT_EQ(study.half_rate[1].peak, 0) << "every other sample";
  EXPECT_EQ(study.force.density.maxCoeff(), 0) << "a constant force";
}

TEST(PassStudy, HalfTheRateIsEveryOtherSampleOfAnExactHold)
{
  const MillModel model = mill_model(published_stand(), settings(ForceMeaning::measured, 0.01));
  const auto study      = pass_study(driven_model(model), twelve_tones(), 4e3);
  const auto thinned    = pass_study(study.response, 4e3);
  for (std::size_t roll = 0; roll < 2; ++roll) {
    EXPECT_TRUE(near(study.half_rate[roll].rms, thinned.half_rate[roll].rms,
                     within(1e-4, "held exactly, one sample more or less at the end")));
    EXPECT_EQ(study.level[roll].rms, thinned.level[roll].rms);
    const auto &spectrum = study.rolls[roll];
    const double power   = spectrum.density.squaredNorm() * (spectrum.frequency[1] - spectrum.frequency[0]);
    EXPECT_TRUE(
        near(std::sqrt(power), study.level[roll].rms, within(0.1, "segments, and a record that begins at rest")));
  }
}
