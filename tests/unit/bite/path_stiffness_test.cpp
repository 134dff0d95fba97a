#include "core/base/errors.h"
#include "reduce/bite/slab/path_stiffness.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <functional>
#include <gtest/gtest.h>

using namespace mill;
using Eigen::VectorXd;

namespace {
// n nodes over 0 .. 20 mm under 50 MPa that deflect by 10 um, and one free node beyond each end.
bite::PathStiffness even_path(const int n, const double trim = 0.2)
{
  const double s = 20e-3 / (n - 1);
  VectorXd x = VectorXd::LinSpaced(n + 2, -s, 20e-3 + s), p = VectorXd::Constant(n + 2, 50e6);
  p[0] = p[n + 1] = 0;
  return bite::path_stiffness(x, p, VectorXd::Constant(n + 2, 1e-5), 2, trim);
}
}  // namespace

TEST(PathStiffness, EvenPressure)
{
  const auto path = even_path(21);
  EXPECT_EQ(path.nodes, 21);
  EXPECT_EQ(path.averaged, 13);  // without 4 at each end
  EXPECT_TRUE(near(path.plateau, 50e6 * 2 * 1e-3 / 1e-5, within_absolute(1e-3, "p B s / delta, rounding")));
  EXPECT_TRUE(
      near(path.sum, 50e6 * 2 * 21e-3 / 1e-5, within_absolute(1e-2, "all nodal forces, 21 spacings; rounding")));
  EXPECT_TRUE(
      near(path.smallest, path.largest,
           within_absolute(1e-6 * path.plateau,
                           "an even load gives every node the same stiffness, up to the rounding of its force")));
}

// The element length is in the quotient: twice the elements, half the plateau; the sum stays.
TEST(PathStiffness, PlateauHalvesAndSumStays)
{
  const auto coarse = even_path(41), fine = even_path(81);
  EXPECT_TRUE(near(fine.plateau / coarse.plateau, 0.5, within(1e-12, "exact: the spacing is halved")));
  EXPECT_TRUE(near(fine.sum / coarse.sum, 1, within(0.02, "the outermost nodes: one spacing more than the arc")));
}

TEST(PathStiffness, WhatIsRefused)
{
  const VectorXd x = VectorXd::LinSpaced(5, 0, 4e-3), p = VectorXd::Constant(5, 1e6),
                 d = VectorXd::Constant(5, 1e-6);
  VectorXd none = d, falling = x;
  none[2]         = -2e-6;
  falling[3]      = 0;
  const auto with = [&](const VectorXd &position, const VectorXd &pressure, const VectorXd &displacement,
                        const double trim) {
    return refusal([&] { bite::path_stiffness(position, pressure, displacement, 1, trim); });
  };
  const std::string start = "stiffness along the contact path: ";
  EXPECT_EQ(with(x, p.head(4), d, 0.2), start + "5 positions, 4 pressures and 5 displacements");
  EXPECT_EQ(with(x, p, d, 0.5), start + "a share of 0.5 cannot be left out at each end; between 0 and 0.5");
  EXPECT_EQ(with(falling, p, d, 0.2), start + "the nodes must rise, number 4 does not");
  EXPECT_EQ(with(x, 0 * p, d, 0.2), start + "0 nodes with pressure; at least three are needed");
  EXPECT_EQ(with(x, p, none, 0.2), start + "the roll does not deflect at x = 2 mm (-2 um) though it is pressed");
}
