// Stands on the curves of their contacts against closed forms, quadratures, energy, and the linear model.
#include "dynamics/nonlinear/curve_response.h"
#include "dynamics/nonlinear/harmonic_balance.h"
#include "dynamics/nonlinear/mode_study.h"
#include "dynamics/response/rolling_force.h"
#include "tests/support/curve_stands.h"
#include "tests/support/near.h"
#include <cmath>
#include <complex>

using namespace mill;
using namespace mill::dynamics;

namespace {
constexpr double load = 1e6;

ForceRecord noise(const double half_range, const double duration)
{
  NoiseSettings settings;
  settings.range     = {load - half_range, load + half_range};
  settings.duration  = duration;
  settings.bandwidth = 500;
  settings.rate      = 5e3;
  return synthetic_force(settings);
}

double furthest(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
}  // namespace

// A mass on a spring that only pushes, thrown up by it again and again under a constant weight: quarter swings of
// a cosine and parabolas.
TEST(ContactCurves, FindSeparationAndTouchToANanosecond)
{
  const double k = 1e9, m = 1000, w = std::sqrt(k / m), rest = load / k, amplitude = 3 * rest;
  CurveStand stand;
  stand.laws    = {power_law(k, 1, 1e5, 4e6, 5)};
  stand.rate    = {w};
  stand.push    = {1 / std::sqrt(m)};
  stand.springs = {{"K3", 0, 1, {1 / std::sqrt(m)}, rest, load, k}};
  CurveState start;
  ASSERT_TRUE(rest_under(stand, 0, start));
  start.q[0] = amplitude * std::sqrt(m);
  std::vector<SpringEvent> events;
  AdaptiveRun motion(stand, start, 0, 1e-10);
  for (int i = 1; i <= 200; ++i)
    motion.advance(i * 5e-4, 0, 0, events);
  const double leaves = std::acos(-rest / amplitude) / w, speed = amplitude * w * std::sin(w * leaves);
  const double flight = 2 * speed * m / load;
  ASSERT_EQ(events.size(), 21u);
  double time = leaves;
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].parts, i % 2 == 0);
    EXPECT_LT(std::abs(events[i].time - time), 1e-9) << i;
    time += i % 2 == 0 ? flight : 2 * leaves;
  }
}

TEST(ContactCurves, FrequencyOfTwoHertzianMassesIsThatOfTheQuadrature)
{
  const double c = 1e13, upper = 9000, lower = 14000, mass = upper * lower / (upper + lower);
  const CurveStand stand = two_masses(upper, lower, power_law(c, 1.5, 1e3, 1e7, 30), load);
  ASSERT_EQ(stand.modes(), 2u);
  const double rest   = std::pow(load / c, 2 / 3.);
  const auto strain   = [&](const double d) { return d > 0 ? 0.4 * c * std::pow(d, 2.5) - load * d : -load * d; };
  const auto pressing = [&](const double d) { return (d > 0 ? c * std::pow(d, 1.5) : 0) - load; };
  EXPECT_TRUE(
      near(stand.rate[1], std::sqrt(1.5 * c * std::sqrt(rest) / mass), within(1e-9, "slope of the table")));
  PeriodicMotion before;
  for (const double part : {0.05, 0.2, 0.5, 0.8, 0.95}) {
    const double amplitude = part * rest / std::abs(stand.springs[0].row[1]);
    const auto motion      = free_motion(stand, 1, amplitude, 15, before.settled ? &before : nullptr);
    ASSERT_TRUE(motion.settled) << part;
    double high = rest;  // the deeper of the two turning points
    for (const double side : {1.0, -1.0}) {
      double end = rest;
      for (Eigen::Index h = 0; h < motion.cosine.cols(); ++h)
        end += motion.cosine(0, h) * (h % 2 == 1 ? side : 1);
      high = std::max(high, end);
    }
    const double energy = strain(high);
    double low          = motion.least[0];
    for (int i = 0; i < 50; ++i)
      low -= (strain(low) - energy) / pressing(low);
    // T = 2 int dd / sqrt(2 (E - V) / m), d = middle + half sin(t): an even, periodic integrand.
    const int n  = 2000;
    double whole = 0;
    for (int i = 0; i < n; ++i) {
      const double angle = M_PI * ((i + 0.5) / n - 0.5), half = (high - low) / 2;
      whole += 2 * half * std::cos(angle) * M_PI / n /
               std::sqrt(2 * (energy - strain((high + low) / 2 + half * std::sin(angle))) / mass);
    }
    EXPECT_TRUE(near(motion.frequency, 1 / whole, within(1e-6, "asked; the series of 15 harmonics is better")));
    before = motion;
  }
}

