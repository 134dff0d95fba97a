#include "core/base/errors.h"
#include "dynamics/cluster/stability.h"
#include "dynamics/cluster/stack.h"
#include "tests/support/near.h"
#include "tests/support/z_mill.h"
#include <gtest/gtest.h>

using namespace mill::cluster;

TEST(ClusterStack, TangentIsTheDerivativeOfTheForces)
{
  for (const ZMill &z : {variant_N(), variant_C()}) {
    ZMill pushed            = z;
    pushed.horizontal       = 5e3;
    pushed.beta             = 0.14;
    Stack stack             = stack_of(pushed);
    const Motion u          = settle(stack).u;
    const Eigen::MatrixXd K = total_tangent(stack, u);
    const double h          = 1e-8;
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      // Five points: its own error is h^4.
      const auto value_at = [&](const double step) {
        Motion moved = u;
        moved[k] += step;
        return forces(stack, moved).total;
      };
      const Eigen::VectorXd slope =
          -(8 * (value_at(h) - value_at(-h)) - (value_at(2 * h) - value_at(-2 * h))) / (12 * h);
      EXPECT_LT((slope - K.col(k)).cwiseAbs().maxCoeff(), 1e-8 * K.cwiseAbs().maxCoeff()) << k;
    }
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-15 * K.cwiseAbs().maxCoeff());
    EXPECT_LT((K - tangent(stack, u).total).cwiseAbs().maxCoeff(), 1e-15 * K.cwiseAbs().maxCoeff());
  }
}

TEST(ClusterStack, ForcesAreTheDerivativeOfTheEnergy)
{
  Stack stack    = stack_of(variant_N());
  const Motion u = settle(stack).u;
  Motion moved   = u;
  moved += Eigen::VectorXd::LinSpaced(u.size(), -8e-8, 9e-8);
  const Eigen::VectorXd f = forces(stack, moved).total;
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const double h      = 4e-8;
    const auto value_at = [&](const double step) {
      Motion other = moved;
      other[k] += step;
      return potential_energy(stack, other);
    };
    const double slope = -(8 * (value_at(h) - value_at(-h)) - (value_at(2 * h) - value_at(-2 * h))) / (12 * h);
    EXPECT_TRUE(
        near(slope, f[k],
             within(1e-5 * f.cwiseAbs().maxCoeff() / std::max(std::abs(f[k]), 1e-9 * f.cwiseAbs().maxCoeff()),
                    "digits of 100 J, h^4 of a contact of 0.8 um", 1e-9 * f.cwiseAbs().maxCoeff())))
        << k;
  }
}

TEST(ClusterStack, ApproachOfRollsAMetreApartKeepsItsDigits)
{
  Stack stack;
  for (const double x : {0.123, 0.987}) {
    Roll roll;
    roll.centre = {x, 0.456 * x};
    stack.rolls.push_back(roll);
  }
  Contact c;
  c.b                         = 1;
  const Eigen::Vector2d apart = stack.rolls[1].centre - stack.rolls[0].centre;
  c.free_length               = apart.norm();
  const Eigen::Vector2d n     = apart / apart.norm(), t(-n.y(), n.x());
  const double closer = 3e-13, sideways = 2e-13;  // m: what 1e10 N/m carries under 3 mN
  Motion u                       = Motion::Zero(stack.size());
  u.segment<2>(stack.per_roll()) = -closer * n + sideways * t;
  EXPECT_TRUE(near(contact_state(stack, c, u).approach, closer,
                   within(1e-9, "sideways squared over the distance; a difference of distances keeps no digit")));
}

TEST(ClusterStack, EnergySharesOfAModeAddUpToOne)
{
  Stack stack    = stack_of(variant_N());
  const Motion u = settle(stack).u;
  for (const Mode &mode : modes(stack, u)) {
    double elastic = 0, kinetic = 0;
    for (const Share &s : mode.elastic)
      elastic += s.value;
    for (const Share &s : mode.kinetic)
      kinetic += s.value;
    EXPECT_TRUE(near(elastic, 1, within(1e-12, "shares add up to the whole: rounding"))) << mode.label;
    EXPECT_TRUE(near(kinetic, 1, within(1e-12, "shares add up to the whole: rounding"))) << mode.label;
  }
}

TEST(ClusterStack, ShapesAreReadOrRefused)
{
  const Stack stack = stack_of(variant_N());
  const auto shape  = parsed_shape(stack, "W y, I y 0.8, L x -1");
  EXPECT_EQ(shape[1], 1);
  EXPECT_EQ(shape[3], 0.8);
  EXPECT_EQ(shape[6], -1);
  for (const char *bad : {"Q y", "W z", "W y a", ""})
    EXPECT_THROW(parsed_shape(stack, bad), mill::InputError) << bad;
}

TEST(ClusterStability, GuideAndForceOfALongColumnMeetTheClosedForm)
{
  // A roll between two others that cannot move sideways: k_x = P/(R_1 + R_2) + P/(R_2 + R_3).
  ZMill z       = variant_N();
  Stack stack   = stack_of(z);
  stack.gravity = false;
  stack.rolls.resize(3);
  stack.contacts.resize(2);
  stack.supports.resize(2);
  Support held = stack.supports[1];
  held.roll    = 0;
  held.name    = "W";
  held.law     = {1e-14, 1};
  stack.supports.push_back(held);
  stack.supports[0].type   = Support::Type::isotropic;
  stack.supports[0].across = 1e14;
  const double P           = 1148e3;
  const auto guide         = least_guide(stack, 1);
  ASSERT_TRUE(guide);
  const auto e = settle(stack);
  const auto d = [&](const std::size_t c) { return contact_state(stack, stack.contacts[c], e.u).distance; };
  EXPECT_TRUE(near(*guide, P / d(0) + P / d(1), within(1e-6, "the neighbouring rolls yield by 1e-6 of it")));
}

TEST(ClusterStability, AControlRollLosesContactWhenARollerCarriesNoLoad)
{
  const Stack stack = stack_of(variant_N());
  const auto lost   = leaving_load(stack, 0, {1, 0}, 60e3);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->contact, "L, upper roller");
  for (const double factor : {1 - 1e-6, 1 + 1e-6}) {
    ZMill mill      = variant_N();
    mill.horizontal = lost->load * factor;
    Stack loaded    = stack_of(mill);
    const auto u    = settle(loaded).u;
    const auto f    = roller_forces(loaded.supports[2], u.segment<2>(6));
    EXPECT_EQ(std::min(f[0], f[1]) > 0, factor < 1) << lost->load;
  }
  Stack weightless               = stack;
  weightless.gravity             = false;
  weightless.supports[2].preload = weightless.supports[3].preload = 4500;
  const auto both                                                 = leaving_load(weightless, 0, {1, 0}, 60e3);
  ASSERT_TRUE(both);
  EXPECT_GT(both->load, lost->load) << "no weight on the lower roller";
}
