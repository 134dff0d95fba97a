// Likelihood of records without leakage: slopes of its cost, transients, estimates of a record whose truth is
// known.
#include "dynamics/response/response_slopes.h"
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <Eigen/QR>
#include <cmath>
#include <complex>

using namespace mill;
using namespace mill::twin;
using calibration::recipe;

namespace {
Eigen::VectorXd some(const std::size_t n)
{
  return Eigen::VectorXd::NullaryExpr(Eigen::Index(n),
                                      [](const Eigen::Index i) { return 0.03 * std::cos(2.0 * double(i)); });
}

calibration::Recipe short_recipe()
{
  calibration::Recipe r = recipe("two");
  r.n                   = 20000;
  return r;
}

/// Every slope of the cost against a central difference.
void expect_slopes(const std::vector<Unknown> &unknowns, const double delay_at = 0)
{
  const MeasuredResponse data = calibration::measured(short_recipe());
  const FittedStand stand     = calibration::stand_r();
  const NoiseDensity noise    = noise_before(data);
  Eigen::VectorXd theta       = some(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].name == "delay")
      theta[Eigen::Index(i)] = delay_at;
  const Likelihood result = likelihood(stand, unknowns, theta, data, noise, Wanted::slopes);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double h     = unknowns[i].name == "delay" ? 1e-8 : 1e-5;
    const auto cost_at = [&](const double step) {
      Eigen::VectorXd moved = theta;
      moved[Eigen::Index(i)] += step;
      return likelihood(stand, unknowns, moved, data, noise, Wanted::cost).cost;
    };
    const double difference = (cost_at(h) - cost_at(-h)) / (2 * h);
    EXPECT_TRUE(near(result.slope[Eigen::Index(i)], difference,
                     within_absolute(2e-6 * (std::abs(difference) + 1e-3 * result.cost),
                                     "difference quotient: its own error and rounding of the cost")))
        << unknowns[i].name;
  }
}
}  // namespace

TEST(Likelihood, SlopesOfSpringsAndRatios)
{
  std::vector<Unknown> unknowns = calibration::unknowns_r();
  unknowns.push_back({"zeta2", 0.7});
  unknowns.push_back({"gain", 0.02});
  unknowns.push_back({"delay", 1e-4});
  expect_slopes(unknowns, 2e-5);
}

TEST(Likelihood, SlopesOfMassesAndOfGroups)
{
  expect_slopes({{"M2", 0.1}, {"M3", 0.05}, {"M4/M5", 0.1}, {"K1/K7", 0.1}, {"K3", 0.05}, {"zeta2", 0.7}});
}

TEST(Likelihood, SlopesOfTheFrequenciesOfModes)
{
  expect_slopes({{"f3", 0.1}, {"f6", 0.1}, {"zeta3", 0.7}});
}

// The information is that of the response slopes of chapter 43, what the transients could explain taken off.
TEST(Likelihood, InformationIsThatOfTheResponseSlopes)
{
  MeasuredResponse data         = calibration::measured(recipe("two"));
  const FittedStand stand       = calibration::stand_r();
  const auto unknowns           = calibration::unknowns_r();
  const dynamics::SlopedStand s = dynamics::sloped_stand(stand.chain, stand.damping);
  const Eigen::MatrixXd seen    = s.shape.middleRows(2, 2);
  const Eigen::Index k          = data.pieces[0].angular.size();
  Eigen::MatrixXd J(4 * k, 7), B(4 * k, 12);  // real parts, then imaginary parts
  for (Eigen::Index b = 0; b < k; ++b) {
    const double w = data.pieces[0].angular[b];
    const auto h   = dynamics::response_slopes(s, seen, w);
    Eigen::MatrixXcd slopes(2, 7), ringing(2, 12);
    slopes << h.parameters.leftCols(6), h.dampings.rowwise().sum();
    slopes *= data.pieces[0].force[b];
    // a record that this stand explains, so that nothing is left for transients to take
    data.pieces[0].acceleration.row(b) = (h.value * data.pieces[0].force[b]).transpose();
    for (Eigen::Index i = 0; i < 6; ++i) {
      const std::complex<double> d(s.frequency[i] * s.frequency[i] - w * w, 2 * 0.01 * s.frequency[i] * w);
      ringing.col(2 * i)     = seen.col(i) / d * s.frequency[i];
      ringing.col(2 * i + 1) = std::complex<double>(0, w) * seen.col(i) / d;
    }
    J.middleRows(2 * b, 2)       = slopes.real();
    J.middleRows(2 * (b + k), 2) = slopes.imag();
    B.middleRows(2 * b, 2)       = ringing.real();
    B.middleRows(2 * (b + k), 2) = ringing.imag();
  }
  const NoiseDensity noise = {Eigen::MatrixXd::Constant(k, 2, 2.5e-5)};
  const Likelihood result  = likelihood(stand, unknowns, Eigen::VectorXd::Zero(7), data, noise, Wanted::slopes);
  EXPECT_LT(result.residual, 1e-9);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(B);
  const Eigen::MatrixXd left = (qr.householderQ().adjoint() * J).bottomRows(4 * k - 12);
  const Eigen::MatrixXd A    = 2 * left.transpose() * left / 2.5e-5;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j)
      EXPECT_TRUE(near(
          result.information(i, j), A(i, j),
          within_absolute(1e-7 * std::sqrt(A(i, i) * A(j, j)), "sums in another order, relative to the diagonal")))
          << i << " " << j;
}