TEST(ContactCurves, KeepTheEnergyOfAnUndampedRun)
{
  const ChainOnCurves chain = chain_on_curves(load, 0);
  const CurveRun run        = curve_response(chain.stand, chain.modal, noise(2e4, 0.5), 20e3, 1e-12);
  EXPECT_GT(run.work, 1);  // J: the force did something
  EXPECT_LT(std::abs(run.balance), 1e-8);
  for (const SpringReach &spring : run.springs)
    if (spring.name == "K3") {
      EXPECT_LT(spring.least, 0.7);  // and the curves were used
    }
}

TEST(ContactCurves, KeepTheEnergyThroughSeparation)
{
  const ChainOnCurves chain = chain_on_curves(load, 0);
  const CurveRun run        = curve_response(chain.stand, chain.modal, noise(1e5, 0.15), 400e3, 1e-12);
  EXPECT_GT(run.events.size(), 10u);
  EXPECT_LT(std::abs(run.balance), 1e-8);
  for (std::size_t i = 1; i < run.events.size(); ++i)
    EXPECT_LE(run.events[i - 1].time, run.events[i].time);
}

TEST(ContactCurves, AreTheLinearModelAtSmallAmplitude)
{
  const ChainOnCurves chain = chain_on_curves(load, 0.01, 2e5);
  const ForceRecord force   = noise(1e-3 * load, 0.5);
  const Response linear     = mill_response(driven_model(chain.modal), force, 20e3);
  const CurveRun run        = curve_response(chain.stand, chain.modal, force, 20e3);
  for (const int roll : {int(upper_work_roll), int(lower_work_roll)}) {
    const Level of_curve = level(run.response.acceleration.col(roll)),
                of_line  = level(linear.acceleration.col(roll));
    EXPECT_TRUE(near(of_curve.rms, of_line.rms, within(1e-4, "asked at a thousandth of the load")));
    EXPECT_TRUE(
        near(of_curve.peak, of_line.peak, within(2e-4, "one sample, and the contact swings ten times as far")));
  }
  // What is left goes with the amplitude.
  const ForceRecord tenth     = noise(1e-4 * load, 0.5);
  const Response small_linear = mill_response(driven_model(chain.modal), tenth, 20e3),
                 small        = curve_response(chain.stand, chain.modal, tenth, 20e3).response;
  EXPECT_TRUE(near(furthest(small.acceleration, small_linear.acceleration),
                   0.1 * furthest(run.response.acceleration, linear.acceleration),
                   within(0.05, "second order in the force; the next order is less than a twentieth of it")));
  for (const int roll : {int(upper_work_roll), int(lower_work_roll)})
    EXPECT_TRUE(near(level(small.acceleration.col(roll)).peak, level(small_linear.acceleration.col(roll)).peak,
                     within(3e-5, "a tenth of the amplitude, not of the tolerance of a step")));
  // And is even in the force, as the square of a compression is, but for a part of third order: a slope that were
  // off would be odd, and the more so the smaller the amplitude.
  const auto odd_part = [&](const ForceRecord &wanted) {
    ForceRecord mirrored       = wanted;
    mirrored.force             = (2 * wanted.force.mean() - wanted.force.array()).matrix();
    const Eigen::MatrixXd line = mill_response(driven_model(chain.modal), wanted, 20e3).acceleration;
    return furthest(curve_response(chain.stand, chain.modal, mirrored, 20e3, 1e-13).response.acceleration + line,
                    curve_response(chain.stand, chain.modal, wanted, 20e3, 1e-13).response.acceleration - line);
  };
  const double odd = odd_part(force);
  EXPECT_LT(odd, 0.03);
  EXPECT_TRUE(near(odd_part(tenth), 0.1 * odd, within(0.1, "third order over second")));
  EXPECT_LT((run.response.load_cell - linear.load_cell).cwiseAbs().maxCoeff(), 1e-4 * load);
}

