#include "core/base/errors.h"
#include "dynamics/bearing/dynamics.h"
#include "dynamics/response/time_integration.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

// The motion of a mass on a bearing against closed forms.  Size of a mill: 900 kg on some 1e10 N/m.
using namespace mill;
using namespace mill::dynamics;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {
constexpr double m = 900;  // kg

// F = k (d - clearance)^n
BearingCurve power_curve(const double k, const double n, const double clearance = 0)
{
  const VectorXd depth = VectorXd::LinSpaced(6, std::log(1e-6), std::log(1e-3)).array().exp();
  BearingCurve curve;
  curve.clearance    = clearance;
  curve.displacement = depth.array() + clearance;
  curve.force        = k * depth.array().pow(n);
  curve.tangent      = n * k * depth.array().pow(n - 1);
  return curve;
}

BearingOscillator oscillator(const BearingCurve &curve)
{
  BearingOscillator o;
  o.mass  = m;
  o.curve = curve;
  return o;
}
}  // namespace

// Where the force is proportional to the displacement both directions are oscillators of their own.
TEST(BearingDynamics, LinearLimitIsTheDampedOscillator)
{
  constexpr double k = 1.5e10, c = 2e5, P = 1e6, f = 400, amplitude = 2e5, y0 = 3e-6;
  BearingOscillator o = oscillator(power_curve(k, 1));
  o.damping           = c;
  o.mean_load         = {P, 0};
  o.amplitude         = amplitude;
  o.frequency         = f;
  o.start             = BearingState{{P / k, y0}, Vector2d::Zero()};
  const auto response = simulate(o, 0.05, 20e3);

  const double w0 = std::sqrt(k / m), decay = c / (2 * m), wd = std::sqrt(w0 * w0 - decay * decay),
               w = 2 * M_PI * f;
  // steady state  a sin wt + b cos wt  under  A sin wt, and the free motion that starts it from rest
  const double p = k - m * w * w, q = c * w, a = amplitude * p / (p * p + q * q),
               b = -amplitude * q / (p * p + q * q);
  const double C = -b, D = (-a * w + decay * C) / wd;
  VectorXd x(response.time.size()), y(response.time.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double t = response.time[i], fade = std::exp(-decay * t);
    x[i] =
        P / k + a * std::sin(w * t) + b * std::cos(w * t) + fade * (C * std::cos(wd * t) + D * std::sin(wd * t));
    y[i] = y0 * fade * (std::cos(wd * t) + decay / wd * std::sin(wd * t));
  }
  const Tolerance closed = within(1e-6, "acceptance; the integrator holds 1e-11 per step, 1600 of them", P / k);
  EXPECT_TRUE(near(VectorXd(response.position.col(0)), x, closed));
  EXPECT_TRUE(near(VectorXd(response.position.col(1)), y, closed));
  EXPECT_TRUE(response.events.empty()) << "without clearance nothing is lost";
  EXPECT_EQ(response.without_contact, 0);
  EXPECT_TRUE(near(response.frequency_along, w0 / (2 * M_PI), within(1e-10, "closed form")));
  EXPECT_TRUE(near(response.frequency_across, w0 / (2 * M_PI), within(1e-10, "secant and tangent are one")));
  EXPECT_TRUE(response.notes.empty());
}

