#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include "fem/contact/half_space.h"
#include "fem/contact/half_space_contact.h"
#include "fem/contact/hertz.h"
#include "fem/contact/row_refinement.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

using namespace mill;
using namespace mill::contact;

namespace {
const Material steel{210e9, 0.3, 7850}, aluminium{70e9, 0.33, 2700};

KernelIntegrals sum(const KernelIntegrals &a, const double factor, const KernelIntegrals &b)
{
  return {a.one + factor * b.one, a.xx + factor * b.xx, a.xy + factor * b.xy, a.x + factor * b.x,
          a.y + factor * b.y};
}

// Rectangle from the origin to (u, v), loaded, seen from the origin, in polar coordinates: the kernels are of
// degree -1, so that the integral over the radius is its length, and one over the angle remains.
KernelIntegrals corner_by_quadrature(const double u, const double v)
{
  static const GaussRule rule = gauss_legendre(40);
  KernelIntegrals k{};
  if (u == 0 || v == 0)
    return k;
  const double diagonal = std::atan2(std::abs(v), std::abs(u));
  const auto add        = [&](const double from, const double to, const bool side) {
    // In s = asinh(tan) of the angle from the axis that the side stands across, the length is smooth even for
    // slender sides.
    const double distance = side ? std::abs(u) : std::abs(v);
    const double s0 = std::asinh(std::tan(from)), s1 = std::asinh(std::tan(to));
    for (int i = 0; i < rule.node.size(); ++i) {
      const double s = (s0 + s1) / 2 + (s1 - s0) / 2 * rule.node[i];
      const double t = std::sinh(s), length = distance * std::sqrt(1 + t * t),
                   angle  = 1 / (1 + t * t) * std::cosh(s);
      const double weight = (s1 - s0) / 2 * rule.weight[i] * length * angle;
      const double along = 1 / std::sqrt(1 + t * t), across = t / std::sqrt(1 + t * t);
      const double c = std::copysign(side ? along : across, u), w = std::copysign(side ? across : along, v);
      k = sum(k, weight, {1, c * c, c * w, c, w});
    }
  };
  add(0, diagonal, true);
  add(0, M_PI / 2 - diagonal, false);
  return k;
}

// The vector (X, Y) points from the load to the point: from x + a to x - a.
KernelIntegrals by_quadrature(const Rectangle &r, const double x, const double y)
{
  KernelIntegrals k{};
  for (const double i : {-1., 1.})
    for (const double j : {-1., 1.}) {
      const double u = x + i * r.half_x, v = y + j * r.half_y;
      k = sum(k, i * j * std::copysign(1., u) * std::copysign(1., v), corner_by_quadrature(u, v));
    }
  return k;
}

void expect_equal(const KernelIntegrals &a, const KernelIntegrals &b, const double tolerance,
                  const std::string &what)
{
  // All are of the size of `one`; x and y are dimensionless in the same way.
  EXPECT_TRUE(near(a.one, b.one,
                   within_absolute(tolerance * b.one, "accuracy stated by the caller, of the largest integral")))
      << what;
  EXPECT_TRUE(near(a.xx, b.xx,
                   within_absolute(tolerance * b.one, "accuracy stated by the caller, of the largest integral")))
      << what;
  EXPECT_TRUE(near(a.xy, b.xy,
                   within_absolute(tolerance * b.one, "accuracy stated by the caller, of the largest integral")))
      << what;
  EXPECT_TRUE(
      near(a.x, b.x, within_absolute(tolerance * b.one, "accuracy stated by the caller, of the largest integral")))
      << what;
  EXPECT_TRUE(
      near(a.y, b.y, within_absolute(tolerance * b.one, "accuracy stated by the caller, of the largest integral")))
      << what;
}

std::string at(const Rectangle &r, const double x, const double y)
{
  return "rectangle " + std::to_string(r.half_x) + " x " + std::to_string(r.half_y) + " at " + std::to_string(x) +
         ", " + std::to_string(y);
}
}  // namespace

