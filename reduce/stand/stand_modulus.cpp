#include "reduce/stand/stand_modulus.h"
#include "core/numerics/difference.h"
#include "core/numerics/mesh_pair.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::reduce {
namespace {
constexpr double width_step = 0.01;  // relative, of central differences
constexpr double force_step = 0.02;
constexpr double least_step = 1e-6;  // below it rounding is seen in the differences

// One work roll on its contact line under a strip of this width.
BentWorkRoll bent_roll(const FourHigh &stand, const Component *solid, const double width, const double K)
{
  const Roll &roll = stand.work_roll;
  if (solid)
    return {*solid, width / 2, K};
  return {foundation_shape({roll.barrel_length / 2, width / 2, K / roll.barrel_length,
                            beam_section(barrel_section(roll), stand.steel).bending})};
}

MillModulus modulus_at(const std::vector<PathSpring> &path, const double force)
{
  std::vector<PathPart> parts;
  for (const PathSpring &spring : path) {
    parts.push_back(spring);
    if (!spring.at_others)
      continue;
    const auto there     = spring.at_others(force);
    parts.back().tangent = there.tangent;
    parts.back().secant  = there.secant;
  }
  return mill_modulus(parts);
}

// Springs in series whose sum is known do not err on their own: what one of them is softer the frame is stiffer.
// Only what the path has in place of the touching work rolls adds to the error.  (30.12)
double error_on_modulus(const std::vector<PathPart> &path, const std::vector<PathPart> &touching,
                        const double modulus_error)
{
  const auto m = mill_modulus(path), closed = mill_modulus(touching);
  double error   = m.tangent / closed.tangent * modulus_error;
  const auto add = [&](const std::vector<PathPart> &parts, const std::vector<PathPart> &without) {
    for (const PathPart &part : parts)
      if (std::none_of(without.begin(), without.end(), [&](const PathPart &p) { return p.name == part.name; }))
        error += m.tangent / part.tangent * part.error;
  };
  add(path, touching);
  add(touching, path);
  return error;
}

struct LoadRange {
  double low, high;  // N
};

// The part of a range in which both contacts have samples.
LoadRange sampled(LoadRange range, const std::array<const ContactCurve *, 2> &contacts)
{
  for (const ContactCurve *curve : contacts)
    if (curve) {
      range.low  = std::max(range.low, curve->load[0]);
      range.high = std::min(range.high, curve->load[curve->load.size() - 1]);
    }
  return range;
}

LoadDeflection stretch_of(const std::vector<PathSpring> &path, const LoadRange &range)
{
  constexpr int n        = 41;
  const auto [low, high] = range;
  LoadDeflection all{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const double F    = i == n - 1 ? high : low * std::pow(high / low, double(i) / (n - 1));
    const auto m      = modulus_at(path, F);
    all.load[i]       = F;
    all.deflection[i] = F / m.secant;
    all.tangent[i]    = m.tangent;
  }
  return all;
}

// The slope at `load` of the parabola through the stretch at three forces a step apart, N/m: the load and both
// sides of it, moved to where there are samples.
double modulus_by_differences(const std::vector<PathSpring> &path, const double load, const LoadRange &range)
{
  const double step = std::min(force_step * load, 0.5 * (range.high - range.low));
  if (!(step >= least_step * load))
    return not_given;
  const double middle = std::min(std::max(load, range.low + step), range.high - step);
  const auto stretch  = [&](const double force) { return force / modulus_at(path, force).secant; };
  const double below = stretch(middle - step), above = stretch(middle + step);
  double rise = 0.5 * (above - below);
  if (middle != load)
    rise += (load - middle) / step * (above - 2 * stretch(middle) + below);
  return step / rise;
}

// Deflection at a force, the tangents summed from the first one of the stretch: Simpson's rule over ln F.  m
double summed_tangents(const std::vector<PathSpring> &path, const LoadDeflection &stretch, const double force)
{
  constexpr int n    = 64;
  double sum         = stretch.deflection[0];
  const double first = stretch.load[0], h = std::log(force / first) / n;
  for (int i = 0; i <= n; ++i) {
    const double load = first * std::exp(i * h);
    sum += h / 3 * (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * load * (1 / modulus_at(path, load).tangent);
  }
  return sum;
}
}  // namespace

CylinderPair work_roll_pair(const FourHigh &stand)
{
  const double d = stand.work_roll.barrel_diameter;
  return {d, d, stand.work_roll.barrel_length, stand.steel};
}

TouchingWorkRolls touching_work_rolls(const FourHigh &stand, const double load, const double off_K3)
{
  const auto rolls    = work_roll_pair(stand);
  const auto approach = [&](const double force) { return line_contact(rolls, force).approach; };
  const auto laws     = secant_laws(rolls, load);
  return {line_contact(rolls, load), laws, std::isnan(off_K3) ? difference(laws.palmgren, laws.johnson) : off_K3,
          0.02 * load / (approach(1.01 * load) - approach(0.99 * load))};
}

double work_rolls_bending(const FourHigh &stand, const Component *solid, const double width, const double K3,
                          const double K5)
{
  double sum = 0;
  for (const double K : {K3, K5})
    sum += work_roll_bending(bent_roll(stand, solid, width, K), K, stand.work_roll.barrel_length / 2,
                             stand.dynamics.mass_reference);
  return sum;
}

BendingSpring bending_spring(const FourHigh &stand, const SolidRolls &rolls, const Parameter &K3,
                             const Parameter &K5)
{
  const double width = stand.strip.width;
  const Component *solid =
      rolls && stand.backup_roll.bending_model == BendingModel::solid ? rolls.work_roll : nullptr;
  const auto bending = [&](const Component *roll, const double b, const double softer = 0) {
    return work_rolls_bending(stand, roll, b, (1 + softer) * K3.value, (1 + softer) * K5.value);
  };
  BendingSpring out;
  out.compliance = bending(solid, width);
  out.meshed     = solid != nullptr;
  out.bends      = out.compliance * K3.value > least_bending;
  if (!out.bends)
    return out;
  const double step = width_step * width;
  out.by_width      = (bending(solid, width + step) - bending(solid, width - step)) / (2 * step);
  out.beam          = 1 / bending(nullptr, width);
  if (!rolls)
    return out;
  out.solid       = 1 / bending(rolls.work_roll, width);
  const double eK = 0.5 * (K3.error_estimate + K5.error_estimate);
  if (std::isnan(eK))  // given without a tolerance
    out.lacks = {"K3", "K5"};
  else
    out.error = mesh_pair_error(out.solid, 1 / bending(rolls.coarse_work_roll, width), rolls.gain) +
                (solid ? 0 : difference(out.solid, out.beam)) +
                difference(1 / bending(solid, width, eK), 1 / out.compliance);
  return out;
}

PathSpring spring_with_bearings(PathPart part, const double K_Zy, const double secant,
                                const LoadDeflection *bearings)
{
  const double rest = 1 / part.tangent - 1 / K_Zy;
  part.secant       = 1 / (rest + 1 / secant);
  if (!bearings)
    return {std::move(part), {}};
  return {std::move(part), [rest, bearings](const double force) {
            const auto bearing = deflected_at(*bearings, force);
            return SpringAtForce{1 / (rest + bearing.compliance), 1 / (rest + bearing.deflection / force)};
          }};
}

PathModulus path_modulus(const std::vector<PathSpring> &path, const std::vector<PathSpring> &touching,
                         const Frame &frame, const double load,
                         const std::array<const ContactCurve *, 2> &contacts)
{
  const std::vector<PathPart> parts(path.begin(), path.end());
  const LoadRange range = sampled({0.1 * load, 2 * load}, contacts);
  PathModulus out{mill_modulus(parts), 0, 0, stretch_of(path, range)};
  if (is_closed(frame))
    out.modulus.error = error_on_modulus(parts, {touching.begin(), touching.end()}, frame.modulus_error);
  if (!std::isnan(out.modulus.error))
    out.modulus.lacks.clear();
  out.by_differences = modulus_by_differences(path, load, range);
  out.by_tangents    = load / summed_tangents(path, out.stretch, load);
  return out;
}

double gap_opening(const StandModel &stand, const MassReference reference)
{
  const StandModel path   = load_path(stand);
  const Eigen::VectorXd y = static_displacement(path);
  return reference == MassReference::mean ? path.b.dot(y) : (path.points[2].row - path.points[3].row).dot(y);
}
}  // namespace mill::reduce
