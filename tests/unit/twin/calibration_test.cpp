// What a record tells, what it would tell, and when the model is refused: TW-15, TW-16, TW-18 to TW-20 in the part
// that does not scan, and the scan itself against a minimisation by hand.  The whole verb on the entries and on
// random stands: calibration_campaign_test.
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "twin/calibration/calibration.h"
#include "twin/calibration/verdict.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>

using namespace mill;
using namespace mill::twin;
using calibration::recipe;

namespace {
std::vector<Eigen::Index> places_of(const std::string &sensors)
{
  if (sensors == "two")
    return {2, 3};
  if (sensors == "four")
    return {1, 2, 3, 4};
  return {0, 1, 2, 3, 4, 5};
}

PlannedRecord planned_record(const Reference &entry)
{
  PlannedRecord record;
  record.places         = places_of(entry["sensors"]);
  record.force_density  = 1000 / std::sqrt(1500.0);
  record.force_highest  = entry["force_band"];
  record.force_recorded = entry["force_recorded"];
  return record;
}

/// Start and fit of an entry, without the scan.
Fit fit_of(const calibration::Recipe &r, const calibration::Record &made)
{
  Fourier fourier;
  const MeasuredResponse data = {{band_record(made.force, made.acceleration, r.rate, 20, 900, fourier)}, r.places};
  const auto start            = coarse_start(calibration::stand_r(), calibration::unknowns_r(),
                                             {{made.force, made.acceleration}}, r.places, r.rate, 20, 900);
  return fitted(calibration::stand_r(), calibration::unknowns_r(), start, data);
}

void expect_shrink_of(const Fit &fit, const std::string &entry)
{
  const auto known = reference("calibrate." + entry + ".result", "twin")["estimates"];
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const double shrink = fit.shrink()[Eigen::Index(i)], ref = known[i]["shrink"];
    ASSERT_EQ(known[i]["name"].get<std::string>(), fit.unknowns[i].name);
    EXPECT_EQ(shrink <= 0.5, ref <= 0.5) << fit.unknowns[i].name;
    EXPECT_LT(std::abs(shrink - ref), 0.25 * ref) << fit.unknowns[i].name;
    const double error = fit.estimate[Eigen::Index(i)] - known[i]["truth"].get<double>();
    EXPECT_LT(std::abs(error), 3.5 * fit.sd()[Eigen::Index(i)]) << fit.unknowns[i].name;
  }
}

/// A short record of which only a few unknowns are fitted, all others at the truth.
struct Small {
  CalibrationInput input;
  explicit Small(const std::vector<Unknown> &unknowns, const Eigen::Index late = 0)
  {
    calibration::Recipe r      = recipe("two");
    r.n                        = 60000;
    const LumpedModel case_set = calibration::set_r();
    LumpedModel stand          = case_set;
    double zeta                = 0.01;
    for (const auto &[name, value] : r.truth) {
      const auto free = std::any_of(unknowns.begin(), unknowns.end(),
                                    [&, key = name](const Unknown &u) { return u.name == key; });
      if (!free)
        (name == "zeta" ? zeta : stand.K[std::size_t(name[1] - '1')].value) *= std::exp(value);
    }
    input.stand     = {calibration::chain_of(stand), Eigen::VectorXd::Constant(6, zeta)};
    input.unknowns  = unknowns;
    input.sensors   = {"upper_work_roll", "lower_work_roll"};
    input.places    = r.places;
    input.rate      = r.rate;
    const auto made = calibration::record(r);
    const auto part = [&](const Eigen::Index from, const Eigen::Index n) {
      return ForcedSamples{made.force.segment(from + late, n), made.acceleration.middleRows(from, n)};
    };
    input.fit   = {part(0, 40000)};
    input.check = {part(40000, 20000 - late)};
  }
};
}  // namespace

TEST(Plan, InformationOfTheReference)
{
  for (const auto &entry : reference("plan.information", "twin")) {
    // the others differ in nothing but the number of places
    if (entry["sensors"].get<std::string>() == "four" ||
        (entry["sensors"].get<std::string>() == "six" &&
         (entry["force_band"].get<double>() < 1000 || !entry["force_recorded"].get<bool>())))
      continue;
    const Identification identification =
        planned(calibration::stand_r(), calibration::unknowns_r(), planned_record(entry));
    EXPECT_EQ(identification.effective(), entry["effective"].get<int>());
    for (std::size_t i = 0; i < identification.names.size(); ++i)
      EXPECT_TRUE(near(identification.shrink[Eigen::Index(i)], entry["shrink"][identification.names[i]],
                       within(1e-3, "same integral; where the force ends a bin more or less")))
          << entry["sensors"] << entry["force_band"] << identification.names[i];
  }
}

