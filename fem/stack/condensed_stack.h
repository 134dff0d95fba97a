#pragma once
#include "fem/stack/roll_kernel.h"
#include "reduce/stack/stack_engine.h"
#include <memory>

namespace mill::fem {
struct CondensedStackSettings {
  int stations_per_width = 40;  ///< of the strip; contacts in stations as long
};

/// The stack as condensed rolls whose contact lines feel each other, with the strip between the work rolls.
/// theory.md 51.4.  Cost of a step, 20-high: LU of two times 280 + 200 + 100 unknowns.
class CondensedStack : public reduce::StackEngine {
public:
  /// @param kernels  of each roll, with its points
  CondensedStack(Stack stack, std::vector<std::shared_ptr<const RollKernel>> kernels,
                 const CondensedStackSettings &settings = {});
  ~CondensedStack() override;
  CondensedStack(CondensedStack &&) noexcept;

  reduce::StackState solve() override;
  reduce::GapShape influence_of_force() const override;
  reduce::GapShape influence_of_loads(std::size_t roll, const std::vector<StackLoad> &unit) const override;
  reduce::GapShape influence_of_radius(std::size_t roll,
                                       const std::function<double(double)> &departure) const override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