// A curve has a second derivative, and an amplitude of a thousandth of the load shows it: a harmonic of twice the
// frequency, of the size that theory.md (36.11) says, which falls with the square of the amplitude.
TEST(ContactCurves, SecondHarmonicIsThatOfTheCurvature)
{
  constexpr double damping = 0.1, frequency = 61;
  constexpr Eigen::Index per_period = 40, periods = 61;  // one second, e^-25 of what the start left
  const ChainOnCurves chain = chain_on_curves(load, damping);
  const CurveStand &stand   = chain.stand;
  using Complex             = std::complex<double>;
  const double w            = 2 * M_PI * frequency;
  const auto answers        = [&](const std::size_t k, const double position) {
    return 1.0 /
           Complex(stand.rate[k] * stand.rate[k] - position * position, 2 * damping * stand.rate[k] * position);
  };
  for (const double part : {1e-3, 1e-4}) {
    const Eigen::Index n = per_period * periods + 1;
    ForceRecord force{Eigen::VectorXd::LinSpaced(n, 0, double(periods) / frequency), Eigen::VectorXd(n), {}};
    for (Eigen::Index i = 0; i < n; ++i)
      force.force[i] = load * (1 + part * std::sin(w * force.time[i]));
    const auto run =
        curve_response(stand, chain.modal, force, per_period * frequency, 1e-13).response.acceleration;
    // Straight lines between samples of a sine: its size times sinc^2.
    const double half = M_PI / double(per_period), push = part * load * std::pow(std::sin(half) / half, 2);
    Eigen::VectorXcd second = Eigen::VectorXcd::Zero(6);
    for (const CurveSpring &spring : stand.springs) {
      // F'' of compression = F (a - b ln F) in closed form for the contacts, k dk/dF for the bearings.
      const double dF  = 0.02 * load;
      const auto slope = [&](const double F) {
        return stand.laws[spring.law].at(stand.laws[spring.law].compression(F)).stiffness;
      };
      const bool contact     = spring.name == "K3" || spring.name == "K5";
      const double gradient  = 5.3e-11 - 1.9e-12 * (std::log(load) + 1);
      const double curvature = contact ? 1.9e-12 / load / std::pow(gradient, 3)
                                       : (slope(load + dF) - slope(load - dF)) / (2 * dF) * spring.stiffness;
      Complex d              = 0;
      for (std::size_t k = 0; k < 6; ++k)
        d += spring.row[k] * answers(k, w) * stand.push[k] * push * Complex(0, -1);
      for (std::size_t k = 0; k < 6; ++k)
        second[Eigen::Index(k)] -= answers(k, 2 * w) * spring.row[k] * 0.25 * curvature * d * d;
    }
    const Eigen::VectorXcd wanted = -4 * w * w * (chain.modal.point * second);
    for (const int roll : {int(upper_work_roll), int(lower_work_roll)}) {
      Complex seen = 0;
      for (Eigen::Index i = 0; i < per_period; ++i)
        seen += run(n - per_period + i, roll) * std::exp(Complex(0, -4 * M_PI * double(i + 1) / per_period)) *
                2.0 / double(per_period);
      EXPECT_LT(std::abs(seen - wanted[roll]), 5e-3 * std::abs(wanted[roll]))
          << part << " " << seen << wanted[roll];
    }
  }
}

TEST(ContactCurves, FixedStepsAreExactForALinearStand)
{
  ChainOnCurves chain = chain_on_curves(load, 0.01);
  for (std::size_t j = 0; j < chain.stand.springs.size(); ++j) {
    const CurveSpring &spring    = chain.stand.springs[j];
    chain.stand.laws[spring.law] = power_law(spring.stiffness, 1, 1e4, 1e7, 5);
    chain.stand.springs[j].rest  = spring.force / spring.stiffness;
  }
  const ForceRecord force = noise(1e5, 0.5);
  EXPECT_LT(furthest(fixed_step_response(chain.stand, chain.modal, force, 2e3).response.acceleration,
                     mill_response(driven_model(chain.modal), force, 2e3).acceleration),
            1e-8);
}

TEST(ContactCurves, FixedStepsConvergeToTheAdaptiveRunWithTheSquareOfTheStep)
{
  for (const double gap_damper : {0.0, 2e5}) {
    const ChainOnCurves chain = chain_on_curves(load, 0.01, gap_damper);
    const ForceRecord force   = noise(4e4, 0.3);
    const Eigen::MatrixXd whole =
        curve_response(chain.stand, chain.modal, force, 5e3, 1e-12).response.acceleration;
    double before = 0;
    for (const int parts : {2, 4, 8}) {
      const double error =
          furthest(fixed_step_response(chain.stand, chain.modal, force, 5e3, parts).response.acceleration, whole);
      if (before > 0) {
        EXPECT_TRUE(near(before / error, 4,
                         within(0.1, "second order; the next term of the error is below a tenth of it")));
      }
      before = error;
    }
    EXPECT_LT(before, 1e-4);
  }
}

