#include "reduce/bite/slab/slab_bite.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/hu_ehmann.h"
#include "reduce/bite/slab/karman.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
std::string model_name(const SlabModel &model)
{
  const char *theories[] = {"Bland-Ford slab", "Hu-Ehmann slab", "Karman slab", "Orowan's inhomogeneous theory",
                            "Sims' sticking friction"};
  const char *arcs[]     = {"rigid arc", "Hitchcock's arc", "elastic arc"};
  return std::string(theories[int(model.theory)]) + ", " + arcs[int(model.arc)];
}

BiteState solve_slab(const RollBite &bite, const SlabModel &model, const ArcFlexibility *flexibility)
{
  BiteState state;
  if (model.theory == Theory::bland_ford)
    state = solve_bland_ford(bite, model.arc, model.curve_points);
  else if (model.theory == Theory::hu_ehmann)
    state = solve_hu_ehmann(bite, model.arc, model.curve_points);
  else {
    KarmanOptions options;
    options.points = 2 * model.curve_points;
    state          = solve_karman(bite, model.theory, model.arc, flexibility, options);
  }
  state.model = model_name(model);
  if (!std::isfinite(state.force) || !std::isfinite(state.torque))
    throw SolverError({"roll bite: no finite force by the " + state.model,
                       sentence("force ", state.force, " N, torque ", state.torque, " N m"),
                       "an arc so much longer than the strip is thick that the friction hill has no number",
                       "a thicker strip.exit_thickness, less friction, or another flow stress", ""});
  if (!(state.force > 0))
    throw InputError(sentence("strip.entry_tension = ", bite.strip.entry_tension / 1e6,
                              " MPa and strip.exit_tension = ", bite.strip.exit_tension / 1e6,
                              " MPa leave a roll force of ", state.force / 1e3, " kN by the ", state.model,
                              ": the rolls would have to pull; less tension is needed"));
  return state;
}

double leaving_thickness(const RollBite &bite, const BiteState &state, const Arc arc)
{
  const Strip &s = bite.strip;
  if (arc != Arc::elastic)
    return s.exit_thickness;
  const double stiff = s.youngs_modulus / (1 - s.poisson_ratio * s.poisson_ratio);
  return s.exit_thickness * (1 + (state.exit_flow_stress - s.exit_tension) / stiff);
}

BiteStiffness slab_stiffness(const RollBite &bite, const BiteState &state)
{
  const Material &m = bite.roll;
  const double A    = 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
  // Of the loaded roll: the arc of its circle, or the contact of a free arc, which its elastic zones make longer.
  const double draft = bite.strip.entry_thickness - bite.strip.exit_thickness;
  const double l     = std::max(
          {std::sqrt(state.flattened_radius * draft), state.arc_length - state.exit_position, state.contact_length});
  BiteStiffness k;
  k.plastic_slope           = -by(state.force_by, Input::exit_thickness);
  k.plastic_slope_following = -state.force_by_exit_following;
  k.flattening              = bite.strip.width / (A * (std::log(4 * bite.roll_radius / (l / 2)) - 0.5));  // (8.12)
  k.combined                = 1 / (1 / k.plastic_slope + 2 / k.flattening);                               // (8.13)
  return k;
}
}  // namespace mill::bite
