#include "fem/stack/condensed_stack.h"
#include "core/base/errors.h"
#include "core/model/stack_supports.h"
#include "core/process/parallel.h"
#include "fem/stack/half_stack.h"
#include "reduce/stack/stations.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::fem {
namespace {
using Eigen::Index;
using Eigen::VectorXd;
using reduce::GapShape;
using reduce::PairState;
using reduce::StackState;

constexpr double settled = 1e-11;  // change of the forces in a step over their largest
constexpr double current = 1e-7;   // the same, between factors that give exact derivatives and the solution
constexpr int most_steps = 60;

// A station that no two stations of a roll resolve would have the same flexibility as its neighbour.
constexpr double least_resolved = 3;

double longest_station(const Stack &stack, const std::vector<std::shared_ptr<const RollKernel>> &kernels,
                       const int per_width)
{
  double longest = stack.strip.width / per_width;
  for (const auto &kernel : kernels)
    if (kernel->has_surface()) {
      const Index n = kernel->edge.size() - 1;
      longest       = std::max(longest, least_resolved * (kernel->edge.tail(n) - kernel->edge.head(n)).maxCoeff());
    }
  return longest;
}

// Where crown, wedge and edge drop are read, from the middle of the strip.
std::array<double, 7> places_read(const StackStrip &strip)
{
  const double half = strip.width / 2, e = strip.crown_at;
  const auto [inner, outer] = strip.edge_drop;
  return {0, half - e, -half + e, half - inner, -half + inner, half - outer, -half + outer};
}

ContactStations stations_read(const StackStrip &strip, const double longest)
{
  const auto places  = places_read(strip);
  const double reach = std::min(0.25 * longest, 0.5 * std::min(strip.crown_at, strip.edge_drop[1]));
  ContactStations stations{VectorXd(7), VectorXd(7)};
  for (Index i = 0; i < 7; ++i) {
    stations.from[i] = strip.offset + places[std::size_t(i)] - reach;
    stations.to[i]   = strip.offset + places[std::size_t(i)] + reach;
  }
  return stations;
}

ContactStations stations_of_strip(const StackStrip &strip, const double longest)
{
  const double from = strip.offset - strip.width / 2, to = strip.offset + strip.width / 2;
  return stations_in({{from, to}}, strip, longest);
}

VectorXd means_of(const std::function<double(double)> &f, const ContactStations &stations)
{
  return VectorXd::NullaryExpr(stations.size(), [&](const Index k) {
    const double a = stations.from[k], b = stations.to[k];
    return (f(a) + 4 * f((a + b) / 2) + f(b)) / 6;  // Simpson
  });
}

GapShape shape_of(VectorXd opening, const VectorXd &h)
{
  GapShape s;
  s.opening   = std::move(opening);
  s.middle    = h[0];
  s.crown     = h[0] - (h[1] + h[2]) / 2;
  s.wedge     = h[1] - h[2];
  s.edge_drop = 0.5 * (h[3] + h[4] - h[5] - h[6]);
  return s;
}

// Whether one set of kernels and stations of the strip serves both.
bool differ_in_settings_only(const Stack &one, const Stack &other)
{
  const StackStrip &a = one.strip, &b = other.strip;
  if (one.rolls.size() != other.rolls.size() || one.contacts.size() != other.contacts.size() ||
      one.upper != other.upper || one.lower != other.lower || a.width != b.width || a.offset != b.offset ||
      a.arc != b.arc || a.crown_at != b.crown_at || a.edge_drop != b.edge_drop)
    return false;
  for (std::size_t r = 0; r < one.rolls.size(); ++r) {
    const StackRoll &c = one.rolls[r], &d = other.rolls[r];
    if (c.diameter != d.diameter || c.length != d.length || c.axis != d.axis || c.turned != d.turned ||
        c.supports.size() != d.supports.size())
      return false;
  }
  return true;
}

PairState pair_state(const StationedContact &contact, const VectorXd &force, const VectorXd &open)
{
  PairState pair;
  pair.z          = contact.stations.centre();
  pair.weight     = contact.stations.length();
  pair.load       = force.cwiseQuotient(pair.weight);
  pair.tangent    = VectorXd::Zero(force.size());
  pair.approach   = -open;
  double touching = 0;
  for (Index k = 0; k < force.size(); ++k)
    if (force[k] > 0) {
      pair.tangent[k]  = 1 / reduce::compliance_of(contact.law, pair.load[k]);
      pair.approach[k] = reduce::approach_of(contact.law, pair.load[k]);
      touching += pair.weight[k];
    }
  pair.force           = force.sum();
  pair.load_centre     = force.dot(pair.z) / pair.force;
  pair.peak_load       = pair.load.maxCoeff();
  pair.peak_pressure   = 2 * pair.peak_load / (M_PI * reduce::half_width_of(contact.law, pair.peak_load));
  pair.touching        = touching / pair.weight.sum();
  pair.uniform_tangent = pair.weight.dot(pair.tangent);
  return pair;
}
}  // namespace