TEST(Plan, NamesTheSensorThatSeparatesTwoSprings)
{
  PlannedRecord record;
  record.places            = {2, 3};
  record.force_density     = 1000 / std::sqrt(1500.0);
  record.force_highest     = 1500;
  const Identification now = planned(calibration::stand_r(), calibration::unknowns_r(), record);
  EXPECT_EQ(weakest_direction(now, calibration::stand_r()), "0.47 ln K1 - 0.88 ln K2");
  EXPECT_TRUE(unseen_directions(now, calibration::stand_r()).empty());
  const auto next = next_sensors(calibration::stand_r(), calibration::unknowns_r(), record);
  ASSERT_EQ(next.size(), 4u);
  EXPECT_EQ(next[0].place, 0);  // the upper frame, which moves on K1 alone
  EXPECT_LT(next[0].identification.shrink[1], 0.2 * now.shrink[1]);
  record.force_highest     = 300;
  const Identification low = planned(calibration::stand_r(), calibration::unknowns_r(), record);
  const auto unseen        = unseen_directions(low, calibration::stand_r());
  ASSERT_EQ(unseen.size(), 3u);
  EXPECT_EQ(unseen[0], "0.98 ln K6 - 0.20 ln K7: these records depend on the two springs in series alone");
}

TEST(Levels, TwoLevelsDetermineOneNumber)
{
  const auto known  = reference("levels", "twin");
  const auto slopes = white_force_levels(calibration::stand_r(), {2, 3}, 1000, 1000, {"K3", "K5"});
  for (Eigen::Index j = 0; j < 2; ++j) {
    EXPECT_TRUE(near(slopes.rms[j], known["rms"][std::size_t(j)], within(1e-3, "integral over frequency")));
    for (Eigen::Index q = 0; q < 4; ++q)
      EXPECT_TRUE(near(slopes.slope(j, q), known["jacobian"][std::size_t(j)][std::size_t(q)].get<double>(),
                       within_absolute(1e-3, "TW-16: grid of 0.02 Hz against the integral")));
  }
  const Eigen::MatrixXd A  = slopes.slope.transpose() * slopes.slope / (0.03 * 0.03);
  const Identification all = identification(A, {{"zeta", 0.7}, {"bandwidth", 0.7}, {"K3", 0.05}, {"K5", 0.05}});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(
        near(all.singular[Eigen::Index(i)], known["singular"][i], within(1e-3, "integral over frequency")));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(near(all.shrink[Eigen::Index(i)], known["shrink"][all.names[i]], within(1e-3, "same")));
    EXPECT_GT(all.shrink[Eigen::Index(i)], 0.5) << all.names[i];  // no one of the four is identified
  }
}

TEST(Calibration, NoiseHidesOneSpring)
{
  const auto r = recipe("noisy");
  expect_shrink_of(fit_of(r, calibration::record(r)), "noisy");
}

TEST(Calibration, AForceThatEndsBelowTheUpperModesHidesThree)
{
  const auto r = recipe("low");
  expect_shrink_of(fit_of(r, calibration::record(r)), "low");
}

TEST(Calibration, DoesNotExplainAStandWithAnotherFrame)
{
  const auto r     = recipe("closed");
  const auto known = reference("calibrate.closed.result", "twin");
  const auto made  = calibration::record(r);
  const auto shown = reference("calibrate.closed.record", "twin");
  for (Eigen::Index j = 0; j < made.acceleration.cols(); ++j) {  // TW-01 of this entry
    const Eigen::VectorXd x = made.acceleration.col(j);
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(near(x[i], shown["first"][std::size_t(j)][std::size_t(i)], within(1e-9, "response", 1)));
    EXPECT_TRUE(near(std::sqrt((x.array() - x.mean()).square().mean()), shown["rms"][std::size_t(j)],
                     within(1e-9, "response")));
  }
  const Fit fit = fit_of(r, made);
  double worst  = 0;
  Fourier fourier;
  const MeasuredResponse data = {{band_record(made.force, made.acceleration, r.rate, 20, 900, fourier)}, r.places};
  const auto left = residuals(calibration::stand_r(), calibration::unknowns_r(), fit.estimate, data, fit.noise);
  for (const BandResidual &band :
       band_residuals(data, left, {{made.force, made.acceleration}}, r.rate, 20, 900, 0))
    if (band.floor < 0.9)  // the reference has neither a model error nor a least energy
      worst = std::max(worst, band.ratio / band.limit);
  EXPECT_TRUE(near(worst, known["own_excess"], within(0.02, "the estimate in its valley")));
  EXPECT_GT(worst, 1.05);
  EXPECT_LT(fit.estimate[0] / 0.1, -3);  // K1 leaves its prior
}

