#include "dynamics/cluster/backbone.h"
#include "dynamics/cluster/modes.h"
#include "dynamics/cluster/motion.h"
#include "dynamics/cluster/response.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/z_mill.h"
#include <gtest/gtest.h>

using namespace mill::cluster;

namespace {
// One roll pressed on a fixed one by its weight's stand-in, a constant force: m x'' = P - k d^p.
struct OneContact {
  Stack stack;
  Motion rest;
};
OneContact one_contact(const double exponent)
{
  OneContact o;
  o.stack.gravity = false;
  for (int i = 0; i < 2; ++i) {
    Roll roll;
    roll.name       = i ? "B" : "A";
    roll.radius     = 0.1;
    roll.length     = 0.5;
    roll.mass       = i ? 20 : 1e9;  // the first stands still
    roll.centre.y() = 0.2 * i;
    o.stack.rolls.push_back(roll);
    for (const double direction : {0., M_PI / 2})
      if (!i || direction == 0) {
        Support held;
        held.name      = roll.name;
        held.roll      = i;
        held.type      = Support::Type::guide;
        held.direction = direction;
        held.law       = {i ? 1e-9 : 1e-13, 1};
        o.stack.supports.push_back(held);
      }
  }
  Contact c;
  c.name        = "A-B";
  c.b           = 1;
  c.free_length = 0.2;
  c.law         = power_law_through(1e9, 1e4, exponent);
  o.stack.contacts.push_back(c);
  o.stack.loads.push_back({1, {0, -1e4}});
  o.rest = settle(o.stack).u;
  return o;
}

// Period by quadrature: 4 quarters by energy, the turning points from u = d0 + A at one side.
double frequency_by_quadrature(const ContactLaw &law, const double P, const double m, const double amplitude_in)
{
  const double d0   = approach(law, P);
  const auto U      = [&](const double d) { return energy(law, d) - P * d; };
  const double high = d0 + amplitude_in, E = U(high);
  double a = 0, b = d0;  // the other turning point
  for (int i = 0; i < 200; ++i) {
    const double c     = 0.5 * (a + b);
    (U(c) > E ? a : b) = c;
  }
  const double low = 0.5 * (a + b), middle = 0.5 * (high + low), half = 0.5 * (high - low);
  // d = middle + half sin(theta) takes the root out of the integrand; midpoints converge faster than any power.
  const int n = 4000;
  double T    = 0;
  for (int i = 0; i < n; ++i) {
    const double theta = -M_PI / 2 + M_PI * (i + 0.5) / n, d = middle + half * std::sin(theta);
    T += 2 * half * std::cos(theta) / std::sqrt(2 / m * (E - U(d))) * M_PI / n;
  }
  return 1 / T;
}
}  // namespace

TEST(ClusterMotion, NonlinearHistoryIsThatOfTheReference)
{
  ZMill z           = variant_C(1302e3);
  Stack stack       = stack_of(z);
  const Motion rest = settle(stack).u;
  for (Contact &c : stack.contacts)
    c.loss_factor = 0.08;
  add_viscous_damping(stack, rest, 2500, 0.2);
  MotionOptions options;
  options.duration = 0.012;
  const auto h     = move(stack, rest, {{0, {0, 880}, 2500}}, options);
  const auto v     = velocity_amplitudes(h, 2500);
  const auto ref   = reference("time_domain.C", "cluster");
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(near(v[2 * i + 1], double(ref[std::size_t(i)][0]),
                     within(1e-5, "Runge-Kutta steps of 2 us in the reference, order 4")));
    EXPECT_TRUE(near(v[2 * i + 1], double(ref[std::size_t(i)][1]),
                     within(1e-2, "linear at P_d/P = 1e-3, window of 12 ms")));
  }
  EXPECT_TRUE(h.events.empty());
}

