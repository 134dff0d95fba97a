#include "fem/contact/half_space.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include <cmath>
#include <limits>

namespace mill::contact {
namespace {
// A difference of a primitive between the ends of an interval loses digits with the distance.  From this many
// interval half lengths on, Gauss points in the interval are more exact: the integrand's nearest singularity is
// then so far that n points leave an error of about (2 far)^(-2 n).
constexpr double far = 4;

const GaussRule &fine_rule()
{
  static const GaussRule rule = gauss_legendre(9);  // 8^-18: below round-off at the least distance
  return rule;
}

double asinh_ratio(const double a, const double b)  // asinh(a / |b|), 0 where b = 0 because a factor b follows
{
  return b == 0 ? 0 : std::asinh(a / std::abs(b));
}

KernelIntegrals &add(KernelIntegrals &sum, const double weight, const KernelIntegrals &k)
{
  sum.one += weight * k.one;
  sum.xx += weight * k.xx;
  sum.xy += weight * k.xy;
  sum.x += weight * k.x;
  sum.y += weight * k.y;
  return sum;
}

KernelIntegrals at_point(const double x, const double y)
{
  const double r = std::hypot(x, y), r2 = r * r;
  return {1 / r, x * x / (r2 * r), x * y / (r2 * r), x / r2, y / r2};
}

// Integral over Y from y - b to y + b at one X = x, |x| > 0; every difference written as one term that keeps its
// digits.
KernelIntegrals along_y(const double x, const double y, const double b)
{
  const double v0 = y - b, v1 = y + b;
  const double r0 = std::hypot(x, v0), r1 = std::hypot(x, v1);
  const double one = std::asinh(v1 / std::abs(x)) - std::asinh(v0 / std::abs(x));
  return {one, v1 / r1 - v0 / r0, 4 * b * y * x / (r0 * r1 * (r0 + r1)),
          std::copysign(std::atan2(2 * b * std::abs(x), x * x + v0 * v1), x),
          std::log1p(4 * b * y / (r0 * r0)) / 2};
}

KernelIntegrals exchanged(const KernelIntegrals &k)
{
  return {k.one, k.one - k.xx, k.xy, k.y, k.x};
}

// int X / r^2 over the rectangle:  primitive  Y ln r + X atan(Y / X)
double first_moment(const double x, const double y, const double a, const double b)
{
  const double u[2] = {x - a, x + a}, v[2] = {y - b, y + b};
  double sum = 0;
  for (int j = 0; j < 2; ++j)
    if (v[j] != 0) {
      const double r0 = std::hypot(u[0], v[j]);
      sum += (j ? 1 : -1) * v[j] * std::log1p(4 * a * x / (r0 * r0)) / 2;
    }
  for (int i = 0; i < 2; ++i)
    sum += (i ? 1 : -1) * std::abs(u[i]) * std::atan2(2 * b * std::abs(u[i]), u[i] * u[i] + v[0] * v[1]);
  return sum;
}

KernelIntegrals closed_form(const double x, const double y, const double a, const double b)
{
  const double u[2] = {x - a, x + a}, v[2] = {y - b, y + b};
  KernelIntegrals k{};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double sign = i == j ? 1 : -1;
      const double vx   = v[j] * asinh_ratio(u[i], v[j]);  // primitive of X^2 / r^3
      k.one += sign * (vx + u[i] * asinh_ratio(v[j], u[i]));
      k.xx += sign * vx;
    }
  for (int j = 0; j < 2; ++j)  // primitive -r, its difference over X without cancellation
    k.xy -= (j ? 1 : -1) * 4 * a * x / (std::hypot(u[0], v[j]) + std::hypot(u[1], v[j]));
  k.x = first_moment(x, y, a, b);
  k.y = first_moment(y, x, b, a);
  return k;
}

// --- mean potential of two rectangles

// Primitive of 1 / r, twice over X and twice over Y.
double fourfold(const double u, const double v)
{
  const double r = std::hypot(u, v);
  return u * u * v * asinh_ratio(v, u) / 2 + u * v * v * asinh_ratio(u, v) / 2 - r * r * r / 6;
}

// Primitive of 1 / r, twice over Y.
double twofold(const double u, const double v)
{
  return v * asinh_ratio(v, u) - std::hypot(u, v);
}

// Distribution of the difference of two points, one in each of two intervals: where it has to be sampled, or the
// ends between which a twofold primitive is differenced.
struct Interval {
  double centre, half1, half2;
  double reach() const
  {
    return half1 + half2;
  }
  double nearest() const  // least |difference|
  {
    return std::max(0., std::abs(centre) - reach());
  }
};

// Mean of f(difference) over Gauss points of both intervals.
template <class Function> double sampled_mean(const Interval &i, const bool very_far, const Function &f)
{
  // Relative error 1e-12 of 5 points at the distance `far`, 1e-13 of 3 points at ten times that.
  static const GaussRule near_rule = gauss_legendre(5), far_rule = gauss_legendre(3);
  const GaussRule &rule = very_far ? far_rule : near_rule;
  double sum            = 0;
  for (int k = 0; k < rule.node.size(); ++k)
    for (int l = 0; l < rule.node.size(); ++l)
      sum += rule.weight[k] * rule.weight[l] * f(i.centre + i.half1 * rule.node[k] + i.half2 * rule.node[l]);
  return sum / 4;
}

// The same by the twofold primitive of f.
template <class Primitive> double differenced_mean(const Interval &i, const Primitive &primitive)
{
  const double s = i.half1 + i.half2, d = i.half1 - i.half2;
  return (primitive(i.centre + s) - primitive(i.centre + d) - primitive(i.centre - d) + primitive(i.centre - s)) /
         (4 * i.half1 * i.half2);
}
}  // namespace

