#pragma once
#include "core/model/stack.h"
#include "reduce/stack/stack_state.h"
#include <functional>
#include <vector>

namespace mill::reduce {
/// Change of the loaded gap with one input.
struct GapShape {
  Eigen::VectorXd opening;  ///< (n) m, h - S over the elements of StripState::edges
  double middle    = 0;     ///< m
  double crown     = 0;     ///< m
  double edge_drop = 0;     ///< m
  double wedge     = 0;     ///< m
};

/// Solves a stack of rolls: by beams (BeamStack), or by condensed rolls (fem/stack/condensed_stack).
class StackEngine {
public:
  virtual ~StackEngine() = default;

  /// Equilibrium.  A second call starts from the last state.
  /// @throws SolverError  no equilibrium: a roll is not held, or Newton's method does not settle
  virtual StackState solve() = 0;

  /// The same rolls and strip under other settings: force, loads, shifts, profiles, feet of supports.  The next
  /// solve() then starts from the last state and keeps what does not follow the settings.
  /// @return  false: this stack needs an engine of its own; nothing is changed
  virtual bool change(const Stack &)
  {
    return false;
  }

  // Exact derivatives at the solved state, by its factors.
  virtual GapShape influence_of_force() const = 0;  ///< per N of rolling force
  /// Per unit of forces on the axis of a roll, at places of its supports and loads.
  virtual GapShape influence_of_loads(std::size_t roll, const std::vector<StackLoad> &unit) const = 0;
  /// Per unit of a radius departure of a roll, a function of z (m, mill frame).
  virtual GapShape influence_of_radius(std::size_t roll, const std::function<double(double)> &departure) const = 0;
};
}  // namespace mill::reduce
