// Accelerations without a recorded force: slopes and curvature of their likelihood, what they tell beside what
// a plan made before, and the verdict on a stand.
#include "dynamics/response/response_slopes.h"
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "twin/calibration/fit.h"
#include "twin/calibration/output_only_adequacy.h"
#include "twin/calibration/plan.h"
#include "twin/calibration/second_minima.h"
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
  OutputOnly record{calibration::stand_r(),
                    unknowns,
                    {{band_record({}, made.acceleration, r.rate, 20, 900, fourier)}, r.places},
                    force_spectrum(20, 900)};
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
  const Likelihood result     = output_only_likelihood(record, theta, noise, Wanted::slopes);
  EXPECT_EQ(output_only_likelihood(record, theta, noise, Wanted::slopes, 2).cost, result.cost);
  for (Eigen::Index i = 0; i < theta.size(); i += i < 8 ? 1 : 5) {
    const auto cost_at = [&](const double step) {
      Eigen::VectorXd moved = theta;
      moved[i] += step;
      return output_only_likelihood(record, moved, noise, Wanted::cost).cost;
    };
    const double difference = (cost_at(1e-5) - cost_at(-1e-5)) / 2e-5;
    EXPECT_TRUE(near(result.slope[i], difference,
                     within_absolute(2e-6 * (std::abs(difference) + 1e-3 * result.cost),
                                     "difference quotient: its own error and rounding of the cost")))
        << i;
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
  const Likelihood result       = output_only_likelihood(record, theta, noise, Wanted::information);
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
  EXPECT_TRUE(near(result.cost, cost, within(1e-9, "same sum")));
  EXPECT_EQ(result.residual, 0);
  for (int a = 0; a < 7; ++a)
    for (int c = 0; c < 7; ++c)
      EXPECT_TRUE(near(
          result.information(a, c), A(a, c),
          within_absolute(1e-7 * std::sqrt(A(a, a) * A(c, c)), "sums in another order, relative to the diagonal")))
          << a << " " << c;
}

// What the plan foretells is what estimates of many records scatter by.  MILLSTAND_STANDS=60 runs more of them.
TEST(OutputOnly, EstimatesScatterByThePlannedDeviation)
{
  const char *asked                   = std::getenv("MILLSTAND_STANDS");
  const int records                   = asked ? std::atoi(asked) : 12;
  const std::vector<Unknown> unknowns = {{"K3", 0.05}, {"K7", 0.1}, {"zeta", 0.7}};
  PlannedRecord plan;
  plan.places                         = {2, 3};
  plan.duration                       = 4;
  plan.force_density                  = std::sqrt(planned_density);
  plan.force_highest                  = 1500;
  plan.force_recorded                 = false;
  const Identification identification = planned(calibration::stand_r(), unknowns, plan);
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
    const Eigen::ArrayXd z =
        fit.estimate.head(3).array() / identification.covariance.diagonal().head(3).array().sqrt();
    sum += z;
    square += z.square();
    for (int q = 0; q < 3; ++q)  // the fit's own deviation
      EXPECT_TRUE(near(fit.sd()[q], std::sqrt(identification.covariance(q, q)),
                       within(0.3, "another force in each record, its density free at the knots")));
  }
  for (int q = 0; q < 3; ++q) {
    const double scatter = std::sqrt(square[q] / records);
    // four deviations of a root mean square of so many normal numbers
    EXPECT_TRUE(near(scatter, 1,
                     within_absolute(4 / std::sqrt(2.0 * records),
                                     "four deviations of a root mean square of so many normal numbers")))
        << identification.names[std::size_t(q)];
    EXPECT_LT(std::abs(sum[q] / records), 4 / std::sqrt(double(records))) << identification.names[std::size_t(q)];
    if (asked)
      std::printf("%s: scatter %.3f, mean %.3f of the planned deviation\n",
                  identification.names[std::size_t(q)].c_str(), scatter, sum[q] / records);
  }
}

