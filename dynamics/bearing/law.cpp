#include "dynamics/bearing/law.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
constexpr double line_contact = 10.0 / 9;

void require_increasing(const char *name, const Eigen::VectorXd &values)
{
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || values[i] <= 0 || (i > 0 && values[i] <= values[i - 1]))
      throw InputError(fmt::format("bearing curve: {} of sample {} is {:g}; every sample has to be positive and "
                                   "larger than the one before",
                                   name, i + 1, values[i]));
}

void require_curve(const BearingCurve &curve)
{
  const Eigen::Index n = curve.displacement.size();
  if (n == 0 || curve.force.size() != n || curve.tangent.size() != n)
    throw InputError(fmt::format("bearing curve: {} displacements, {} forces and {} tangents; as many of each are "
                                 "needed, one at least",
                                 n, curve.force.size(), curve.tangent.size()));
  require_increasing("displacement", curve.displacement);
  require_increasing("force", curve.force);
  for (Eigen::Index i = 0; i < n; ++i)
    if (!std::isfinite(curve.tangent[i]) || curve.tangent[i] <= 0)
      throw InputError(fmt::format("bearing curve: tangent of sample {} is {:g} N/m; a bearing grows stiffer or "
                                   "stays as it is, so it has to be positive",
                                   i + 1, curve.tangent[i]));
}

double start_of(const BearingCurve &curve)
{
  if (std::isnan(curve.clearance))
    return std::max(0.0, curve.displacement[0] - line_contact * curve.force[0] / curve.tangent[0]);
  if (curve.clearance < 0 || curve.clearance >= curve.displacement[0])
    throw InputError(fmt::format("bearing curve: clearance {:g} um has to lie between zero and the displacement "
                                 "{:g} um of the first sample",
                                 1e6 * curve.clearance, 1e6 * curve.displacement[0]));
  return curve.clearance;
}

// Slopes at which a cubic between two rising samples cannot fall: within the circle of radius 3 around zero, in
// units of the chord.
bool limit_slopes(BearingLaw &law)
{
  bool limited = false;
  for (Eigen::Index i = 0; i + 1 < law.exponent.size(); ++i) {
    const double chord = (law.log_force[i + 1] - law.log_force[i]) / (law.log_depth[i + 1] - law.log_depth[i]);
    const double size  = std::hypot(law.exponent[i], law.exponent[i + 1]) / chord;
    if (size <= 3)
      continue;
    limited = true;
    law.exponent.segment(i, 2) *= 3 / size;
  }
  return limited;
}

// Before the first sample.  A power law with its exponent; where that is below one, as for a preloaded bearing
// whose rollers come free one after the other, a power would start with an infinite slope, so a + b e^2 times e
// instead.
ForceAndSlope before_first(const BearingLaw &law, const double depth)
{
  const double first = std::exp(law.log_depth[0]), force = std::exp(law.log_force[0]), n = law.exponent[0];
  const double e = depth / first;
  if (n >= 1) {
    const double f = force * std::pow(e, n);
    return {f, n * f / depth};
  }
  const double a = (3 - n) / 2, b = (n - 1) / 2;
  return {force * e * (a + b * e * e), force / first * (a + 3 * b * e * e)};
}

ForceAndSlope between(const BearingLaw &law, const Eigen::Index i, const double depth)
{
  const double h = law.log_depth[i + 1] - law.log_depth[i], t = (std::log(depth) - law.log_depth[i]) / h;
  const double rise = law.log_force[i + 1] - law.log_force[i];
  const double m0 = h * law.exponent[i], m1 = h * law.exponent[i + 1];
  // Hermite's cubic in the form  y0 + t (m0 + t (c2 + t c3))
  const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
  const double force = std::exp(law.log_force[i] + t * (m0 + t * (c2 + t * c3)));
  return {force, force / depth * (m0 + t * (2 * c2 + 3 * t * c3)) / h};
}

ForceAndSlope after_last(const BearingLaw &law, const double depth)
{
  const Eigen::Index last = law.log_depth.size() - 1;
  const double end = std::exp(law.log_depth[last]), force = std::exp(law.log_force[last]);
  const double tangent = law.exponent[last] * force / end;
  return {force + tangent * (depth - end), tangent};
}
}  // namespace

double BearingLaw::largest() const
{
  return clearance + std::exp(log_depth[log_depth.size() - 1]);
}

BearingLaw bearing_law(const BearingCurve &curve)
{
  require_curve(curve);
  BearingLaw law;
  law.clearance              = start_of(curve);
  const Eigen::ArrayXd depth = curve.displacement.array() - law.clearance;
  law.log_depth              = depth.log();
  law.log_force              = curve.force.array().log();
  law.exponent               = curve.tangent.array() * depth / curve.force.array();
  law.limited                = limit_slopes(law);
  return law;
}

ForceAndSlope force_at(const BearingLaw &law, const double displacement)
{
  const double depth = displacement - law.clearance;
  if (depth <= 0)
    return {0, 0};
  const double place = std::log(depth);
  const auto *first = law.log_depth.data(), *end = first + law.log_depth.size();
  const auto above = std::upper_bound(first, end, place);
  if (above == first)
    return before_first(law, depth);
  if (above == end)
    return after_last(law, depth);
  return between(law, above - first - 1, depth);
}

double displacement_under(const BearingLaw &law, const double load)
{
  if (load <= 0)
    return law.clearance;
  double low = law.clearance, high = law.largest();
  while (force_at(law, high).force < load)
    high += high - low;
  // Newton inside a bracket: the force rises everywhere, so the root is unique.
  double d = high;
  for (int i = 0; i < 200 && high - low > 4e-16 * high; ++i) {
    const ForceAndSlope force         = force_at(law, d);
    (force.force < load ? low : high) = d;
    const double next                 = d - (force.force - load) / force.tangent;
    if (std::abs(next - d) <= 1e-15 * d)
      break;
    d = next > low && next < high ? next : 0.5 * (low + high);
  }
  return d;
}
}  // namespace mill::dynamics