TEST(KernelIntegrals, AgreeWithQuadratureInsideOnTheEdgeAndNear)
{
  for (const Rectangle r : {Rectangle{1, 1}, Rectangle{1, 30}, Rectangle{5, 0.2}})
    for (const auto &[fx, fy] :
         {std::pair{0., 0.}, {0.3, -0.7}, {1., 0.4}, {1., 1.}, {-1., 1.}, {2.5, 0.1}, {-3.9, 3.9}, {0., 2.}}) {
      const double x = fx * r.half_x, y = fy * r.half_y;
      expect_equal(kernel_integrals(r, x, y), by_quadrature(r, x, y), 1e-12, at(r, x, y));
    }
}

TEST(KernelIntegrals, LoseNoDigitsFarAway)
{
  // The sum over 3 x 7 parts has 21 other centres, and each part is seven times as far.
  for (const Rectangle r : {Rectangle{1, 1}, Rectangle{1, 100}})
    for (const auto &[x, y] :
         {std::pair{1e3, 0.}, {0.5, 1e3}, {1e3, -2e3}, {4.1, 0.2}, {30., 300.}, {-1e6, 1e6}}) {
      KernelIntegrals parts{};
      const Rectangle part{r.half_x / 3, r.half_y / 7};
      for (int i = -1; i <= 1; ++i)
        for (int j = -3; j <= 3; ++j)
          parts = sum(parts, 1, kernel_integrals(part, x - 2 * i * part.half_x, y - 2 * j * part.half_y));
      expect_equal(kernel_integrals(r, x, y), parts, 1e-13, at(r, x, y));
    }
}

TEST(KernelIntegrals, BecomeThePointLoadWithTheRightQuadrupole)
{
  const Rectangle r{1, 1};
  const double x = 1e3, y = 0;
  const KernelIntegrals k = kernel_integrals(r, x, y);
  const double area = 4, second = 1. / 3;  // mean square of a coordinate
  // 1/r: mean of (2 X^2 - Y^2) / 2 x^5 terms, on the axis (2 - 1) / 2 of the second moment
  EXPECT_TRUE(near(k.one / (area / x), 1 + second / (2 * x * x),
                   within(1e-12, "next term of the series is of order x^-4 = 1e-12")));
  EXPECT_TRUE(near(k.x / (area / x), 1, within(1e-12, "X / r^2 is harmonic, and the moments of a square cancel")));
  EXPECT_EQ(k.xy, 0);
}

TEST(KernelIntegrals, DoNotJumpWhereTheFormulaChanges)
{
  const Rectangle r{1, 2};
  for (const auto &[x, y] : {std::pair{4., 0.3}, {0.3, 8.}, {4., 8.}}) {
    const double e = 1e-14;
    expect_equal(kernel_integrals(r, x * (1 - e), y * (1 - e)), kernel_integrals(r, x * (1 + e), y * (1 + e)),
                 1e-12, at(r, x, y));
  }
}

TEST(Influence, IsReciprocal)
{
  const HalfSpaces pair = half_spaces(steel, aluminium);
  const Rectangle r{0.001, 0.002};
  const Eigen::Matrix3d there = rectangle_influence(pair, r, 0.004, -0.003),
                        back  = rectangle_influence(pair, r, -0.004, 0.003);
  EXPECT_TRUE(
      near((there - back.transpose()).norm() / there.norm(), 0, within_absolute(1e-14, "reciprocity, rounding")));
  EXPECT_GT(std::abs(there(2, 0)), 1e-3 * there(2, 2));
}

TEST(Influence, TurnsWithTheAxes)
{
  const HalfSpaces pair   = half_spaces(steel, rigid_material());
  const Eigen::Matrix3d a = rectangle_influence(pair, {0.001, 0.002}, 0.004, -0.003);
  const Eigen::Matrix3d b = rectangle_influence(pair, {0.002, 0.001}, 0.003, 0.004);
  Eigen::Matrix3d turn;  // a quarter turn: (x, y) -> (-y, x)
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(near((turn * a * turn.transpose() - b).norm() / a.norm(), 0,
                   within_absolute(1e-14, "symmetry of a turned frame, rounding")));
}

