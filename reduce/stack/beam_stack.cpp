#include "reduce/stack/beam_stack.h"
#include "core/base/errors.h"
#include "core/model/stack_supports.h"
#include "core/process/parallel.h"
#include "reduce/stack/group_modes.h"
#include "reduce/stack/strip_side.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace mill::reduce {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double balanced = 1e-12;  // forces out of balance over the rolling force
constexpr double rounding = 1e-10;  // the same, where another step no longer halves it
constexpr int most_steps  = 60;

VectorXd strip_edges(const Stack &stack, const Stations &stations)
{
  std::vector<double> edges;
  for (const double z : stations.z)
    if (std::abs(z - stack.strip.offset) < stack.strip.width / 2 + 1e-6)
      edges.push_back(z - stack.strip.offset);
  return Eigen::Map<VectorXd>(edges.data(), Index(edges.size()));
}

[[noreturn]] void not_held()
{
  throw SolverError({"roll stack: the stiffness matrix is singular", "",
                     "a roll is not held by its contacts and supports, or all its contacts are open",
                     "check supports and contacts of every roll, and the signs of crowns and bending forces", ""});
}

double mean_of(const std::function<double(double)> &f, const double z1, const double z2)
{
  double mean = 0;
  for (int g = 0; g < UnitGauss::n; ++g)
    mean += UnitGauss::weight[g] * f(z1 + (z2 - z1) * UnitGauss::place[g]);
  return mean;
}

PairState pair_state(const RollGroup &group, const std::size_t contact, const LineLaw &law)
{
  std::vector<const ContactElement *> elements;
  for (const ContactElement &e : group.contacts)
    if (e.contact == contact)
      elements.push_back(&e);
  PairState pair;
  const Index k = Index(elements.size()) * UnitGauss::n;
  for (VectorXd *v : {&pair.z, &pair.weight, &pair.load, &pair.tangent, &pair.approach})
    v->resize(k);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Index first = Index(i) * UnitGauss::n;
    const auto copy   = [&](VectorXd &to, const auto &from) { to.segment<UnitGauss::n>(first) = from.matrix(); };
    copy(pair.z, elements[i]->z);
    copy(pair.weight, elements[i]->weight);
    copy(pair.load, elements[i]->load);
    copy(pair.tangent, elements[i]->tangent);
    copy(pair.approach, elements[i]->approach);
  }
  pair.force           = pair.weight.dot(pair.load);
  pair.load_centre     = pair.weight.cwiseProduct(pair.z).dot(pair.load) / pair.force;
  pair.peak_load       = pair.load.size() > 0 ? pair.load.maxCoeff() : 0;
  pair.peak_pressure   = 2 * pair.peak_load / (M_PI * half_width_of(law, pair.peak_load));
  pair.touching        = pair.weight.dot((pair.load.array() > 0).cast<double>().matrix()) / pair.weight.sum();
  pair.uniform_tangent = pair.weight.dot(pair.tangent);
  return pair;
}
}  // namespace

struct BeamStack::Implementation {
  Stack stack;
  Stations stations;
  int threads;
  std::vector<RollGroup> groups;
  std::vector<StripSide> sides;   // upper, lower
  VectorXd edges, length, entry;  // m; entry: H minus its mean
  MatrixXd flattening;
  MatrixXd law;  // I + k_o (flexibility) of the strip at the factors
  VectorXd q;
  double level = 0;
  std::vector<bool> pressed;
  bool solved = false;

