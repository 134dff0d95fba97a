#include "fem/contact/half_plane_numbers.h"
#include "fem/contact/space_numbers.h"
#include "tests/support/near.h"
#include <cmath>

// Two bodies of revolution in plane strain and in space: each number within its stated error of Hertz, Cattaneo,
// Mindlin and Lundberg.
using namespace mill;

namespace {
const Material steel{210e9, 0.3, 7850};
const double modulus = 210e9 / (2 * (1 - 0.3 * 0.3));  // Pa, E* of steel on steel

RoundBody cylinder(const double diameter)
{
  RoundBody body;
  body.diameter = diameter;
  return body;
}

TwoCylinders line_pair()
{
  TwoCylinders pair;
  pair.steel                   = steel;
  pair.upper                   = cylinder(0.4);
  pair.lower                   = cylinder(0.6);
  pair.contact.at              = 2e6;
  pair.contact.friction        = 0.3;
  pair.contact.tangential_load = 0.3e6;
  return pair;
}

// Two balls of 60 mm: a circle.
TwoCylinders balls()
{
  TwoCylinders pair;
  pair.steel = steel;
  pair.upper = pair.lower = cylinder(0.06);
  pair.upper.crown_radius = pair.lower.crown_radius = 0.03;
  pair.in_space                                     = true;
  pair.space.at                                     = 1000;
  pair.space.friction                               = 0.3;
  pair.space.tangential_load                        = 150;
  return pair;
}

// A roller on a plane, its ends relieved by the logarithm.
TwoCylinders roller()
{
  TwoCylinders pair;
  pair.steel         = steel;
  pair.upper         = cylinder(0.02);
  pair.upper.length  = 0.02;
  pair.upper.profile = EndProfile::log;
  pair.lower.shape   = BodyShape::plane;
  pair.in_space      = true;
  pair.space.at      = 8000;
  pair.space.tilt    = 2e-4;
  return pair;
}

void expect_covered(const contact::SpaceNumber &number, const double closed, const char *name)
{
  EXPECT_GT(number.error, 0) << name;
  EXPECT_TRUE(near(number.value, closed, within(number.error + 1e-12, "its own stated error"))) << name;
}
}  // namespace

TEST(BodyNumbers, LineIsThatOfHertz)
{
  const auto pair   = line_pair();
  const auto fine   = contact::half_plane_values(pair, pair.contact.at, true),
             coarse = contact::half_plane_values(pair, pair.contact.at, false);
  const auto error  = contact::line_errors(fine, coarse, pair.contact.at, not_given);
  const double R = 0.2 * 0.3 / 0.5, q = pair.contact.at, b = std::sqrt(4 * q * R / (M_PI * modulus));
  EXPECT_LT(error.half_width, 0.01);
  EXPECT_TRUE(near(fine.half_width, b, within(error.half_width, "its own stated error")));
  EXPECT_TRUE(near(fine.peak_pressure, 2 * q / (M_PI * b), within(error.peak_pressure, "its own stated error")));
  const auto wrong = contact::line_errors(fine, coarse, pair.contact.at, 1.1 * fine.tangent);
  EXPECT_TRUE(near(wrong.tangent, 0.1, within(1e-9, "another slope is the error, rounding")));
  auto heavier = fine;
  heavier.peak_pressure *= 1.05;
  const double misfit = std::abs(0.5 * M_PI * heavier.half_width * heavier.peak_pressure / q - 1);
  EXPECT_TRUE(near(contact::line_errors(heavier, heavier, q, not_given).half_width, misfit,
                   within(1e-12, "a parabola that does not carry the load, rounding")));
}

TEST(BodyNumbers, SlipOfALineIsThatOfCattaneo)
{
  const auto pair = line_pair();
  const auto slip = contact::half_plane_slip(pair);
  const double R = 0.2 * 0.3 / 0.5, q = pair.contact.at, b = std::sqrt(4 * q * R / (M_PI * modulus));
  const double stick = b * std::sqrt(1 - pair.contact.tangential_load / (pair.contact.friction * q));
  EXPECT_FALSE(slip.coupled);
  EXPECT_TRUE(near(slip.closed.stick, stick, within(1e-12, "the same formula, rounding")));
  EXPECT_LT(slip.error.stick, 0.01);
  EXPECT_TRUE(near(slip.value.stick, stick,
                   within(std::max(slip.error.stick, 1e-3), "its own stated error, at "
                                                            "least a tenth of a strip of 161")));
  // What the strips carry is what was applied.
  const double strip = slip.width.x[1] - slip.width.x[0];
  EXPECT_TRUE(near(slip.width.pressure.sum() * strip, q, within(1e-9, "equilibrium, residual of the solver")));
  EXPECT_TRUE(near(std::abs(slip.width.shear.sum()) * strip, pair.contact.tangential_load,
                   within(1e-6, "equilibrium, residual of the solver")));
  auto unlike                 = pair;
  unlike.lower.youngs_modulus = 70e9;
  EXPECT_TRUE(contact::half_plane_slip(unlike).coupled);
}