TEST(ClusterMotion, FreeRunKeepsMomentumAndEnergy)
{
  Stack stack          = stack_of(variant_N());
  const Motion rest    = settle(stack).u;
  Eigen::VectorXd kick = Eigen::VectorXd::Zero(10);
  kick[1]              = 0.02;
  kick[0]              = 0.004;
  kick[7]              = 0.01;
  MotionOptions options;
  options.duration  = 0.1;
  options.interval  = 1e-3;
  options.tolerance = 1e-12;
  const auto h      = move(stack, rest, {}, options, {}, kick);
  EXPECT_LT(h.momentum_balance, 1e-9 * h.largest_momentum)
      << "change of momentum less impulse of all outer forces";
  EXPECT_LT(h.energy_balance.cwiseAbs().maxCoeff(), 1e-9 * h.energy[0]) << "1e-8 per second";
}

TEST(ClusterMotion, AfterAContactOpensTheRollMovesAsAFreeBody)
{
  const OneContact o   = one_contact(1.5);
  Eigen::VectorXd kick = Eigen::VectorXd::Zero(4);
  kick[3]              = 0.2;  // m/s, more than the contact has stored
  MotionOptions options;
  options.duration  = 0.002;
  options.interval  = 1e-5;
  options.tolerance = 1e-11;
  const auto h      = move(o.stack, o.rest, {}, options, {}, kick);
  ASSERT_GE(h.events.size(), 2u);
  EXPECT_TRUE(h.events[0].opens);
  EXPECT_FALSE(h.events[1].opens);
  // Speed where it opens from the energy, then time aloft 2 v m / P.
  const ContactLaw &law = o.stack.contacts[0].law;
  const double d0 = approach(law, 1e4), m = 20;
  const double v = std::sqrt(kick[3] * kick[3] + 2 / m * (energy(law, d0) - 1e4 * d0));
  EXPECT_TRUE(
      near(h.events[1].time - h.events[0].time, 2 * v * m / 1e4, within(1e-5, "energy balance of the run")));
}

TEST(ClusterBackbone, OneCurvedContactMeetsTheQuadrature)
{
  const OneContact o = one_contact(1.5);
  const auto modes_  = modes(o.stack, o.rest);
  int mode           = -1;
  for (std::size_t k = 0; k < modes_.size(); ++k)
    for (const Share &s : modes_[k].kinetic)
      if (s.name == "B y" && s.value > 0.99)
        mode = int(k);
  ASSERT_GE(mode, 0);
  const double d0   = approach(o.stack.contacts[0].law, 1e4);
  const auto points = backbone(o.stack, o.rest, mode, {0.01 * d0, 0.1 * d0, 0.4 * d0}, {9, 64});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(near(points[0].frequency, modes_[std::size_t(mode)].frequency, within(1e-4, "small amplitude")));
  for (const BackbonePoint &p : points) {
    EXPECT_TRUE(near(p.frequency, frequency_by_quadrature(o.stack.contacts[0].law, 1e4, 20, -p.lowest),
                     within(1e-6, "nine harmonics")))
        << p.amplitude;
    EXPECT_LT(p.frequency, points[0].frequency * (1 + 1e-12)) << "softens on its way to opening";
    EXPECT_EQ(p.lets_go, "");
  }
}

TEST(ClusterBackbone, FreeVibrationOfTheSameAmplitudeHasTheSameFrequency)
{
  const OneContact o    = one_contact(1.5);
  const double d0       = approach(o.stack.contacts[0].law, 1e4);
  const double turning  = 0.3 * d0;  // towards the fixed roll
  const double f        = frequency_by_quadrature(o.stack.contacts[0].law, 1e4, 20, turning);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(4);
  start[3]              = -turning;
  MotionOptions options;
  options.duration  = 3 / f;
  options.interval  = 0.01 / f;
  options.tolerance = 1e-11;
  const auto h      = move(o.stack, o.rest, {}, options, start);
  EXPECT_TRUE(near(h.displacement(3, 300), -turning, within(1e-6, "three periods of the quadrature")));
}
