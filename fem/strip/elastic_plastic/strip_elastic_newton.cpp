#include "fem/strip/elastic_plastic/strip_elastic_newton.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <cmath>

namespace mill::fem {
using bite::sentence;
using Eigen::VectorXd;

ElasticContinuation::ElasticContinuation(const ElasticPass &p, ElasticGrid &g, const ElasticRoll &r,
                                         VectorXd start, StripCourse &h)
    : pass(p), grid(g), roll(r), u(std::move(start)), course(h)
{
}

// Residual at which a level is good enough to go on from: what it leaves is gone after the next one's first step.
constexpr double start_tolerance = 1e-3;
// And where the lines of a mesh are laid by it: they shall not hang on what is left.
constexpr double mesh_tolerance = 1e-7;
// Steps in a row cut down to this share, because a speed or a height would turn negative: the level is out of
// reach.
constexpr double crawling_share = 1e-3;
constexpr int most_crawling     = 5;
// Steps after which a leap must have come below where it began.
constexpr int leap_steps = 12;

bool ElasticContinuation::is_last(const ElasticStage &s) const
{
  const ElasticStage last = last_stage(pass);
  return !s.held_shape && s.cutoff_strain_rate == last.cutoff_strain_rate && s.cutoff_slip == last.cutoff_slip &&
         s.softness == last.softness && s.compliance == last.compliance && s.flattening == last.flattening;
}

double ElasticContinuation::tolerance(const ElasticStage &s) const
{
  const bool lays_mesh = pass.model.arc == bite::Arc::elastic && !grid.moves() &&
                         s.cutoff_strain_rate == fit_rate && s.flattening == 1;
  return is_last(s)  ? pass.model.tolerance
         : lays_mesh ? std::max(pass.model.tolerance, mesh_tolerance)
                     : std::max(pass.model.tolerance, start_tolerance);
}

bool ElasticContinuation::newton(ElasticStage stage, const char *what, const int steps, const bool leaps)
{
  const VectorXd before = u;
  find_thinnest(stage);
  ElasticEquations e  = elastic_equations(pass, grid, roll, stage, u, memory, true);
  double residual     = e.residual.norm();
  const double enough = tolerance(stage);
  int stuck = 0, crawling = 0, leap = 0;
  double before_leap = 0;
  for (int step = 1; step <= steps && std::isfinite(residual); ++step) {
    course.spend(grid.n_unknowns, pass.model.work_limit);
    if (!factor.factorise(grid.n_unknowns, e.entries))
      break;
    const VectorXd d = factor.solve(e.residual), from = u;
    const double longest = largest_share(d);
    crawling             = longest < crawling_share ? crawling + 1 : 0;
    double next          = 0;
    const auto go        = [&](const double share) {
      u    = from - share * d;
      e    = elastic_equations(pass, grid, roll, stage, u, memory, false);
      next = e.residual.norm();
    };
    const double least = leaps ? 0.03 : 4e-3;
    double share       = longest;
    for (go(share); !(next < (1 - 1e-4 * share) * residual) && share > least * longest; go(share))
      share *= 0.5;
    if (!(next < residual)) {
      // The least residual in reach is none: where a state ceases to exist the next one is found by a leap.
      ++stuck;
      if (leaps) {
        go(0.5 * longest);
        if (leap == 0) {
          leap        = step;
          before_leap = residual;
        }
      }
    }
    const bool moved = find_thinnest(stage);
    last_residual    = residual;
    if (!std::isfinite(next) || stuck > 5 || crawling > most_crawling)
      break;
    e        = elastic_equations(pass, grid, roll, stage, u, memory, true);
    residual = last_residual = e.residual.norm();
    if (leap > 0 && step >= leap + leap_steps && residual > before_leap)
      break;
    if (residual < enough && !moved) {
      const double unit = pass.stress * pass.length * pass.bite->strip.width;
      course.levels.push_back({what, grid.n_unknowns, stage.cutoff_strain_rate, stage.cutoff_slip * pass.reduction,
                               stage.flattening, step, residual, e.force * unit});
      reached = stage;
      return true;
    }
  }
  u = before;
  return false;
}

bool ElasticContinuation::advance(const ElasticStage &target, const char *what, const int depth)
{
  if (newton(target, what) || newton(target, what, 40, false))
    return true;
  if (depth == 3)
    return false;
  const auto between = [](const double a, const double b, const double least) {
    return std::sqrt(std::max(a, least) * std::max(b, least));
  };
  ElasticStage middle       = target;
  middle.cutoff_strain_rate = between(reached.cutoff_strain_rate, target.cutoff_strain_rate, 1e-7);
  middle.cutoff_slip        = between(reached.cutoff_slip, target.cutoff_slip, 1e-7);
  middle.softness           = between(reached.softness, target.softness, 1e-15);
  middle.compliance         = 0.5 * (reached.compliance + target.compliance);
  middle.flattening         = 0.5 * (reached.flattening + target.flattening);
  return advance(middle, what, depth + 1) && advance(target, what, depth + 1);
}

// With an elastic roll the exit thickness is that of the thinnest place under load, which moves.
bool ElasticContinuation::find_thinnest(ElasticStage &stage) const
{
  if (roll.displacement.size() == 0)
    return false;
  const int before = stage.thinnest;
  stage.thinnest   = thinnest_spine(grid, u, before);
  return stage.thinnest != before;
}

std::pair<int, int> spines_in_contact(const ElasticGrid &grid, const VectorXd &u, const double softness)
{
  int first = -1, last = -1;
  for (int i = 0; i < grid.x.size(); ++i)
    if (grid.force(i) >= 0 && u[grid.force(i)] > std::sqrt(softness) * grid.tributary[i]) {
      first = first < 0 ? i : first;
      last  = i;
    }
  return {first, last};
}

// Speeds and heights stay positive.
double ElasticContinuation::largest_share(const VectorXd &d) const
{
  double share = 1;
  for (int i = 0; i < grid.x.size(); ++i) {
    for (int j = 0; j <= 2 * grid.n_through; ++j) {
      const int k = grid.velocity(i, j, 0);
      if (d[k] > 0.8 * u[k])
        share = std::min(share, 0.8 * u[k] / d[k]);
    }
    for (int J = 1; J <= grid.n_through; ++J) {
      const int k = grid.height(i, J);
      if (std::abs(d[k]) > 0.2 * u[k])
        share = std::min(share, 0.2 * u[k] / std::abs(d[k]));
    }
  }
  return std::max(share, 1e-4);
}

ElasticStage last_stage(const ElasticPass &pass)
{
  ElasticStage s;
  s.cutoff_strain_rate = pass.model.cutoff_strain_rate;
  s.cutoff_slip        = pass.model.cutoff_slip;
  s.softness           = 1e-14;
  s.compliance         = 1;
  s.flattening         = pass.model.arc == bite::Arc::elastic ? 1 : 0;
  s.held_shape         = false;
  return s;
}

namespace {
[[noreturn]] void refuse(const ElasticContinuation &c, const ElasticStage &wanted)
{
  const auto stage = [](const ElasticStage &s) {
    return sentence("g0 = ", s.cutoff_strain_rate, " of the mean rate of shear, elasticity of the strip ",
                    100 * s.compliance, " %, flattening of the roll ", 100 * s.flattening, " %");
  };
  const ElasticPass &pass = c.pass;
  throw SolverError({"roll bite by finite elements, elastic-plastic strip: no convergence at " + stage(wanted),
                     sentence("last residual ", c.last_residual, ", wanted ", pass.model.tolerance, "; ",
                              c.grid.n_unknowns, " unknowns"),
                     sentence("rolls that cannot draw the strip in (angle of bite ", pass.arc_length / pass.radius,
                              " rad, friction ", c.u[c.grid.bulk(Bulk::friction)],
                              "), tension near the flow stress, or a mesh too coarse for the "
                              "ends of the contact"),
                     "more friction or less reduction; more elements along; a converged state nearby as start",
                     "converged up to " + stage(c.reached)});
}

// Moves the lines of the mesh so that two of them are the ends of the contact: pressure and gap zero there.  From
// here on the state is a smooth function of what is given.
bool fit(ElasticContinuation &c, const ElasticStage &stage)
{
  ElasticGrid &g           = c.grid;
  const auto [first, last] = spines_in_contact(g, c.u, stage.softness);
  if (first < 2 || last + 3 > g.x.size() || last - first < 8)
    return false;
  const VectorXd before = c.u;
  g.entry_spine         = first - first % 2;
  g.exit_spine          = last + last % 2;
  if (g.force(g.entry_spine) < 0 || g.force(g.exit_spine) < 0) {
    g.entry_spine = g.exit_spine = -1;
    return false;
  }
  c.u[g.bulk(Bulk::entry_end)] = g.x[g.entry_spine];
  c.u[g.bulk(Bulk::exit_end)]  = g.x[g.exit_spine];
  for (int i = 0; i < g.x.size(); ++i)
    if (g.force(i) >= 0 && (i < g.entry_spine || i > g.exit_spine))
      c.u[g.force(i)] = 0;
  g.ends_of_contact = true;
  if (c.newton(stage, "Newton, fitted ends", 40))
    return true;
  g.ends_of_contact = false;
  g.entry_spine = g.exit_spine = -1;
  c.u                          = before;
  return false;
}

}  // namespace

// Down from a regularised strip at rate `from`, everything else as at the end.
void harden(ElasticContinuation &c, const double from, const double until)
{
  const ElasticStage last = last_stage(c.pass);
  const char *what        = "Newton, free surface";
  for (const double rate : {0.1, 0.03, 0.01, 1e-3}) {
    if (rate > 1.01 * from || rate <= last.cutoff_strain_rate || rate < until)
      continue;
    ElasticStage s       = last;
    s.cutoff_strain_rate = rate;
    s.cutoff_slip        = std::max(last.cutoff_slip, std::min(0.2, 0.5 * rate));
    s.softness           = 1e-2 * rate * rate;
    if (c.reached.held_shape || c.reached.flattening < s.flattening) {
      s.cutoff_slip     = std::max(s.cutoff_slip, 0.05);
      ElasticStage part = s;
      part.flattening   = 0;
      if (!c.advance(part, what))
        refuse(c, part);
      for (const double share : {0.2, 0.6})
        if (s.flattening > 0) {
          part.flattening = share;
          if (!c.advance(part, what))
            refuse(c, part);
        }
    }
    // A rigid roll is there already.
    const bool there = c.reached.cutoff_strain_rate == s.cutoff_strain_rate &&
                       c.reached.cutoff_slip == s.cutoff_slip && c.reached.softness == s.softness &&
                       c.reached.flattening == s.flattening;
    if (!there && !c.advance(s, what))
      refuse(c, s);
    if (c.fits && rate <= fit_rate && !c.grid.moves())
      fit(c, s);
  }
  if (until == 0 && !c.advance(last, what))
    refuse(c, last);
}

void solve_cold(ElasticContinuation &c, const double until)
{
  ElasticStage s;
  const char *what = "Newton, fixed surface";
  for (const double rate : {1., 0.3, 0.1}) {
    s.cutoff_strain_rate = s.cutoff_slip = rate;
    if (!c.advance(s, what))
      refuse(c, s);
    s.compliance = 1;  // from the second level on: at the first the strip is only viscous
  }
  harden(c, 0.1, until);
}

// From a state of another mesh or pass: the last level at once, or from a regularised strip on.
void solve_warm(ElasticContinuation &c)
{
  const ElasticStage last = last_stage(c.pass);
  const char *what        = "Newton, free surface";
  if (!c.fits && c.newton(last, what, 20))
    return;
  for (const double rate : {c.fits ? fit_rate : 1e-3, 1e-2, 0.1}) {
    ElasticStage soft       = last;
    soft.cutoff_strain_rate = rate;
    soft.cutoff_slip        = std::max(last.cutoff_slip, 0.5 * rate);
    soft.softness           = 1e-2 * rate * rate;
    if (c.newton(soft, what, 25)) {
      harden(c, c.fits ? rate : 0.9 * rate);
      return;
    }
  }
  refuse(c, last);
}
}  // namespace mill::fem
