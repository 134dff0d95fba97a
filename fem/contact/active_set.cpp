#include "fem/contact/active_set.h"
#include "core/base/errors.h"
#include "fem/contact/active_factor.h"
#include "fem/contact/coarse_problem.h"
#include "fem/contact/mode_equations.h"
#include "fem/contact/no_equilibrium.h"
#include "fem/contact/reachable.h"
#include "fem/contact/set_by_continuation.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace mill::contact {
namespace {
constexpr int small_problem = 48;   // nodes that are settled against each other without a coarser start
constexpr int group_size    = 4;    // nodes per unknown of the coarser problem
constexpr int most_in_doubt = 700;  // beyond, plain exchange is cheaper than the border of so many nodes

void require(const Problem &p)
{
  const auto n = p.C.rows(), k = p.G.cols();
  if (n == 0 || p.C.cols() != n || p.G.rows() != n || k == 0 || p.initial_gap.size() != n ||
      (p.W.size() > 0 && (p.W.rows() != n || p.W.cols() != k)))
    throw InputError("contact: sizes do not fit: C " + std::to_string(n) + " x " + std::to_string(p.C.cols()) +
                     ", G " + std::to_string(p.G.rows()) + " x " + std::to_string(k) + ", W " +
                     std::to_string(p.W.rows()) + " x " + std::to_string(p.W.cols()) + ", gap " +
                     std::to_string(p.initial_gap.size()));
  if (!p.C.allFinite() || !p.G.allFinite() || !p.W.allFinite() || !p.initial_gap.allFinite())
    throw InputError("contact: the problem holds a number that is not finite");
  if (!(p.C.diagonal().array() > 0).all())
    throw InputError("contact: a diagonal entry of the compliance is not positive");
}

// All nodes for one set: what the iteration looks at.
struct Evaluation {
  ModeState modes;
  Eigen::MatrixXd gram;
  Eigen::VectorXd nodal, gap;  // (n) gap with the rounding of the active nodes in it
  double length = 0;           // m, of the closing of the active nodes: the scale of rounding in a gap
};

double length_scale(const ScaledModes &modes, const ModeState &state, const std::vector<int> &active)
{
  const auto closed = [&](const int i) {
    const auto row = modes.rhs.row(i);
    double sum     = std::abs(row[2 * modes.k]);
    for (int j = 0; j < modes.k; ++j)
      sum += std::abs(row[j] * state.motion[j]) + std::abs(row[modes.k + j] * state.resultant[j]);
    return sum;
  };
  double out = 0;
  if (active.empty())
    return (modes.rhs.leftCols(modes.k) * state.motion).cwiseAbs().maxCoeff();
  for (const int i : active)
    out = std::max(out, closed(i));
  return out;
}

void finish(Evaluation &e, const ActiveFactor &factor, const ScaledModes &modes, const Eigen::VectorXd &force)
{
  e.gap   = factor.product(force) - modes.rhs * closing(e.modes, modes);
  e.nodal = Eigen::VectorXd::Zero(e.gap.size());
  for (std::size_t i = 0; i < factor.order().size(); ++i)
    e.nodal[factor.order()[i]] = force[Eigen::Index(i)];
  e.length = length_scale(modes, e.modes, factor.order());
}

Evaluation evaluate(const ActiveFactor &factor, const ScaledModes &modes, const Loading &loading)
{
  Evaluation e;
  e.gram  = factor.gram();
  e.modes = solve_modes(e.gram, modes, loading);
  finish(e, factor, modes, factor.combine(closing(e.modes, modes)));
  return e;
}

// Largest violation of equilibrium and complementarity, each relative to what it is made of.
double residual(const Evaluation &e, const ScaledModes &modes, const ActiveFactor &factor)
{
  double worst        = 0;
  const double length = e.length > 0 ? e.length : 1;
  const double force  = std::max(e.nodal.maxCoeff(), std::numeric_limits<double>::min());
  for (int i = 0; i < e.gap.size(); ++i) {
    worst = std::max(worst, factor.contains(i) ? std::abs(e.gap[i]) / length : -e.gap[i] / length);
    worst = std::max(worst, -e.nodal[i] / force);
  }
  const auto G                  = modes.rhs.leftCols(modes.k);
  const Eigen::VectorXd missing = G.transpose() * e.nodal - e.modes.resultant;
  const Eigen::VectorXd made_of = (G.cwiseAbs().transpose() * e.nodal).cwiseMax(e.modes.resultant.cwiseAbs());
  for (int j = 0; j < modes.k; ++j)
    if (made_of[j] > 0)
      worst = std::max(worst, std::abs(missing[j]) / made_of[j]);
  return worst;
}

// One step of iterative refinement of forces and modes together.
void refine(Evaluation &e, const ActiveFactor &factor, const ScaledModes &modes, const Loading &loading)
{
  const auto &order = factor.order();
  const int k       = modes.k;
  Eigen::VectorXd force(order.size()), open(order.size());
  Eigen::MatrixXd GW(order.size(), 2 * k);
  for (std::size_t i = 0; i < order.size(); ++i) {
    force[Eigen::Index(i)]  = e.nodal[order[i]];
    open[Eigen::Index(i)]   = e.gap[order[i]];
    GW.row(Eigen::Index(i)) = modes.rhs.row(order[i]).head(2 * k);
  }
  const Eigen::VectorXd y = -factor.solve(open);
  const auto G            = GW.leftCols(k);
  // Corrections obey the same k equations, driven by what is missing.
  Loading none            = loading;
  none.value              = Eigen::VectorXd::Zero(k);
  auto gram               = e.gram;
  gram.col(2 * k).head(k) = -(G.transpose() * (force + y) - e.modes.resultant);
  const ModeState d       = solve_modes(gram, modes, none);
  Eigen::VectorXd c(2 * k);
  c << d.motion, -d.resultant;
  force += y + factor.solve(GW * c);
  e.modes.motion += d.motion;
  e.modes.resultant += d.resultant;
  finish(e, factor, modes, force);
}

// The best `count` of `from` by a value, smallest first; order of equal values does not matter.
void add_smallest(std::vector<int> from, const Eigen::VectorXd &value, const std::size_t count,
                  std::vector<int> &to)
{
  const auto end = from.begin() + std::ptrdiff_t(std::min(count, from.size()));
  std::partial_sort(from.begin(), end, from.end(), [&](const int a, const int b) { return value[a] < value[b]; });
  to.insert(to.end(), from.begin(), end);
}
}  // namespace