// Free oscillation on F = k |x|^n about zero: the quarter period is the integral of dx over the speed,
//   T = 4 sqrt(m (n+1) / 2k) A^((1-n)/2) B,   B = sqrt(pi) G(1/(n+1)) / ((n+1) G(1/(n+1) + 1/2))
TEST(BearingDynamics, PeriodOnAPowerLawIsTheQuadrature)
{
  for (const double n : {1.0, 10.0 / 9, 1.5}) {
    const double k = 1e10 * std::pow(1e-5, 1 - n), A = 4e-5, r = 1 / (n + 1);
    const double B         = std::sqrt(M_PI) * r * std::tgamma(r) / std::tgamma(r + 0.5);
    const double T         = 4 * std::sqrt(m * (n + 1) / (2 * k)) * std::pow(A, (1 - n) / 2) * B;
    BearingOscillator o    = oscillator(power_curve(k, n));
    o.start                = BearingState{{A, 0}, Vector2d::Zero()};
    constexpr int quarters = 81;
    const auto response    = simulate(o, quarters * T / 4 * (1 + 1e-9), 4 / T);
    // After 20 1/4 periods the mass passes through the middle; its distance from there gives the period.
    const double late = response.position(quarters, 0) / response.velocity(quarters, 0);
    EXPECT_TRUE(near(1 + late / (quarters * T / 4), 1, within(1e-7, "1e-11 per step, 3000 steps"))) << n;
    EXPECT_TRUE(near(response.position(80, 0), A, within(1e-6, "amplitude after 20 periods"))) << n;
  }
}

// Between the sides of the clearance the mass flies straight on; each touch is half a period of the spring.
TEST(BearingDynamics, BouncesInTheClearance)
{
  constexpr double k = 1e10, gap = 5e-5, v = 0.05;
  BearingOscillator o = oscillator(power_curve(k, 1, gap));
  o.start             = BearingState{Vector2d::Zero(), Vector2d(0.6 * v, 0.8 * v)};
  const double flight = gap / v, touch = M_PI * std::sqrt(m / k), period = 2 * flight + touch;
  const auto response = simulate(o, 10 * period, 1000 / period);
  ASSERT_EQ(response.events.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const double touches = double(i / 2), expected = flight + touches * period + (i % 2 ? touch : 0);
    EXPECT_EQ(response.events[i].regained, i % 2 == 0) << i;
    EXPECT_TRUE(near(response.events[i].time, expected, within(1e-7, "20 restarts of the formulas at 1e-11")))
        << i;
  }
  EXPECT_TRUE(near(response.without_contact, 2 * flight / period, within(1e-6, "from the same instants")));
  double slowest = v, fastest = 0;
  for (Eigen::Index i = 0; i < response.time.size(); ++i)
    if (response.force[i] == 0) {
      slowest = std::min(slowest, response.velocity.row(i).norm());
      fastest = std::max(fastest, response.velocity.row(i).norm());
      EXPECT_EQ(response.acceleration.row(i).norm(), 0) << "free flight";
    }
  EXPECT_TRUE(near(slowest, v, within(1e-7, "no energy is lost in ten touches")));
  EXPECT_TRUE(near(fastest, v, within(1e-7, "none is won")));
}

// Energy of an undamped motion in two directions that loses its contact again and again.
TEST(BearingDynamics, EnergyIsKept)
{
  constexpr double k = 2e10 * 3.6, n = 10.0 / 9, gap = 5e-5;
  BearingOscillator o = oscillator(power_curve(k, n, gap));
  o.mean_load         = {3e5, 0};
  o.start             = BearingState{{-4e-5, 3e-5}, {0.2, 0.15}};
  const auto response = simulate(o, 0.2, 50e3);
  EXPECT_GT(response.events.size(), 50u) << "the case has to lose its contact";
  VectorXd energy(response.time.size());
  for (Eigen::Index i = 0; i < energy.size(); ++i) {
    const double depth = std::max(0.0, response.position.row(i).norm() - gap);
    energy[i]          = 0.5 * m * response.velocity.row(i).squaredNorm() + k * std::pow(depth, n + 1) / (n + 1) -
                3e5 * response.position(i, 0);
  }
  const double size = energy.cwiseAbs().maxCoeff();
  EXPECT_LT((energy.array() - energy[0]).abs().maxCoeff() / size, 1e-6) << "1e-11 per step, 32 000 steps";
  // and it is the bound on the step that decides
  o.tolerance        = 1e-9;
  const auto coarser = simulate(o, 0.2, 50e3);
  EXPECT_LT(coarser.steps, response.steps);
}

