#include "reduce/bite/slab/regime.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/skidding.h"
#include "reduce/bite/slab/slab_checks.h"
#include <cmath>
#include <optional>

namespace mill::bite {
namespace {
// Beyond these the elastic zones and the shape of the arc move the force by more than the finite elements err; in
// thick strip the elastic zones are a part of the rigid ends that the plane flow has anyway.
constexpr double much_elastic = 0.05, much_flattened = 1.3, thin_from = 2.5;

std::optional<BiteState> on_hitchcock(const RollBite &bite)
{
  KarmanOptions quick;
  quick.derivatives = false;
  quick.points      = 0;
  try {
    return solve_karman(bite, Theory::karman, Arc::hitchcock, nullptr, quick);
  } catch (const SolverError &) {
  } catch (const InputError &) {
  }
  return std::nullopt;
}

// Compression before the strip yields and recovery behind the line of centres, both on a parabola of radius R'.
double elastic_share(const Strip &s, const double radius)
{
  const double stiff = s.youngs_modulus / (1 - s.poisson_ratio * s.poisson_ratio);
  const double draft = s.entry_thickness - s.exit_thickness;
  const double reference =
      std::isfinite(s.initial_thickness) ? s.initial_thickness : s.entry_thickness;  // where the strain is zero
  const auto yield = [&](const double h) { return carried_flow_stress(s.flow_stress, std::log(reference / h)); };
  const double in  = s.entry_thickness * std::max(0., yield(s.entry_thickness) - s.entry_tension) / stiff,
               out = s.exit_thickness * std::max(0., yield(s.exit_thickness) - s.exit_tension) / stiff;
  const double plastic = std::sqrt(radius * draft);
  return (std::sqrt(radius * (draft + in)) + std::sqrt(radius * out)) / plastic - 1;
}
}  // namespace

Regime regime_of(const RollBite &bite)
{
  check_pass(bite);
  const Strip &s = bite.strip;
  Regime r;
  const auto state    = on_hitchcock(bite);
  const double radius = state ? state->flattened_radius : bite.roll_radius;
  if (state) {
    RollBite resting  = bite;
    resting.gap_rate  = 0;
    r.flattening      = radius / bite.roll_radius;
    r.friction_margin = friction_margin(resting, radius, state->friction);
  }
  r.arc_over_thickness = 2 * std::sqrt(bite.roll_radius * (s.entry_thickness - s.exit_thickness)) /
                         (s.entry_thickness + s.exit_thickness);
  r.elastic_share = elastic_share(s, radius);
  const bool thin = r.arc_over_thickness > thin_from;
  const bool flat = !state || r.flattening > much_flattened;
  r.elastic_strip = thin && (flat || r.elastic_share > much_elastic);
  r.reason        = sentence(
             "arc over mean thickness ", r.arc_over_thickness, ", R'/R ", state ? sentence(r.flattening) : "not found",
             ", elastic zones ", 100 * r.elastic_share, " % of the arc, friction ",
      state ? sentence(r.friction_margin) + " times the least that draws the strip in" : "not judged");
  return r;
}
}  // namespace mill::bite
