#include "core/base/errors.h"
#include "fem/contact/half_plane_contact.h"
#include "fem/contact/half_space.h"
#include "fem/contact/hertz.h"
#include "fem/contact/line_bodies.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace mill;
using namespace mill::contact;

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
const Material steel{210e9, 0.3, 7850}, bronze{110e9, 0.34, 8800};
const Tolerance printed = within(3e-5, "reference printed with five or six digits");

HalfPlanePair planes(const std::array<LineBody, 2> &bodies)
{
  return {half_spaces(bodies[0].material, bodies[1].material), relative_radius(bodies[0].radius, bodies[1].radius),
          common_datum(bodies)};
}
}  // namespace

TEST(LineBodies, TwoSteelRollsByJohnson)
{
  // contact.md 8.4
  const auto line = line_bodies({LineBody{0.2, steel, 0}, LineBody{0.65, steel, 0}}, 1e6);
  EXPECT_TRUE(near(line.half_width, 1.2991e-3, printed));
  EXPECT_TRUE(near(line.peak_pressure, 490.05e6, printed));
  EXPECT_TRUE(near(line.approach, 35.931e-6, printed));
  EXPECT_TRUE(near(line.tangent, 30146e6, printed));
}

TEST(LineBodies, DiscBetweenRigidPlates)
{
  // contact.md 8.4: both plates together, one contact is half of it.
  const auto one = [](const double R, const double q) {
    return line_bodies({LineBody{R, steel, 0}, LineBody{infinite, rigid_material(), 0}}, q);
  };
  EXPECT_TRUE(near(2 * one(0.010, 500e3).approach, 13.7495e-6, printed));
  EXPECT_TRUE(near(one(0.010, 500e3).half_width, 0.166093e-3, printed));
  EXPECT_TRUE(near(2 * one(0.050, 1000e3).approach, 30.0268e-6, printed));
  EXPECT_TRUE(near(one(0.050, 1000e3).peak_pressure, 1212.074e6, printed));
}

TEST(LineBodies, AnElasticPlaneGivesWayToItsDepth)
{
  // Johnson (1985), eq. 5.56, as printed there: q (1 - nu^2)/(pi E) [2 ln(2 d/b) - nu/(1 - nu)].
  const double q = 2e5, d = 0.1, nu = bronze.poisson_ratio;
  const auto line = line_bodies({LineBody{0.05, rigid_material(), 0}, LineBody{infinite, bronze, d}}, q);
  const double expected =
      q * (1 - nu * nu) / (M_PI * bronze.youngs_modulus) * (2 * std::log(2 * d / line.half_width) - nu / (1 - nu));
  EXPECT_TRUE(near(line.approach, expected, within(1e-13, "the same formula in another order")));
}

TEST(LineBodies, TheTangentIsTheSlopeOfTheApproach)
{
  const std::array<LineBody, 2> bodies{LineBody{0.02, steel, 0}, LineBody{infinite, bronze, 0.05}};
  const double q = 3e5, h = 1e-4 * q;
  const double slope = 2 * h / (line_bodies(bodies, q + h).approach - line_bodies(bodies, q - h).approach);
  EXPECT_TRUE(near(line_bodies(bodies, q).tangent, slope, within(1e-7, "third order of a step of 1e-4")));
}

TEST(LineBodies, HalfPlanesMeetTheClosedForm)
{
  for (const auto &bodies :
       {std::array<LineBody, 2>{LineBody{0.02, steel, 0}, LineBody{infinite, bronze, 0.05}},
        std::array<LineBody, 2>{LineBody{0.05, bronze, 0}, LineBody{0.3, steel, 0}},
        std::array<LineBody, 2>{LineBody{0.01, steel, 0}, LineBody{infinite, rigid_material(), 0}}}) {
    const auto closed = line_bodies(bodies, 3e5);
    const auto s      = half_plane_contact(planes(bodies), 3e5, 161);
    EXPECT_TRUE(near(s.half_width, closed.half_width, within(2e-3, "read by a fit, 64 strips on it")));
    EXPECT_TRUE(near(s.peak_pressure, closed.peak_pressure, within(2e-3, "64 strips on the half width")));
    EXPECT_TRUE(near(s.approach, closed.approach, within(1e-4, "second order in 1/64")));
    EXPECT_TRUE(near(half_plane_tangent(planes(bodies), 3e5, 161), closed.tangent,
                     within(5e-4, "fit through nine loads; grid in proportion to the half width")));
    EXPECT_LE(s.residual, 1e-12);
  }
}

TEST(LineBodies, ReportInvalidInput)
{
  const LineBody cylinder{0.1, steel, 0}, plane{infinite, steel, std::nan("")};
  EXPECT_THROW(line_bodies({cylinder, plane}, 1e5), InputError);  // no depth
  EXPECT_THROW(line_bodies({plane, plane}, 1e5), InputError);
  EXPECT_THROW(line_bodies({cylinder, cylinder}, 0), InputError);
  EXPECT_THROW(line_bodies({LineBody{0.1, rigid_material(), 0}, LineBody{0.1, rigid_material(), 0}}, 1e5),
               InputError);
}

TEST(FiniteLine, IsTheMiddleOfARollerWithEvenLoad)
{
  // contact.md 8.7: roller R 12.5, L 40 mm on a half space, 20 kN, logarithmic ends: 17.152 .. 17.155 um.
  const double E    = contact_modulus(half_spaces(steel, steel));
  const auto hertz  = hertz_line(500e3, 0.0125, E);
  const auto finite = lundberg_line(hertz, 500e3, 0.040, E);
  EXPECT_TRUE(near(finite.approach, 17.1535e-6, within(1e-3, "the profile holds the load even within 2.5 %")));
  // ln 2 + 1/2 = 1.1932, the constant that Lundberg prints.
  EXPECT_TRUE(near(finite.approach, 2 * 500e3 / (M_PI * E) * (1.1932 + std::log(0.040 / hertz.half_width)),
                   within(1e-5, "constant printed with five digits")));
  const double h      = 1e-4;
  const auto value_at = [&](const double q) { return lundberg_line(hertz_line(q, 0.0125, E), q, 0.040, E); };
  const double slope =
      0.040 * 500e3 * 2 * h / (value_at(500e3 * (1 + h)).approach - value_at(500e3 * (1 - h)).approach);
  EXPECT_TRUE(near(finite.tangent, slope, within(1e-7, "third order of a step of 1e-4")));
  EXPECT_THROW(lundberg_line(hertz, 500e3, hertz.half_width, E), InputError);
}