// A whirl: the mass circles where the bearing just holds it.  Angular momentum and radius stay.
TEST(BearingDynamics, WhirlStaysOnItsCircle)
{
  constexpr double k = 7e10, n = 10.0 / 9, gap = 2e-5, radius = 6e-5;
  BearingOscillator o = oscillator(power_curve(k, n, gap));
  const double speed  = std::sqrt(k * std::pow(radius - gap, n) * radius / m);
  o.start             = BearingState{{radius, 0}, {0, speed}};
  const double turn   = 2 * M_PI * radius / speed;
  const auto response = simulate(o, 25 * turn, 40 / turn);
  EXPECT_LT((response.position.rowwise().norm().array() / radius - 1).abs().maxCoeff(), 1e-6)
      << "1e-11 per step, 25 turns";
  const Eigen::Index last = response.time.size() - 1;
  EXPECT_TRUE(near(response.position(last, 1) / radius, 0, within(1e-5, "phase after 25 turns", 1)));
}

// A force that runs in straight lines: the linear bearing against the exact first-order hold of the same
// oscillator. The record is at rest but for one sample, which no step may miss.
TEST(BearingDynamics, RecordedPulseIsNotSteppedOver)
{
  constexpr double k = 1.5e10, c = 2e5, P = 1e6;
  ForceRecord record;
  record.time         = VectorXd::LinSpaced(401, 3, 3.04);
  record.force        = VectorXd::Zero(401);
  record.force[237]   = 5e5;
  BearingOscillator o = oscillator(power_curve(k, 1));
  o.damping           = c;
  o.mean_load         = {0, P};
  o.direction         = {0, 2};
  o.record            = record;
  const auto response = simulate(o, 0.04, 20e3);

  StateSpace system;
  system.A = Eigen::MatrixXd::Zero(2, 2);
  system.A << 0, 1, -k / m, -c / m;
  system.B               = VectorXd::Unit(2, 1) / m;
  system.C               = Eigen::MatrixXd::Identity(1, 2);
  system.D               = VectorXd::Zero(1);
  const HoldResult exact = first_order_hold(system, record, 20e3);
  ASSERT_EQ(exact.time.size(), response.time.size());
  EXPECT_EQ(response.time[0], 3);
  const double pulse = exact.output.cwiseAbs().maxCoeff();
  EXPECT_GT(pulse, 1e-6) << "the pulse moves the mass by a micrometre";
  const VectorXd y = response.position.col(1).array() - P / k;
  EXPECT_TRUE(near(y, VectorXd(exact.output.row(0)),
                   within(1e-6, "1e-11 per step of a motion twelve times as large", pulse)));
}

// What the law of central forces says of small motions across the load: stiffness F/d.  A ring of many rollers,
// each with its own law Q = d^(10/9) along its own direction, says the same.
TEST(BearingDynamics, AcrossTheLoadARoundBearingHasItsSecant)
{
  constexpr int Z    = 2000;
  constexpr double n = 10.0 / 9, d = 1e-4;
  double force = 0, along = 0, across = 0;
  for (int j = 0; j < Z; ++j) {
    const double psi = 2 * M_PI * j / Z, cosine = std::cos(psi), approach = std::max(0.0, d * cosine);
    force += std::pow(approach, n) * cosine;
    if (approach > 0) {
      along += n * std::pow(approach, n - 1) * cosine * cosine;
      across += n * std::pow(approach, n - 1) * std::sin(psi) * std::sin(psi);
    }
  }
  EXPECT_TRUE(near(across, force / d, within(2e-3, "2000 rollers; a root-like end of the loaded arc")));
  BearingOscillator o = oscillator(power_curve(force / std::pow(d, n), n));
  o.mean_load         = {force, 0};
  const auto response = simulate(o, 1e-2, 1e4);
  EXPECT_TRUE(near(std::pow(response.frequency_across / response.frequency_along, 2), across / along,
                   within(2e-3, "the same sum")));
  EXPECT_LT((response.position.col(0).array() / d - 1).abs().maxCoeff(), 1e-9) << "at rest it stays at rest";
}