  Implementation(Stack s, const BeamStackSettings &settings)
      : stack(with_bearing_springs(std::move(s))),
        stations(stations_of(stack, stack.strip.width / settings.elements_per_width)), threads(settings.threads)
  {
    const bool both_planes = has_inclined_contact(stack);
    for (auto &rolls : touching_groups(stack))
      groups.emplace_back(stack, stations, rolls, both_planes);
    edges  = strip_edges(stack, stations);
    length = edges.tail(edges.size() - 1) - edges.head(edges.size() - 1);
    sides.emplace_back(stack, group_of(stack.upper), stack.upper, 1, edges, settings.flattening);
    sides.emplace_back(stack, group_of(stack.lower), stack.lower, -1, edges, settings.flattening);
    flattening = sides[0].flattening + sides[1].flattening;
    entry      = VectorXd::NullaryExpr(length.size(), [&](const Index i) {
      return 0.5 * (entry_departure(stack.strip, edges[i]) + entry_departure(stack.strip, edges[i + 1]));
    });
    entry.array() -= entry.dot(length) / length.sum();
  }

  RollGroup &group_of(const std::size_t roll)
  {
    return *std::find_if(groups.begin(), groups.end(), [&](const RollGroup &g) { return g.holds(roll); });
  }

  double opening_factor() const
  {
    return reduce::opening_factor(stack.strip);
  }
  double entry_factor() const
  {
    return reduce::entry_factor(stack.strip);
  }

  VectorXd opening() const
  {
    VectorXd o = flattening * q;
    for (const StripSide &side : sides)
      o += side.integrals(side.group.u).cwiseQuotient(length) - side.ground;
    return o;
  }

  // What the law of the strip wants at the present opening, (51.5).
  VectorXd wanted_load() const
  {
    return (level - opening_factor() * opening().array() + entry_factor() * entry.array()).matrix();
  }

  // Both halves at the same time: factors and flexibility at the strip.
  void factorise(const double least_tangent, const double touching)
  {
    std::array<bool, 2> held = {true, true};
    std::array<MatrixXd, 2> by_axis;
    share_tasks(2, threads, [&](const long i) {
      StripSide &side = sides[std::size_t(i)];
      held[std::size_t(i)] =
          touching > 0 ? side.group.factorise_touching(touching) : side.group.factorise(least_tangent);
      if (held[std::size_t(i)])
        by_axis[std::size_t(i)] = side.flexibility();
    });
    if (!held[0] || !held[1])
      not_held();
    law =
        opening_factor() * (flattening + MatrixXd(length.cwiseInverse().asDiagonal() * (by_axis[0] + by_axis[1])));
    law.diagonal().array() += 1;
  }

  /// Change of all unknowns that takes out residuals of the beams, of the strip's law and of its force.
  struct Change {
    std::array<VectorXd, 2> u;
    VectorXd q;
    double level;
  };
  Change change(const std::array<VectorXd, 2> &out_of_balance, const VectorXd &of_law, const double of_force) const
  {
    const Index m        = length.size();
    VectorXd by_residual = VectorXd::Zero(m);
    const VectorXd none  = VectorXd::Zero(m);
    for (std::size_t i = 0; i < 2; ++i)
      by_residual += sides[i].integrals(sides[i].respond(out_of_balance[i], none));
    MatrixXd S = MatrixXd::Zero(m + 1, m + 1);
    VectorXd rhs(m + 1);
    for (Index i = 0; i < m; ++i) {
      if (pressed[std::size_t(i)]) {
        S.row(i).head(m) = law.row(i);
        S(i, m)          = -1;
        rhs[i]           = of_law[i] - opening_factor() * by_residual[i] / length[i];
      } else {
        S(i, i) = 1;
        rhs[i]  = of_law[i];
      }
    }
    S.row(m).head(m) = length.transpose();
    rhs[m]           = of_force;
    const VectorXd y = S.partialPivLu().solve(rhs);
    Change c;
    c.q     = y.head(m);
    c.level = y[m];
    for (std::size_t i = 0; i < 2; ++i)
      c.u[i] = sides[i].respond(out_of_balance[i], c.q);
    return c;
  }

  std::array<VectorXd, 2> out_of_balance() const
  {
    std::array<VectorXd, 2> r;
    for (std::size_t i = 0; i < 2; ++i) {
      r[i] = sides[i].group.out_of_balance();
      for (std::size_t k = 0; k < sides[i].rows.size(); ++k)
        sides[i].rows[k].add_to(r[i], q[Index(k)]);
    }
    return r;
  }