TEST(BodyNumbers, BallsAreThoseOfHertzAndMindlin)
{
  const auto pair = balls();
  const auto s    = contact::space_numbers(pair);
  const double R = 0.015, P = pair.space.at, a = std::cbrt(3 * P * R / (4 * modulus));
  EXPECT_EQ(s.form, contact::SpaceForm::point);
  expect_covered(s.half_width, a, "half width");
  expect_covered(s.length, 2 * a, "length");
  expect_covered(s.peak_pressure, 1.5 * P / (M_PI * a * a), "pressure");
  expect_covered(s.approach, a * a / R, "approach");
  expect_covered(s.tangent, 2 * modulus * a, "tangent");
  expect_covered(s.secant, P * R / (a * a), "secant");
  EXPECT_LT(s.approach.error, 0.01);
  EXPECT_TRUE(std::isnan(s.edge_factor.value)) << "a ball has no end";
  EXPECT_FALSE(s.moment) << "without tilt both halves are alike";
  const auto slip = contact::space_slip(pair, s);
  const double G = 210e9 / 2.6, left = 1 - pair.space.tangential_load / (0.3 * P);
  const double no_slip = 8 * a * G / (2 * (2 - 0.3));  // two bodies in series, Mindlin (1949)
  EXPECT_TRUE(near(slip.first.closed, no_slip, within(1e-9, "the same formula, rounding")));
  EXPECT_TRUE(near(slip.first.value, no_slip, within(0.02, "16 rectangles over a radius")));
  EXPECT_TRUE(near(slip.stick.closed, a * std::cbrt(left), within(1e-9, "the same formula, rounding")));
  EXPECT_TRUE(near(slip.stick.value, a * std::cbrt(left),
                   within(0.03, "16 rectangles over a radius, slip across "
                                "the load")));
  EXPECT_LE(slip.friction_share.maxCoeff(), 1 + 1e-9) << "no rectangle carries more than friction allows";
}

TEST(BodyNumbers, ATiltedRollerTouchesFirstAtOneEnd)
{
  const auto pair = roller();
  const auto s    = contact::space_numbers(pair);
  EXPECT_EQ(s.form, contact::SpaceForm::line);
  EXPECT_GT(s.first_touch, 0);
  EXPECT_LT(s.first_touch, 0.5 * pair.upper.length * pair.space.tilt) << "the relief takes part of the tilt";
  ASSERT_TRUE(s.moment);
  EXPECT_GT(s.moment->value, 0) << "more load where the faces close";
  EXPECT_TRUE(near(s.approach.closed - contact::closed_space(s.shape, s.form, pair.space.at, 0).approach,
                   s.first_touch, within(1e-9, "Lundberg from the first touch, rounding")));
  EXPECT_GT(s.line_load_ratio.value, 1);
  EXPECT_EQ(s.line_load_ratio.closed, 1);
  // Palmgren, P^0.9: tangent over secant of the fit is 1 / 0.9.
  auto heavier = pair;
  heavier.space.at *= 1.01;
  EXPECT_TRUE(near(contact::space_numbers(heavier).palmgren / s.palmgren, std::pow(1.01, 0.9),
                   within(1e-12, "a power of the load, rounding")));
}

// A profile that stands out at both ends by a straight line: a small load is carried there, each end over a length
// s with q = k slope (s - x), so that P = k slope s^2.
TEST(BodyNumbers, AFaceWithRaisedEndsIsCarriedThere)
{
  TwoCylinders pair;
  pair.steel               = steel;
  pair.upper               = cylinder(0.025);
  pair.upper.length        = 0.04;
  pair.upper.profile       = EndProfile::table;
  pair.upper.profile_table = {{0, 0}, {0.02, -10e-6}};
  pair.lower.shape         = BodyShape::plane;
  pair.in_space            = true;
  const auto shape         = contact::space_shape(pair);
  const double L = 0.04, slope = 10e-6 / 0.02;
  for (const double load : {200., 2000.}) {
    const double b = std::sqrt(4 * load / L * 0.0125 / (M_PI * modulus));
    const double k = M_PI * modulus / (2 * (std::log(2 * L / b) + 0.5));  // N/m2, (33.6)
    EXPECT_TRUE(near(shape.slices(load, 0).length, std::min(L, 2 * std::sqrt(load / (k * slope))),
                     within_absolute(2.1 * L / 400, "400 slices, one at either end of the loaded length")))
        << load;
  }
  // Under a tilt the end that it closes alone carries; the moment is the load over the distance of its centroid.
  const double load = 200, tilt = 1e-4;
  const double b     = std::sqrt(4 * load / L * 0.0125 / (M_PI * modulus));
  const double k     = M_PI * modulus / (2 * (std::log(2 * L / b) + 0.5));
  const double s     = std::sqrt(2 * load / (k * (slope + tilt)));
  const auto one_end = shape.slices(load, tilt);
  EXPECT_TRUE(near(one_end.length, s, within_absolute(1.1 * L / 400, "400 slices")));
  EXPECT_TRUE(near(one_end.moment, load * (L / 2 - s / 3), within(5e-3, "400 slices, the last one half loaded")));
}

TEST(BodyNumbers, ALineAboveTheWorkingLoadMayBeTooShort)
{
  const auto s = contact::space_numbers(roller());
  double load  = 8000;
  while (contact::space_form(s.shape, load, 0) == contact::SpaceForm::line)
    load *= 2;
  EXPECT_TRUE(std::isnan(contact::closed_space(s.shape, contact::SpaceForm::line, load, 0).approach));
  EXPECT_GT(contact::closed_space(s.shape, contact::SpaceForm::line, load / 2, 0).approach, 0);
}