TEST(Influence, IsZeroAcrossForEqualBodiesAndAddsUp)
{
  const HalfSpaces equal = half_spaces(steel, steel);
  EXPECT_EQ(equal.coupling, 0);
  const HalfSpaces one = half_spaces(steel, rigid_material()), other = half_spaces(rigid_material(), aluminium),
                   both = half_spaces(steel, aluminium);
  EXPECT_TRUE(near((one.normal + other.normal) / both.normal, 1, within(1e-15, "sum of two fractions, rounding")));
  EXPECT_TRUE(near((one.coupling + other.coupling) / both.coupling, 1,
                   within(1e-14, "difference of two fractions, rounding")));
  EXPECT_GT(one.coupling, 0);
  EXPECT_LT(other.coupling, 0);
  // (1 - nu^2) / E of both bodies
  EXPECT_TRUE(near(contact_modulus(both) * (0.91 / 210e9 + (1 - 0.33 * 0.33) / 70e9), 1,
                   within(1e-14, "product of short numbers, rounding")));
}

TEST(Influence, OfALongRectangleIsThatOfAStrip)
{
  // Only differences: the displacement of a strip has no zero of its own.  Ends at 1e8 half widths leave x / 1e8.
  const HalfSpaces pair = half_spaces(steel, rigid_material());
  const Rectangle r{1, 1e8};
  const auto line  = [&](const double x) { return strip_influence(pair, 1, x, 1); };
  const auto plane = [&](const double x) {
    const Eigen::Matrix3d u = rectangle_influence(pair, r, x, 0);
    return (Eigen::Matrix2d() << u(0, 0), u(0, 2), u(2, 0), u(2, 2)).finished();
  };
  for (const double x : {0.5, 1., 3.9, 4.1, 10.}) {
    const Eigen::Matrix2d a = line(x) - line(0), b = plane(x) - plane(0);
    EXPECT_TRUE(near(
        (a - b).norm() / b.norm(), 0,
        within_absolute(
            1e-6, "ends at 1e8 half widths leave x / 1e8, and the difference of two logarithms its rounding")))
        << x;
  }
}

TEST(Influence, RefusesInvalidBodiesAndRectangles)
{
  EXPECT_THROW(half_spaces(rigid_material(), rigid_material()), InputError);
  EXPECT_THROW(half_spaces({-1, 0.3, 0}, steel), InputError);
  EXPECT_THROW(half_spaces({1e9, 0.51, 0}, steel), InputError);
  EXPECT_THROW(kernel_integrals({0, 1}, 0, 0), InputError);
  EXPECT_THROW(mean_potential({1, 1}, {1, -1}, 0, 0), InputError);
  EXPECT_THROW(strip_influence(half_spaces(steel, steel), 0, 0, 1), InputError);
}

TEST(MeanPotential, OfASquareOnItselfIsTheKnownOne)
{
  // Unit square: 4 (ln(1 + sqrt 2) - (sqrt 2 - 1) / 3)
  const double known = 4 * (std::log(1 + std::sqrt(2.)) - (std::sqrt(2.) - 1) / 3);
  EXPECT_TRUE(near(mean_potential({0.5, 0.5}, {0.5, 0.5}, 0, 0), known,
                   within_absolute(1e-13, "closed form of the unit square, rounding")));
}

