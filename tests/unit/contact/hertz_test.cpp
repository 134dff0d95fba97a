#include "core/base/errors.h"
#include "fem/contact/hertz.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::contact;

namespace {
const Material steel{210e9, 0.3, 7850};
const double E = contact_modulus(half_spaces(steel, steel));

// Complete elliptic integrals with complementary modulus kp by the trapezoidal rule in ln(tan), which converges
// exponentially; in extended precision, and not by the mean that the product uses.
struct Integrals {
  long double K, E;
};

Integrals integrals(const long double kp)
{
  Integrals sum{0, 0};
  const long double step = 0.02L;
  for (int i = -2500; i <= 2500; ++i) {
    const long double t = std::exp(i * step), sine = 1 + t * t, root = std::sqrt(1 + kp * kp * t * t);
    sum.K += step * t / (std::sqrt(sine) * root);
    sum.E += step * t * root / (sine * std::sqrt(sine));
  }
  return sum;
}
}  // namespace

TEST(HertzPoint, SatisfiesItsEquationsForAnyRatioOfTheRadii)
{
  for (const double ratio : {1.5, 2., 1e2, 1e4, 1e6, 1e8}) {
    const double P = 1000, R_min = 0.01, R_max = ratio * R_min;
    const PointContact c = hertz_point(P, R_max, R_min, E);
    const long double kp = c.semi_y / c.semi_x, m = 1 - kp * kp;
    const auto [K, L] = integrals(kp);
    EXPECT_TRUE(near(double((L / (kp * kp) - K) / (K - L) / ratio), 1,
                     within(1e-13, "elliptic integrals by their mean, in long double")))
        << ratio;
    EXPECT_TRUE(near(double(1 / (2 * R_max) * 2 * M_PI * std::pow(c.semi_x, 3) * E * m / (3 * P * (K - L))), 1,
                     within(1e-13, "elliptic integrals by their mean, in long double")))
        << ratio;
    EXPECT_TRUE(
        near(double(c.peak_pressure * c.semi_y * K / E) / c.approach, 1, within(1e-14, "closed form, rounding")))
        << ratio;
    EXPECT_TRUE(
        near(2 * M_PI / 3 * c.peak_pressure * c.semi_x * c.semi_y / P, 1, within(1e-14, "closed form, rounding")))
        << ratio;
  }
}

TEST(HertzPoint, EqualRadiiAreTheSphereAndNearlyEqualOnesGoOverIntoIt)
{
  const PointContact c = hertz_point(1000, 0.01, 0.01, E);
  EXPECT_TRUE(
      near(c.semi_x / std::cbrt(3 * 1000 * 0.01 / (4 * E)), 1, within(1e-15, "sphere, closed form, rounding")));
  EXPECT_DOUBLE_EQ(c.semi_x, c.semi_y);
  EXPECT_TRUE(near(c.approach * 0.01 / (c.semi_x * c.semi_x), 1, within(1e-15, "sphere, closed form, rounding")));
  for (const double difference : {1e-15, 1e-9, 1e-5}) {
    const PointContact d = hertz_point(1000, 0.01 * (1 + difference), 0.01, E);
    EXPECT_TRUE(near(d.approach / c.approach, 1,
                     within(difference + 1e-15, "the mean curvature changes by half of the difference")))
        << difference;
    EXPECT_GE(d.semi_x, d.semi_y) << difference;
  }
}

TEST(HertzPoint, AxesGoWithTheirRadii)
{
  const PointContact a = hertz_point(1000, 0.01, 0.03, E), b = hertz_point(1000, 0.03, 0.01, E);
  EXPECT_EQ(a.semi_x, b.semi_y);
  EXPECT_EQ(a.semi_y, b.semi_x);
  EXPECT_LT(a.semi_x, a.semi_y);
  EXPECT_EQ(a.approach, b.approach);
}

TEST(HertzPoint, TangentIsTheSlopeAndTheInverseReturnsTheLoad)
{
  const double P = 2500, h = 1e-4 * P;
  const PointContact c = hertz_point(P, 0.01, 0.3, E);
  const double below   = hertz_point(P - h, 0.01, 0.3, E).approach,
               above   = hertz_point(P + h, 0.01, 0.3, E).approach;
  EXPECT_TRUE(
      near(c.tangent * (above - below) / (2 * h), 1, within(1e-8, "third derivative times the step squared")));
  EXPECT_TRUE(
      near(hertz_point_at(c.approach, 0.01, 0.3, E).load / P, 1, within(1e-13, "root found by Newton, rounding")));
}