// Both steps of the scan against the best of a fine grid of the one unknown that is left.
TEST(Calibration, AProfileIsTheMinimumOverAllOthers)
{
  const std::vector<Unknown> unknowns = {{"K1", 0.1}, {"K2", 0.1}};
  const Small small(unknowns);
  Fourier fourier;
  const MeasuredResponse data = {
      {band_record(small.input.fit[0].force, small.input.fit[0].acceleration, small.input.rate, 20, 120, fourier)},
      small.input.places};
  const Fit first      = fitted(small.input.stand, unknowns, Eigen::Vector2d(0.05, -0.05), data);
  const ScannedFit all = scanned(small.input.stand, first, data, {3, 60, 1e-4, 2});
  ASSERT_EQ(all.profiles.size(), 2u);
  const Profile &K1 = all.profiles[0];
  EXPECT_GE(K1.deviance.minCoeff(), 0);
  const auto cost = [&](const double a, const double b) {
    return likelihood(small.input.stand, unknowns, Eigen::Vector2d(a, b), data, all.best.noise, Wanted::cost).cost;
  };
  const auto lowest_over_K2 = [&](const double a) {
    double lowest = cost(a, -0.4);
    for (double b = -0.4; b <= 0.4; b += 0.01)
      lowest = std::min(lowest, cost(a, b));
    return 2 * (lowest - all.best.cost);
  };
  for (const Eigen::Index i : {2, 6, 8, 12}) {
    const double brute = lowest_over_K2(K1.theta[i]);
    EXPECT_LT(K1.deviance[i], brute + 0.02) << K1.theta[i];
    EXPECT_GT(K1.deviance[i], brute - 0.05 * (1 + brute)) << K1.theta[i];  // between two points of the grid
  }
  // The ends of the interval lie where the deviance is 3.84.
  for (const Eigen::Index side : {0, 1})
    EXPECT_TRUE(near(lowest_over_K2(all.interval(0, side)), 3.84,
                     within_absolute(0.15, "grid of 0.01 over the other spring and 13 points of the profile")));
}

TEST(Calibration, AlignsTwoClocksWhenTheDelayIsAnUnknown)
{
  Small late({{"zeta", 0.7}, {"delay", 0.05}}, 0);
  for (auto *pieces : {&late.input.fit, &late.input.check})
    for (ForcedSamples &piece : *pieces) {  // accelerations 40 samples late: 2 ms
      const Eigen::Index n = piece.force.size() - 40;
      piece.force          = piece.force.tail(n).eval();
      piece.acceleration   = piece.acceleration.topRows(n).eval();
    }
  late.input.clipped     = {"pass.csv: load_cell"};
  const Calibration done = calibrate(late.input, {});
  EXPECT_TRUE(near(done.unknowns[1].estimate, 0.002,
                   within_absolute(4 * done.unknowns[1].sd, "four deviations of the fit")));
  EXPECT_LT(done.unknowns[1].sd, 1e-6);
  EXPECT_TRUE(near(done.unknowns[0].estimate, 0.3365,
                   within_absolute(4 * done.unknowns[0].sd, "four deviations of the fit")));
  EXPECT_TRUE(near(done.check.after, 1,
                   within_absolute(0.08, "1760 complex numbers of a check of one second: three deviations")));
  // nothing else is wrong
  ASSERT_EQ(done.refusals.size(), 1u);
  EXPECT_EQ(done.refusals[0], "pass.csv: load_cell is clipped");
}

namespace {
/// Accelerations some samples late, which the caller did not ask to be aligned.
Calibration with_late_clock(const Eigen::Index samples)
{
  Small late({{"zeta", 0.7}});
  for (auto *pieces : {&late.input.fit, &late.input.check})
    for (ForcedSamples &piece : *pieces) {
      const Eigen::Index n = piece.force.size() - samples;
      piece.force          = piece.force.tail(n).eval();
      piece.acceleration   = piece.acceleration.topRows(n).eval();
    }
  return calibrate(late.input, {});
}
}  // namespace