// A piece cut out of the middle rings on from before it; without the transients its bins would be wrong by far
// more than the noise.
TEST(Likelihood, ExplainsAPieceThatStillRingsFromBefore)
{
  calibration::Recipe r = recipe("two");
  r.n                   = 60000;
  r.density             = 1e-3;
  const auto made       = calibration::record(r);
  const auto middle     = [&](const auto &x) { return x.middleRows(30000, 24001).eval(); };
  Fourier fourier;
  const MeasuredResponse data = {
      {band_record(middle(made.force), middle(made.acceleration), r.rate, 20, 900, fourier)}, r.places};
  const auto unknowns = calibration::unknowns_r();
  Eigen::VectorXd truth(7);
  for (std::size_t i = 0; i < 7; ++i)
    truth[Eigen::Index(i)] = r.truth.at(unknowns[i].name);
  const auto &band         = data.pieces[0];
  const NoiseDensity noise = {Eigen::MatrixXd::Constant(band.angular.size(), 2, 1e-6)};
  const auto left          = residuals(calibration::stand_r(), unknowns, truth, data, noise);
  const double all         = 1e-6 * double(left[0].size());
  EXPECT_TRUE(
      near(left[0].squaredNorm() / all, 1, within_absolute(0.06, "1056 bins of two sensors: deviation 0.022")));
  const StandAt moved = stand_at(calibration::stand_r(), unknowns, truth);
  dynamics::SlopedStand s;
  s.frequency = moved.frequency, s.damping = moved.damping, s.force = moved.force;
  double without = 0;
  for (Eigen::Index b = 0; b < band.angular.size(); ++b) {
    const auto h = dynamics::response_slopes(s, moved.shape.middleRows(2, 2), band.angular[b]);
    without += (band.acceleration.row(b).transpose() - h.value * band.force[b]).squaredNorm();
  }
  EXPECT_GT(without / all, 10);
}

TEST(Likelihood, EstimatesOfARecordWhoseTruthIsKnown)
{
  const auto r        = recipe("two");
  const auto unknowns = calibration::unknowns_r();
  const auto data     = calibration::measured(r);
  const auto known    = reference("calibrate.two.result", "twin");
  Eigen::VectorXd near_truth(7);
  near_truth << 0.05, -0.05, -0.06, 0.04, 0.08, -0.03, 0.3;
  const Fit fit = fitted(calibration::stand_r(), unknowns, near_truth, data);
  EXPECT_TRUE(fit.converged);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto j    = Eigen::Index(i);
    const double sd = fit.sd()[j], ref_sd = known["estimates"][i]["sd"];
    EXPECT_LT(std::abs(fit.estimate[j] - r.truth.at(unknowns[i].name)), 3.5 * sd) << unknowns[i].name;
    EXPECT_LT(std::abs(sd - ref_sd), 0.25 * ref_sd) << unknowns[i].name;
    EXPECT_LT(std::abs(fit.estimate[j] - known["estimates"][i]["estimate"].get<double>()), 1.5 * ref_sd);
  }
  const auto check = calibration::measured(r.check());
  const double before =
      misfit_on(calibration::stand_r(), unknowns, Eigen::VectorXd::Zero(7), check, data, fit.noise);
  EXPECT_TRUE(near(before, known["heldout"]["before"]["misfit"], within(0.03, "noise of the residuals")));
  EXPECT_TRUE(near(misfit_on(calibration::stand_r(), unknowns, fit.estimate, check, data, fit.noise), 1,
                   within_absolute(0.03, "noise of the residuals, as the misfit before")));
}

TEST(Likelihood, RefusesUnknownsThatTheChainDoesNotHave)
{
  const MeasuredResponse none;
  try {
    likelihood(calibration::stand_r(), {{"K4", 0.1}}, Eigen::VectorXd::Zero(1), none, {}, Wanted::cost);
    FAIL();
  } catch (const InputError &e) {
    EXPECT_STREQ(e.what(), "error: \"K4\": this stand has no spring, mass or damping ratio of this name");
  }
}