  void update()
  {
    share_tasks(2, threads, [&](const long i) { sides[std::size_t(i)].group.update(); });
  }

  void step(const std::array<VectorXd, 2> &residual)
  {
    const VectorXd wanted = wanted_load();
    VectorXd of_law(q.size());
    for (Index i = 0; i < q.size(); ++i) {
      pressed[std::size_t(i)] = !solved ? wanted[i] > 0 || q[i] > 0 : wanted[i] > 0;
      of_law[i]               = pressed[std::size_t(i)] ? wanted[i] - q[i] : -q[i];
    }
    const Change c = change(residual, of_law, stack.strip.force - length.dot(q));
    for (std::size_t i = 0; i < 2; ++i)
      sides[i].group.u += c.u[i];
    q += c.q;
    level += c.level;
  }

  double imbalance(const std::array<VectorXd, 2> &residual) const
  {
    double most = 0;
    for (std::size_t i = 0; i < 2; ++i)
      most = std::max(most, sides[i].group.largest_force(residual[i]));
    const double of_law = (q - wanted_load().cwiseMax(0)).cwiseAbs().maxCoeff() * length.maxCoeff();
    return std::max(most, of_law) / stack.strip.force;
  }

  // What the beams themselves leave, over the rolling force: places of a drawing may lie micrometres apart.
  double rounding_of_beams() const
  {
    return std::max(sides[0].group.rounding(), sides[1].group.rounding()) / stack.strip.force;
  }

  int solve()
  {
    const double line = stack.strip.force / stack.strip.width;
    if (!solved) {
      q     = VectorXd::Constant(length.size(), line);
      level = line;
      pressed.assign(std::size_t(q.size()), true);
      factorise(0, line);
      update();
      step(out_of_balance());
    }
    // Contacts that are open keep a trace of stiffness, so that a roll between two of them is held.
    const double least = 1e-9 * stack.rolls[stack.upper].material.youngs_modulus;
    double out         = std::numeric_limits<double>::infinity();
    for (int steps = 1; steps <= most_steps; ++steps) {
      update();
      const auto residual = out_of_balance();
      const double before = std::exchange(out, imbalance(residual));
      if (out < balanced || (out < std::max(rounding, rounding_of_beams()) && out > before / 2)) {
        factorise(least, 0);  // for the derivatives
        update();
        solved = true;
        return steps;
      }
      factorise(least, 0);
      step(residual);
    }
    throw SolverError({"roll stack: no equilibrium after 60 Newton steps", "",
                       "contacts that open and close, by crowns or bending forces that part the rolls",
                       "smaller crowns or bending forces, or a larger rolling force", ""});
  }

  double length_at(const double z) const
  {
    Index i = 0;
    while (i + 1 < length.size() && edges[i + 1] < z)
      ++i;
    return length[i];
  }

  // h - S at a place, mean over an element's length about it.
  double opening_at(const std::array<const VectorXd *, 2> &u, const VectorXd &load, const double z,
                    const bool with_ground) const
  {
    const double d = 0.5 * length_at(z);
    double sum     = 0;
    for (std::size_t i = 0; i < 2; ++i)
      sum += sides[i].opening(*u[i], load, z - d, z + d, with_ground);
    return sum;
  }

  GapShape shape(const std::array<const VectorXd *, 2> &u, const VectorXd &load, const bool with_ground) const
  {
    const double half = stack.strip.width / 2, e = stack.strip.crown_at;
    const auto h = [&](const double z) { return opening_at(u, load, z, with_ground); };
    GapShape s;
    s.middle          = h(0);
    const double plus = h(half - e), minus = h(-half + e);
    s.crown                   = s.middle - (plus + minus) / 2;
    s.wedge                   = plus - minus;
    const auto [inner, outer] = stack.strip.edge_drop;
    s.edge_drop               = 0.5 * (h(half - inner) + h(-half + inner) - h(half - outer) - h(-half + outer));
    s.opening                 = flattening * load;
    for (std::size_t i = 0; i < 2; ++i)
      s.opening += sides[i].integrals(*u[i]).cwiseQuotient(length) - (with_ground ? 1 : 0) * sides[i].ground;
    return s;
  }

