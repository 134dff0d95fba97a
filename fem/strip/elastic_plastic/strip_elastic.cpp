#include "fem/strip/elastic_plastic/strip_elastic.h"
#include "core/base/errors.h"
#include "fem/strip/elastic_plastic/strip_elastic_equations.h"
#include "fem/strip/elastic_plastic/strip_elastic_newton.h"
#include "fem/strip/elastic_plastic/strip_elastic_results.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/karman.h"
#include <chrono>
#include <cmath>

namespace mill::fem {
using bite::sentence;
using Eigen::VectorXd;

namespace {
bool reaches_limit(const ElasticGrid &grid, const VectorXd &u)
{
  for (int i = 1; i + 1 < grid.x.size(); ++i)
    if (grid.force(i) >= 0 && (grid.force(i - 1) < 0 || grid.force(i + 1) < 0) &&
        u[grid.force(i)] > 1e-6 * grid.tributary[i])
      return true;
  return false;
}

// Reach of the contact to look at, before and behind the line of centres, scaled
std::pair<double, double> expected_reach(const ElasticPass &pass)
{
  const double L = pass.arc_length;
  // Spring-back of the strip under a pressure of twice the flow stress fills the gap of a circle up to here.
  const double back = std::sqrt(pass.radius * pass.exit * 4 * pass.shear_compliance);
  double length     = L;
  if (pass.model.arc == bite::Arc::elastic) {
    length = 1.6 * L;
    try {
      bite::KarmanOptions quick;
      quick.derivatives = false;
      quick.points      = 0;
      length            = std::max(
                     1.2 * L,
                     bite::solve_karman(*pass.bite, bite::Theory::karman, bite::Arc::hitchcock, nullptr, quick).arc_length /
                         pass.length);
    } catch (const InputError &) {  // light passes of strip under tension are none to a rigid-plastic slab
    } catch (const SolverError &) {
    }
    return {1.1 * length + back, 0.45 * length + 1.5 * back};
  }
  return {1.1 * L + 0.5 * back, 0.1 * L + 1.5 * back};
}

[[noreturn]] void refuse_reach(const ElasticPass &pass, const double before, const double behind)
{
  throw SolverError({"roll bite by finite elements: the contact goes on where none was expected",
                     sentence("from ", before * pass.length * 1e3, " mm before to ", behind * pass.length * 1e3,
                              " mm behind the line of centres"),
                     "strip so thin and hard that the rolls are flattened to a foil's gap",
                     "less reduction, smaller rolls", ""});
}

struct Solved {
  ElasticGrid grid;
  ElasticRoll roll;
  VectorXd unknowns;
  double touch_from = 0, touch_to = 0;  // -
};

// A mesh for contact between two abscissae, fine where it is expected to end.
Solved meshed(const ElasticPass &pass, const bite::ArcFlexibility *flexibility, const double from, const double to,
              const double size, const std::vector<ElasticFocus> &foci, const int through)
{
  const StripElasticModel &model = pass.model;
  const double outside           = model.outside > 0 ? model.outside : pass.arc_length < 1 + pass.exit ? 1.5 : 1;
  Solved s;
  s.touch_from = from;
  s.touch_to   = to;
  std::vector<double> fixed{from - outside, to + outside};
  if (pass.model.arc == bite::Arc::rigid)  // where circle and strip meet, always in the same place of an element
    fixed = {from - outside, -pass.arc_length, 0, to + outside};
  s.grid = elastic_grid(elastic_lines(fixed, from, to, size, foci), through, from, to);
  s.roll = elastic_roll(pass, s.grid, flexibility);
  return s;
}

// Lines that follow the place where circle and strip meet, so that the state is a smooth function of what is
// given.
void lead_by_circle(ElasticGrid &g, const double arc_length)
{
  const auto nearest = [&](const double x) {
    int best = 0;
    for (int i = 0; i < g.x.size(); i += 2)
      if (std::abs(g.x[i] - x) < std::abs(g.x[best] - x))
        best = i;
    return best;
  };
  g.entry_spine = nearest(-arc_length);
  g.exit_spine  = nearest(0);
  g.entry_ratio = -g.x[g.entry_spine] / arc_length;
}

void place_lines(const ElasticGrid &g, VectorXd &u)
{
  u[g.bulk(Bulk::entry_end)] = g.x[g.entry_spine];
  u[g.bulk(Bulk::exit_end)]  = g.x[g.exit_spine];
}

// A rigid roll is met where its circle meets the strip.
Solved solve_on_circle(const ElasticPass &pass, StripCourse &course)
{
  const StripElasticModel &model = pass.model;
  auto [before, behind]          = expected_reach(pass);
  const double L = pass.arc_length, size = L / model.elements_along, end = size * model.finest;
  for (int attempt = 0; attempt < 3; ++attempt, before *= 1.2, behind *= 2) {
    Solved s = meshed(pass, nullptr, -before, behind, size,
                      {{-L - size, -L + size, end}, {-size, behind, 2 * end}}, model.elements_through);
    lead_by_circle(s.grid, L);
    // The first levels on a mesh with half the lines, where they cost a fifth
    Solved coarse = meshed(pass, nullptr, -before, behind, 2 * size,
                           {{-L - size, -L + size, 2 * end}, {-size, behind, 4 * end}},
                           std::max(2, model.elements_through / 2));
    ElasticContinuation first(pass, coarse.grid, coarse.roll, first_guess(pass, coarse.grid), course);
    bool begun = true;
    try {
      solve_cold(first, 0.1);
    } catch (const SolverError &) {  // a finer mesh may do
      begun = false;
    }
    ElasticContinuation c(pass, s.grid, s.roll, interpolated(coarse.grid, first.u, s.grid), course);
    place_lines(s.grid, c.u);
    if (begun && c.newton(first.reached, "Newton, free surface")) {
      harden(c, 0.1);
    } else {
      c.u = first_guess(pass, s.grid);
      solve_cold(c);
    }
    if (reaches_limit(s.grid, c.u))
      continue;
    s.unknowns = c.u;
    return s;
  }
  refuse_reach(pass, before, behind);
}

// An elastic roll: where, is found on a coarse mesh.
Solved solve_on_elastic_roll(const ElasticPass &pass, const bite::ArcFlexibility *flexibility, StripCourse &course)
{
  const StripElasticModel &model = pass.model;
  auto [before, behind]          = expected_reach(pass);
  for (int attempt = 0; attempt < 3; ++attempt, before *= 1.4, behind *= 1.4) {
    Solved coarse = meshed(pass, flexibility, -before, behind, (before + behind) / 36, {},
                           std::min(4, model.elements_through));
    ElasticContinuation c(pass, coarse.grid, coarse.roll, first_guess(pass, coarse.grid), course);
    solve_cold(c, fit_rate);
    if (reaches_limit(coarse.grid, c.u))
      continue;
    const auto [from, to] = spines_in_contact(coarse.grid, c.u, c.reached.softness);
    if (from < 0)
      continue;
    const double first = coarse.grid.x[from], last = coarse.grid.x[to];
    const double size = (last - first) / model.elements_along, end = size * model.finest,
                 margin = 0.05 * (last - first);
    const double known  = (before + behind) / 36;  // the ends, to a coarse element
    Solved fine =
        meshed(pass, flexibility, first - margin, last + margin, size,
               {{first - known, first + known, end}, {last - known, last + known, end}}, model.elements_through);
    {
      ElasticContinuation d(pass, fine.grid, fine.roll, interpolated(coarse.grid, c.u, fine.grid), course);
      d.fits = true;
      try {
        solve_warm(d);
      } catch (const SolverError &) {
        d.u = first_guess(pass, fine.grid);
        solve_cold(d);
      }
      fine.unknowns = d.u;
    }
    if (!reaches_limit(fine.grid, fine.unknowns))
      return fine;
  }
  refuse_reach(pass, before, behind);
}

Solved solve_from_nothing(const ElasticPass &pass, const bite::ArcFlexibility *flexibility, StripCourse &course)
{
  return pass.model.arc == bite::Arc::elastic ? solve_on_elastic_roll(pass, flexibility, course)
                                              : solve_on_circle(pass, course);
}

// Unknowns in the units of another pass
VectorXd in_units(const ElasticGrid &grid, VectorXd u, const double length, const double stress)
{
  for (int i = 0; i < grid.x.size(); ++i) {
    for (int J = 1; J <= grid.n_through; ++J)
      u[grid.height(i, J)] *= length;
    if (grid.force(i) >= 0)
      u[grid.force(i)] *= length * stress;
  }
  for (const int id : grid.pressure_of)
    u[id] *= stress;
  for (const Bulk b : {Bulk::roll_height, Bulk::entry_thickness, Bulk::exit_thickness, Bulk::radius,
                       Bulk::entry_end, Bulk::exit_end})
    u[grid.bulk(b)] *= length;
  for (const Bulk b :
       {Bulk::entry_tension, Bulk::exit_tension, Bulk::inlet_xx, Bulk::inlet_yy, Bulk::inlet_pressure})
    u[grid.bulk(b)] *= stress;
  return u;
}

Solved solve_from(const ElasticPass &pass, const StripElastic &start, const bite::ArcFlexibility *flexibility,
                  StripCourse &course)
{
  Solved s;
  std::vector<double> lines = start.lines;
  for (double &x : lines)
    x /= pass.length;
  s.touch_from = start.touch_from / pass.length;
  s.touch_to   = start.touch_to / pass.length;
  s.grid       = elastic_grid(lines, int(start.flow.y.cols() - 1) / 2, s.touch_from, s.touch_to);
  s.roll       = elastic_roll(pass, s.grid, flexibility);
  const double length =
      start.flow.y(start.flow.y.rows() - 1, start.flow.y.cols() - 1) * 2;  // entry thickness then
  ElasticContinuation c(
      pass, s.grid, s.roll,
      in_units(s.grid, start.flow.unknowns, length / pass.length, start.stress_unit / pass.stress), course);
  if (start.entry_spine >= 0) {
    s.grid.entry_spine     = start.entry_spine;
    s.grid.exit_spine      = start.exit_spine;
    s.grid.entry_ratio     = start.entry_ratio;
    s.grid.ends_of_contact = pass.model.arc == bite::Arc::elastic;
    if (s.grid.ends_of_contact && !c.newton(last_stage(pass), "Newton, fitted ends", 20)) {
      s.grid.entry_spine = s.grid.exit_spine = -1;
      s.grid.ends_of_contact                 = false;
    }
  }
  if (!s.grid.ends_of_contact)
    solve_warm(c);
  if (reaches_limit(s.grid, c.u))
    return solve_from_nothing(pass, flexibility, course);
  s.unknowns = c.u;
  return s;
}
}  // namespace

StripElastic solve_elastic_strip(const bite::RollBite &bite, const StripElasticModel &model,
                                 const bite::ArcFlexibility *flexibility, const StripElastic *start)
{
  const auto begin       = std::chrono::steady_clock::now();
  const ElasticPass pass = elastic_pass(bite, model);
  if (flexibility && model.arc != bite::Arc::elastic)
    throw InputError("a flexibility of the roll's surface is for Arc::elastic only");
  StripCourse course;
  Solved s           = start && start->flow.unknowns.size() > 0 ? solve_from(pass, *start, flexibility, course)
                                                                : solve_from_nothing(pass, flexibility, course);
  ElasticStage stage = last_stage(pass);
  StripElastic out   = elastic_results(pass, s.grid, s.roll, stage, s.unknowns);
  // Inlet and outlet have moved with the ends of the contact.
  const ElasticGrid there = moved(s.grid, s.unknowns);
  const int last          = int(there.x.size()) - 1;
  out.touch_from          = (s.touch_from + there.x[0] - s.grid.x[0]) * pass.length;
  out.touch_to            = (s.touch_to + there.x[last] - s.grid.x[last]) * pass.length;
  out.flow.history        = std::move(course.levels);
  out.flow.work           = course.work;
  out.flow.seconds        = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}
}  // namespace mill::fem
