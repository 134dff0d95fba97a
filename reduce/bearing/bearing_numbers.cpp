#include "reduce/bearing/bearing_numbers.h"
#include "core/model/bearing_ratings.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
double error_of(const ComparedStates &s, const StateNumber &number, const double value)
{
  if (s.companions.empty() || !(std::abs(value) > 0))
    return not_given;
  double sum = 0, support = 0;
  for (std::size_t i = 0; i < s.companions.size(); ++i)
    sum += (i < s.meshes ? mesh_pair_safety : 1) * difference(number(s.companions[i].at), value);
  for (const StateVariant &v : s.supports)
    support = std::max(support, difference(number(v.at), value));
  return sum + support;
}

// One number of the heaviest roller.
StateNumber of_heaviest(Eigen::VectorXd RowRollers::*number)
{
  return [number](const AssemblyState &state) {
    const RowRollers rows = heaviest_of_rows(state);
    Eigen::Index row;
    rows.load.maxCoeff(&row);
    return (rows.*number)[row];
  };
}
}  // namespace

ComparedNumber compared_number(const ComparedStates &s, const StateNumber &number)
{
  ComparedNumber out;
  out.value    = number(s.at);
  out.error    = error_of(s, number, out.value);
  out.standard = number(s.standard);
  out.palmgren = number(s.palmgren);
  out.rigid    = number(s.rigid);
  for (const StateVariant &v : s.supports)
    out.supports.push_back(number(v.at));
  for (const StateVariant &v : s.arrangements)
    out.arrangements.push_back(number(v.at));
  return out;
}

double estimate_error(const std::vector<RollerCandidate> &candidates, const EstimatedPart part)
{
  switch (part) {
  case EstimatedPart::stiffness:
    return stiffness_spread(candidates);
  case EstimatedPart::angle:
    return axial_spread(candidates);
  case EstimatedPart::rollers:
    break;
  }
  double spread = 0;
  for (const RollerCandidate &c : candidates)
    spread = std::max(spread, difference(double(candidates.front().rollers_per_row), double(c.rollers_per_row)));
  return spread;
}

RowRollers heaviest_of_rows(const AssemblyState &state)
{
  const auto rows = state.roller_load.rows();
  RowRollers out{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  for (Eigen::Index r = 0; r < rows; ++r) {
    Eigen::Index j;
    out.load[r]    = state.roller_load.row(r).maxCoeff(&j);
    out.secant[r]  = out.load[r] / state.roller_approach(r, j);
    out.tangent[r] = state.roller_tangent(r, j);
  }
  return out;
}

BearingNumbers bearing_numbers(const ComparedStates &s, const std::vector<RollerCandidate> &candidates)
{
  const auto compared = [&](const EstimatedPart part, const StateNumber &number) {
    ComparedNumber out = compared_number(s, number);
    out.error += estimate_error(candidates, part);
    return out;
  };
  const auto along = [&s](const int axis) {
    return [&s, axis](const AssemblyState &state) { return stiffness_along(state, s.loading, axis); };
  };
  BearingNumbers n;
  n.tangent        = compared(EstimatedPart::stiffness,
                              [&](const AssemblyState &state) { return radial_tangent(state, s.loading); });
  n.secant         = compared(EstimatedPart::stiffness, radial_secant);
  n.tangent_across = compared(EstimatedPart::stiffness, along(1));
  n.axial      = compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.tangent(2, 2); });
  n.tilting    = compared(EstimatedPart::angle, along(4));
  n.axial_load = compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.load[2]; });
  n.axial_displacement =
      compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.motion[2]; });
  n.moment         = compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.load[4]; });
  n.tilt           = compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.motion[4]; });
  n.roller_secant  = compared(EstimatedPart::rollers, of_heaviest(&RowRollers::secant));
  n.roller_tangent = compared(EstimatedPart::rollers, of_heaviest(&RowRollers::tangent));
  n.roller_max     = compared(EstimatedPart::rollers, of_heaviest(&RowRollers::load));
  n.rib_max =
      compared(EstimatedPart::angle, [](const AssemblyState &state) { return state.rib_force.maxCoeff(); });
  for (Eigen::Index r = 0; r < s.at.row_share.size(); ++r) {
    n.row_share.push_back(compared_number(s, [r](const AssemblyState &state) { return state.row_share[r]; }));
    n.row_axial.push_back(
        compared(EstimatedPart::angle, [r](const AssemblyState &state) { return state.row_axial[r]; }));
  }
  Eigen::Index row, roller;
  s.at.roller_load.maxCoeff(&row, &roller);
  // Both flanks carry alike without a load across: the angle has no sign.
  n.heaviest_angle = std::abs(std::remainder(s.at.azimuth[roller], 2 * M_PI));
  return n;
}
}  // namespace mill::bearing
