#include "fem/roll/contact_numbers.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "fem/roll/contact_slope.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
// Two meshes, the active set of the one load where the value is a tangent, and a second engine where it was asked.
Compared compared_slope(const double value, const double coarse, const double exact, const double second)
{
  const double error = std::max(mesh_pair_error(value, coarse), difference(exact, value));
  return {value, widened(error, second, value), coarse, second};
}

Compared compared_section(const double value, const double coarse, const double second, const double least_error)
{
  const double error = std::max(mesh_pair_error(value, coarse), least_error);
  return {value, widened(error, second, value), coarse, second};
}

ContactSlope second_slope(const ContactCurve *curve, const double load)
{
  return curve ? slope_of(*curve, load) : ContactSlope{not_given, not_given, not_given, not_given};
}
}  // namespace

double line_contact_curvature(const reduce::LineContact &hertz, const double load)
{
  // (3.5a) and (3.5b) differ by one in the bracket.
  const double A_over_L = 1 / hertz.secant - 1 / hertz.tangent;
  return std::pow(hertz.tangent, 3) * A_over_L / load;
}

StiffnessAtLoad stiffness_at(const ContactPairs &pairs, const ContactCurves &curves, const double load)
{
  const auto *const engine = curves.second ? &*curves.second : nullptr;
  const auto fine          = slope_at(pairs.mirrored, curves.mirrored, load);
  const auto coarse        = slope_at(pairs.coarse, curves.coarse, load, Role::companion);
  const auto second        = second_slope(engine ? &engine->mirrored : nullptr, load);
  const auto held          = slope_at(pairs.in_stand, curves.in_stand, load);
  const auto held_coarse   = slope_at(pairs.in_stand_coarse, curves.in_stand_coarse, load, Role::companion);
  const auto held_second   = second_slope(engine ? &engine->in_stand : nullptr, load);
  const auto middle        = barrel_profile(pairs.mirrored, solve_load(pairs.mirrored, load));
  const auto mid           = middle_station(pairs.mirrored.grid);

  StiffnessAtLoad out;
  out.hertz            = reduce::line_contact(pairs.closed_form, load);
  out.laws             = reduce::secant_laws(pairs.closed_form, load);
  out.hertz_curvature  = line_contact_curvature(out.hertz, load);
  out.exact            = fine.exact;
  out.middle_secant    = pairs.closed_form.length * middle.line_load[mid] / middle.approach[mid];
  out.open_at_middle   = middle.half_width[mid] == 0;
  out.tangent          = compared_slope(fine.tangent, coarse.tangent, fine.exact, second.tangent);
  out.secant           = compared_slope(fine.secant, coarse.secant, fine.secant, second.secant);
  out.in_stand_tangent = compared_slope(held.tangent, held_coarse.tangent, held.exact, held_second.tangent);
  out.in_stand_secant  = compared_slope(held.secant, held_coarse.secant, held.secant, held_second.secant);
  const double error   = widened(not_given, coarse.curvature, fine.curvature);
  out.curvature        = {fine.curvature, widened(error, second.curvature, fine.curvature), coarse.curvature,
                          second.curvature};
  return out;
}

SectionAtLoad section_at(const ContactPairs &pairs, const ContactCurves &curves, const double load)
{
  const auto point = solve_load(pairs.mirrored, load), point2 = solve_load(pairs.coarse, load);
  const auto coarse = barrel_profile(pairs.coarse, point2);
  const auto mid = middle_station(pairs.mirrored.grid), mid2 = middle_station(pairs.coarse.grid);
  SectionAtLoad out;
  out.hertz         = reduce::line_contact(pairs.closed_form, load);
  out.mirrored      = barrel_profile(pairs.mirrored, point);
  out.in_stand      = barrel_profile(pairs.in_stand, solve_load(pairs.in_stand, load));
  out.coarse_state  = point2.state;
  const auto &fine  = out.mirrored;
  const auto &other = curves.second;
  const auto second = [&](const Eigen::VectorXd BarrelProfile::*values) {
    if (!other)
      return not_given;
    const Eigen::VectorXd &v = other->mirrored_at.*values;
    return v[pairs.mirrored.grid.whole ? v.size() / 2 : 0];
  };
  const double misfit =
      std::abs(0.5 * M_PI * fine.half_width[mid] * fine.peak_pressure[mid] / fine.line_load[mid] - 1);
  out.half_width =
      compared_section(fine.half_width[mid], coarse.half_width[mid2], second(&BarrelProfile::half_width), misfit);
  out.peak_pressure    = compared_section(fine.peak_pressure[mid], coarse.peak_pressure[mid2],
                                          second(&BarrelProfile::peak_pressure), misfit);
  out.approach         = compared_section(point.approach, point2.approach,
                                  other ? load / slope_of(other->mirrored, load).secant : not_given, 0);
  out.line_load_spread = other ? line_load_spread(out.in_stand, other->in_stand_at) : not_given;
  return out;
}

double line_load_spread(const BarrelProfile &first, const BarrelProfile &second)
{
  double low = first.z.maxCoeff(), high = first.z.minCoeff(), mean = 0, b = 0;
  for (Eigen::Index k = 0; k < second.z.size(); ++k)
    if (second.line_load[k] > 0) {
      low  = std::min(low, second.z[k]);
      high = std::max(high, second.z[k]);
      b    = std::max(b, second.half_width[k]);
      mean = std::max(mean, second.line_load[k]);  // of a crowned contact the mean is not its measure
    }
  const double margin = 9 * b;
  if (low > 1e-9)
    low = -high;  // one side of a symmetric contact
  double worst         = 0;
  Eigen::Index nearest = 0;
  for (Eigen::Index k = 0; k < first.z.size(); ++k) {
    if (first.z[k] < std::max(low + margin, second.z[0]) || first.z[k] > high - margin)
      continue;
    while (nearest + 2 < second.z.size() && second.z[nearest + 1] < first.z[k])
      ++nearest;
    const double t = (first.z[k] - second.z[nearest]) / (second.z[nearest + 1] - second.z[nearest]);
    const double q = (1 - t) * second.line_load[nearest] + t * second.line_load[nearest + 1];
    worst          = std::max(worst, std::abs(first.line_load[k] - q));
  }
  return worst / mean;
}
}  // namespace mill::fem
