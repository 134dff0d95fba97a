#include "core/numerics/mesh_pair.h"
#include "core/numerics/root_search.h"
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

// The stated error of a point contact contains the distance to its closed form, so what is tested is what both
// grids say without it, and the distance itself.
// @param most  -, distance that 12 rectangles over a half axis may have
void expect_covered(const contact::SpaceNumber &number, const double closed, const double most, const char *name)
{
  const double by_grids = mesh_pair_error(number.value, number.coarse, 2);
  EXPECT_GT(by_grids, 0) << name;
  EXPECT_TRUE(near(number.value, closed, within(by_grids, "first order on grids of 12 and 6 rectangles"))) << name;
  EXPECT_TRUE(near(number.value, closed, within(most, "12 rectangles over a half axis"))) << name;
  EXPECT_TRUE(near(number.error, std::max(by_grids, std::abs(closed / number.value - 1)),
                   within(1e-9, "the larger of both, rounding")))
      << name;
}
}  // namespace

TEST(BodyNumbers, LineIsThatOfHertz)
{
  const auto pair   = line_pair();
  const auto fine   = contact::half_plane_values(pair, pair.contact.at, true),
             coarse = contact::half_plane_values(pair, pair.contact.at, false);
  const auto error  = contact::line_errors(fine, coarse, pair.contact.at, not_given, 2);
  const double R = 0.2 * 0.3 / 0.5, q = pair.contact.at, b = std::sqrt(4 * q * R / (M_PI * modulus));
  EXPECT_LT(error.half_width, 0.01);
  EXPECT_TRUE(near(fine.half_width, b, within(error.half_width, "its own stated error")));
  EXPECT_TRUE(near(fine.peak_pressure, 2 * q / (M_PI * b), within(error.peak_pressure, "its own stated error")));
  const auto wrong = contact::line_errors(fine, coarse, pair.contact.at, 1.1 * fine.tangent, 2);
  EXPECT_TRUE(near(wrong.tangent, 0.1, within(1e-9, "another slope is the error, rounding")));
  auto heavier = fine;
  heavier.peak_pressure *= 1.05;
  const double misfit = std::abs(0.5 * M_PI * heavier.half_width * heavier.peak_pressure / q - 1);
  EXPECT_TRUE(near(contact::line_errors(heavier, heavier, q, not_given, 2).half_width, misfit,
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
  expect_covered(s.half_width, a, 0.01, "half width");
  expect_covered(s.length, 2 * a, 0.01, "length");
  expect_covered(s.peak_pressure, 1.5 * P / (M_PI * a * a), 0.01, "pressure");
  expect_covered(s.approach, a * a / R, 0.01, "approach");
  expect_covered(s.tangent, 2 * modulus * a, 0.01, "tangent");
  expect_covered(s.secant, P * R / (a * a), 0.01, "secant");
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

// What a slip grid says is within its stated error of a finer one, also where stuck cells are whole.
TEST(BodyNumbers, SlipOfUnlikeBallsIsWithinItsErrorOfAFinerGrid)
{
  auto pair                  = balls();
  pair.lower.youngs_modulus  = 70e9;
  pair.space.tangential_load = 250;
  const auto s               = contact::space_numbers(pair);
  const auto slip            = contact::space_slip(pair, s);
  ASSERT_TRUE(slip.coupled);
  EXPECT_GE(slip.stick.error, 0.5 * slip.fine.contact.width / slip.stick.value)
      << "half the width of a row of whole cells, on both sides of its middle";
  const auto finer     = contact::slip_in_space(s.shape, pair.space, s.fine, 15);
  const auto its_error = [](const contact::SpaceNumber &number) {
    return within(number.error, "its stated error, which the finer grid is to lie in");
  };
  EXPECT_TRUE(near(finer.stick_half_width, slip.stick.value, its_error(slip.stick)));
  EXPECT_TRUE(near(finer.displacement, slip.displacement.value, its_error(slip.displacement)));
  EXPECT_TRUE(near(finer.first_stiffness, slip.first.value, its_error(slip.first)));
  EXPECT_TRUE(near(finer.tangent, slip.tangent.value, its_error(slip.tangent)));
}

// The grids are 16 and 10 cells, of unlike materials 12 and 8: an error of the first order is the difference over
// 0.6 and over 0.5.
TEST(BodyNumbers, ErrorsOfSlipAreThoseOfTheRatioOfTheGrids)
{
  for (const bool unlike : {false, true}) {
    auto pair = balls();
    if (unlike)
      pair.lower.youngs_modulus = 70e9;
    const auto slip = contact::space_slip(pair, contact::space_numbers(pair));
    EXPECT_TRUE(
        near(slip.displacement.error,
             1.25 * std::abs(slip.displacement.coarse / slip.displacement.value - 1) / (unlike ? 0.5 : 0.6),
             within(1e-9, "(1.5), rounding")))
        << unlike;
  }
}

TEST(BodyNumbers, StuckStripsOfUnlikeMaterialsAreWhole)
{
  auto pair                 = line_pair();
  pair.lower.youngs_modulus = 70e9;
  const auto slip           = contact::half_plane_slip(pair);
  const double strip        = slip.width.x[1] - slip.width.x[0];
  const double by_grids     = mesh_pair_error(slip.value.stick, slip.coarse.stick, 161. / 81);
  EXPECT_TRUE(near(slip.error.stick, by_grids + 0.5 * strip / slip.value.stick,
                   within(1e-9, "half the width of whole strips, rounding")));
}

// A straight roller under a tilt that lifts one end off: its length is of whole rows, of which the last one is not
// known.  On a face that carries everywhere nothing is open.
TEST(BodyNumbers, ALengthOfWholeRowsIncludesOneInItsError)
{
  auto pair          = roller();
  pair.upper.profile = EndProfile::none;
  pair.space.at      = 500;
  pair.space.tilt    = 2e-4;
  const auto lifted  = contact::space_numbers(pair);
  ASSERT_LT(lifted.length.value, 0.95 * pair.upper.length);
  const auto &z     = lifted.fine.grid.z;
  const double end  = 0.5 * pair.upper.length - lifted.length.value;  // the loaded side is that of positive z
  Eigen::Index last = 0;
  (z.array() - end).abs().minCoeff(&last);
  EXPECT_TRUE(near(z[last], end, within_absolute(1e-9, "an edge of the grid, rounding")));
  const double by_grids = mesh_pair_error(lifted.length.value, lifted.length.coarse, 2);
  EXPECT_TRUE(near(lifted.length.error, by_grids + (z[last + 1] - z[last]) / lifted.length.value,
                   within(1e-9, "the first loaded row, rounding")));
  pair.space.tilt  = 0;
  const auto whole = contact::space_numbers(pair);
  EXPECT_TRUE(near(whole.length.value, pair.upper.length, within(1e-9, "both ends, rounding")));
  EXPECT_TRUE(near(whole.length.error, 0, within(1e-9, "nothing is open, rounding", 1)));
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
// A crowned roller: below a load the faces do not cut the ellipse, whatever the working load was.
TEST(BodyNumbers, AClosedFormHoldsAtItsOwnLoadsOnly)
{
  auto pair               = roller();
  pair.upper.profile      = EndProfile::none;
  pair.upper.crown_radius = 1;
  const auto shape        = contact::space_shape(pair);
  const auto border       = border_between(1., 1e6, [&](const double load) { return shape.is_point(load, 0); });
  const auto semi         = contact::hertz_point(border.holds, shape.radius, 1, shape.modulus).semi_y;
  ASSERT_TRUE(near(semi, 0.5 * pair.upper.length, within(1e-9, "the ellipse is as long as the face, by halves")));
  const double below = 0.9 * border.holds, above = 1.1 * border.fails;
  using contact::SpaceForm;
  EXPECT_TRUE(near(contact::closed_space(shape, SpaceForm::point, below, 0).approach,
                   contact::hertz_point(below, shape.radius, 1, shape.modulus).approach,
                   within(1e-12, "the same formula")));
  EXPECT_TRUE(std::isnan(contact::closed_space(shape, SpaceForm::point, above, 0).approach));
  EXPECT_TRUE(std::isnan(contact::closed_space(shape, SpaceForm::line, below, 0).approach));
  EXPECT_GT(contact::closed_space(shape, SpaceForm::line, above, 0).approach, 0);
}

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