TEST(Calibration, ReportsADelayThatIsNotAnUnknown)
{
  const Calibration right = with_late_clock(0);
  ASSERT_TRUE(right.delay);
  EXPECT_LT(std::abs(right.delay->seconds), 4 * right.delay->deviation);
  EXPECT_FALSE(right.delay->significant());
  EXPECT_TRUE(right.refusals.empty());
  const Calibration one = with_late_clock(1);  // 0.050 ms of the 0.056 ms that are allowed up to 900 Hz
  EXPECT_TRUE(
      near(one.delay->seconds, 5e-5, within_absolute(4 * one.delay->deviation, "four deviations of the delay")));
  EXPECT_LT(one.delay->deviation, 5e-7) << "a hundredth of a sample";
  EXPECT_TRUE(one.delay->significant());
  EXPECT_FALSE(one.delay->too_large());
  const Calibration far = with_late_clock(40);
  EXPECT_TRUE(
      near(far.delay->seconds, 0.002, within_absolute(4 * far.delay->deviation, "four deviations of the delay")));
  EXPECT_TRUE(far.delay->too_large());
  EXPECT_EQ(std::count(far.refusals.begin(), far.refusals.end(), far.delay->words(20000)), 1);
}

// Pieces shorter than the shortest segment give no H1; the delay is then fitted from zero.
TEST(Calibration, ADelayIsFittedWithoutAnH1)
{
  calibration::Recipe r       = recipe("two");
  r.n                         = 20000;
  const MeasuredResponse data = calibration::measured(r);
  const FittedStand stand     = calibration::stand_r();
  const auto unknowns         = calibration::unknowns_r();
  const Fit fit          = fitted(stand, unknowns, Eigen::VectorXd::Zero(Eigen::Index(unknowns.size())), data);
  const ClockDelay delay = clock_delay(stand, fit, data, {}, r.rate, 20, 900, {});
  EXPECT_GT(delay.deviation, 0);
  EXPECT_TRUE(
      near(delay.seconds, 0,
           within_absolute(4 * delay.deviation, "the record has no delay; four deviations of its estimate")));
}

TEST(Calibration, PrintsADelayInSamplesWithItsRemedy)
{
  const ClockDelay delay{-1.5e-4, 2.5e-6, 1 / (20 * 900.)};
  EXPECT_TRUE(delay.too_large());
  EXPECT_EQ(delay.words(20000),
            "the accelerations are 3 samples (0.15 ms) earlier than the force, uncertain by 0.05 samples: two "
            "clocks, or a filter in one of the amplifiers; up to 0.0556 ms are allowed, --align fits the delay as "
            "one more unknown");
  EXPECT_FALSE((ClockDelay{2e-6, 1e-7, 1 / (20 * 900.)}).significant()) << "below a tenth of what is allowed";
  EXPECT_FALSE((ClockDelay{2e-5, 1e-5, 1 / (20 * 900.)}).significant()) << "within three deviations";
}

TEST(Calibration, AgreesWithACaseThatIsRight)
{
  Small small({{"zeta", 0.7}});
  small.input.stand.damping *= std::exp(calibration::recipe("two").truth.at("zeta"));
  const Calibration done = calibrate(small.input, {});
  EXPECT_TRUE(done.agrees);
  EXPECT_TRUE(done.refusals.empty());
  EXPECT_LT(done.case_deviance, 10.9);  // chi-square of one, 99.9 %
  Calibration result;
  result.unknowns      = {Calibrated{}, Calibrated{}};
  result.case_deviance = 1.25;
  result.check         = {2, 1, {}, 0, {}};
  // 5.991: table of chi-square of two, 5 %
  EXPECT_EQ(agreement_words(result), "the case agrees with these records already: freeing 2 unknowns lowers the "
                                     "deviance by 1.2, chance alone lowers it by up to 6.0; no calibrated case is "
                                     "written");
}

TEST(Calibration, ShowsNumbersWithTheDigitsOfTheirIntervals)
{
  Calibrated u{"K3", 0.05, -0.07, 1.3e-5, -0.070026, -0.069974, 2.7e-4, true, -0.07, "", 0};
  const ShownChange shown = shown_change(u, true);
  EXPECT_EQ(shown.value, "-6.7606 %");
  EXPECT_EQ(shown.low, "-6.7630 %");
  EXPECT_EQ(shown.high, "-6.7582 %");
}

// The value of a case with other priors kept, between the ends of two fits: its error is that of the ends.
TEST(Calibration, TheErrorOfAFactorIsThatOfItsInterval)
{
  Calibrated u{"K3", 0.05, 0, 0.01, -0.0196, 0.0196, 0.2, true, 0.03, "", 0.005};
  const ChangeInterval written = change_interval(u, true);
  EXPECT_EQ(written.value, 0.03);
  EXPECT_EQ(written.low, -0.0196) << "the fit with all freed reaches lower";
  EXPECT_DOUBLE_EQ(written.high, 0.03 + 1.96 * 0.005);
  EXPECT_DOUBLE_EQ(deviation_of(written), (0.03 + 0.0196) / 1.96);
  EXPECT_DOUBLE_EQ(deviation_of(change_interval(u, false)), 0.01) << "of one fit it is the deviation of this fit";
}
