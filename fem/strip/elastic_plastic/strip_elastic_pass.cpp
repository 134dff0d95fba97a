#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "fem/strip/common/strip_results.h"
#include "fem/strip/elastic_plastic/strip_elastic_equations.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>

// What is asked of a pass, its scales, and a first guess.
namespace mill::fem {
using bite::sentence;
using Eigen::VectorXd;

ElasticPass elastic_pass(const bite::RollBite &bite, const StripElasticModel &model)
{
  bite::check_pass(bite);
  const Strip &strip = bite.strip;
  bite::check_friction(bite);
  if (!(strip.youngs_modulus > 0 && strip.poisson_ratio > 0 && strip.poisson_ratio < 0.5))
    throw InputError(
        sentence("an elastic-plastic strip needs strip.youngs_modulus above 0 and strip.poisson_ratio between 0 "
                 "and 0.5, not ",
                 strip.youngs_modulus / 1e9, " GPa and ", strip.poisson_ratio));
  if (model.arc == bite::Arc::hitchcock)
    throw InputError(
        "the elastic-plastic strip takes a rigid roll or an elastic one; Hitchcock's circle is for theories "
        "that cannot do with any shape");
  if (bite.gap_rate != 0)
    throw InputError(sentence("the elastic-plastic strip is solved for a gap at rest, not for one that opens at ",
                              bite.gap_rate, " m/s"));
  if (model.elements_along < 8 || model.elements_through < 2 || !(model.finest > 0 && model.finest <= 1) ||
      !(model.stiffness > 0))
    throw InputError(
        "elastic-plastic strip: at least 8 elements along and 2 through half the thickness, the finest between "
        "0 and 1 of the others, a positive factor on the stiffness");
  ElasticPass p;
  p.bite         = &bite;
  p.model        = model;
  p.length       = strip.entry_thickness;
  p.speed        = std::isnan(bite.roll_speed) ? 1 : bite.roll_speed;
  p.exit         = strip.exit_thickness / p.length;
  p.radius       = bite.roll_radius / p.length;
  p.inlet_strain = entry_strain(strip);
  p.reduction    = std::log(1 / p.exit);
  // Half way through the pass, so that every stress is near one.
  p.stress            = material_flow_stress({&strip.flow_stress, 1, 0, 0}, p.inlet_strain + 0.5 * p.reduction);
  const double centre = p.radius - 0.5 * (1 - p.exit);
  p.arc_length        = std::sqrt(p.radius * p.radius - centre * centre);
  p.mean_rate         = 2 * p.reduction / p.arc_length;
  const double E      = model.stiffness * strip.youngs_modulus / p.stress;
  p.shear_compliance  = (1 + strip.poisson_ratio) / E;
  p.bulk_compliance   = 3 * (1 - 2 * strip.poisson_ratio) / E;
  p.film              = follows_bite(strip.friction);
  return p;
}

VectorXd first_guess(const ElasticPass &pass, const ElasticGrid &grid)
{
  VectorXd u      = VectorXd::Zero(grid.n_unknowns);
  const double h2 = pass.exit, R = pass.radius, L = pass.arc_length;
  const int top                       = 2 * grid.n_through;
  u[grid.bulk(Bulk::entry_thickness)] = 1;
  u[grid.bulk(Bulk::exit_thickness)]  = h2;
  u[grid.bulk(Bulk::roll_height)]     = 0.5 * h2;
  u[grid.bulk(Bulk::entry_tension)]   = pass.bite->strip.entry_tension / pass.stress;
  u[grid.bulk(Bulk::exit_tension)]    = pass.bite->strip.exit_tension / pass.stress;
  u[grid.bulk(Bulk::stress_factor)]   = 1;
  u[grid.bulk(Bulk::radius)]          = R;
  u[grid.bulk(Bulk::inlet_strain)]    = pass.inlet_strain;
  if (grid.moves()) {
    u[grid.bulk(Bulk::entry_end)] = grid.x[grid.entry_spine];
    u[grid.bulk(Bulk::exit_end)]  = grid.x[grid.exit_spine];
  }
  const Friction &law = pass.bite->strip.friction;
  if (slides(law))
    u[grid.bulk(Bulk::friction)] = bite::starting_coefficient(law, pass.speed);
  const double s1 = u[grid.bulk(Bulk::entry_tension)], nu = pass.bite->strip.poisson_ratio;
  u[grid.bulk(Bulk::inlet_pressure)] = -(1 + nu) / 3 * s1;
  u[grid.bulk(Bulk::inlet_xx)]       = (2 - nu) / 3 * s1;
  u[grid.bulk(Bulk::inlet_yy)]       = -(1 + nu) / 3 * s1;
  for (int i = 0; i < grid.x.size(); ++i) {
    const double x     = grid.x[i];
    const bool pressed = x > -L && x < 1e-9;
    const double half  = x <= -L ? 0.5 : x >= 0 ? 0.5 * h2 : 0.5 * h2 + R - std::sqrt(R * R - x * x);
    const double slope = pressed ? x / std::sqrt(R * R - x * x) : 0;
    const double speed = (1 + std::min(0.03, 0.3 * pass.reduction)) * 0.5 * h2 / half;  // some forward slip
    for (int j = 0; j <= top; ++j) {
      u[grid.velocity(i, j, 0)] = speed;
      if (grid.velocity(i, j, 1) >= 0)
        u[grid.velocity(i, j, 1)] = speed * slope * j / top;
    }
    for (int J = 1; J <= grid.n_through; ++J)
      u[grid.height(i, J)] = half * J / grid.n_through;
    if (pressed && grid.force(i) >= 0)
      u[grid.force(i)] = grid.tributary[i];
    if (i % 2 && pressed)
      for (int J = 0; J < grid.n_through; ++J)
        u[grid.pressure(i / 2, J, 0)] = 0.5;
  }
  return u;
}
}  // namespace mill::fem
