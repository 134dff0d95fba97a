#include "fem/strip/rigid_plastic/strip_flow.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include "fem/strip/common/unsymmetric_factor.h"
#include "fem/strip/rigid_plastic/strip_flow_equations.h"
#include "fem/strip/rigid_plastic/strip_flow_results.h"
#include <chrono>
#include <cmath>
#include <optional>

namespace mill::fem {
namespace {
using Eigen::VectorXd;

StripStage last_stage(const StripPass &pass)
{
  const bool follows = pass.model.follow_surface;
  return {pass.model.cutoff_strain_rate,
          pass.model.cutoff_slip,
          false,
          follows,
          pass.model.release,
          0,
          pass.model.arc == bite::Arc::rigid ? 0. : 1.,
          1};
}

// Residual at which a level is good enough to go on from: what it leaves is gone after the next one's first step.
constexpr double start_tolerance = 1e-2;
constexpr int picard_steps       = 6;

// Length to which predicted directions are cut, by the residual; 0.7 where a level begins.  A direction of length
// one cannot leave the yield surface, for any step: points that are to become rigid need it shorter, and as
// the residual goes to zero it may not disturb the quadratic convergence.
double longest_direction(const double residual)
{
  return 1 - 0.2 * std::min(1., residual);
}
constexpr double longest_at_start = 0.7;

// Newton's method on one grid, with what has converged so far.
class Continuation {
public:
  // @param finest  its last level is the solution; false: a start for a finer grid
  Continuation(const StripPass &p, const StripGrid &g, VectorXd start, StripCourse &h, const bool finest)
      : pass(p), grid(g), u(std::move(start)), course(h), is_finest(finest)
  {
  }
  // From a state of another grid, with the directions there: those of interpolated velocities are noise where the
  // strip is all but rigid.
  Continuation(const StripPass &p, const StripGrid &from, const VectorXd &old, const StripGrid &g, StripCourse &h,
               const bool finest)
      : Continuation(p, g, interpolated(from, old, g), h, finest)
  {
    StripDirections there;
    strip_equations(p, from, last_stage(p), old, nullptr, &there);
    directions = interpolated(from, there, g);
  }

  // Steps with the viscosity of the present state: from a guess that is none to where Newton converges.
  // False where the strip cannot carry anything: a flow stress next to nothing in a part of it.
  bool picard(const StripStage &stage)
  {
    for (int step = 0; step < picard_steps; ++step) {
      const StripEquations e = strip_equations(pass, grid, stage, u);
      const VectorXd d       = direction(e);
      if (d.size() == 0)
        return false;
      u -= d;
      if (step == picard_steps - 1)
        note("Picard", stage, picard_steps, e.residual.norm(), e.force.value);
    }
    reached = stage;
    return true;
  }

  // One level; on failure the unknowns stay what they were.
  bool newton(const StripStage &stage)
  {
    const double enough = ends_at(stage) ? pass.model.tolerance : std::max(pass.model.tolerance, start_tolerance);
    const VectorXd kept = u;
    StripDirections before, after;
    StripEquations e = strip_equations(pass, grid, stage, u, &directions, &before, longest_at_start);
    double residual  = e.residual.norm();
    for (int step = 1; step <= 30 && std::isfinite(residual); ++step) {
      const VectorXd d = direction(e), from = u;
      if (d.size() == 0)
        break;
      // The ends of the contact move by a tenth of the arc at most: beyond that the linearisation says nothing.
      const double farthest =
          std::max(std::abs(d[grid.whole(Whole::entry)]), std::abs(d[grid.whole(Whole::exit)]));
      double share = std::min(1., 0.1 * pass.arc_length / farthest), next = 0;
      for (;; share *= 0.5) {
        u    = from - share * d;
        e    = strip_equations(pass, grid, stage, u, &before, &after, longest_direction(residual));
        next = e.residual.norm();
        // The first steps may climb: they set the predicted directions right.
        if (std::isfinite(next) && next < (step <= 6 ? 2 : 1 - 0.1 * share) * residual)
          break;
        if (share < 1e-3)
          break;
      }
      last_residual = residual;
      if (share < 1e-3)
        break;
      residual = last_residual = next;
      std::swap(before, after);
      if (residual < enough) {
        note(stage.free_surface ? "Newton, free surface" : "Newton, fixed surface", stage, step, residual,
             e.force.value);
        reached    = stage;
        directions = std::move(before);
        return true;
      }
    }
    u = kept;
    return false;
  }

