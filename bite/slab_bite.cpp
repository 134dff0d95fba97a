#include "bite/slab_bite.h"
#include "bite/bland_ford.h"
#include "bite/hu_ehmann.h"
#include "bite/karman.h"
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
  return state;
}

BiteStiffness slab_stiffness(const RollBite &bite, const BiteState &state)
{
  const Material &m = bite.roll;
  const double A    = 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
  const double l    = std::sqrt(bite.roll_radius * (bite.strip.entry_thickness - bite.strip.exit_thickness));
  BiteStiffness k;
  k.plastic_slope           = -by(state.force_by, Input::exit_thickness);
  k.plastic_slope_following = -state.force_by_exit_following;
  k.flattening              = bite.strip.width / (A * (std::log(4 * bite.roll_radius / (l / 2)) - 0.5));  // (8.12)
  k.combined                = 1 / (1 / k.plastic_slope + 2 / k.flattening);                               // (8.13)
  return k;
}
}  // namespace mill::bite
