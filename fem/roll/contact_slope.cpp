#include "fem/roll/contact_slope.h"
#include "core/base/errors.h"
#include "reduce/chain/contact_stiffness.h"
#include <cmath>
#include <optional>

namespace mill::fem {
namespace {
constexpr double worst_result    = 1e-3;  // a smooth sweep reaches 1e-5
constexpr double worst_companion = 1e-2;  // steps of a mesh twice as coarse, still a line contact

// Nothing where it is not a line contact: a crown is being closed, or only the ends touch.
std::optional<reduce::ContactStiffness> fitted(const ContactCurve &curve, const double load,
                                               const double worst_fit = worst_result)
{
  try {
    return reduce::contact_stiffness(curve, load, worst_fit);
  } catch (const SolverError &) {
    return std::nullopt;
  }
}
}  // namespace

ContactSlope slope_at(const ContactPair &pair, const ContactCurve &curve, const double load, const Role role)
{
  const auto point = solve_load(pair, load);
  const auto fit   = fitted(curve, load, role == Role::companion ? worst_companion : worst_result);
  // The steps of a coarse mesh leave its slope, but nothing of its second derivative.
  const bool smooth = fit && fit->fit_error <= worst_result;
  return {fit ? fit->tangent : point.tangent, load / point.approach, point.tangent,
          smooth ? fit->curvature : not_given};
}

ContactSlope slope_of(const ContactCurve &curve, const double load)
{
  if (const auto fit = fitted(curve, load))
    return {fit->tangent, fit->secant, not_given, fit->curvature};
  // Straight between the samples, over the logarithm of the load.
  Eigen::Index i = 0;
  while (i + 2 < curve.load.size() && curve.load[i + 1] < load)
    ++i;
  const double t          = std::log(load / curve.load[i]) / std::log(curve.load[i + 1] / curve.load[i]);
  const auto interpolated = [&](const Eigen::VectorXd &v) { return v[i] + t * (v[i + 1] - v[i]); };
  return {interpolated(curve.tangent), interpolated(curve.secant), not_given, not_given};
}
}  // namespace mill::fem
