// Accelerations whose force nobody recorded: slopes and curvature of their likelihood, what they tell beside what
// a plan foretold, and the verdict on a stand.
#include "dynamics/response/response_slopes.h"
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "twin/calibration/fit.h"
#include "twin/calibration/output_only_adequacy.h"
#include "twin/calibration/plan.h"
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>

using namespace mill;
using namespace mill::twin;
using calibration::recipe;

namespace {
constexpr double planned_density = 1000.0 * 1000.0 / 1500.0;  // N^2/Hz, of the entries

/// A record of so many samples with two sensors and these unknowns; the force is forgotten.
OutputOnly forgotten_force(const std::vector<Unknown> &unknowns, calibration::Recipe r)
{
  const auto made = calibration::record(r);
  Fourier fourier;
  OutputOnly record{
      calibration::stand_r(),
      unknowns,
      {{band_record({}, made.acceleration, r.rate, 20, 900, fourier)}, r.places},
      force_spectrum(20, 900)
  };
  set_unit_force(record.data);
  record.force.level = planned_density;
  return record;
}

calibration::Recipe short_recipe(const Eigen::Index samples)
{
  calibration::Recipe r = recipe("two");
  r.n                   = samples;
  return r;
}

Eigen::VectorXd some(const std::size_t n)
{
  return Eigen::VectorXd::NullaryExpr(Eigen::Index(n),
                                      [](const Eigen::Index i) { return 0.03 * std::cos(2.0 * double(i)); });
}
}  // namespace

TEST(OutputOnly, SlopesAreThoseOfTheCost)
{
  std::vector<Unknown> unknowns = calibration::unknowns_r();
  unknowns.push_back({"zeta2", 0.7});
  const OutputOnly record     = forgotten_force(unknowns, short_recipe(20000));
  const Eigen::VectorXd theta = some(record.all_unknowns().size());
  const NoiseDensity noise    = equal_noise(record, theta);
  const Likelihood at         = output_only_likelihood(record, theta, noise, Wanted::slopes);
  EXPECT_EQ(output_only_likelihood(record, theta, noise, Wanted::slopes, 2).cost, at.cost);
  for (Eigen::Index i = 0; i < theta.size(); i += i < 8 ? 1 : 5) {
    const auto cost_at = [&](const double step) {
      Eigen::VectorXd moved = theta;
      moved[i] += step;
      return output_only_likelihood(record, moved, noise, Wanted::cost).cost;
    };
    const double difference = (cost_at(1e-5) - cost_at(-1e-5)) / 2e-5;
    EXPECT_NEAR(at.slope[i], difference, 2e-6 * (std::abs(difference) + 1e-3 * at.cost)) << i;
  }
}

// Determinants and traces of whole matrices S against the sums over the direction of h.
TEST(OutputOnly, CostAndInformationAreThoseOfGaussianAccelerations)
{
  const auto unknowns = calibration::unknowns_r();
  OutputOnly record   = forgotten_force(unknowns, short_recipe(20000));
  auto &band          = record.data.pieces[0];
  band.acceleration.setZero();  // nothing rings, and S^-1 weighs nothing
  const Eigen::Index k = band.angular.size();
  NoiseDensity noise   = {Eigen::MatrixXd(k, 2)};
  noise[0].col(0).setConstant(2.5e-5);
  noise[0].col(1).setConstant(4e-4);
  const Eigen::VectorXd theta   = Eigen::VectorXd::Zero(Eigen::Index(record.all_unknowns().size()));
  const Likelihood at           = output_only_likelihood(record, theta, noise, Wanted::information);
  const dynamics::SlopedStand s = dynamics::sloped_stand(record.stand.chain, record.stand.damping);
  Eigen::MatrixXd A             = Eigen::MatrixXd::Zero(7, 7);
  double cost                   = 0;
  for (Eigen::Index b = 0; b < k; ++b) {
    const auto h = dynamics::response_slopes(s, s.shape.middleRows(2, 2), band.angular[b]);
    Eigen::MatrixXcd slopes(2, 7);
    slopes << h.parameters.leftCols(6), h.dampings.rowwise().sum();
    const Eigen::MatrixXcd N = noise[0].row(b).cast<std::complex<double>>().asDiagonal(),
                           S = planned_density * h.value * h.value.adjoint() + N, inverse = S.inverse();
    cost += std::log((N.inverse() * S).determinant().real());
    std::vector<Eigen::MatrixXcd> changed;
    for (int a = 0; a < 7; ++a) {
      const Eigen::MatrixXcd half = planned_density * slopes.col(a) * h.value.adjoint();
      changed.push_back(inverse * (half + half.adjoint()));
    }
    for (int a = 0; a < 7; ++a)
      for (int c = 0; c < 7; ++c)
        A(a, c) += (changed[std::size_t(a)] * changed[std::size_t(c)]).trace().real();
  }
  EXPECT_TRUE(near(at.cost, cost, within(1e-9, "same sum")));
  EXPECT_EQ(at.residual, 0);
  for (int a = 0; a < 7; ++a)
    for (int c = 0; c < 7; ++c)
      EXPECT_NEAR(at.information(a, c), A(a, c), 1e-7 * std::sqrt(A(a, a) * A(c, c))) << a << " " << c;
}