TEST(ContactCurves, HarmonicBalanceIsTheSteadyStateOfFixedSteps)
{
  for (const double gap_damper : {0.0, 1e5}) {
    const ChainOnCurves chain = chain_on_curves(load, 0.05, gap_damper);
    const double frequency = chain.modal.frequency[2], force = 2e5;
    const PeriodicMotion motion = forced_motion(chain.stand, frequency, force, 9);
    ASSERT_TRUE(motion.settled);
    const int n = 800;
    const FixedStep step(chain.stand, 1 / frequency / n);
    CurveState state;
    ASSERT_TRUE(rest_under(chain.stand, force, state));
    Eigen::MatrixXcd series = Eigen::MatrixXcd::Zero(6, 4);
    const int settle        = 400;  // periods; the slowest mode has lost e^-20 by then
    for (int i = 0; i < n * (settle + 1); ++i) {
      if (i >= n * settle)
        for (int h = 0; h <= 3; ++h)
          for (Eigen::Index k = 0; k < 6; ++k)
            series(k, h) +=
                (h == 0 ? 1. : 2.) / n * state.q[std::size_t(k)] * std::polar(1.0, -2 * M_PI * h * (i % n) / n);
      ASSERT_TRUE(step.advance(state, force * std::cos(2 * M_PI * (i % n) / n),
                               force * std::cos(2 * M_PI * (i % n + 1) / n)));
    }
    for (int h = 0; h <= 3; ++h)
      for (Eigen::Index k = 0; k < 6; ++k)
        EXPECT_LT(std::abs(series(k, h) - motion.modal(k, h)), 1e-4 * motion.modal.col(h).cwiseAbs().maxCoeff())
            << h << " " << k;
    EXPECT_GT(motion.modal.col(2).cwiseAbs().maxCoeff(), 1e-4 * motion.modal.col(1).cwiseAbs().maxCoeff());
  }
}

TEST(ContactCurves, FrequenciesOfModesThatStrainAContactFollowTheAmplitude)
{
  const ChainOnCurves chain = chain_on_curves(load, 0.01);
  const ForceRecord force   = noise(1e4, 0.5);
  const CurveRun run        = curve_response(chain.stand, chain.modal, force, 20e3);
  const auto modes          = mode_study(chain.stand, chain.modal, run, 5e3, 1e9);
  ASSERT_EQ(modes.size(), 6u);
  double smallest = INFINITY;
  for (const NonlinearMode &mode : modes) {
    EXPECT_EQ(mode.followed.front(), mode.frequency);
    EXPECT_LT(mode.bend, 0) << mode.number;  // contacts soften as their force falls
    EXPECT_LT(std::abs(mode.bend_in_run), std::abs(mode.bend)) << mode.number;
    ASSERT_EQ(mode.harmonics.size(), 3u);
    EXPECT_GT(mode.harmonics[0], mode.harmonics[1]);
    if (!std::isnan(mode.parting_force))
      smallest = std::min(smallest, mode.parting_force);
  }
  // A steady force just below the smallest of them parts nothing, just above it does.
  const auto parts = [&](const double amplitude) {
    const auto worst = std::min_element(modes.begin(), modes.end(), [](const auto &a, const auto &b) {
      return a.parting_force < b.parting_force;
    });
    const int n      = 200;
    const FixedStep step(chain.stand, 1 / worst->frequency / n);
    CurveState state;
    EXPECT_TRUE(rest_under(chain.stand, 0, state));
    bool parted = false;
    for (int i = 0; i < 150 * n; ++i) {
      step.advance(state, amplitude * std::sin(2 * M_PI * i / n), amplitude * std::sin(2 * M_PI * (i + 1) / n));
      for (std::size_t j = 0; j < state.d.size(); ++j)
        parted = parted || chain.stand.springs[j].rest + state.d[j] < 0;
    }
    return parted;
  };
  EXPECT_FALSE(parts(0.97 * smallest));
  EXPECT_TRUE(parts(1.03 * smallest));
  const double scale = scale_to_part(chain.stand, chain.modal, force, 20e3, run.springs[1].least);
  ASSERT_TRUE(std::isfinite(scale));
  const auto scaled = [&](const double by) {
    const double mean = force.force.mean();
    return curve_response(chain.stand, chain.modal, {force.time, mean + by * (force.force.array() - mean), {}},
                          20e3)
        .events.size();
  };
  EXPECT_EQ(scaled(0.99 * scale), 0u);
  EXPECT_GT(scaled(1.01 * scale), 0u);
}