TEST(MeanPotential, IsTheMeanOfTheKernelAndSymmetric)
{
  for (const auto &[a, b] : {std::pair{Rectangle{1, 1}, Rectangle{1, 1}},
                             {Rectangle{1, 20}, Rectangle{1, 3}},
                             {Rectangle{1, 3}, Rectangle{0.5, 40}}})
    for (const auto &[fx, fy] :
         {std::pair{1.05, 0.}, {3., 1.5}, {0., 1.05}, {6., 0.}, {0., 4.}, {50., 0.3}, {50., 50.}}) {
      const double x = fx * (a.half_x + b.half_x), y = fy * (a.half_y + b.half_y);
      // In 40 x 40 parts, so that the points near the edge of the other rectangle are dense.
      double mean = 0;
      const int n = 40;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (const double s : {-1 / std::sqrt(3.), 1 / std::sqrt(3.)})
            for (const double t : {-1 / std::sqrt(3.), 1 / std::sqrt(3.)})
              mean += kernel_integrals(a, x + b.half_x * ((2 * i + 1 + s) / n - 1),
                                       y + b.half_y * ((2 * j + 1 + t) / n - 1))
                          .one /
                      (4 * n * n);
      const double m = mean_potential(a, b, x, y);
      EXPECT_TRUE(near(m / mean, 1, within(5e-5, "the two-point rule in 40 parts, next to an edge")))
          << at(b, x, y);  // the two-point rule in 40 parts, next to an edge
      EXPECT_TRUE(near(mean_potential(b, a, -x, -y) * a.half_x * a.half_y / (m * b.half_x * b.half_y), 1,
                       within(1e-11, "reciprocity: differences of the fourfold primitive cost digits")))
          << at(b, x, y);
    }
}

TEST(MeanPotential, DoesNotJumpWhereTheRuleChanges)
{
  const Rectangle a{1, 1};
  for (const double x : {8., 80., 8.2, 82.}) {
    const double below = mean_potential(a, a, x * (1 - 1e-13), 0),
                 above = mean_potential(a, a, x * (1 + 1e-13), 0);
    EXPECT_TRUE(
        near(above / below, 1, within(3e-12, "the closed form goes over into the series: their common digits")))
        << x;
  }
}

// --- grids, fits and the engine

TEST(GradedEdges, EndWithTheStepAskedForAndGrowTowardsTheMiddle)
{
  const Eigen::VectorXd z    = graded_edges(0.02, 1e-3, 5e-5, 1.3);
  const Eigen::Index n       = z.size() - 1;
  const Eigen::VectorXd step = z.tail(n) - z.head(n);
  EXPECT_EQ(z[0], 0);
  EXPECT_EQ(z[n], 0.02);
  EXPECT_TRUE(near(step[n - 1], 5e-5, within_absolute(1e-15, "m, the length at the end is asked for")));
  for (Eigen::Index i = 1; i + 1 < n; ++i)  // the first takes what is left
    EXPECT_LE(step[i + 1], step[i] * (1 + 1e-9));
  EXPECT_LE(step.maxCoeff(), 1.5e-3 * (1 + 1e-9));
  EXPECT_THROW(graded_edges(0.02, 1e-3, 0, 1.3), InputError);
}

TEST(FitPressure, IsExactForASemiEllipseAndNanWithoutOne)
{
  std::vector<double> x, p;
  for (int i = 0; i < 8; ++i) {
    x.push_back(0.1 * (i + 0.5));
    p.push_back(3e8 * std::sqrt(1 - x.back() * x.back()));
  }
  p.back() *= 0.5;  // the outermost does not count
  const PressureFit fit = fit_pressure(x, p);
  EXPECT_TRUE(near(fit.half_width, 1, within(1e-13, "exact data, rounding of a least-squares fit")));
  EXPECT_TRUE(near(fit.peak / 3e8, 1, within(1e-13, "exact data, rounding of a least-squares fit")));
  EXPECT_TRUE(std::isnan(fit_pressure({1, 2, 3}, {3, 2, 1}).peak));
  EXPECT_TRUE(std::isnan(fit_pressure({1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}).half_width));
}

namespace {
const HalfSpaces pair = half_spaces(steel, steel);
const GapShape sphere = [](const double x, const double z) { return (x * x + z * z) / 0.02; };

HalfSpaceContact small_sphere(const int n)
{
  const double a = hertz_point(1000, 0.01, 0.01, contact_modulus(pair)).semi_x;
  return {pair, {1.2 * a / n, n, Eigen::VectorXd::LinSpaced(n + 1, 0, 1.2 * a)}, sphere};
}
}  // namespace