// At the truth nothing is wrong; with another damping the level at the resonances is, with another spring the
// ratios.
TEST(OutputOnly, WrongDampingFailsInTheLevelsAndAWrongSpringInTheRatios)
{
  calibration::Recipe r       = recipe("two");
  const auto unknowns         = calibration::unknowns_r();
  const OutputOnly record     = forgotten_force(unknowns, r);
  const ForcedSamples samples = {{}, calibration::record(r).acceleration};
  const auto at               = [&](const std::string &name, const double more) {
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(Eigen::Index(record.all_unknowns().size()));
    for (std::size_t i = 0; i < 7; ++i)
      theta[Eigen::Index(i)] = r.truth.at(unknowns[i].name) + (unknowns[i].name == name ? more : 0);
    return theta;
  };
  const NoiseDensity noise = renewed_noise(record, at("", 0), equal_noise(record, at("", 0)));
  const auto wrong         = [&](const Eigen::VectorXd &theta, const double model_error) {
    const auto seen = seen_force(record, theta, noise);
    int levels = 0, directions = 0;
    for (const LevelBand &band : level_bands(record, seen, 20, 900, model_error))
      levels += band.wrong();
    for (const BandResidual &band :
         direction_residuals(record, seen, noise, {samples}, r.rate, 20, 900, model_error))
      directions += band.wrong();
    return std::pair{levels, directions};
  };
  EXPECT_EQ(wrong(at("", 0), 0), (std::pair{0, 0}));
  EXPECT_GT(wrong(at("zeta", 0.4), 0).first, 1) << "of the bands with 1 % of the energy";
  EXPECT_GT(wrong(at("zeta", 0.4), usual_model_error).first, 1)
      << "a damping that is off by half is no model error";
  EXPECT_GT(wrong(at("K3", 0.02), 0).second, 0);
  EXPECT_TRUE(near(output_only_misfit(record, at("", 0), noise, 20, 900), 1,
                   within_absolute(0.03, "17601 complex numbers: deviation 0.008")));
  EXPECT_GT(output_only_misfit(record, at("K3", 0.02), noise, 20, 900), 1.1);  // a dozen deviations
}

namespace {
/// One spring of prior sd 0.1 in two wells 0.02 wide: that at -0.35 is lower by so much of the cost.
FitProblem two_wells(const double lower)
{
  FitProblem problem;
  problem.unknowns   = {{"K1", 0.1}};
  problem.is_spring  = [](const std::string &) { return true; };
  problem.values     = 1;
  problem.before     = {};
  problem.renewed    = [](const Eigen::VectorXd &, const NoiseDensity &noise) { return noise; };
  problem.likelihood = [=](const Eigen::VectorXd &theta, const NoiseDensity &, Wanted, int) {
    const double x = theta[0], w = 0.02, far = lower - 0.5 * std::pow((x + 0.35) / w, 2),
                 near_by = -0.5 * std::pow((x - 0.05) / w, 2), most = std::max(far, near_by),
                 p = std::exp(far - most), q = std::exp(near_by - most);
    Likelihood result;
    result.cost        = -most - std::log(p + q);
    result.slope       = Eigen::VectorXd::Constant(1, (p * (x + 0.35) + q * (x - 0.05)) / ((p + q) * w * w));
    result.information = Eigen::MatrixXd::Constant(1, 1, 1 / (w * w));
    add_prior(result, {{"K1", 0.1}}, theta);
    return result;
  };
  return problem;
}

ScannedFit scanned_wells(const FitProblem &problem)
{
  const FitSettings settings{3, 60, 1e-6, 1};
  ScannedFit scan = scanned(problem, fitted(problem, Eigen::VectorXd::Constant(1, -0.35), settings), settings);
  prefer_a_correction(problem, 1, settings, scan);
  return scan;
}
}  // namespace

