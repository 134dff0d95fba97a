// Other places of a resonance that records hardly show: a likelihood with wells along the frequency of one mode,
// written down, so that the scan is compared with it.
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "twin/calibration/calibration_parts.h"
#include "twin/calibration/mode_scan.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr Eigen::Index third = 2;     // mode
constexpr double distance    = 0.06;  // of wells, ln w
constexpr double height      = 20;    // of the cost between them

/// Cost along x = ln w3 over the case, without the prior: a well at each multiple of the distance, the lowest at
/// the first one above the case.
double cost_at(const double x)
{
  return height * std::pow(std::sin(M_PI * x / distance), 2) + 600 * std::pow(x - distance, 2);
}

double slope_at(const double x)
{
  return height * M_PI / distance * std::sin(2 * M_PI * x / distance) + 1200 * (x - distance);
}

struct Wells {
  FittedStand stand = calibration::stand_r();
  std::vector<Unknown> unknowns{{"K2", 0.82}};
  FitProblem problem;
  Fit fit;
  Wells()
  {
    problem.unknowns   = unknowns;
    problem.likelihood = [this](const Eigen::VectorXd &theta, const NoiseDensity &, const Wanted wanted, int) {
      const double x = x_of(theta);
      Likelihood sum;
      sum.cost = cost_at(x);
      if (wanted != Wanted::cost) {
        const Eigen::VectorXd s = frequency_slopes(stand_at(stand, unknowns, theta)).row(third).transpose();
        sum.slope               = slope_at(x) * s;
        sum.information         = 2 * height * std::pow(M_PI / distance, 2) * s * s.transpose();
      }
      add_prior(sum, unknowns, theta);
      return sum;
    };
    problem.values = 1;
    fit            = minimised(problem, Eigen::VectorXd::Zero(1), {}, {0, 60, 1e-9, 1});
    fit.covariance *= 20;  // as if the well were wide enough to be scanned
  }
  double x_of(const Eigen::VectorXd &theta) const
  {
    const double there = stand_at(stand, unknowns, theta).frequency[third],
                 here  = stand_at(stand, unknowns, Eigen::VectorXd::Zero(1)).frequency[third];
    return std::log(there / here);
  }
};
}  // namespace

TEST(ModeScan, FollowsTheCostAndFindsTheLowestWell)
{
  const Wells wells;
  std::optional<Eigen::VectorXd> lower;
  const auto scans =
      scanned_modes(wells.stand, wells.problem, wells.fit, wells.unknowns, 900, {0, 60, 1e-6, 1}, lower);
  const auto of_third =
      std::find_if(scans.begin(), scans.end(), [](const ModeScan &scan) { return scan.mode == third; });
  ASSERT_NE(of_third, scans.end());
  const ModeScan &scan = *of_third;
  for (std::size_t k = 0; k < scan.theta.size(); ++k) {
    const double x     = wells.x_of(scan.theta[k]);
    const double prior = 0.5 * std::pow(scan.theta[k][0] / 0.82, 2);
    EXPECT_TRUE(near(scan.deviance[Eigen::Index(k)], 2 * (cost_at(x) + prior - wells.fit.cost),
                     within_absolute(1e-6, "the cost that is written down, rounding")));
  }
  EXPECT_TRUE(scan.has_several_places());
  ASSERT_TRUE(lower);
  EXPECT_TRUE(near(wells.x_of(*lower), distance, within_absolute(2e-3, "the prior pulls by less")));
}

TEST(ModeScan, OneWellIsOnePlace)
{
  ModeScan scan{third, 9, Eigen::VectorXd::LinSpaced(7, 180, 192), Eigen::VectorXd(7), {}};
  scan.deviance << 30, 12, 3, 0, 4, 15, 40;
  EXPECT_FALSE(scan.has_several_places());
  scan.deviance << 30, 5, 12, 0, 4, 15, 40;
  EXPECT_TRUE(scan.has_several_places()) << "a second minimum below 9";
  scan.deviance << 30, 10, 12, 0, 4, 15, 40;
  EXPECT_FALSE(scan.has_several_places()) << "a second minimum above 9";
  scan.deviance << 30, 3.5, 4, 0, 4, 15, 40;
  EXPECT_FALSE(scan.has_several_places()) << "a rise of less than 1 between them";
}