TEST(HalfSpaceContact, CarriesTheLoadOnAllFourQuarters)
{
  HalfSpaceContact contact = small_sphere(10);
  const HalfSpaceState s   = contact.at_load(1000);
  const double step        = s.z[1] - s.z[0];
  EXPECT_TRUE(near(2 * s.line_load.sum() * step / 1000, 1,
                   within(1e-13, "the load is a constraint of the system, rounding")));
  EXPECT_TRUE(near((s.pressure - s.pressure.transpose()).norm() / s.pressure.norm(), 0,
                   within_absolute(1e-12, "x and z are alike: the same sums in another order")));
  EXPECT_EQ(s.n_unknowns, 100);
  EXPECT_FALSE(s.reaches_end);
  EXPECT_LE(s.residual, 1e-12);
}

TEST(HalfSpaceContact, ConvergesAtSecondOrder)
{
  const PointContact hertz = hertz_point(1000, 0.01, 0.01, contact_modulus(pair));
  const auto error         = [&](const int n) {
    return std::abs(small_sphere(n).at_load(1000).approach / hertz.approach - 1);
  };
  // The boundary of the contact falls differently on each grid, so the bound is c / n^2 with the constant of none.
  for (const int n : {6, 12, 24})
    EXPECT_LT(error(n), 0.1 / (n * n)) << n;
}

TEST(HalfSpaceContact, OperatorIsTheSameContactOnAnyRows)
{
  // Rows of uneven length: pressures move to other places, the approach hardly.
  const double a = hertz_point(1000, 0.01, 0.01, contact_modulus(pair)).semi_x;
  const int n    = 20;
  HalfSpaceContact uneven(pair, {1.2 * a / n, n, graded_edges(1.2 * a, a / 10, a / 40, 1.2)}, sphere);
  EXPECT_TRUE(near(uneven.at_load(1000).approach / small_sphere(n).at_load(1000).approach, 1,
                   within(2e-4, "two grids of one sphere: second order")));
}

TEST(HalfSpaceContact, SmoothTangentLiesAmongTheSteps)
{
  const PointContact hertz = hertz_point(1000, 0.01, 0.01, contact_modulus(pair));
  HalfSpaceContact contact = small_sphere(12);
  EXPECT_TRUE(near(contact.tangent(1000) / hertz.tangent, 1, within(1e-3, "parabola through nine loads")));
  EXPECT_TRUE(near(contact.at_load(1000).set_tangent / hertz.tangent, 1,
                   within(2e-2, "steps of a set of some hundred rectangles")));
}

TEST(HalfSpaceContact, BothSidesAreTheQuarterTwice)
{
  const double a = hertz_point(1000, 0.01, 0.01, contact_modulus(pair)).semi_x;
  const int n    = 10;
  const auto on  = [&](const GapShape &gap) {
    QuarterGrid both{1.2 * a / n, n, Eigen::VectorXd::LinSpaced(2 * n + 1, -1.2 * a, 1.2 * a)};
    both.half = true;
    return HalfSpaceContact(pair, both, gap).at_load(1000);
  };
  const HalfSpaceState half = on(sphere), quarter = small_sphere(n).at_load(1000);
  EXPECT_TRUE(near(half.approach / quarter.approach, 1,
                   within(1e-11, "one contact, half and quarter: the same sums in another order")));
  EXPECT_TRUE(near(half.set_tangent / quarter.set_tangent, 1,
                   within(1e-11, "one contact, half and quarter: the same sums in another order")));
  EXPECT_TRUE(
      near(half.moment / (1000 * a), 0, within_absolute(1e-12, "without tilt there is no moment, rounding")));
  // A tilted sphere rolls: the contact is one row further along, the same to the last digits, and its moment that
  // of the load there.
  const double step           = 0.12 * a;
  const HalfSpaceState rolled = on([&](const double x, const double z) { return sphere(x, z) - step / 0.01 * z; });
  EXPECT_TRUE(
      near(rolled.moment / (1000 * step), 1, within(1e-9, "a crown that rolls by whole rows is the same system")));
  EXPECT_TRUE(near((rolled.approach + step * step / 0.02) / quarter.approach, 1,
                   within(1e-9, "a crown that rolls by whole rows is the same system")));
}