Material rigid_material()
{
  return {std::numeric_limits<double>::infinity(), 0, 0};
}

HalfSpaces half_spaces(const Material &body1, const Material &body2)
{
  HalfSpaces sum;
  double sign = 1;
  for (const Material *m : {&body1, &body2}) {
    require_input(m->youngs_modulus > 0, "half space: Young's modulus must be positive");
    require_input(m->poisson_ratio >= 0 && m->poisson_ratio <= 0.5,
                  "half space: the Poisson ratio must be in 0 .. 0.5");
    const double nu = m->poisson_ratio, G = m->youngs_modulus / (2 * (1 + nu));
    sum.normal += (1 - nu) / (2 * M_PI * G);
    sum.along += nu / (2 * M_PI * G);
    sum.coupling += sign * (1 - 2 * nu) / (4 * M_PI * G);
    sign = -1;
  }
  require_input(sum.normal > 0, "half space: two rigid bodies have no contact to compute");
  sum.shear = sum.normal;  // (1 - nu^2) / E = (1 - nu) / (2 G)
  return sum;
}

double contact_modulus(const HalfSpaces &bodies)
{
  return 1 / (M_PI * bodies.normal);
}

KernelIntegrals kernel_integrals(const Rectangle &rectangle, const double x, const double y)
{
  const double a = rectangle.half_x, b = rectangle.half_y;
  require_input(a > 0 && b > 0, "half space: the sides of a loaded rectangle must be positive");
  const GaussRule &rule = fine_rule();
  const bool far_x = std::abs(x) >= far * a, far_y = std::abs(y) >= far * b;
  KernelIntegrals sum{};
  if (far_x && far_y)
    for (int i = 0; i < rule.node.size(); ++i)
      for (int j = 0; j < rule.node.size(); ++j)
        add(sum, a * b * rule.weight[i] * rule.weight[j], at_point(x + a * rule.node[i], y + b * rule.node[j]));
  else if (far_x)
    for (int i = 0; i < rule.node.size(); ++i)
      add(sum, a * rule.weight[i], along_y(x + a * rule.node[i], y, b));
  else if (far_y)
    for (int j = 0; j < rule.node.size(); ++j)
      add(sum, b * rule.weight[j], exchanged(along_y(y + b * rule.node[j], x, a)));
  else
    sum = closed_form(x, y, a, b);
  return sum;
}

