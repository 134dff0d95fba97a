#pragma once
#include "core/model/stack.h"
#include "reduce/stack/stack_state.h"
#include "reduce/stack/strip_flattening.h"
#include <functional>
#include <memory>
#include <vector>

namespace mill::reduce {
struct BeamStackSettings {
  int elements_per_width = 60;  ///< of the strip; the rest of the rolls in elements as long
  Flattening flattening  = Flattening::half_space;
};

/// Change of the loaded gap with one input.
struct GapShape {
  Eigen::VectorXd opening;  ///< (n) m, h - S over the elements of StripState::edges
  double middle    = 0;     ///< m
  double crown     = 0;     ///< m
  double edge_drop = 0;     ///< m
  double wedge     = 0;     ///< m
};

/// The stack as Timoshenko beams on their bearings, joined by line contacts, with the strip between the work
/// rolls. theory.md 51.2.  Cost of a Newton step: O(stations x (4 rolls of a half)^3).
class BeamStack {
public:
  explicit BeamStack(Stack stack, const BeamStackSettings &settings = {});
  ~BeamStack();
  BeamStack(BeamStack &&) noexcept;

  /// Equilibrium.  A second call starts from the last state.
  /// @throws SolverError  no equilibrium: a roll is not held, or Newton's method does not settle
  StackState solve();

  // Exact derivatives at the solved state, by its factors.
  GapShape influence_of_force() const;  ///< per N of rolling force
  /// Per unit of forces on the axis of a roll.
  GapShape influence_of_loads(std::size_t roll, const std::vector<StackLoad> &unit) const;
  /// Per unit of a radius departure of a roll, a function of z (m, mill frame).
  GapShape influence_of_radius(std::size_t roll, const std::function<double(double)> &departure) const;

  /// Lowest natural frequencies about the solved state without a strip spring, Hz, ascending, to 1e-8.
  Eigen::VectorXd frequencies(int n) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::reduce
