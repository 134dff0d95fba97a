#include "app/contact_slope.h"
#include "core/errors.h"
#include "reduce/contact_stiffness.h"
#include <cmath>
#include <optional>

namespace mill {
namespace {
// Nothing where it is no line contact: a crown is being closed, or only the ends touch.
std::optional<reduce::ContactStiffness> fitted(const ContactCurve &curve, const double load,
                                               const double worst_fit = 1e-3)
{
  try {
    return reduce::contact_stiffness(curve, load, worst_fit);
  } catch (const SolverError &) {
    return std::nullopt;
  }
}
}  // namespace

ContactSlope slope_at(const fem::ContactPair &pair, const ContactCurve &curve, const double load, const Role role)
{
  const auto point = fem::solve_load(pair, load);
  const auto fit   = fitted(curve, load, role == Role::companion ? 1e-2 : 1e-3);
  return {fit ? fit->tangent : point.tangent, load / point.approach, point.tangent,
          fit ? fit->curvature : not_given};
}

ContactSlope slope_of(const ContactCurve &curve, const double load)
{
  if (const auto fit = fitted(curve, load))
    return {fit->tangent, fit->secant, not_given, fit->curvature};
  // Straight between the samples, over the logarithm of the load.
  Eigen::Index i = 0;
  while (i + 2 < curve.load.size() && curve.load[i + 1] < load)
    ++i;
  const double t = std::log(load / curve.load[i]) / std::log(curve.load[i + 1] / curve.load[i]);
  const auto at  = [&](const Eigen::VectorXd &v) { return v[i] + t * (v[i + 1] - v[i]); };
  return {at(curve.tangent), at(curve.secant), not_given, not_given};
}

double difference(const double other, const double value)
{
  return std::abs(other / value - 1);
}
}  // namespace mill