namespace {
Eigen::Matrix3d influence(const HalfSpaces &e, const KernelIntegrals &k)
{
  const double yy = k.one - k.xx;
  Eigen::Matrix3d u;
  u << e.shear * k.one + e.along * k.xx, e.along * k.xy, -e.coupling * k.x,  //
      e.along * k.xy, e.shear * k.one + e.along * yy, -e.coupling * k.y,     //
      e.coupling * k.x, e.coupling * k.y, e.normal * k.one;
  return u;
}
}  // namespace

Eigen::Matrix3d rectangle_influence(const HalfSpaces &bodies, const Rectangle &rectangle, const double x,
                                    const double y)
{
  return influence(bodies, kernel_integrals(rectangle, x, y));
}

Eigen::Matrix3d point_influence(const HalfSpaces &bodies, const double x, const double y)
{
  return influence(bodies, at_point(x, y));
}

double mean_potential(const Rectangle &from, const Rectangle &to, const double x, const double y)
{
  const Interval X{x, from.half_x, to.half_x}, Y{y, from.half_y, to.half_y};
  require_input(std::min({X.half1, X.half2, Y.half1, Y.half2}) > 0,
                "half space: the sides of a rectangle must be positive");
  // In one coordinate the singularity stands off by the distance in both.
  const double off_x = std::hypot(x, Y.nearest()) / X.reach(), off_y = std::hypot(y, X.nearest()) / Y.reach();
  const bool far_x = off_x >= far, far_y = off_y >= far;
  const bool very_far_x = off_x >= 10 * far, very_far_y = off_y >= 10 * far;
  const double area = 4 * from.half_x * from.half_y;
  if (far_x && far_y)
    return area * sampled_mean(X, very_far_x, [&](const double u) {
             return sampled_mean(Y, very_far_y, [&](const double v) { return 1 / std::sqrt(u * u + v * v); });
           });
  // Where X passes through 0 the two rectangles are apart in Y: the integrand is even and smooth there, but its
  // primitive holds ln|X|, which only cancels in the differences.
  const auto off_zero = [](const double u, const double other) {
    return std::max(std::abs(u), 1e-9 * std::abs(other));
  };
  if (far_x)
    return area * sampled_mean(X, very_far_x, [&](const double u) {
             return differenced_mean(Y, [&](const double v) { return twofold(off_zero(u, y), v); });
           });
  if (far_y)
    return area * sampled_mean(Y, very_far_y, [&](const double v) {
             return differenced_mean(X, [&](const double u) { return twofold(off_zero(v, x), u); });
           });
  return area * differenced_mean(X, [&](const double u) {
           return differenced_mean(Y, [&](const double v) { return fourfold(u, v); });
         });
}

Eigen::Matrix2d strip_influence(const HalfSpaces &bodies, const double half_width, const double x,
                                const double datum)
{
  require_input(half_width > 0 && datum > 0, "half space: half width and datum of a strip must be positive");
  const double a  = half_width;
  double log_part = 0;  // int ln(datum / |x - s|) ds over the strip
  if (std::abs(x) >= far * a) {
    const GaussRule &rule = fine_rule();
    for (int i = 0; i < rule.node.size(); ++i)
      log_part += a * rule.weight[i] * std::log(datum / std::abs(x + a * rule.node[i]));
  } else {
    const auto primitive = [&](const double s) { return s == 0 ? 0. : s * (1 + std::log(datum / std::abs(s))); };
    log_part             = primitive(x + a) - primitive(x - a);
  }
  const double side = M_PI / 2 * (std::abs(x + a) - std::abs(x - a)) * 2;  // pi int sign(x - s) ds
  Eigen::Matrix2d u;
  u << 2 * bodies.shear * log_part, -bodies.coupling * side,  //
      bodies.coupling * side, 2 * bodies.normal * log_part;
  return u;
}
}  // namespace mill::contact
