// Order of elimination and factors of a half of a stack.
#include "core/base/errors.h"
#include "fem/stack/half_stack.h"
#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace mill::fem {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool HalfStack::is_coupled(const Unknowns &one, const Unknowns &other) const
{
  if (!one.is_force)
    return other.is_force && is_coupled(other, one);
  const StationedContact &c = contacts[one.item];
  if (!other.is_force)
    return other.item == c.a || other.item == c.b;
  const StationedContact &d = contacts[other.item];
  return c.a == d.a || c.a == d.b || c.b == d.a || c.b == d.b;
}

bool HalfStack::is_at_strip(const Unknowns &one) const
{
  if (!one.is_force)
    return one.item == work_roll;
  return contacts[one.item].a == work_roll || contacts[one.item].b == work_roll;
}

std::vector<std::vector<std::size_t>> HalfStack::graph() const
{
  const std::size_t strip = nodes.size();
  std::vector<std::vector<std::size_t>> neighbours(strip + 1);
  for (std::size_t i = 0; i < strip; ++i) {
    for (std::size_t j = 0; j < strip; ++j)
      if (i != j && is_coupled(nodes[i], nodes[j]))
        neighbours[i].push_back(j);
    if (is_at_strip(nodes[i])) {
      neighbours[i].push_back(strip);
      neighbours[strip].push_back(i);
    }
  }
  return neighbours;
}

// Level by level; within one the node with the fewest neighbours, motions of a roll after all contacts on which it
// leans.
std::vector<std::size_t> HalfStack::order_of_elimination() const
{
  std::vector<int> level(stacked.size(), 0);
  for (std::size_t round = 0; round < stacked.size(); ++round)
    for (const StationedContact &c : contacts)
      level[c.b] = std::max(level[c.b], level[c.a] + 1);
  const auto level_of = [&](const Unknowns &node) {
    return level[node.is_force ? contacts[node.item].a : node.item];
  };
  std::vector<std::set<std::size_t>> left;
  for (const auto &list : graph())
    left.emplace_back(list.begin(), list.end());
  std::vector<char> done(nodes.size(), 0);
  std::vector<std::size_t> order;
  const auto may_follow = [&](const std::size_t i) {
    return nodes[i].is_force || std::none_of(left[i].begin(), left[i].end(), [&](const std::size_t j) {
             return j < nodes.size() && nodes[j].is_force && contacts[nodes[j].item].a == nodes[i].item;
           });
  };
  while (order.size() < nodes.size()) {
    std::size_t best = nodes.size();
    const auto rank  = [&](const std::size_t i) { return std::pair(-level_of(nodes[i]), left[i].size()); };
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!done[i] && may_follow(i) && (best == nodes.size() || rank(i) < rank(best)))
        best = i;
    done[best] = 1;
    order.push_back(best);
    for (const std::size_t j : left[best]) {
      left[j].insert(left[best].begin(), left[best].end());
      left[j].erase(j);
      left[j].erase(best);
    }
  }
  return order;
}

void HalfStack::list_touching()
{
  std::vector<Index> sizes;
  for (Unknowns &node : nodes) {
    if (node.is_force) {
      const auto &touching = contacts[node.item].touching;
      node.entry.clear();
      for (std::size_t k = 0; k < touching.size(); ++k)
        if (touching[k])
          node.entry.push_back(Index(k));
    }
    sizes.push_back(node.size());
  }
  sizes.push_back(by_strip.rows());
  factors.resize(sizes);
}

// Factors of some unknowns in the equations of others, over the scale; empty where there are none.  (51.16)
MatrixXd HalfStack::coupling(const Unknowns &one, const Unknowns &other) const
{
  if (!one.is_force)
    return other.is_force ? MatrixXd(coupling(other, one).transpose()) : MatrixXd();
  const StationedContact &c = contacts[one.item];
  if (!other.is_force) {
    if (other.item == c.a)
      return -stacked[c.a].motion(c.line_a)(one.entry, other.entry);
    return other.item == c.b ? MatrixXd(-stacked[c.b].motion(c.line_b)(one.entry, other.entry)) : MatrixXd();
  }
  const StationedContact &d = contacts[other.item];
  MatrixXd sum;
  const bool whole = one.size() == Index(c.touching.size()) && other.size() == Index(d.touching.size());
  for (const auto &[roll, line] : {std::pair(c.a, c.line_a), std::pair(c.b, c.line_b)})
    for (const auto &[with, its] : {std::pair(d.a, d.line_a), std::pair(d.b, d.line_b)}) {
      if (roll != with)
        continue;
      const MatrixXd &part = stacked[roll].flexibility(line, its);
      if (sum.size() > 0)
        sum += whole ? MatrixXd(part / scale) : MatrixXd(part(one.entry, other.entry) / scale);
      else if (whole)
        sum = part / scale;
      else
        sum = part(one.entry, other.entry) / scale;
    }
  if (one.item == other.item)
    for (Index i = 0; i < one.size(); ++i) {
      const Index k = one.entry[std::size_t(i)];
      sum(i, i) += c.slope[k] / (c.stations.to[k] - c.stations.from[k]) / scale;
    }
  return sum;
}

MatrixXd HalfStack::coupling_with_strip(const Unknowns &one) const
{
  const StackedRoll &work = stacked[work_roll];
  if (!one.is_force)
    return -work.motion(strip_line).transpose();
  const StationedContact &c = contacts[one.item];
  return work.flexibility(c.a == work_roll ? c.line_a : c.line_b, strip_line)(one.entry, Eigen::all) / scale;
}

void HalfStack::not_held(const std::size_t roll) const
{
  throw SolverError({"roll stack: roll " + stack.rolls[names[roll]].name + " is not held", "",
                     "it has no supports, and all contacts that hold it are open",
                     "check supports and contacts of every roll, and the signs of crowns and bending forces", ""});
}

void HalfStack::no_pressing(const StationedContact &contact) const
{
  const double most = contact.force.cwiseQuotient(contact.stations.length()).maxCoeff();
  throw SolverError({"roll stack: contact " + stack.rolls[names[contact.a]].name + "-" +
                         stack.rolls[names[contact.b]].name + " has no positive compliance",
                     fmt::format("largest line load {:.4g} kN/mm", 1e-6 * most),
                     "a line load beyond what the plane law of a contact describes",
                     "smaller bending forces, or a smaller rolling force", ""});
}

void HalfStack::factorise()
{
  fit_widths(false);
  by_strip = stacked[work_roll].flexibility(strip_line, strip_line);
  for (StationedContact &c : contacts) {
    const VectorXd length = c.stations.length();
    c.slope =
        VectorXd::NullaryExpr(length.size(), [&](const Index k) { return c.slope_of(c.force[k] / length[k]); });
  }
  list_touching();
  const std::size_t strip = nodes.size();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = i; j < nodes.size(); ++j)
      if (is_coupled(nodes[i], nodes[j])) {
        auto [values, turned] = factors.block(i, j);
        values                = turned ? coupling(nodes[j], nodes[i]) : coupling(nodes[i], nodes[j]);
      }
    if (is_at_strip(nodes[i]))
      factors.block(i, strip).values = coupling_with_strip(nodes[i]);
  }
  if (const std::size_t loose = factors.factorise(); loose < strip) {
    const Unknowns &node = nodes[loose];
    if (node.is_force)
      no_pressing(contacts[node.item]);
    not_held(node.item);
  }
  // Of the strip's own flexibility, which a half space need not make symmetric, the rest is what is eliminated.
  by_strip += scale * MatrixXd(factors.block(strip, strip).values.selfadjointView<Eigen::Lower>());
}
}  // namespace mill::fem
