#include "reduce/bearing/rating_numbers.h"
#include "core/numerics/difference.h"
#include "reduce/bearing/geometry.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
constexpr double usual_viscosity = 1, usual_contamination = 0.3;
constexpr double rated_pressure = 4e9;  // Pa, behind ISO 76

double known_difference(const double a, const double b)
{
  return std::isfinite(a) && std::isfinite(b) && b != 0 ? difference(a, b) : not_given;
}

/// The larger one of those that are known; NaN: neither is.
double larger_known(const double a, const double b)
{
  return std::isnan(a) ? b : std::isnan(b) ? a : std::max(a, b);
}

/// A life goes with C^(10/3), (5.34): its relative error by that of C is added to the rest.
double with_error_of_C(const double error, const double C_error)
{
  return std::hypot(error, std::pow(1 + C_error, 10. / 3) - 1);
}

RatedLoad rated_load(const RollerBearing &b, const AssemblyState &state, const EquivalentLoads &loads,
                     const RatingNumbers &n)
{
  const double p = elastic_roller(b, state.roller_load.maxCoeff(), b.roller_diameter / 2).inner_peak_pressure;
  RatedLoad out;
  out.P              = loads.dynamic;
  out.P_error        = known_difference(n.slices.equivalent_load, out.P);
  out.S0             = n.C0 / loads.statics;
  out.S0_by_pressure = std::pow(rated_pressure / p, 2);
  out.S0_by_yield    = std::pow(b.yield_pressure / p, 2);
  out.S0_error       = known_difference(out.S0_by_pressure, out.S0);
  out.C_by_slices    = out.P * std::pow(n.slices.life / 1e6, 0.3);
  out.L10            = basic_life(n.C, out.P);
  out.L10_error      = with_error_of_C(known_difference(n.slices.life, out.L10), n.C_error);
  return out;
}
}  // namespace

RatingNumbers rating_numbers(const RollerBearing &b, const ComparedStates &s)
{
  RatingNumbers n;
  n.by_formula      = ratings(b);
  n.C               = std::isfinite(b.dynamic_rating) ? b.dynamic_rating : n.by_formula.dynamic;
  n.C0              = std::isfinite(b.static_rating) ? b.static_rating : n.by_formula.static_rating;
  n.C0_by_pressure  = radial_load_of_pressure(b, rated_pressure);
  const bool judged = b.estimated.empty();  // else the rollers follow from the ratings
  n.C_error         = judged ? known_difference(n.by_formula.dynamic, b.dynamic_rating) : not_given;
  n.C0_error        = judged ? known_difference(n.by_formula.static_rating, b.static_rating) : not_given;
  if (std::isnan(n.C0_error))
    n.C0_error = known_difference(n.C0_by_pressure, n.C0);

  n.slices = reference_life(b, s.at, n.C);
  const auto by_slices =
      compared_number(s, [&](const AssemblyState &state) { return reference_life(b, state, n.C).life; });
  n.L10r_standard     = by_slices.standard;
  n.L10r_without_edge = reference_life(b, s.at, n.C, EndFactor::none).life;
  n.L10r_thin_slices  = reference_life(b, s.at, n.C, EndFactor::thin_slices).life;
  double error        = by_slices.error + known_difference(n.L10r_thin_slices, n.slices.life);
  const auto loads    = equivalent_loads(b, s.at.load.head<2>().norm(), s.at.load[2]);
  // A moment alone loads the rollers, and leaves no force but rounding.
  if (loads.dynamic > 1e-9 * s.at.roller_load.sum()) {
    n.load = rated_load(b, s.at, loads, n);
    error  = larger_known(error, known_difference(n.load->L10, n.slices.life));
  }
  n.L10r_error = with_error_of_C(error, n.C_error);

  const double limit  = fatigue_load_limit(n.C0, pitch_diameter(b));
  const auto modified = [&](const double kappa, const double dirt) {
    return life_factor(kappa, dirt, limit / n.slices.equivalent_load) * n.slices.life;
  };
  const bool known_oil = std::isfinite(b.viscosity_ratio), known_dirt = std::isfinite(b.contamination);
  const double kappa = n.viscosity_ratio = known_oil ? b.viscosity_ratio : usual_viscosity;
  const double dirt = n.contamination = known_dirt ? b.contamination : usual_contamination;
  n.L10mr                             = modified(kappa, dirt);
  const auto change = [&](const double k, const double e) { return known_difference(modified(k, e), n.L10mr); };
  double open       = error;
  if (!known_oil)
    open += std::max(change(kappa / 2, dirt), change(2 * kappa, dirt));
  if (!known_dirt)
    open += std::max(change(kappa, 0.2), change(kappa, 0.4));
  n.L10mr_error = with_error_of_C(open, n.C_error);
  if (n.load)
    n.load->L10mr = life_factor(kappa, dirt, limit / n.load->P) * n.load->L10;
  return n;
}

CandidateRange candidate_range(const std::vector<RollerCandidate> &candidates, const double taken,
                               const std::function<double(const RollerCandidate &)> &number)
{
  double low = taken, high = taken;
  for (const RollerCandidate &c : candidates) {
    low  = std::min(low, number(c));
    high = std::max(high, number(c));
  }
  return {low, high, std::max(high / taken - 1, 1 - low / taken)};
}
}  // namespace mill::bearing