TEST(HalfSpaceContact, ReportsInvalidInput)
{
  const QuarterGrid narrow{1e-5, 10, Eigen::VectorXd::LinSpaced(11, 0, 1e-3)};  // 0.1 mm for a contact of 0.4 mm
  EXPECT_THROW(HalfSpaceContact(pair, narrow, sphere).at_load(1000), SolverError);
  EXPECT_THROW(HalfSpaceContact(pair, narrow, sphere).at_load(0), InputError);
  EXPECT_THROW(HalfSpaceContact(pair, {1e-5, 0, narrow.z}, sphere), InputError);
  EXPECT_THROW(HalfSpaceContact(pair, {1e-5, 3, Eigen::Vector3d(0, 2, 1)}, sphere), InputError);
  const GapShape nothing = [](double, double) { return std::numeric_limits<double>::infinity(); };
  EXPECT_THROW(HalfSpaceContact(pair, narrow, nothing), InputError);
}

TEST(SingularEnd, IsThatOfASharpEdgeOnly)
{
  // A roller whose end is sharp, the same with the ends relieved by 10 um over the last 2 mm, and a sphere.
  const GapShape sharp    = [](const double x, double) { return x * x / 0.025; };
  const GapShape relieved = [](const double x, const double z) {
    const double beyond = std::max(0., z - 3e-3);
    return x * x / 0.025 + 10e-6 * std::pow(beyond / 2e-3, 2);
  };
  const QuarterGrid grid{2.5e-5, 20, graded_edges(5e-3, 5e-4, 1e-4, 1.3)};
  EXPECT_TRUE(has_singular_end(pair, grid, sharp, 2000));
  EXPECT_FALSE(has_singular_end(pair, grid, relieved, 2000));
  EXPECT_FALSE(has_singular_end(pair, {5e-5, 20, Eigen::VectorXd::LinSpaced(11, 0, 1e-3)}, sphere, 1000));
}

namespace {
// Rows of a roller of 20 mm whose last 2 mm are rounded by 20 um; the largest line load over the mean.
double largest_line_load(const Eigen::VectorXd &rows)
{
  const double load = 10e3, length = 0.02, arc = 2e-3;
  const GapShape rounded = [&](const double x, const double z) {
    if (z > length / 2)
      return std::numeric_limits<double>::infinity();
    const double beyond = std::max(0., z - length / 2 + arc) / arc;
    return x * x / 0.025 + 20e-6 * beyond * beyond;
  };
  const double half_width = hertz_line(load / length, 0.0125, contact_modulus(pair)).half_width;
  QuarterGrid grid{half_width / 6, 12, rows};
  for (int round = 0; round < 6; ++round) {
    const HalfSpaceState state = HalfSpaceContact(pair, grid, rounded).at_load(load);
    const Eigen::VectorXd next = refined_rows(grid, state, 0.04, 5e-5);
    if (next.size() == grid.z.size())
      return state.line_load.maxCoeff() / (load / length);
    grid.z = next;
  }
  return HalfSpaceContact(pair, grid, rounded).at_load(load).line_load.maxCoeff() / (load / length);
}
}  // namespace

TEST(RefinedRows, FindTheLineLoadWhereARoundingBegins)
{
  const double from_graded = largest_line_load(graded_edges(0.01, 8e-4, 5e-5, 1.4)),
               from_even   = largest_line_load(Eigen::VectorXd::LinSpaced(101, 0, 0.01));
  EXPECT_TRUE(near(from_graded, from_even,
                   within(0.01, "two grids that share no row; a quarter of the largest bend of 4 %")));
}
