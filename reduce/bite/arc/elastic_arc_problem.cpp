#include "reduce/bite/arc/elastic_arc_problem.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <Eigen/LU>
#include <cmath>

namespace mill::bite {
void refuse_arc_window(const char *end, const double first, const double last)
{
  throw SolverError({sentence("roll bite: the elastic arc has no ", end, " between its points"),
                     sentence("points from ", first * 1e3, " to ", last * 1e3, " mm about the line of centres"),
                     "the arc grows far beyond its rigid length",
                     "a smaller work roll, less friction or more tension", ""});
}

namespace {
/// Distance of unknowns from their answer: pressures over a stress, friction as it is.
double distance(const Unknowns &u, const Unknowns &answer, const double stress)
{
  const double p = (u.pressure - answer.pressure).norm() / (stress * std::sqrt(u.pressure.size()));
  return std::hypot(p, u.mu - answer.mu);
}

struct Convergence {
  bool reached   = false;
  int steps      = 0;
  double residue = 0;
};

/// Newton's method with halved steps where a whole one does not come closer.
Convergence newton(const ArcProblem &problem, Unknowns &u, const double share, const double stress,
                   const double tolerance)
{
  Convergence c;
  Unknowns answer = problem.answer(u, share);
  c.residue       = distance(u, answer, stress);
  for (; c.steps < 50; ++c.steps) {
    if (c.residue < tolerance) {
      c.reached = true;
      return c;
    }
    const auto t = problem.tangent(u, share, false);
    Eigen::VectorXd r(problem.n + 1);
    r << u.pressure - answer.pressure, u.mu - answer.mu;
    const Eigen::VectorXd step = problem.matrix(t).partialPivLu().solve(r);
    bool closer                = false;
    for (double a = 1; a > 1e-4 && !closer; a *= 0.5) {
      const Unknowns trial{u.pressure - a * step.head(problem.n), u.mu - a * step[problem.n]};
      try {
        const Unknowns there = problem.answer(trial, share);
        const double d       = distance(trial, there, stress);
        if (d < c.residue * (1 - 0.1 * a)) {
          u         = trial;
          answer    = there;
          c.residue = d;
          closer    = true;
        }
      } catch (const SolverError &) {  // a trial shape without exit or entry in the window
      }
    }
    if (!closer) {
      c.reached = c.residue < 1e3 * tolerance;  // rounding
      return c;
    }
  }
  return c;
}
}  // namespace

int solve_on(const ArcProblem &problem, Unknowns &u, const bool near, const double stress, const double tolerance)
{
  int steps    = 0;
  double share = 0, stride = 1;
  if (!near)
    u.pressure = problem.answer({Eigen::VectorXd::Zero(problem.n), u.mu}, 0).pressure;
  Convergence c;
  while (share < 1) {
    const double next = std::min(1.0, share + stride);
    Unknowns trial    = u;
    try {
      c = newton(problem, trial, next, stress, tolerance);
      steps += c.steps;
    } catch (const SolverError &) {
      if (stride < 0.02)
        throw;
      c = {};
    }
    if (c.reached) {
      u     = trial;
      share = next;
      stride *= 2;
    } else if (near) {
      return solve_on(problem, u, false, stress, tolerance);
    } else
      stride *= 0.5;
    if (stride < 0.01)
      throw SolverError(
          {"roll bite: the elastic arc does not converge",
           sentence("reached ", 100 * share, " % of the roll's compliance, force there ",
                    problem.weight.dot(u.pressure) * problem.bite_.strip.width / 1e3, " kN, residual ", c.residue,
                    " of the flow stress"),
           "the strip is so thin or hard that the arc becomes parallel: a zone without slip would form",
           "a smaller work roll, less friction, more tension or a thicker strip", ""});
  }
  return steps;
}
}  // namespace mill::bite
