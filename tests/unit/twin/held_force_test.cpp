// What the samples of a stand show under a force in straight lines between its samples, against the response in
// time that the integrator of the dynamics computes.
#include "dynamics/response/time_integration.h"
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/calibration/modal_columns.h"
#include <cmath>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr double rate = 2000;

/// One mode; a force that ends long before the record does, so that nothing rings on at either end.
struct HeldRecord {
  double w = 2 * M_PI * 700, zeta = 0.03, gain = 2;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(4000), acceleration;
  HeldRecord()
  {
    force.segment(1, 1500) = synthetic::white(7, 1500, rate, 1);
    ForceRecord record{Eigen::VectorXd::LinSpaced(4000, 0, 3999 / rate), force, {}, {}};
    dynamics::StateSpace mode{Eigen::MatrixXd(2, 2), Eigen::VectorXd(2), Eigen::MatrixXd(1, 2),
                              Eigen::VectorXd(1)};
    // states w q and q': with q and q' the matrix exponential loses eight digits to their scale
    mode.A << 0, w, -w, -2 * zeta * w;
    mode.B << 0, gain;
    mode.C << -w, -2 * zeta * w;
    mode.D << gain;
    acceleration =
        dynamics::first_order_hold(mode, record, rate, dynamics::HoldForm::matrix_exponential).output.row(0);
  }
  StandAt stand() const
  {
    StandAt at;
    at.frequency = Eigen::VectorXd::Constant(1, w);
    at.damping   = Eigen::VectorXd::Constant(1, zeta);
    at.force     = Eigen::VectorXd::Constant(1, gain);
    at.shape     = Eigen::MatrixXd::Ones(1, 1);
    return at;
  }
};
}  // namespace

TEST(HeldForce, TheWholeResponseInTheSamplesIsTheIntegratorsUpToHalfTheRate)
{
  const HeldRecord record;
  Fourier fourier;
  const BandRecord band =
      band_record(record.force, record.acceleration, rate, 20, 990, fourier, BetweenSamples::lines);
  const ModalColumns c      = modal_columns(record.stand(), band, {0, band.angular.size()});
  const double largest      = band.acceleration.cwiseAbs().maxCoeff();
  const double not_the_same = (c.driven.col(0) - band.acceleration.col(0).array()).abs().maxCoeff();
  EXPECT_LT(not_the_same, 1e-10 * largest) << "both are exact but for rounding";
}

TEST(HeldForce, ASmoothForceMovesTheStandAsTheTransferFunctionSays)
{
  const HeldRecord record;
  Fourier fourier;
  const BandRecord band = band_record(record.force, record.acceleration, rate, 20, 990, fourier);
  const ModalColumns c  = modal_columns(record.stand(), band, {0, band.angular.size()});
  for (Eigen::Index b = 0; b < band.angular.size(); b += 97) {
    const double w = band.angular[b];
    const std::complex<double> d(record.w * record.w - w * w, 2 * record.zeta * record.w * w);
    EXPECT_TRUE(near(std::abs(c.driven(b, 0)), std::abs(w * w * record.gain * band.force[b] / d),
                     within(1e-12, "one product, written twice")));
  }
}