TEST(BearingDynamics, RefusesWrongInputWithTheReason)
{
  const BearingOscillator good = oscillator(power_curve(1e10, 1));
  const auto message           = [&](const auto &change, const double duration = 0.1, const double rate = 1e4) {
    BearingOscillator o = good;
    change(o);
    try {
      simulate(o, duration, rate);
    } catch (const InputError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto nothing = [](BearingOscillator &) {};
  EXPECT_EQ(message(nothing), "");
  EXPECT_NE(message([](auto &o) { o.mass = 0; }).find("mass 0 kg has to be positive"), std::string::npos);
  EXPECT_NE(message([](auto &o) { o.damping = -1; }).find("damping -1 N s/m"), std::string::npos);
  EXPECT_NE(message([](auto &o) { o.amplitude = 5; }).find("needs a frequency above zero"), std::string::npos);
  EXPECT_NE(message([](auto &o) {
              o.amplitude = 5, o.frequency = 5;
              o.direction = Vector2d::Zero();
            }).find("needs a direction"),
            std::string::npos);
  EXPECT_NE(message([](auto &o) { o.tolerance = 1; }).find("tolerance 1 is outside"), std::string::npos);
  EXPECT_NE(message(nothing, 0).find("duration 0 s"), std::string::npos);
  EXPECT_NE(message(nothing, 1e-6).find("outputs"), std::string::npos);
  EXPECT_NE(message([](auto &o) {
              o.record = ForceRecord{Vector2d(0, 0.05), Vector2d(0, 1), {}};
            }).find("longer than the force record, 0.05 s"),
            std::string::npos);
  EXPECT_NE(message([](auto &o) { o.curve.force[0] = -1; }).find("bearing curve"), std::string::npos);
}

// Pressed beyond the last sample the motion goes on, and says so.
TEST(BearingDynamics, NotesThatTheCurveIsTooShort)
{
  BearingOscillator o = oscillator(power_curve(1e10, 1));
  o.start             = BearingState{{1.5e-3, 0}, Vector2d::Zero()};
  const auto response = simulate(o, 0.02, 1e4);
  ASSERT_EQ(response.notes.size(), 1u);
  EXPECT_NE(response.notes[0].find("up to 1500 um from the middle, the curve of the bearing ends at 1000 um"),
            std::string::npos)
      << response.notes[0];
}

TEST(BearingDynamics, TablesHaveTheColumnsOfTheFiles)
{
  BearingOscillator o = oscillator(power_curve(1e10, 1));
  o.mean_load         = {1e6, 0};
  o.amplitude         = 1e5;
  o.frequency         = 200;
  const auto response = simulate(o, 0.2, 1e4);
  const Table motion  = bearing_response_table(response);
  EXPECT_EQ(motion.names,
            (std::vector<std::string>{"time", "x", "y", "force", "acceleration_x", "acceleration_y"}));
  EXPECT_EQ(motion.units, (std::vector<std::string>{"s", "m", "m", "N", "m/s2", "m/s2"}));
  const Table lines = bearing_spectrum_table(response);
  EXPECT_EQ(lines.units, (std::vector<std::string>{"Hz", "g/sqrt(Hz)", "N/sqrt(Hz)"}));
  const double resonance = std::sqrt(1e10 / m) / (2 * M_PI);  // undamped: it rings at its own frequency as well
  EXPECT_LT(std::min(std::abs(response.spectrum_peak - 200), std::abs(response.spectrum_peak - resonance)),
            1e4 / double(response.spectrum.segment_length))
      << "one line of the spectrum";
  EXPECT_EQ(response.peak_force, response.force.maxCoeff());
}