struct CondensedStack::Implementation {
  Stack stack;
  std::vector<std::shared_ptr<const RollKernel>> kernels;
  int threads;
  double longest;
  ContactStations at_strip, read;
  std::vector<HalfStack> halves;    // upper, lower
  std::array<HalfVector, 2> right;  // of the unloaded stack
  std::array<HalfVector, 2> state;
  VectorXd length, entry, ground, ground_read, force;
  double level = 0;
  std::vector<char> pressed;
  bool has_factors = false;
  double since     = 0;  // change of the forces since the factors

  Implementation(Stack s, std::vector<std::shared_ptr<const RollKernel>> its_kernels,
                 const CondensedStackSettings &settings)
      : stack(with_bearing_springs(std::move(s))), kernels(std::move(its_kernels)), threads(settings.threads),
        longest(longest_station(stack, kernels, settings.stations_per_width)),
        at_strip(stations_of_strip(stack.strip, longest)), read(stations_read(stack.strip, longest))
  {
    const int planes  = reduce::has_inclined_contact(stack) ? 2 : 1;
    const auto groups = reduce::touching_groups(stack);
    for (const std::size_t roll : {stack.upper, stack.lower})
      for (const auto &rolls : groups)
        if (std::find(rolls.begin(), rolls.end(), roll) != rolls.end())
          halves.emplace_back(stack, rolls, kernels, roll, planes, at_strip, read, longest);
    length = at_strip.length();
    force  = stack.strip.force / stack.strip.width * length;
    pressed.assign(std::size_t(force.size()), 1);
    take_profiles();
    for (std::size_t i = 0; i < 2; ++i)
      state[i] = halves[i].zero();
  }

  // What stands on the right sides.
  void take_profiles()
  {
    entry = means_of([&](const double z) { return reduce::entry_departure(stack.strip, z - stack.strip.offset); },
                     at_strip);
    entry.array() -= entry.dot(length) / length.sum();
    const auto departure = [&](const double z) {
      return reduce::radius_departure(stack.rolls[stack.upper], z) +
             reduce::radius_departure(stack.rolls[stack.lower], z);
    };
    ground      = means_of(departure, at_strip);
    ground_read = means_of(departure, read);
    for (std::size_t i = 0; i < 2; ++i)
      right[i] = halves[i].unloaded();
  }

  bool change(const Stack &drawn)
  {
    if (!differ_in_settings_only(stack, drawn))
      return false;
    const Stack before = stack, next = with_bearing_springs(drawn);
    for (std::size_t r = 0; r < stack.rolls.size(); ++r)  // in place: the halves refer to the rolls
      stack.rolls[r] = next.rolls[r];
    stack.strip  = next.strip;
    bool changed = false;
    for (HalfStack &half : halves)
      changed = half.follow(before) || changed;
    has_factors = has_factors && !changed;
    force *= stack.strip.force / before.strip.force;
    take_profiles();
    return true;
  }