TEST(HertzLine, IsTheLimitOfALongEllipse)
{
  // In the middle of a slender ellipse the load per length is that of a line contact with the same half width.
  const PointContact c = hertz_point(1000, 0.01, 1e7, E);
  const double q       = M_PI / 2 * c.peak_pressure * c.semi_x;
  const HertzLine line = hertz_line(q, 0.01, E);
  EXPECT_TRUE(near(line.half_width / c.semi_x, 1,
                   within(1e-6, "ln(axis ratio) / (axis ratio)^2, ratio 4e4 to the power 2/3")));
  EXPECT_TRUE(near(line.peak_pressure / c.peak_pressure, 1,
                   within(1e-6, "ln(axis ratio) / (axis ratio)^2, ratio 4e4 to the power 2/3")));
}

TEST(Cattaneo, TractionCarriesTheTangentialLoadAndEndsAtFriction)
{
  const HertzLine line = hertz_line(1e6, 0.05, E);
  const double mu      = 0.3;
  for (const double ratio : {0., 0.3, 1.}) {
    const PartialSlip slip = cattaneo_line(line, ratio);
    double Q               = 0;
    const int n            = 20000;
    for (int i = 0; i < n; ++i) {
      const double x = line.half_width * (-1 + (2 * i + 1.) / n), t = cattaneo_traction(line, slip, mu, x);
      const double s = x / line.half_width;
      Q += t * 2 * line.half_width / n;
      EXPECT_LE(t, mu * line.peak_pressure * std::sqrt(1 - s * s) * (1 + 1e-12));
    }
    EXPECT_TRUE(near(Q / (mu * 1e6), ratio, within_absolute(1e-6, "midpoint rule, root at the rim: n^-1.5")))
        << ratio;  // midpoint rule, root at the rim: n^-1.5
  }
  EXPECT_EQ(cattaneo_line(line, 1).stick, 0);
}

TEST(Mindlin, StiffnessIsTheFirstSlopeOfTheApproach)
{
  const HalfSpaces pair = half_spaces(steel, steel);
  const PointContact c  = hertz_point(1000, 0.01, 0.01, E);
  const double small    = 1e-7;
  const PartialSlip s   = mindlin_sphere(c, pair, 0.3, small);
  EXPECT_TRUE(near(small * 0.3 * 1000 / s.tangential / s.stiffness, 1,
                   within(1e-6, "first order in the load ratio of 1e-7: a sixth of it")));
  EXPECT_EQ(mindlin_sphere(c, pair, 0.3, 1).stick, 0);
}

TEST(Punches, PressuresCarryTheLoad)
{
  // Substitution r = a sin(t): the integrands become smooth.
  const double a = 0.01, P = 1e4;
  double circle = 0, strip = 0;
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    const double t = M_PI / 2 * (i + 0.5) / n, r = a * std::sin(t), dr = a * std::cos(t) * M_PI / 2 / n;
    circle += circular_punch_pressure(P, a, r) * 2 * M_PI * r * dr;
    strip += 2 * strip_punch_pressure(P, a, r) * dr;
  }
  EXPECT_TRUE(near(circle / P, 1, within(1e-6, "midpoint rule: (pi/2n)^2 / 24")));
  EXPECT_TRUE(near(strip / P, 1, within(1e-12, "midpoint rule on a smooth periodic integrand")));
  EXPECT_TRUE(std::isinf(circular_punch_pressure(P, a, a)));
  EXPECT_EQ(strip_punch_pressure(P, a, -1.01 * a), 0);
  EXPECT_TRUE(near(circular_punch(P, a, E).mean_pressure / circular_punch_pressure(P, a, 0), 2,
                   within(1e-14, "closed form, rounding")));
}

TEST(Hertz, RefusesWhatHasNoContact)
{
  EXPECT_THROW(hertz_point(0, 0.01, 0.01, E), InputError);
  EXPECT_THROW(hertz_point(1, -0.01, 0.01, E), InputError);
  EXPECT_THROW(hertz_point(1, 0.01, std::nan(""), E), InputError);
  EXPECT_THROW(hertz_point_at(0, 0.01, 0.01, E), InputError);
  EXPECT_THROW(hertz_line(1, 0, E), InputError);
  EXPECT_THROW(cylinder_approach(1, 0, 0.001, steel), InputError);
  EXPECT_THROW(cattaneo_line({0.001, 1e9}, 1.1), InputError);
  EXPECT_THROW(mindlin_sphere(hertz_point(1, 0.01, 0.02, E), half_spaces(steel, steel), 0.3, 0.5), InputError);
  EXPECT_THROW(circular_punch(1, 0.01, 0), InputError);
}