// What the plan foretells is what estimates of many records scatter by.  MILLSTAND_STANDS=60 runs more of them.
TEST(OutputOnly, EstimatesScatterByWhatThePlanForetells)
{
  const char *asked                   = std::getenv("MILLSTAND_STANDS");
  const int records                   = asked ? std::atoi(asked) : 12;
  const std::vector<Unknown> unknowns = {
      {"K3",   0.05},
      {"K7",   0.1 },
      {"zeta", 0.7 }
  };
  PlannedRecord plan;
  plan.places         = {2, 3};
  plan.duration       = 4;
  plan.force_density  = std::sqrt(planned_density);
  plan.force_highest  = 1500;
  plan.force_recorded = false;
  const Told told     = planned(calibration::stand_r(), unknowns, plan);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(3), square = sum;
  for (int i = 0; i < records; ++i) {
    calibration::Recipe r   = short_recipe(80000);
    r.truth                 = {};
    r.seed                  = 7000 + 10 * std::uint64_t(i);
    const OutputOnly record = forgotten_force(unknowns, r);
    FitProblem problem;
    problem.unknowns   = record.all_unknowns();
    problem.likelihood = [&](const Eigen::VectorXd &theta, const NoiseDensity &noise, const Wanted wanted, int) {
      return output_only_likelihood(record, theta, noise, wanted);
    };
    problem.renewed = [&](const Eigen::VectorXd &theta, const NoiseDensity &noise) {
      return renewed_noise(record, theta, noise);
    };
    const Eigen::VectorXd truth = Eigen::VectorXd::Zero(Eigen::Index(problem.unknowns.size()));
    problem.before              = equal_noise(record, truth);
    problem.values              = number_of_values(record.data);
    const Fit fit               = fitted(problem, truth, {1, 20, 1e-3, 1});
    const Eigen::ArrayXd z      = fit.estimate.head(3).array() / told.covariance.diagonal().head(3).array().sqrt();
    sum += z;
    square += z.square();
    for (int q = 0; q < 3; ++q)  // the fit's own deviation
      EXPECT_TRUE(near(fit.sd()[q], std::sqrt(told.covariance(q, q)),
                       within(0.3, "another force in each record, its density free at the knots")));
  }
  for (int q = 0; q < 3; ++q) {
    const double scatter = std::sqrt(square[q] / records);
    // four deviations of a root mean square of so many normal numbers
    EXPECT_NEAR(scatter, 1, 4 / std::sqrt(2.0 * records)) << told.names[std::size_t(q)];
    EXPECT_LT(std::abs(sum[q] / records), 4 / std::sqrt(double(records))) << told.names[std::size_t(q)];
    if (asked)
      std::printf("%s: scatter %.3f, mean %.3f of the planned deviation\n", told.names[std::size_t(q)].c_str(),
                  scatter, sum[q] / records);
  }
}
