#include "dynamics/cluster/stability.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "dynamics/cluster/modes.h"
#include <algorithm>
#include <cmath>

namespace mill::cluster {
namespace {
// Equilibrium under a factor on the rolling force; empty where it does not exist.
std::optional<Equilibrium> at_factor(Stack stack, const double factor)
{
  for (Load &load : stack.loads)
    load.force *= factor;
  for (Contact &c : stack.contacts)
    if (c.strip)
      c.free_length = 0;  // carries the force of the loads, whatever that is
  try {
    return equilibrium(stack);
  } catch (const SolverError &) {
    return {};
  }
}

// A contact or a roller that carried force and carries none.
std::string lost_contact(const Stack &stack, const Equilibrium &before, const Equilibrium &now)
{
  for (const Support &s : stack.supports)
    if (s.type == Support::Type::rollers) {
      const auto f = roller_forces(s, before.u.segment<2>(2 * s.roll)),
                 g = roller_forces(s, now.u.segment<2>(2 * s.roll));
      const auto t = roller_directions(s);
      for (std::size_t k = 0; k < 2; ++k)
        if (f[k] > 0 && g[k] <= 0)
          return s.name + (t[k].y() > t[1 - k].y() ? ", upper roller" : ", lower roller");
    }
  for (std::size_t i = 0; i < stack.contacts.size(); ++i)
    if (before.contact_loads[i] > 0 && now.contact_loads[i] <= 0)
      return stack.contacts[i].name;
  return "";
}

constexpr double edge_within = 1e-10;  // of the parameter at which a state at rest ends
}  // namespace

std::optional<BucklingLoad> buckling_load(Stack stack, const double largest)
{
  set_rollers(stack, closed_form_approaches(stack));
  const auto stable = [&](const double factor) {
    const auto e = at_factor(stack, factor);
    return e && e->stable();
  };
  double good = 0, factor = 1;
  while (factor <= largest && stable(factor)) {
    good = factor;
    factor *= 1.5;
  }
  if (factor > largest)
    return {};
  const double edge = border_between(good, factor, stable, edge_within).holds;
  BucklingLoad load{edge, ""};
  if (const auto e = at_factor(stack, edge))
    load.motion = modes(stack, e->u).front().label;
  return load;
}

std::optional<double> least_guide(Stack stack, const std::size_t support)
{
  set_rollers(stack, closed_form_approaches(stack));
  const auto stable = [&](const double stiffness) {
    stack.supports[support].law = {1 / stiffness, 1};
    try {
      return equilibrium(stack).stable();
    } catch (const SolverError &) {
      return false;
    }
  };
  double good = 1 / stack.supports[support].law.kappa;
  for (int i = 0; i < 30 && !stable(good); ++i)
    good *= 4;
  if (!stable(good))
    return {};
  if (stable(1))
    return 0.;
  return border_between(good, 1, stable, edge_within).holds;
}

std::optional<LostContact> leaving_load(const Stack &stack, const int roll, const Eigen::Vector2d &direction,
                                        const double largest)
{
  Stack pushed = stack;
  set_rollers(pushed, closed_form_approaches(pushed));
  const Equilibrium start = equilibrium(pushed);
  pushed.side_loads.push_back({roll, {0, 0}});
  Motion from     = start.u;
  const auto lost = [&](const double load) {
    pushed.side_loads.back().force = load * direction;
    try {
      const Equilibrium e       = equilibrium(pushed, {}, from);
      const std::string contact = lost_contact(pushed, start, e);
      if (contact.empty())
        from = e.u;
      return contact;
    } catch (const SolverError &) {
      return std::string("no state at rest beyond");
    }
  };
  constexpr int steps = 40;
  for (int i = 1; i <= steps; ++i) {
    const double load = largest * i / steps;
    if (std::string contact = lost(load); !contact.empty()) {
      const auto holds = [&](const double tried) {
        const std::string now = lost(tried);
        if (!now.empty())
          contact = now;
        return now.empty();
      };
      const double edge = border_between(largest * (i - 1) / steps, load, holds, edge_within).holds;
      return LostContact{edge, contact};
    }
  }
  return {};
}
}  // namespace mill::cluster
