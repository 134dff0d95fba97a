#include "reduce/bite/slab/karman_path.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "reduce/bite/sentence.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
BranchPath::BranchPath(const SliceInputs<double> &inputs, const int side, const double start, const double f,
                       const double far_end, const double tolerance)
    : in_(inputs), equation_(inputs, side), side_(side), span_(std::abs(far_end - start)),
      proposed_((far_end - start) / 3)
{
  PathNode node{start, {f, 0, 0}, 0, false};
  if (side > 0)
    node.piece = inputs.pieces.size() - 1;
  equation_.piece           = node.piece;
  const double first        = excess(node);
  node.at_limit             = first > 0;
  const Slice<double> slice = equation_.slice(start, f);
  const double length       = std::abs(far_end - start) * slice.by_shear / 2;
  // What the three integrals may grow to: the tolerance is relative to these.
  equation_.piece = side > 0 ? 0 : inputs.pieces.size() - 1;
  const double stress =
      std::max(slice.yield, equation_.yield(side > 0 ? in_.exit_thickness : in_.entry_thickness));
  const double shear =
      std::max(0.02, std::min(0.5, std::max(in_.friction.coefficient, 0.5 * in_.friction.entry_factor)));
  scale_ = {tolerance * stress * in_.exit_thickness, tolerance * stress * length,
            tolerance * stress * length * shear * in_.arm};
  nodes_.push_back(node);
}

double BranchPath::excess(const PathNode &node)
{
  equation_.piece    = node.piece;
  equation_.at_limit = node.at_limit;
  return equation_.slice(node.t, node.y[0]).excess;
}

PathNode BranchPath::stepped(const PathNode &from, const double length, double *error)
{
  equation_.piece    = from.piece;
  equation_.at_limit = from.at_limit;
  PathNode to        = from;
  to.y               = extrapolated_step(equation_, from.t, from.y, length, &scale_, error);
  to.t               = from.t + length;
  return to;
}

/// Node at which the friction changes its regime inside a step that ends in the other one.
PathNode BranchPath::event(const PathNode &from, const double length)
{
  const auto at_end = root_between(
      {from.t, excess(from)}, {from.t + length, excess(stepped(from, length))},
      [&](const double t) { return excess(stepped(from, t - from.t)); }, 1e-14);
  return at_end && *at_end != from.t ? stepped(from, *at_end - from.t) : from;  // else it starts on the border
}

void BranchPath::refuse_crawling(const PathNode &node_reached, const double length) const
{
  throw SolverError({"roll bite: the pressure could not be integrated along the arc",
                     sentence("after ", n_attempts_, " steps it stands at ", node_reached.t / span_,
                              " of the arc, with steps of ", std::abs(length) / span_),
                     "a strip far thinner than the arc is long, or friction just at its limit",
                     "check strip.exit_thickness, strip.friction and the tensions", ""});
}

PathNode BranchPath::step_towards(const double target)
{
  const PathNode from = nodes_.back();
  // Not across a kink of the flow stress.
  double stop     = target;
  bool kink       = false;
  const auto &all = in_.pieces;
  if (side_ > 0 && from.piece > 0 && all[from.piece].from >= stop) {
    stop = all[from.piece].from;
    kink = true;
  } else if (side_ < 0 && from.piece + 1 < all.size() && all[from.piece + 1].from <= stop) {
    stop = all[from.piece + 1].from;
    kink = true;
  }
  double length = proposed_;
  bool whole    = false;
  for (int attempt = 0; attempt < 60; ++attempt) {
    if (++n_attempts_ > 400 + 20 * int(in_.pieces.size()))
      refuse_crawling(from, length);
    whole = std::abs(length) >= std::abs(stop - from.t) * (1 - 1e-12);
    if (whole)
      length = stop - from.t;
    double error        = 0;
    PathNode to         = stepped(from, length, &error);
    const bool violated = equation_.violated;
    const double factor = error > 0 ? std::clamp(0.9 * std::pow(error, -1.0 / 11), 0.2, 3.0) : 3.0;
    if (!(error <= 1)) {
      length *= std::isfinite(error) ? std::min(factor, 0.8) : 0.1;
      continue;
    }
    const double there = excess(to);
    const bool flipped = from.at_limit ? there < -1e-11 : there > 1e-11;
    if (violated && !flipped && std::abs(length) > 1e-6 * std::abs(stop)) {
      length *= 0.5;  // the regime is left inside the step and entered again
      continue;
    }
    if (flipped) {
      to          = event(from, length);
      to.at_limit = !from.at_limit;
      if (++n_events_ > 40)
        throw SolverError({"roll bite: the friction changes between slipping and sticking without end",
                           "more than 40 changes on one side of the neutral point", "friction just at its limit",
                           "change strip.friction.coefficient slightly", ""});
      return to;
    }
    if (whole) {
      to.t = stop;
      if (kink)
        to.piece = side_ > 0 ? from.piece - 1 : from.piece + 1;
      if (std::abs(length) > std::abs(proposed_))
        proposed_ = length * factor;
    } else
      proposed_ = length * factor;
    return to;
  }
  throw SolverError({"roll bite: the pressure could not be integrated along the arc",
                     "stopped in one step after 60 attempts", "a flow stress without a finite value in the arc",
                     "check strip.flow_stress", ""});
}

void BranchPath::extend(const double target)
{
  while (beyond(nodes_.back().t, target) == false && nodes_.back().t != target)
    nodes_.push_back(step_towards(target));
}

PathNode BranchPath::node_before(const double t) const
{
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
    if (!beyond(node->t, t))
      return *node;
  return nodes_.front();
}

Branch<double> BranchPath::at(const double t)
{
  extend(t);
  const PathNode node = node_before(t);
  if (node.t == t)
    return node.y;
  if (std::abs(t - node.t) < 0.05 * std::abs(proposed_)) {  // the last steps of a search for the neutral point
    equation_.piece    = node.piece;
    equation_.at_limit = node.at_limit;
    double error       = 0;
    const auto y       = extrapolated_step<3>(equation_, node.t, node.y, t - node.t, &scale_, &error);
    if (error < 0.1)
      return y;
  }
  return stepped(node, t - node.t).y;
}

Slice<double> BranchPath::slice_at(const double t, const double f)
{
  const PathNode node = node_before(t);
  equation_.piece     = node.piece;
  equation_.at_limit  = node.at_limit;
  return equation_.slice(t, f);
}
}  // namespace mill::bite