struct ActiveSet::Implementation {
  Problem p;
  ScaledModes modes;
  ActiveFactor factor;
  std::unique_ptr<CoarseProblem> groups;  // how nodes are grouped, made at the first cold start
  std::unique_ptr<ActiveSet> coarse;
  bool warm = false;

  // A second gap of zero in addition to the true one: the part that changes along a path (continuation).
  static Eigen::MatrixXd with_path(const Eigen::VectorXd &gap)
  {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(gap.size(), 2);
    out.col(0)          = gap;
    return out;
  }

  explicit Implementation(Problem problem)
      : p(std::move(problem)), modes(scaled_modes(p.G, p.W, p.C.diagonal().mean(), with_path(p.initial_gap))),
        factor(p.C, modes.rhs)
  {
  }

  std::vector<int> imposed_resultants(const Loading &loading) const
  {
    std::vector<int> out;
    for (int j = 0; j < modes.k; ++j)
      if (!loading.prescribed[j])
        out.push_back(j);
    return out;
  }

  Eigen::MatrixXd levers(const std::vector<int> &imposed) const
  {
    return modes.rhs(Eigen::all, imposed);
  }

  // The only mode that is not held carries nothing and every node resists it: the bodies just touch.
  bool just_touching(const Loading &loading, const std::vector<int> &imposed, ModeState &out) const
  {
    for (const int j : imposed)
      if (loading.value[j] != 0)
        return false;
    out.motion    = loading.value;
    out.resultant = Eigen::VectorXd::Zero(modes.k);
    for (const int j : imposed)
      out.motion[j] = 0;
    const Eigen::VectorXd open = p.initial_gap - modes.rhs.leftCols(modes.k) * out.motion;
    if (imposed.empty())
      return open.minCoeff() >= 0;
    if (int(imposed.size()) == modes.k && modes.k > 1)
      throw SolverError({"contact: nothing presses and nothing is held", "all resultants are zero",
                         "bodies that float apart have no position", "impose a force or a motion", ""});
    const auto lever = modes.rhs.col(imposed[0]);
    if (imposed.size() > 1 || !(lever.array() >= 0).all() || !(lever.array() > 0).any())
      return false;
    double closest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < open.size(); ++i)
      if (lever[i] > 0)
        closest = std::min(closest, open[i] / lever[i]);
      else if (open[i] < 0)
        return false;  // the motions that are held close a node which this one cannot open
    out.motion[imposed[0]] = closest;
    return true;
  }

  State open_state(const ModeState &m)
  {
    factor.reset({});
    State s;
    const int n  = int(p.C.rows());
    s.motion     = m.motion.cwiseQuotient(modes.scale);
    s.resultant  = Eigen::VectorXd::Zero(modes.k);
    s.nodal      = Eigen::VectorXd::Zero(n);
    s.gap        = (p.initial_gap - modes.rhs.leftCols(modes.k) * m.motion).cwiseMax(0);
    s.compliance = Eigen::MatrixXd::Constant(modes.k, modes.k, std::numeric_limits<double>::infinity());
    s.stiffness  = Eigen::MatrixXd::Zero(modes.k, modes.k);
    s.d_nodal    = Eigen::MatrixXd::Zero(n, modes.k);
    s.active.assign(n, 0);
    s.iterations = 1;
    return s;
  }

  void begin_with(const std::vector<char> &set)
  {
    std::vector<int> order;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i])
        order.push_back(int(i));
    factor.reset(order);
  }

  // A first set: from the same problem on groups of nodes, the most loaded first so that the rim can go cheaply.
  void cold_start(const Loading &loading)
  {
    const int n = int(p.C.rows());
    if (n <= small_problem) {
      begin_with(std::vector<char>(n, 1));
      return;
    }
    if (!coarse) {
      groups = std::make_unique<CoarseProblem>(coarse_problem(p, group_size));
      coarse = std::make_unique<ActiveSet>(std::move(groups->problem));
    } else
      coarse->set_gap(grouped(p.initial_gap));
    coarse->forget();
    Loading user = loading;
    for (int j = 0; j < modes.k; ++j)
      user.value[j] *= loading.prescribed[j] ? 1 / modes.scale[j] : modes.scale[j];
    Eigen::VectorXd force;
    try {
      force = coarse->solve(user).nodal;
    } catch (const SolverError &) {  // groups reach less far than nodes: begin with all of them
      force = Eigen::VectorXd::Ones(coarse->problem().C.rows());
    }
    std::vector<int> order;
    for (int i = 0; i < n; ++i)
      if (force[groups->group_of[i]] > 0)
        order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) {
      return force[groups->group_of[a]] > force[groups->group_of[b]];
    });
    factor.reset(order);
  }

  Eigen::VectorXd grouped(const Eigen::VectorXd &values) const
  {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(coarse->problem().C.rows());
    for (int i = 0; i < values.size(); ++i)
      out[groups->group_of[i]] += values[i];
    return out;
  }

  // Nodes that violate a condition, and as many that come next.
  std::vector<int> in_doubt(const Evaluation &e, std::size_t &n_violated) const
  {
    std::vector<int> doubt, pulls, presses, enters, open;
    for (int i = 0; i < e.gap.size(); ++i)
      if (factor.contains(i))
        (e.nodal[i] < 0 ? pulls : presses).push_back(i);
      else
        (e.gap[i] < -1e-14 * e.length ? enters : open).push_back(i);
    n_violated = pulls.size() + enters.size();
    if (n_violated == 0)
      return doubt;
    doubt = pulls;
    doubt.insert(doubt.end(), enters.begin(), enters.end());
    if (!pulls.empty())
      add_smallest(presses, e.nodal, 8 + pulls.size(), doubt);
    if (!enters.empty())
      add_smallest(open, e.gap, 8 + enters.size() / 2, doubt);
    std::sort(doubt.begin(), doubt.end());
    return doubt;
  }

  // The nodes in doubt against each other, all others held.  False: no set was found.
  bool settle(const std::vector<int> &doubt, const Evaluation &e, const Loading &loading)
  {
    std::vector<char> start;
    std::vector<int> inside;
    for (const int i : doubt) {
      if (factor.contains(i))
        inside.push_back(i);
      start.push_back(factor.contains(i) ? e.nodal[i] >= 0 : e.gap[i] < 0);
    }
    factor.remove(inside);
    const Border border = factor.border(doubt);
    const auto chosen =
        candidates_in_contact(border.S, border.rhs, factor.gram(), modes, loading, std::move(start), e.length);
    if (chosen.empty())
      return false;
    factor.append(border, chosen);
    return true;
  }

  void exchange(const Evaluation &e)
  {
    std::vector<char> set(e.gap.size());
    for (int i = 0; i < e.gap.size(); ++i)
      set[i] = factor.contains(i) ? e.nodal[i] >= 0 : e.gap[i] < 0;
    begin_with(set);
  }

  State state(Evaluation e, const Loading &loading)
  {
    State s;
    s.residual = residual(e, modes, factor);
    for (int i = 0; i < 2 && s.residual > 1e-14; ++i) {
      Evaluation better = e;
      refine(better, factor, modes, loading);
      const double now = residual(better, modes, factor);
      if (!(now < s.residual))
        break;
      e          = better;
      s.residual = now;
    }
    const int n = int(p.C.rows()), k = modes.k;
    s.motion    = e.modes.motion.cwiseQuotient(modes.scale);
    s.resultant = e.modes.resultant.cwiseProduct(modes.scale);
    s.nodal     = e.nodal.cwiseMax(0);
    s.gap       = e.gap.cwiseMax(0);
    s.active    = factor.indicator();
    for (int i = 0; i < n; ++i)
      if (s.active[i])
        s.gap[i] = 0;
    const Tangents t = tangents(e.gram, modes);
    s.compliance     = t.compliance;
    s.stiffness      = t.stiffness;
    s.d_nodal        = Eigen::MatrixXd::Zero(n, k);
    if (t.compliance.allFinite()) {
      Eigen::MatrixXd c = Eigen::MatrixXd::Zero(modes.rhs.cols(), k);
      c.topRows(k)      = modes.scale.asDiagonal() * t.compliance;
      for (int j = 0; j < k; ++j)
        c(k + j, j) = -1 / modes.scale[j];
      const Eigen::MatrixXd d = factor.combine(c);
      for (std::size_t i = 0; i < factor.order().size(); ++i)
        s.d_nodal.row(factor.order()[i]) = d.row(Eigen::Index(i));
    }
    return s;
  }

  // A free motion that no touching node resists, as the tilt of a roller that touches at one station, has no place
  // of its own.  Where nothing drives it, it stays at zero if that is an equilibrium.
  std::optional<State> with_one_at_rest(const Loading &loading, const std::vector<int> &imposed)
  {
    for (const int j : imposed) {
      if (loading.value[j] != 0)
        continue;
      Loading held       = loading;
      held.prescribed[j] = true;
      try {
        State s          = solve(held, {});
        const auto lever = modes.rhs.col(j);
        // 1e-10 as for the residual of an active set, of an arm as long as the longest
        if (std::abs(lever.dot(s.nodal)) <= 1e-10 * lever.cwiseAbs().maxCoeff() * s.nodal.sum())
          return s;
      } catch (const SolverError &) {  // another one is not determined either
      }
    }
    return std::nullopt;
  }

  State solve(const Loading &loading, const std::vector<char> &start)
  {
    const std::vector<int> imposed = imposed_resultants(loading);
    ModeState touching;
    if (just_touching(loading, imposed, touching)) {
      warm = false;
      return open_state(touching);
    }
    if (!imposed.empty()) {
      const Support support = pressing_support(levers(imposed), loading.value(imposed));
      // 1e-10: the rounding of the least squares; a line of action on the very edge of the nodes still passes.
      if (support.relative_missing > 1e-10)
        refuse_unreachable(support, modes, imposed, loading);
    }
    const bool given = std::any_of(start.begin(), start.end(), [](const char a) { return a != 0; });
    if (given && start != factor.indicator())
      begin_with(start);
    else if (!given && !(start.empty() && warm))
      cold_start(loading);
    warm = false;  // until this solve has ended well

    std::vector<int> all_doubts;
    bool followed = false;
    for (int iteration = 1; iteration <= 60; ++iteration) {
      const Evaluation e     = evaluate(factor, modes, loading);
      std::size_t n_violated = 0;
      bool lost              = !e.nodal.allFinite() || !e.gap.allFinite();
      std::vector<int> doubt;
      if (!lost) {
        doubt = in_doubt(e, n_violated);
        // Too few nodes for the free motions: balance is not to be had by exchange.
        lost = n_violated == 0 && !e.modes.determined && residual(e, modes, factor) > 1e-10;
      }
      if (!lost && n_violated == 0) {
        State s      = state(e, loading);
        s.iterations = iteration;
        warm         = true;
        return s;
      }
      if (!lost && doubt.size() > most_in_doubt && iteration < 20) {
        exchange(e);
        continue;
      }
      if (!lost && iteration > 6) {  // nodes in doubt stay so: the exchange cannot return to an earlier set
        std::vector<int> both;
        std::set_union(doubt.begin(), doubt.end(), all_doubts.begin(), all_doubts.end(), std::back_inserter(both));
        all_doubts = doubt = both;
      }
      if (lost || !settle(doubt, e, loading)) {
        if (followed)
          break;
        followed = true;
        try {
          factor.reset(set_by_continuation(p, modes, loading));
        } catch (const SolverError &) {
          if (std::optional<State> resting = with_one_at_rest(loading, imposed))
            return *std::move(resting);
          refuse_undetermined(imposed);
        }
      }
    }
    throw SolverError({"contact: no active set found", "it alternates after 60 iterations",
                       "an operator that is not symmetric and positive definite", "check the condensation", ""});
  }
};