  GapShape influence(const std::array<VectorXd, 2> &forces, const VectorXd &of_law, const double of_force) const
  {
    const Change c = change(forces, of_law, of_force);
    return shape({&c.u[0], &c.u[1]}, c.q, false);
  }

  // A roll at the strip also closes the gap itself: the opening is smaller by its departure.
  GapShape influence_of_radius(const std::size_t roll, const std::function<double(double)> &departure) const
  {
    auto forces     = no_forces();
    VectorXd of_law = VectorXd::Zero(q.size()), ground = VectorXd::Zero(q.size());
    const double offset = stack.strip.offset;
    bool at_strip       = false;
    for (std::size_t i = 0; i < 2; ++i) {
      if (sides[i].group.holds(roll))
        forces[i] = sides[i].group.force_of_radius(roll, departure);
      at_strip = at_strip || sides[i].work_roll() == roll;
    }
    if (!at_strip)
      return influence(forces, of_law, 0);
    for (Index i = 0; i < q.size(); ++i) {
      ground[i] = mean_of(departure, edges[i] + offset, edges[i + 1] + offset);
      of_law[i] = pressed[std::size_t(i)] ? opening_factor() * ground[i] : 0;
    }
    GapShape s = influence(forces, of_law, 0);
    s.opening -= ground;
    const double half = stack.strip.width / 2, e = stack.strip.crown_at;
    const auto r = [&](const double z) {
      const double d = 0.5 * length_at(z);
      return mean_of(departure, z - d + offset, z + d + offset);
    };
    s.middle -= r(0);
    s.crown -= r(0) - (r(half - e) + r(-half + e)) / 2;
    s.wedge -= r(half - e) - r(-half + e);
    const auto [inner, outer] = stack.strip.edge_drop;
    s.edge_drop -= 0.5 * (r(half - inner) + r(-half + inner) - r(half - outer) - r(-half + outer));
    return s;
  }
  std::array<VectorXd, 2> no_forces() const
  {
    return {VectorXd::Zero(sides[0].group.size()), VectorXd::Zero(sides[1].group.size())};
  }

  // d(force)/d(h - S) with h averaged by the line load.
  double mean_modulus() const
  {
    const VectorXd o      = opening();
    const Change c        = change(no_forces(), VectorXd::Zero(q.size()), 1);
    const GapShape s      = shape({&c.u[0], &c.u[1]}, c.q, false);
    const double F        = stack.strip.force;
    const double by_force = (length.dot(c.q.cwiseProduct(o)) + length.dot(q.cwiseProduct(s.opening)) -
                             length.dot(q.cwiseProduct(o)) / F) /
                            F;
    return 1 / by_force;
  }
};

namespace {
// Change of the line load at every place of a contact with deflections, as pair_state() orders them.
VectorXd change_of_load(const RollGroup &group, const std::size_t contact, const VectorXd &u)
{
  std::vector<double> change;
  for (const ContactElement &e : group.contacts) {
    if (e.contact != contact)
      continue;
    VectorXd of_element(Index(e.unknown.size()));
    for (std::size_t i = 0; i < e.unknown.size(); ++i)
      of_element[Index(i)] = u[e.unknown[i]];
    const VectorXd closer = e.row.transpose() * of_element;
    for (int g = 0; g < UnitGauss::n; ++g)
      change.push_back(e.load[g] > 0 ? e.tangent[g] * closer[g] : 0);
  }
  return Eigen::Map<const VectorXd>(change.data(), Index(change.size()));
}
}  // namespace

