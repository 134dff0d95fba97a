#include "fem/contact/continuation.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::contact {
namespace {
// All nodes at one place of the path: values and slopes of what is zero on the other side of complementarity.
struct Slopes {
  ModeState constant, linear;
  Eigen::MatrixXd gram;
  Eigen::MatrixXd nodal;  // (n, 2) force at parameter 0 and its slope, 0 outside
  Eigen::MatrixXd gap;    // (n, 2)
  double length;          // m, of the closing
};

Slopes slopes(const ActiveFactor &factor, const ScaledModes &modes, const Loading &constant, const Loading &linear,
              const double coordinate, const ModeState &here)
{
  Slopes out;
  out.gram   = factor.gram();
  out.linear = solve_modes(out.gram, modes, linear, 1);
  // A free motion that too few nodes determine goes on from where it is.
  ModeState near = here;
  near.motion -= coordinate * out.linear.motion;
  near.resultant -= coordinate * out.linear.resultant;
  out.constant = solve_modes(out.gram, modes, constant, 0, &near);
  Eigen::MatrixXd c(modes.rhs.cols(), 2);
  c << closing(out.constant, modes, 0), closing(out.linear, modes, 1);
  const Eigen::MatrixXd force  = factor.combine(c);
  const Eigen::MatrixXd closed = factor.rhs() * c;
  out.gap                      = factor.product(force) - closed;
  out.nodal                    = Eigen::MatrixXd::Zero(out.gap.rows(), 2);
  for (std::size_t i = 0; i < factor.order().size(); ++i) {
    out.nodal.row(factor.order()[i]) = force.row(i);
    out.gap.row(factor.order()[i]).setZero();
  }
  out.length = closed.cwiseAbs().maxCoeff();
  return out;
}

const char *const outside =
    "no equilibrium next to this one: the line of action leaves the contact, or a free motion would jump";

[[noreturn]] void lost(const double place, const std::string &why)
{
  throw SolverError({"contact: the path ends before its end", "at " + std::to_string(place) + " of the way", why,
                     "impose motions instead of resultants, or shorten the path", ""});
}

// Which of the nodes without force and gap touch from here on: complementarity of the derivatives.
void settle(ActiveFactor &factor, const ScaledModes &modes, const Loading &linear, const std::vector<int> &ties,
            const std::vector<char> &guess, const double place)
{
  std::vector<int> inside;
  for (const int i : ties)
    if (factor.contains(i))
      inside.push_back(i);
  factor.remove(inside);
  const Border border        = factor.border(ties);
  const Eigen::MatrixXd gram = factor.gram();
  const double rate          = std::max(1e-300, border.rhs.cwiseAbs().maxCoeff());
  auto chosen                = candidates_in_contact(border.S, border.rhs, gram, modes, linear, guess, rate, 1);
  if (chosen.empty())
    chosen = candidates_in_contact(border.S, border.rhs, gram, modes, linear, std::vector<char>(ties.size(), 1),
                                   rate, 1);
  if (chosen.empty())
    lost(place, outside);
  factor.append(border, chosen);
}
}  // namespace

