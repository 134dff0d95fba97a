#include "fem/strip/rigid_plastic/strip_flow_equations.h"
#include "core/base/errors.h"
#include "fem/strip/common/strip_results.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/skidding.h"
#include "reduce/bite/slab/slab_checks.h"
#include <cmath>
#include <optional>

namespace mill::fem {
namespace {
// A neutral point nearer to the end of the arc than this friction puts it wanders in Newton's method.
constexpr double safe_margin = 2.2;

// What the rolls cannot pull through is refused before it makes a Newton iteration fail; what a slab theory makes
// of the pass is where the continuation starts.
void start_from_slab(StripPass &p)
{
  bite::KarmanOptions quick;
  quick.derivatives      = false;
  quick.points           = 0;
  bite::RollBite resting = *p.bite;
  resting.gap_rate       = 0;  // Karman's equation knows no moving gap
  const auto slab        = [&](const bite::Arc arc) {
    return bite::solve_karman(resting, bite::Theory::karman, arc, nullptr, quick);
  };
  std::optional<bite::BiteState> state;
  if (p.model.arc == bite::Arc::hitchcock)
    try {
      state = slab(bite::Arc::hitchcock);
    } catch (const SolverError &) {  // no flattened radius by that theory
    }
  if (!state)
    state = slab(bite::Arc::rigid);
  p.exit_slip               = state->forward_slip;
  p.friction                = slides(p.bite->strip.friction) ? state->friction : 0;
  const double rigid_radius = p.bite->roll_radius;
  if (state->flattened_radius > 1.2 * rigid_radius ||
      bite::friction_margin(resting, rigid_radius, p.friction) < safe_margin)
    p.start_radius = state->flattened_radius / p.length;
  const double margin = bite::friction_margin(resting, p.start_radius * p.length, p.friction);
  p.more_friction     = std::max(1., safe_margin / margin);
}
}  // namespace

StripPass strip_pass(const bite::RollBite &bite, const StripFlowModel &model,
                     const bite::ArcFlexibility *flexibility)
{
  bite::check_pass(bite);
  const Strip &strip = bite.strip;
  if ((model.arc == bite::Arc::elastic) != (flexibility != nullptr))
    throw InputError(flexibility ? "a flexibility of the roll's surface is for Arc::elastic only"
                                 : "Arc::elastic needs the flexibility of the roll's surface");
  StripPass p;
  p.bite        = &bite;
  p.flexibility = flexibility;
  p.model       = model;
  p.length      = strip.entry_thickness;
  p.speed       = std::isnan(bite.roll_speed) ? 1 : bite.roll_speed;
  // Half way through the pass, so that every stress is near one.
  p.stress =
      scaled_flow_stress(p, entry_strain(strip) + 0.5 * std::log(strip.entry_thickness / strip.exit_thickness));
  using Size    = bite::Dual<3>;
  const Size h1 = Size::variable(1, 0), h2 = Size::variable(strip.exit_thickness / p.length, 1),
             R = Size::variable(bite.roll_radius / p.length, 2), centre = R - 0.5 * (h1 - h2);
  const Size arc_length = sqrt(R * R - centre * centre), rate = 2.0 * log(h1 / h2) / arc_length;
  p.arc_length   = arc_length.value;
  p.mean_rate    = rate.value;
  p.mean_rate_by = rate.by;
  if (model.arc != bite::Arc::rigid)
    p.mean_rate_by[2] = 0;
  const bool idle = plain_coefficient(strip.friction) == 0;
  p.start_radius  = bite.roll_radius / p.length;
  if (std::isnan(model.exit_speed) && !idle)
    start_from_slab(p);
  return p;
}

Eigen::VectorXd first_guess(const StripPass &pass, const StripGrid &grid)
{
  Eigen::VectorXd u  = Eigen::VectorXd::Zero(grid.n_unknowns);
  const Strip &strip = pass.bite->strip;
  const double h2 = strip.exit_thickness / pass.length, R = pass.start_radius, centre = R - 0.5 * (1 - h2),
               arc_length        = std::sqrt(R * R - centre * centre);
  u[grid.whole(Whole::entry)]    = -arc_length;
  u[grid.whole(Whole::radius)]   = R;
  u[grid.whole(Whole::tension)]  = strip.exit_tension / pass.stress;
  u[grid.whole(Whole::friction)] = pass.friction * pass.more_friction;
  const double exit_speed        = std::isnan(pass.model.exit_speed) ? 1 + pass.exit_slip : pass.model.exit_speed;
  for (int i = 0; i <= 2 * grid.n_along; ++i) {
    const auto corner  = [&](const int I) { return -grid.spine[I][0] * arc_length + grid.spine[I][2]; };
    const double x     = i % 2 == 0 ? corner(i / 2) : 0.5 * (corner(i / 2) + corner(i / 2 + 1));
    const bool touches = i >= grid.first && i <= grid.last;
    const double half  = touches ? circle_height(h2, 0., R, x) : i < grid.first ? 0.5 : 0.5 * h2;
    const double slope = i > grid.first && i < grid.last ? x / std::sqrt(R * R - x * x) : 0;
    for (int J = 1; J <= grid.n_through; ++J)
      u[grid.height(i, J)] = half * grid.lines.rows[J];
    for (int j = 0; j <= 2 * grid.n_through; ++j) {
      const double share =
          j % 2 == 0 ? grid.lines.rows[j / 2] : 0.5 * (grid.lines.rows[j / 2] + grid.lines.rows[j / 2 + 1]);
      const double along        = exit_speed * 0.5 * h2 / half;
      u[grid.velocity(i, j, 0)] = along;
      u[grid.velocity(i, j, 1)] = along * slope * share;
    }
    if (touches)
      u[grid.contact(i)] = 1;
    if (touches && i % 2 == 0)
      for (int J = 0; J <= grid.n_through; ++J)
        u[grid.pressure(i / 2, J)] = 0.5;
  }
  for (int c = 0; c < grid.n_unknowns; ++c)
    if (grid.held[c])
      u[c] = 0;
  return u;
}

StripEquations strip_equations(const StripPass &pass, const StripGrid &grid, const StripStage &stage,
                               const Eigen::VectorXd &unknowns, const StripDirections *before,
                               StripDirections *after, const double longest)
{
  StripAssembly assembly(pass, grid, stage, unknowns);
  if (before && before->bulk.cols() == assembly.after.bulk.cols() &&
      before->slip.cols() == assembly.after.slip.cols())
    assembly.before = before;
  assembly.longest = longest;
  assembly.bulk();
  assembly.ends();
  assembly.streamlines();
  assembly.contact();
  assembly.roll_shape();
  assembly.whole();
  StripEquations out = std::move(assembly.out);
  if (after)
    *after = std::move(assembly.after);
  for (int row = 0; row < grid.n_unknowns; ++row)
    if (grid.held[row]) {
      out.residual[row] = unknowns[row];
      out.entries.emplace_back(row, row, 1.);
    }
  return out;
}
}  // namespace mill::fem