BeamStack::BeamStack(Stack stack, const BeamStackSettings &settings)
    : self(std::make_unique<Implementation>(std::move(stack), settings))
{
}
BeamStack::~BeamStack()                     = default;
BeamStack::BeamStack(BeamStack &&) noexcept = default;

StackState BeamStack::solve()
{
  Implementation &my = *self;
  StackState state;
  state.newton_steps                    = my.solve();
  state.residual                        = my.imbalance(my.out_of_balance());
  const Implementation::Change by_force = my.change(my.no_forces(), VectorXd::Zero(my.q.size()), 1);
  for (std::size_t c = 0; c < my.stack.contacts.size(); ++c) {
    const StackContact &contact = my.stack.contacts[c];
    const StackRoll &a = my.stack.rolls[contact.a], &b = my.stack.rolls[contact.b];
    state.pairs.push_back(
        pair_state(my.group_of(contact.a), c,
                   line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, contact.ring_stiffness)));
    const std::size_t side = &my.group_of(contact.a) == &my.sides[0].group ? 0 : 1;
    state.pairs.back().loaded_tangent =
        loaded_tangent(state.pairs.back(), change_of_load(my.group_of(contact.a), c, by_force.u[side]));
  }
  const GapShape gap = my.shape({&my.sides[0].group.u, &my.sides[1].group.u}, my.q, true);
  for (std::size_t r = 0; r < my.stack.rolls.size(); ++r) {
    const RollGroup &group = my.group_of(r);
    RollState roll{group.places(r), group.deflection(r, 0), group.deflection(r, 1), {}, {}};
    for (const StackSupport &support : my.stack.rolls[r].supports) {
      Index i = 0;
      while (i + 1 < roll.z.size() && roll.z[i] < support.z + my.stack.rolls[r].shift - 1e-6)
        ++i;
      roll.reactions.push_back(support.stiffness[1] * (support.motion[1] - roll.y[i]));
      roll.across.push_back(support.stiffness[0] * (support.motion[0] - roll.x[i]));
    }
    state.rolls.push_back(std::move(roll));
  }
  state.strip.edges     = my.edges;
  state.strip.load      = my.q;
  state.strip.opening   = gap.opening;
  state.strip.entry     = my.entry;
  state.strip.middle    = gap.middle;
  state.strip.crown     = gap.crown;
  state.strip.edge_drop = gap.edge_drop;
  state.strip.wedge     = gap.wedge;
  state.modulus.mid     = 1 / influence_of_force().middle;
  state.modulus.mean    = my.mean_modulus();
  return state;
}

GapShape BeamStack::influence_of_force() const
{
  return self->influence(self->no_forces(), Eigen::VectorXd::Zero(self->q.size()), 1);
}

GapShape BeamStack::influence_of_loads(const std::size_t roll, const std::vector<StackLoad> &unit) const
{
  auto forces = self->no_forces();
  for (std::size_t i = 0; i < 2; ++i)
    if (self->sides[i].group.holds(roll))
      for (const StackLoad &load : unit)
        forces[i] += self->sides[i].group.force_at(load, roll);
  return self->influence(forces, Eigen::VectorXd::Zero(self->q.size()), 0);
}

GapShape BeamStack::influence_of_radius(const std::size_t roll,
                                        const std::function<double(double)> &departure) const
{
  return self->influence_of_radius(roll, departure);
}

BeamStackParts BeamStack::parts() const
{
  return {self->stack, self->stations, self->groups, self->sides, self->length, self->q, self->flattening};
}

Eigen::VectorXd BeamStack::frequencies(const int n) const
{
  std::vector<double> all;
  for (const RollGroup &group : self->groups)
    for (const double square : lowest_modes(group, n).square)
      all.push_back(std::sqrt(std::max(0., square)) / (2 * M_PI));
  std::sort(all.begin(), all.end());
  return Eigen::Map<Eigen::VectorXd>(all.data(), n);
}
}  // namespace mill::reduce
