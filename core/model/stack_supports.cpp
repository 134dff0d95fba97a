#include "core/model/stack_supports.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mill {
namespace {
using Eigen::Vector2d;

// Cubic of approach over load between two points of the curve, with their slopes 1 / tangent.
BearingPoint between(const BearingCurve &c, const std::size_t i, const double load)
{
  const double step = c.load[i + 1] - c.load[i], t = (load - c.load[i]) / step;
  const double rise = c.approach[i + 1] - c.approach[i];
  const double low = step / c.tangent[i] - rise, high = rise - step / c.tangent[i + 1];
  const double bulge = (1 - t) * low + t * high;
  BearingPoint point;
  point.approach     = c.approach[i] + t * rise + t * (1 - t) * bulge;
  const double slope = (rise + (1 - 2 * t) * bulge + t * (1 - t) * (high - low)) / step;
  point.tangent      = 1 / slope;
  return point;
}

bool has_bearing(const StackRoll &roll)
{
  return std::any_of(roll.supports.begin(), roll.supports.end(),
                     [](const StackSupport &support) { return !support.bearing.empty(); });
}

void set_spring(StackSupport &support, const Vector2d &force_on_roll)
{
  if (!support.curve)
    throw std::logic_error("bearing " + support.bearing + " of a stack was not solved");
  const double load = force_on_roll.norm(), housing = std::isnan(support.housing) ? 0 : 1 / support.housing;
  const BearingPoint point = bearing_point(*support.curve, load);
  const double stiffness   = 1 / (1 / point.tangent + housing);
  const Vector2d outward   = load > 0 ? Vector2d(-force_on_roll / load) : Vector2d(0, 0);
  const double ahead       = point.approach + housing * load - load / stiffness;
  for (const std::size_t axis : {0u, 1u})
    if (support.stiffness[axis] > 0) {
      support.stiffness[axis] = stiffness;
      support.motion[axis]    = ahead * outward[Eigen::Index(axis)];
    }
}
}  // namespace

BearingPoint bearing_point(const BearingCurve &curve, const double load)
{
  for (const std::size_t end : {std::size_t(0), curve.load.size() - 1})
    if (end == 0 ? load < curve.load[0] : load >= curve.load[end])
      return {curve.approach[end] + (load - curve.load[end]) / curve.tangent[end], curve.tangent[end]};
  const auto next     = std::upper_bound(curve.load.begin() + 1, curve.load.end() - 1, load);
  const std::size_t i = std::size_t(next - curve.load.begin()) - 1;
  return between(curve, i, load);
}

Eigen::Matrix2d support_forces(const Stack &stack, const std::size_t roll,
                               const std::vector<StackResultant> &resultants)
{
  const StackRoll &of = stack.rolls[roll];
  Vector2d force(0, 0), moment(0, 0);  // along x and y
  const auto add = [&](const Vector2d &f, const double z) {
    force += f;
    moment += f * z;
  };
  for (std::size_t c = 0; c < stack.contacts.size(); ++c)
    if (stack.contacts[c].b == roll) {
      const auto &a = stack.rolls[stack.contacts[c].a].axis;
      const Vector2d n(of.axis[0] - a[0], of.axis[1] - a[1]);
      add(resultants[c].force * n.normalized(), resultants[c].centre);
    }
  for (const StackLoad &load : of.loads)
    add({load.force[0], load.force[1]}, load.z + of.shift);
  for (const auto &[work_roll, sign] : {std::pair(stack.upper, 1.), std::pair(stack.lower, -1.)})
    if (work_roll == roll)
      add({0, sign * stack.strip.force}, stack.strip.offset);
  const double z0 = of.supports[0].z + of.shift, z1 = of.supports[1].z + of.shift;
  Eigen::Matrix2d reactions;
  reactions.col(1) = -(moment - force * z0) / (z1 - z0);
  reactions.col(0) = -force - reactions.col(1);
  return reactions;
}

Stack with_bearing_springs(Stack stack)
{
  const bool any = std::any_of(stack.rolls.begin(), stack.rolls.end(), has_bearing);
  if (!any)
    return stack;
  const auto resultants = stack_resultants(stack, stack.strip.force);
  for (std::size_t r = 0; r < stack.rolls.size(); ++r)
    if (StackRoll &roll = stack.rolls[r]; has_bearing(roll)) {
      const Eigen::Matrix2d forces = support_forces(stack, r, resultants);
      for (std::size_t s = 0; s < roll.supports.size(); ++s)
        set_spring(roll.supports[s], forces.col(Eigen::Index(s)));
    }
  return stack;
}
}  // namespace mill