  double k_open() const
  {
    return reduce::opening_factor(stack.strip);
  }

  struct Change {
    std::array<HalfVector, 2> half;
    VectorXd force;
    double level;
  };
  // All equations linear at the factors: of the contacts and rolls, of the strip's law, of its force.  Stations of
  // the strip without load keep none.
  Change linear(const std::array<HalfVector, 2> &of_halves, const VectorXd &of_law, const double of_force) const
  {
    Change c;
    const Index n     = length.size();
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n + 1, n + 1);
    VectorXd rhs = VectorXd::Zero(n + 1), free_opening = VectorXd::Zero(n);
    for (std::size_t i = 0; i < 2; ++i) {
      c.half[i] = halves[i].without_strip(of_halves[i]);
      free_opening += c.half[i].strip;
    }
    const double per_load = length.mean();  // brings a station's force to a line load
    for (Index k = 0; k < n; ++k) {
      if (!pressed[std::size_t(k)]) {
        S(k, k) = 1;
        continue;
      }
      S.row(k).head(n) = k_open() * per_load * (halves[0].at_strip().row(k) + halves[1].at_strip().row(k));
      S(k, k) += per_load / length[k];
      S(k, n) = -1;
      rhs[k]  = per_load * (of_law[k] - k_open() * free_opening[k]);
    }
    S.row(n).head(n).setOnes();
    rhs[n]           = of_force;
    const VectorXd y = S.partialPivLu().solve(rhs);
    c.force          = y.head(n);
    c.level          = y[n] / per_load;
    for (std::size_t i = 0; i < 2; ++i)
      halves[i].add_strip(c.half[i], c.force);
    return c;
  }

  VectorXd law_constant() const  // (51.5) without its level and opening
  {
    return reduce::entry_factor(stack.strip) * entry + k_open() * ground;
  }

  void factorise()
  {
    has_factors = false;
    share_tasks(2, threads, [&](const long i) { halves[std::size_t(i)].factorise(); });
    has_factors = true;
    since       = 0;
  }

  // Next forces of a half; stations that would pull open, those that overlap touch.  Returns the largest change.
  double take(const std::size_t i, const HalfVector &next, const VectorXd &strip_force, bool &exchanged)
  {
    HalfStack &half = halves[i];
    const auto open = half.openings(next, strip_force, right[i]);
    double change = 0, largest = 0;
    for (std::size_t c = 0; c < half.contacts.size(); ++c) {
      StationedContact &contact = half.contacts[c];
      const VectorXd lengths    = contact.stations.length();
      const double trace        = 1e-6 * next.contact[c].cwiseAbs().maxCoeff();
      for (Index k = 0; k < lengths.size(); ++k) {
        char &touches      = contact.touching[std::size_t(k)];
        const double wants = next.contact[c][k];
        if (touches ? wants <= 0 : open[c][k] < -1e-13) {
          touches   = !touches;
          exchanged = true;
        }
        const double held = touches ? std::max(wants, trace) : 0;
        change            = std::max(change, std::abs(held - contact.force[k]));
        largest           = std::max(largest, held);
        contact.force[k]  = held;
      }
    }
    state[i] = next;
    for (std::size_t c = 0; c < half.contacts.size(); ++c)
      state[i].contact[c] = half.contacts[c].force;
    return largest > 0 ? change / largest : 0;
  }

  std::array<HalfVector, 2> linearised() const
  {
    std::array<HalfVector, 2> r = right;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < halves[i].contacts.size(); ++c) {
        const StationedContact &contact = halves[i].contacts[c];
        const VectorXd lengths          = contact.stations.length();
        for (Index k = 0; k < lengths.size(); ++k) {
          const double q = contact.force[k] / lengths[k];
          if (contact.touching[std::size_t(k)])
            r[i].contact[c][k] += contact.closing_of(q) - contact.slope[k] * q;
        }
      }
    return r;
  }

  // Opening of the strip's stations by the surfaces alone.
  VectorXd opening(const std::array<HalfVector, 2> &of) const
  {
    return of[0].strip + of[1].strip;
  }

  // A step on the way may have needed wider b_0 than the solution.
  bool fit_widths()
  {
    bool changed = false;
    for (HalfStack &half : halves)
      changed = half.fit_widths(true) || changed;
    return changed;
  }

  int solve()
  {
    const VectorXd constant = law_constant();
    bool outdated           = !has_factors;
    bool fitted             = false;  // once, so that a width cannot change from step to step
    for (int step = 1; step <= most_steps; ++step) {
      if (outdated)
        factorise();
      const Change next = linear(linearised(), constant, stack.strip.force);
      bool exchanged    = false;
      double change     = (next.force - force).cwiseAbs().maxCoeff() / next.force.cwiseAbs().maxCoeff();
      for (std::size_t i = 0; i < 2; ++i)
        change = std::max(change, take(i, next.half[i], next.force, exchanged));
      force                = next.force;
      level                = next.level;
      const VectorXd wants = (constant.array() + level).matrix() - k_open() * opening(next.half);
      for (Index k = 0; k < force.size(); ++k) {
        char &touches = pressed[std::size_t(k)];
        if (touches ? force[k] <= 0 : wants[k] > 0) {
          touches   = !touches;
          exchanged = true;
        }
      }
      since += change;
      if (!exchanged && change < settled) {
        outdated = !std::exchange(fitted, true) && fit_widths();
        if (outdated)
          continue;
        if (since > current)
          factorise();  // for the derivatives
        return step;
      }
      // The slopes of the contacts change with the logarithm of the load: factors serve until a contact changes.
      outdated = exchanged || change > 0.1;
    }
    throw SolverError({"roll stack: no equilibrium of the condensed rolls after 60 steps", "",
                       "contacts that open and close, by crowns or bending forces that part the rolls",
                       "smaller crowns or bending forces, or a larger rolling force", ""});
  }

  VectorXd read_of(const std::array<HalfVector, 2> &of, const VectorXd &strip_force) const
  {
    return halves[0].read(of[0], strip_force) + halves[1].read(of[1], strip_force);
  }

  std::array<HalfVector, 2> nothing() const
  {
    return {halves[0].zero(), halves[1].zero()};
  }

  GapShape influence(const std::array<HalfVector, 2> &of_halves, const VectorXd &of_law, const double of_force,
                     const VectorXd &more_opening, const VectorXd &more_read) const
  {
    const Change c = linear(of_halves, of_law, of_force);
    return shape_of(opening(c.half) + more_opening, read_of(c.half, c.force) + more_read);
  }

  GapShape influence_of_force() const
  {
    return influence(nothing(), VectorXd::Zero(length.size()), 1, VectorXd::Zero(length.size()),
                     VectorXd::Zero(7));
  }

  GapShape influence_of_loads(const std::size_t roll, const std::vector<StackLoad> &unit) const
  {
    auto of       = nothing();
    VectorXd more = VectorXd::Zero(7);
    for (std::size_t i = 0; i < 2; ++i)
      if (halves[i].holds(roll)) {
        of[i] = halves[i].of_loads(roll, unit);
        more += halves[i].read_of_loads(roll, unit);
      }
    return influence(of, VectorXd::Zero(length.size()), 0, VectorXd::Zero(length.size()), more);
  }

  GapShape influence_of_radius(const std::size_t roll, const std::function<double(double)> &departure) const
  {
    auto of = nothing();
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < halves[i].contacts.size(); ++c) {
        const StationedContact &contact = halves[i].contacts[c];
        const StackContact &drawn       = stack.contacts[contact.contact];
        if (drawn.a == roll || drawn.b == roll)
          of[i].contact[c] = -means_of(departure, contact.stations);
      }
    const bool at_the_strip = roll == stack.upper || roll == stack.lower;
    const VectorXd closed   = at_the_strip ? means_of(departure, at_strip) : VectorXd::Zero(length.size());
    const VectorXd at_read  = at_the_strip ? means_of(departure, read) : VectorXd::Zero(7);
    return influence(of, k_open() * closed, 0, -closed, -at_read);
  }

  // d(force)/d(h - S) with h averaged by the line load.
  double mean_modulus() const
  {
    const VectorXd o = opening(state) - ground;
    const Change c   = linear(nothing(), VectorXd::Zero(length.size()), 1);
    const double F   = stack.strip.force;
    return F / (c.force.dot(o) + force.dot(opening(c.half)) - force.dot(o) / F);
  }
};