void follow_path(ActiveFactor &factor, const ScaledModes &modes, const Loading &constant, const Loading &linear,
                 const ModeState &start, const std::vector<int> &touching,
                 const std::function<void(const PathStep &)> &seen)
{
  const int n              = int(factor.rhs().rows());
  double coordinate        = 0;
  ModeState here           = start;
  std::vector<int> ties    = touching;
  std::vector<char> before = factor.indicator();
  Eigen::MatrixXd gram     = factor.gram();
  std::vector<char> guess(ties.size(), 1);
  for (int event = 0; event <= 100 * n + 100; ++event) {
    if (!ties.empty())
      settle(factor, modes, linear, ties, guess, coordinate);
    const Slopes s = slopes(factor, modes, constant, linear, coordinate, here);
    if (std::max(s.constant.missing, s.linear.missing) > 1e-9)  // rounding of an equation that holds: 1e-13
      lost(coordinate, outside);
    PathStep step{coordinate, s.constant, s.linear, gram, s.gram, {}, {}};
    const std::vector<char> now = factor.indicator();
    for (int i = 0; i < n; ++i)
      if (now[i] != before[i])
        (now[i] ? step.entered : step.left).push_back(i);
    seen(step);
    before = now;
    gram   = s.gram;
    if (coordinate >= 1)
      return;
    if (!s.gap.allFinite() || !s.nodal.allFinite())
      lost(coordinate, "no equilibrium");

    // The next zero of a force or a gap; a node settled just now stays as it is while it moves by rounding only.
    std::vector<char> settled(n, 0);
    for (const int i : ties)
      settled[i] = 1;
    double next = 1;
    int first   = -1;
    for (int i = 0; i < n; ++i) {
      const auto &side = now[i] ? s.nodal : s.gap;
      if (side(i, 1) >= 0)
        continue;
      const double zero = -side(i, 0) / side(i, 1);
      if (zero < next && !(settled[i] && zero <= coordinate + 1e-11)) {
        next  = std::max(coordinate, zero);
        first = i;
      }
    }
    // Not moved: what was tied stays tied, so that the same place is settled for more nodes each time.
    const std::vector<int> still = next - coordinate <= 1e-13 ? ties : std::vector<int>{};
    const double force           = (s.nodal.col(0).cwiseAbs() + next * s.nodal.col(1).cwiseAbs()).maxCoeff();
    ties.clear();
    guess.clear();
    if (next < 1)
      for (int i = 0; i < n; ++i) {
        const double value = now[i] ? s.nodal(i, 0) + next * s.nodal(i, 1) : s.gap(i, 0) + next * s.gap(i, 1);
        const double slope = now[i] ? s.nodal(i, 1) : s.gap(i, 1);
        // Ties are equal up to rounding: 1e-13 of the largest force or closing.
        const bool tied = std::find(still.begin(), still.end(), i) != still.end();
        if (i == first || tied || value <= 1e-13 * (now[i] ? force : s.length)) {
          ties.push_back(i);
          guess.push_back(slope < 0 ? !now[i] : now[i]);
        }
      }
    coordinate     = next;
    here.motion    = s.constant.motion + coordinate * s.linear.motion;
    here.resultant = s.constant.resultant + coordinate * s.linear.resultant;
  }
  lost(coordinate, "more events than a path of this size can have");
}

Path follow(ActiveSet &solver, const Loading &from, const Loading &to)
{
  const int k = solver.modes().k;
  if (from.value.size() != k || to.value.size() != k ||
      scaled(from, solver.modes()).prescribed != scaled(to, solver.modes()).prescribed)
    throw InputError("continuation: both drives must impose the same modes in the same way");
  const State start = solver.solve(from);
  std::vector<int> touching;
  const double force  = start.nodal.size() ? start.nodal.maxCoeff() : 0.;
  const double length = (solver.problem().G * start.motion).cwiseAbs().maxCoeff();
  for (int i = 0; i < start.nodal.size(); ++i)
    if (start.nodal[i] <= 1e-13 * force && start.gap[i] <= 1e-13 * length)
      touching.push_back(i);

  const ScaledModes &modes = solver.modes();
  const Loading constant   = scaled(from, modes);
  Loading linear           = scaled(to, modes);
  linear.value -= constant.value;

  ModeState begin;
  begin.motion    = start.motion.cwiseProduct(modes.scale);
  begin.resultant = start.resultant.cwiseQuotient(modes.scale);
  Path path;
  const auto per_scale = modes.scale.cwiseInverse();
  follow_path(solver.factor(), modes, constant, linear, begin, touching, [&](const PathStep &step) {
    Event e;
    e.position  = step.position;
    e.motion    = (step.constant.motion + step.position * step.linear.motion).cwiseProduct(per_scale);
    e.resultant = (step.constant.resultant + step.position * step.linear.resultant).cwiseProduct(modes.scale);
    e.stiffness_before = tangents(step.gram_before, modes).stiffness;
    e.stiffness_after  = tangents(step.gram_after, modes).stiffness;
    e.entered          = step.entered;
    e.left             = step.left;
    path.events.push_back(e);
  });
  return path;
}

PathPoint sample(const Path &path, const double point)
{
  if (!(point >= 0 && point <= 1) || path.events.empty())
    throw InputError("continuation: a path is sampled between 0 and 1, not at " + std::to_string(point));
  std::size_t i = 1;
  while (i + 1 < path.events.size() && path.events[i].position <= point)
    ++i;
  if (path.events.size() == 1)
    return {path.events[0].motion, path.events[0].resultant, path.events[0].stiffness_after};
  const Event &a = path.events[i - 1], &b = path.events[i];
  const double weight = b.position > a.position ? (point - a.position) / (b.position - a.position) : 1.;
  return {a.motion + weight * (b.motion - a.motion), a.resultant + weight * (b.resultant - a.resultant),
          a.stiffness_after};
}
}  // namespace mill::contact