  // From the last level to another one, in as many parts as it takes.
  bool advance(const StripStage &target, const int depth = 0)
  {
    if (newton(target))
      return true;
    if (depth == 5)
      return false;
    StripStage middle         = target;
    middle.cutoff_strain_rate = std::sqrt(reached.cutoff_strain_rate * target.cutoff_strain_rate);
    middle.cutoff_slip        = std::sqrt(reached.cutoff_slip * target.cutoff_slip);
    middle.flexibility        = 0.5 * (reached.flexibility + target.flexibility);
    middle.tension            = 0.5 * (reached.tension + target.tension);
    middle.end_pressure       = 0.5 * (reached.end_pressure + target.end_pressure);
    middle.friction           = std::sqrt(reached.friction * target.friction);
    return advance(middle, depth + 1) && advance(target, depth + 1);
  }

  const StripPass &pass;
  const StripGrid &grid;
  VectorXd u;
  StripStage reached;          // where it converged last
  StripDirections directions;  // as they were then
  double last_residual = 0;

private:
  VectorXd direction(const StripEquations &e)
  {
    course.spend(grid.n_unknowns, pass.model.work_limit);
    return factor.factorise(grid.n_unknowns, e.entries) ? factor.solve(e.residual) : VectorXd();
  }
  void note(const char *what, const StripStage &stage, const int iterations, const double residual,
            const double force)
  {
    const double width = pass.bite->strip.width;
    course.levels.push_back({what, grid.n_unknowns, stage.cutoff_strain_rate, stage.cutoff_slip, stage.flexibility,
                             iterations, residual, force * pass.stress * pass.length * width});
  }
  bool ends_at(const StripStage &stage) const
  {
    const StripStage last = last_stage(pass);
    return is_finest && stage.cutoff_strain_rate == last.cutoff_strain_rate &&
           stage.cutoff_slip == last.cutoff_slip && stage.free_surface == last.free_surface &&
           stage.release == last.release && stage.end_pressure == last.end_pressure &&
           stage.flexibility == last.flexibility && stage.tension == last.tension &&
           stage.friction == last.friction;
  }
  UnsymmetricFactor factor;
  StripCourse &course;
  bool is_finest;
};

[[noreturn]] void refuse(const StripPass &pass, const Continuation &c, const StripStage &wanted)
{
  const StripFlowModel &m = pass.model;
  std::string remedy = "more elements along the arc, or a state nearby as start (less friction, less reduction)";
  if (m.arc == bite::Arc::elastic)
    remedy = "a rigid-plastic strip has a pressure step at both ends, which an elastic roll answers to with an "
             "infinite slope: take the elastic-plastic strip, or Hitchcock's circle";
  if (pass.flexibility) {
    const auto &result = pass.flexibility->position;
    remedy += "; the flexibility given reaches from " + short_number(result[0] * 1e3, 3) + " to " +
              short_number(result[result.size() - 1] * 1e3, 3) +
              " mm from the line of centres, the contact had come to " +
              short_number(-c.u[c.grid.whole(Whole::exit)] * pass.length * 1e3, 3) + " to " +
              short_number(-c.u[c.grid.whole(Whole::entry)] * pass.length * 1e3, 3) + " mm";
  }
  throw SolverError(
      {"roll bite by finite elements: no convergence at g0 = " + short_number(wanted.cutoff_strain_rate, 3) +
           " of the mean rate of shear, d0 = " + short_number(wanted.cutoff_slip, 3) + " of the roll's speed" +
           (wanted.flexibility > 0 ? ", roll flattening " + short_number(100 * wanted.flexibility, 3) + " %" : ""),
       "last residual " + short_number(c.last_residual, 3) + ", wanted " + short_number(m.tolerance, 3) + "; " +
           std::to_string(c.grid.n_unknowns) + " unknowns",
       "friction at its limit over most of the arc, or a mesh too coarse for the ends of the contact", remedy,
       "converged up to g0 = " + short_number(c.reached.cutoff_strain_rate, 3) +
           ", d0 = " + short_number(c.reached.cutoff_slip, 3) + ", flattening " +
           short_number(100 * c.reached.flexibility, 3) + " %"});
}

// From an even flow to the last level, on one grid.
void solve_cold(Continuation &c)
{
  const StripStage wanted = last_stage(c.pass);
  StripStage stage;
  // A regularised strip would be torn by the tensions that it carries once it is all but rigid.
  const Strip &strip   = c.pass.bite->strip;
  const double tension = std::max(std::abs(strip.entry_tension), std::abs(strip.exit_tension)) / c.pass.stress;
  stage.tension        = std::min(1., 0.3 / tension);
  stage.friction       = c.pass.more_friction;
  if (!c.picard(stage))
    refuse(c.pass, c, stage);
  stage.picard = false;
  for (const double rate : {1., 0.03, 0.001, 0.}) {
    stage.cutoff_strain_rate = std::max(rate, wanted.cutoff_strain_rate);
    stage.cutoff_slip        = std::max(wanted.cutoff_slip, std::min(0.3 * rate, 0.05));
    if (!c.advance(stage))
      refuse(c.pass, c, stage);
    if (wanted.free_surface && !stage.free_surface && rate < 0.5) {
      stage.free_surface = true;
      if (!c.advance(stage))
        refuse(c.pass, c, stage);
    }
    if (stage.cutoff_strain_rate == wanted.cutoff_strain_rate && stage.cutoff_slip == wanted.cutoff_slip)
      break;
  }
  if (wanted.release) {
    stage.release          = true;
    c.reached.end_pressure = c.u[c.grid.contact(c.grid.last)];
    if (!c.advance(stage))
      refuse(c.pass, c, stage);
  }
  if (stage.tension < 1) {
    stage.tension = 1;
    if (!c.advance(stage))
      refuse(c.pass, c, stage);
  }
  if (stage.friction > 1) {
    stage.friction = 1;
    if (!c.advance(stage))
      refuse(c.pass, c, stage);
  }
  if (wanted.flexibility > 0) {
    stage.flexibility = 1;
    if (!c.advance(stage))
      refuse(c.pass, c, stage);
  }
}

// A state of another grid or pass as start: the last level at once, or from a regularised strip on.
bool solve_warm(Continuation &c)
{
  const StripStage wanted = last_stage(c.pass);
  if (c.newton(wanted))
    return true;
  StripStage soft         = wanted;
  soft.cutoff_strain_rate = std::max(wanted.cutoff_strain_rate, 0.03);
  soft.cutoff_slip        = std::max(wanted.cutoff_slip, 0.01);
  return c.newton(soft) && c.advance(wanted);
}

StripLines scaled(StripLines lines, const double by)
{
  lines.inlet *= by;
  lines.outlet *= by;
  return lines;
}

VectorXd solve_unknowns(const StripPass &pass, const StripGrid &grid, const StripFlow *start, StripCourse &course)
{
  if (start && start->unknowns.size() > 0) {
    Continuation c(pass, strip_grid(start->lines), start->unknowns, grid, course, true);
    if (solve_warm(c))
      return c.u;
  }
  std::vector<StripGrid> grids{grid};
  for (StripLines lines = grid.lines; coarsened(lines);)
    grids.push_back(strip_grid(lines));
  std::optional<VectorXd> u;
  for (auto g = grids.rbegin(); g != grids.rend(); ++g) {
    const bool finest = g + 1 == grids.rend();
    if (u) {
      Continuation c(pass, *(g - 1), *u, *g, course, finest);
      u.reset();
      if (solve_warm(c))
        u = c.u;
      if (u)
        continue;
    }
    Continuation c(pass, *g, first_guess(pass, *g), course, finest);
    try {
      solve_cold(c);
      u = c.u;
    } catch (const SolverError &) {  // a finer grid may do: sticking needs it
      if (finest)
        throw;
    }
  }
  return *u;
}

double input_unit(const StripPass &pass, const int input)
{
  switch (bite::Input(input)) {
  case bite::Input::entry_thickness:
  case bite::Input::exit_thickness:
  case bite::Input::arc_radius:
    return pass.length;
  case bite::Input::entry_tension:
  case bite::Input::exit_tension:
    return pass.stress;
  case bite::Input::roll_speed:
  case bite::Input::gap_rate:
    return std::isnan(pass.bite->roll_speed) ? not_given : pass.speed;
  default:
    return 1;
  }
}

// Exact derivatives of force and traction by all inputs, (18.15): one transposed solve each.
struct Gradients {
  bite::Gradient force, traction;
};
Gradients gradients(StripPass pass, const StripGrid &grid, StripStage stage, const VectorXd &u, const bool held)
{
  stage.arc_held         = held;
  pass.held_radius       = held ? u[grid.whole(Whole::radius)] : not_given;
  const StripEquations e = strip_equations(pass, grid, stage, u);
  UnsymmetricFactor factor;
  Gradients out;
  out.force.fill(not_given);
  out.traction.fill(not_given);
  if (!factor.factorise(grid.n_unknowns, e.entries))
    return out;
  const double unit = pass.stress * pass.length * pass.bite->strip.width;
  for (const auto &[sum, gradient] : {std::pair(&e.force, &out.force), std::pair(&e.traction, &out.traction)}) {
    const VectorXd weight = factor.solve_transposed(sum->by.head(grid.n_unknowns));
    const VectorXd by     = sum->by.tail(bite::n_inputs) - e.by_input.transpose() * weight;
    for (int i = 0; i < bite::n_inputs; ++i)
      (*gradient)[i] = by[i] * unit / input_unit(pass, i);
  }
  return out;
}
}  // namespace

StripFlow solve_strip_flow(const StripLines &lines, const bite::RollBite &bite, const StripFlowModel &model,
                           const bite::ArcFlexibility *flexibility, const StripFlow *start)
{
  const auto begin     = std::chrono::steady_clock::now();
  const StripPass pass = strip_pass(bite, model, flexibility);
  const StripGrid grid = strip_grid(scaled(lines, 1 / pass.length));
  StripCourse course;
  const VectorXd u       = solve_unknowns(pass, grid, start, course);
  const StripStage stage = last_stage(pass);
  StripFlow flow         = strip_flow_results(pass, grid, stage, u);
  flow.lines             = lines;
  flow.history           = std::move(course.levels);
  flow.work              = course.work;
  if (model.derivatives) {
    const Gradients held = gradients(pass, grid, stage, u, true);
    flow.state.force_by  = held.force;
    for (int i = 0; i < bite::n_inputs; ++i)
      flow.state.torque_by[i] = bite.roll_radius * held.traction[i];
    flow.state.force_by_exit_following =
        model.arc == bite::Arc::rigid
            ? bite::by(held.force, bite::Input::exit_thickness)
            : bite::by(gradients(pass, grid, stage, u, false).force, bite::Input::exit_thickness);
  } else {
    flow.state.force_by.fill(not_given);
    flow.state.torque_by.fill(not_given);
  }
  flow.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return flow;
}
}  // namespace mill::fem