CondensedStack::CondensedStack(Stack stack, std::vector<std::shared_ptr<const RollKernel>> kernels,
                               const CondensedStackSettings &settings)
    : self(std::make_unique<Implementation>(std::move(stack), std::move(kernels), settings))
{
}
CondensedStack::~CondensedStack()                          = default;
CondensedStack::CondensedStack(CondensedStack &&) noexcept = default;

StackState CondensedStack::solve()
{
  Implementation &my = *self;
  StackState out;
  out.newton_steps    = my.solve();
  const auto by_force = my.linear(my.nothing(), VectorXd::Zero(my.length.size()), 1);
  out.pairs.resize(my.stack.contacts.size());
  out.rolls.resize(my.stack.rolls.size());
  for (std::size_t i = 0; i < 2; ++i) {
    const HalfStack &half = my.halves[i];
    const auto open       = half.openings(my.state[i], my.force, my.right[i]);
    for (std::size_t c = 0; c < half.contacts.size(); ++c) {
      PairState &pair = out.pairs[half.contacts[c].contact];
      pair            = pair_state(half.contacts[c], my.state[i].contact[c], open[c]);
      pair.loaded_tangent =
          reduce::loaded_tangent(pair, (pair.tangent.array() > 0)
                                           .select(by_force.half[i].contact[c].array() / pair.weight.array(), 0.)
                                           .matrix());
    }
    for (const std::size_t r : half.rolls()) {
      const auto d = half.deflection(r, my.state[i], my.force);
      out.rolls[r] = {d.z, d.x, d.y, d.reactions, d.across};
    }
    out.residual = std::max(out.residual, half.imbalance(my.state[i], my.force) / my.stack.strip.force);
  }
  const VectorXd h = my.read_of(my.state, my.force) + my.halves[0].read_unloaded() + my.halves[1].read_unloaded() -
                     my.ground_read;
  const GapShape gap = shape_of(my.opening(my.state) - my.ground, h);
  const Index n      = my.length.size();
  out.strip.edges.resize(n + 1);
  out.strip.edges << my.at_strip.from, my.at_strip.to[n - 1];
  out.strip.edges.array() -= my.stack.strip.offset;
  out.strip.load      = my.force.cwiseQuotient(my.length);
  out.strip.opening   = gap.opening;
  out.strip.entry     = my.entry;
  out.strip.middle    = gap.middle;
  out.strip.crown     = gap.crown;
  out.strip.edge_drop = gap.edge_drop;
  out.strip.wedge     = gap.wedge;
  out.modulus.mid     = 1 / my.influence_of_force().middle;
  out.modulus.mean    = my.mean_modulus();
  return out;
}

bool CondensedStack::change(const Stack &stack)
{
  return self->change(stack);
}

GapShape CondensedStack::influence_of_force() const
{
  return self->influence_of_force();
}

GapShape CondensedStack::influence_of_loads(const std::size_t roll, const std::vector<StackLoad> &unit) const
{
  return self->influence_of_loads(roll, unit);
}

GapShape CondensedStack::influence_of_radius(const std::size_t roll,
                                             const std::function<double(double)> &departure) const
{
  return self->influence_of_radius(roll, departure);
}
}  // namespace mill::fem