// The prior of 3.4 deviations costs 5.6, that of 0.48 deviations 0.1: wells 7.5 apart differ by a deviance of 4.
TEST(OutputOnly, PrefersTheMinimumNearThePriorsWhenTwoExplainTheRecordAlike)
{
  const ScannedFit scan = scanned_wells(two_wells(7.5));
  EXPECT_TRUE(
      near(scan.best.estimate[0], 0.05 / 1.04,
           within_absolute(1e-3, "curvature of the well and of the prior; the other well adds less than 1e-3")));
  ASSERT_FALSE(scan.basins.empty());
  EXPECT_TRUE(
      near(scan.basins[0].theta, -0.35 / 1.04,
           within_absolute(1e-3, "curvature of the well and of the prior; the other well adds less than 1e-3")));
  const double deviance = 2 * (0.5 * 0.35 * 0.35 / (0.01 + 0.0004) - 7.5 - 0.5 * 0.05 * 0.05 / (0.01 + 0.0004));
  EXPECT_TRUE(near(scan.basins[0].deviance, deviance,
                   within_absolute(1e-3, "closed form of two parabolas; the fit ends at 1e-6")));
  const auto judged = judged_with_minima(scan);
  EXPECT_FALSE(judged[0].identified);
  EXPECT_EQ(judged[0].why_not, "not identified by these data: a second minimum at -28.6 %, deviance -3.5");
}

TEST(OutputOnly, KeepsAMinimumBeyondThePriorsWhenItIsMuchLower)
{
  const ScannedFit scan = scanned_wells(two_wells(12));
  EXPECT_TRUE(
      near(scan.best.estimate[0], -0.35 / 1.04,
           within_absolute(1e-3, "curvature of the well and of the prior; the other well adds less than 1e-3")));
}

// The ends of the interval of a scanned spring say more of another one than the curvature at its best place.
TEST(OutputOnly, IntervalCoversTheEndsOfOtherProfiles)
{
  ScannedFit scan;
  scan.best.unknowns   = {{"K1", 0.1}, {"K2", 0.1}};
  scan.best.estimate   = Eigen::Vector2d(0.01, -0.01);
  scan.best.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
  scan.interval.resize(2, 2);
  scan.interval << -0.01, 0.03, -0.03, 0.01;
  scan.ends         = {Eigen::Vector2d(-0.01, 0.06)};
  scan.basins       = {{"K1", 0.02, 0.5, Eigen::Vector2d(0.02, -0.15)}};
  const auto judged = judged_with_minima(scan);
  EXPECT_TRUE(judged[0].identified);  // the second minimum lies inside its interval
  EXPECT_EQ(judged[1].low, -0.15);
  EXPECT_EQ(judged[1].high, 0.06);
  EXPECT_TRUE(near(judged[1].sd, 0.21 / 3.92, within_absolute(1e-12, "closed form, rounding")));
  EXPECT_FALSE(judged[1].identified);
  EXPECT_EQ(judged[1].why_not, "not identified by these data: 54 % of the prior's deviation is left");
}

// A weak resonance that noise feigns is sharp at its top and hardly higher than its surroundings.
TEST(OutputOnly, AFlatProfileIsNotIdentified)
{
  ScannedFit scan;
  scan.best.unknowns   = {{"K3", 0.1}};
  scan.best.estimate   = Eigen::VectorXd::Zero(1);
  scan.best.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-6);
  scan.interval        = Eigen::RowVector2d(-0.002, 0.002);
  Profile profile{"K3", Eigen::VectorXd::LinSpaced(17, -0.25, 0.25), Eigen::VectorXd::Constant(17, 6)};
  profile.deviance[8] = 0;
  scan.profiles       = {profile};
  const auto low      = judged_with_minima(scan);
  EXPECT_FALSE(low[0].identified);
  EXPECT_TRUE(near(low[0].sd, 0.5 / 6, within_absolute(1e-12, "closed form, rounding")));
  EXPECT_EQ(low[0].why_not, "not identified by these data: 83 % of the prior's deviation is left");
  scan.profiles[0].deviance *= 2;
  scan.profiles[0].deviance[8] = 0;
  const auto high              = judged_with_minima(scan);
  EXPECT_TRUE(high[0].identified);
  EXPECT_TRUE(near(high[0].sd, 2 * 0.75 * 0.03125 / 6,
                   within_absolute(1e-12, "closed form, rounding; 9 of 12 on the way to both neighbours")));
}