ActiveSet::ActiveSet(Problem problem)
{
  require(problem);
  self = std::make_unique<Implementation>(std::move(problem));
}
ActiveSet::~ActiveSet()                     = default;
ActiveSet::ActiveSet(ActiveSet &&) noexcept = default;

State ActiveSet::solve(const Loading &loading, const std::vector<char> &start)
{
  const auto k = self->modes.k;
  if (loading.value.size() != k || !(loading.prescribed.empty() || int(loading.prescribed.size()) == k) ||
      !loading.value.allFinite())
    throw InputError("contact: a loading needs " + std::to_string(k) + " finite values");
  if (!start.empty() && int(start.size()) != self->p.C.rows())
    throw InputError("contact: a start needs an entry for each of " + std::to_string(self->p.C.rows()) + " nodes");
  return self->solve(scaled(loading, self->modes), start);
}

void ActiveSet::set_gap(const Eigen::VectorXd &initial_gap)
{
  if (initial_gap.size() != self->p.C.rows() || !initial_gap.allFinite())
    throw InputError("contact: the gap needs " + std::to_string(self->p.C.rows()) + " finite values");
  self->p.initial_gap                    = initial_gap;
  self->modes.rhs.col(2 * self->modes.k) = initial_gap;
  self->factor.set_rhs(2 * self->modes.k, initial_gap);
}

void ActiveSet::forget()
{
  self->warm = false;
}
const Problem &ActiveSet::problem() const
{
  return self->p;
}
ActiveFactor &ActiveSet::factor()
{
  return self->factor;
}
const ScaledModes &ActiveSet::modes() const
{
  return self->modes;
}
}  // namespace mill::contact
