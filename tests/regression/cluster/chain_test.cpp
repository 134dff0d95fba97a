#include "dynamics/cluster/contact_law.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/z_mill.h"
#include <gtest/gtest.h>

// The vertical chain W-I-E and the refits over the angle of the rollers, against numbers computed outside this
// program (tests/reference/cluster.json).
using namespace mill::cluster;

namespace {
struct ChainCase {
  std::string law;
  double length, density;
};

// Straight springs with the tangents of the three contact laws at 1148 kN; nothing next to the column.
Stack chain_of(const ChainCase &c, const double bearing)
{
  constexpr double load = 1148e3;
  ZMill z               = variant_N();
  z.kap_b               = 0;
  z.isotropic           = true;
  Stack stack           = stack_of(z);
  stack.gravity         = false;
  stack.rolls.resize(3);
  stack.contacts.resize(2);
  stack.supports.resize(2);
  stack.supports[0].law    = {1 / bearing, 1};
  stack.supports[0].across = bearing;
  for (Roll &roll : stack.rolls)
    roll.mass = c.density * M_PI * roll.radius * roll.radius * c.length;
  for (Contact &contact : stack.contacts) {
    const auto body = [&](const int roll) {
      return ContactBody{stack.rolls[std::size_t(roll)].radius, {2.07e11, 0.29, c.density}};
    };
    const ContactLaw law = c.law == "power" ? palmgren_law(c.length, 3.84e-5)
                                            : line_law(c.law == "log" ? LineForm::foeppl : LineForm::johnson,
                                                       body(contact.a), body(contact.b), c.length);
    contact.law          = straight_law(tangent(law, approach(law, load)));
  }
  return stack;
}

// Hz, the three vertical modes, lowest first.
std::vector<double> vertical(const Stack &chain)
{
  Stack stack = chain;
  std::vector<double> f;
  for (const Mode &mode : modes(stack, settle(stack).u)) {
    double up = 0;
    for (std::size_t k = 1; k < mode.kinetic.size(); k += 2)
      up += mode.kinetic[k].value;
    if (up > 0.5)
      f.push_back(mode.frequency);
  }
  return f;
}

// The bearing that brings the lowest vertical mode to a frequency: rising, so halved intervals of its logarithm.
double bearing_for(const ChainCase &c, const double frequency)
{
  double low = std::log(1e9), high = std::log(1e11);
  for (int i = 0; i < 60; ++i) {
    const double middle                                                        = 0.5 * (low + high);
    (vertical(chain_of(c, std::exp(middle))).front() < frequency ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}
}  // namespace

// CL-14: 621 Hz is fitted, the other two follow.
TEST(ZMillChain, TwelveCasesPredictModesFiveAndSix)
{
  const auto rows = reference("chain", "cluster");
  ASSERT_EQ(rows.size(), 12u);
  for (const auto &row : rows) {
    const ChainCase c{row[0], row[1], row[2]};
    const double bearing = bearing_for(c, 621);
    const auto f         = vertical(chain_of(c, bearing));
    ASSERT_EQ(f.size(), 3u) << row;
    EXPECT_TRUE(near(bearing, double(row[3]), within(1e-6, "root of a 3 x 3 eigenvalue"))) << row;
    EXPECT_TRUE(near(f[1], double(row[5]), within(1e-6, "3 x 3 eigenvalues"))) << row;
    EXPECT_TRUE(near(f[2], double(row[6]), within(1e-6, "3 x 3 eigenvalues"))) << row;
  }
}

TEST(ZMillChain, ShapesOfVariantCAreThoseOfTheReference)
{
  Stack stack    = stack_of(variant_C());
  const auto all = modes(stack, settle(stack).u);
  const auto ref = reference("mode_shapes.C", "cluster");
  int n_found    = 0;
  for (const Mode &mode : all)
    for (std::size_t i = 0; i < 2; ++i)
      if (std::abs(mode.frequency - (i == 0 ? 2477.5 : 6123.7)) < 1) {
        ++n_found;
        EXPECT_TRUE(near(std::abs(mode.shape[3] / mode.shape[1]), double(ref[i][0]), within(1e-5, "one model")));
        EXPECT_TRUE(near(std::abs(mode.shape[5] / mode.shape[1]), double(ref[i][1]), within(1e-5, "one model")));
      }
  EXPECT_EQ(n_found, 2);
}

// The stiffness of the rollers refitted to 647.5 Hz for other angles: the lateral mode of W with the control rolls
// moves, the angle is not known.
TEST(ZMillRollers, RefitsOverTheirAngle)
{
  for (const auto &row : reference("stack.N.theta", "cluster")) {
    ZMill z      = variant_N();
    z.kap_r      = 0;
    z.theta      = double(row[0]) * M_PI / 180;
    const auto f = [&](const double k_r, const char *shape) {
      z.k_r           = k_r;
      Stack stack     = stack_of(z);
      const auto all  = modes(stack, settle(stack).u);
      const auto mode = identified(stack, {{shape, parsed_shape(stack, shape)}}, all)[0];
      return all[std::size_t(mode)].frequency;
    };
    // Mean of the two tangential modes over the stiffness, halved intervals.
    double low = std::log(1e7), high = std::log(1e9);
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (low + high), k = std::exp(middle);
      (0.5 * (f(k, "L y, R y") + f(k, "L y, R y -1")) < 647.5 ? low : high) = middle;
    }
    const double k_r = std::exp(0.5 * (low + high));
    EXPECT_TRUE(near(k_r, double(row[1]), within(1e-5, "least squares of 647 and 648 for 647.5"))) << row;
    EXPECT_TRUE(near(f(k_r, "W x, L x, R x"), double(row[2]), within(1e-5, "one model"))) << row;
  }
}
