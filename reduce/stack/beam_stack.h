#pragma once
#include "core/model/stack.h"
#include "reduce/stack/stack_engine.h"
#include "reduce/stack/strip_flattening.h"
#include <memory>
#include <vector>

namespace mill::reduce {
struct BeamStackSettings {
  int elements_per_width = 60;  ///< of the strip; the rest of the rolls in elements as long
  Flattening flattening  = Flattening::half_space;
  int threads            = 1;  ///< at most two have work: one for each half
};

class RollGroup;
class StripSide;
struct Stations;

/// What its equilibrium consists of, for those who set it in motion; valid as long as the BeamStack.
struct BeamStackParts {
  const Stack &stack;
  const Stations &stations;
  const std::vector<RollGroup> &groups;
  const std::vector<StripSide> &sides;  ///< upper, lower
  const Eigen::VectorXd &length;        ///< (n) m, of the elements of the strip
  const Eigen::VectorXd &load;          ///< (n) N/m
  const Eigen::MatrixXd &flattening;    ///< (n, n) 1/Pa, of both work rolls
};

/// The stack as Timoshenko beams on their bearings, joined by line contacts, with the strip between the work
/// rolls. theory.md 51.2.  Cost of a Newton step: O(stations x (4 rolls of a half)^3).
class BeamStack : public StackEngine {
public:
  explicit BeamStack(Stack stack, const BeamStackSettings &settings = {});
  ~BeamStack() override;
  BeamStack(BeamStack &&) noexcept;

  StackState solve() override;
  GapShape influence_of_force() const override;
  GapShape influence_of_loads(std::size_t roll, const std::vector<StackLoad> &unit) const override;
  GapShape influence_of_radius(std::size_t roll, const std::function<double(double)> &departure) const override;

  BeamStackParts parts() const;

  /// Lowest natural frequencies about the solved state without a strip spring, Hz, ascending, to 1e-8.
  Eigen::VectorXd frequencies(int n) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::reduce
