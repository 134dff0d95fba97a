#pragma once
#include "fem/stack/roll_kernel.h"
#include "reduce/stack/stack_engine.h"
#include <memory>

namespace mill::fem {
struct CondensedStackSettings {
  int stations_per_width = 40;  ///< of the strip; contacts in stations as long
  int threads            = 1;   ///< at most two have work: one for each half
};

/// The stack as condensed rolls whose contact lines feel each other, with the strip between the work rolls.
/// theory.md 51.4.  Cost of the factors of a half of a 20-high: 125 n^3 operations, n stations of a contact.
class CondensedStack : public reduce::StackEngine {
public:
  /// @param kernels  of each roll, with its points
  CondensedStack(Stack stack, std::vector<std::shared_ptr<const RollKernel>> kernels,
                 const CondensedStackSettings &settings = {});
  ~CondensedStack() override;
  CondensedStack(CondensedStack &&) noexcept;

  reduce::StackState solve() override;
  bool change(const Stack &stack) override;
  reduce::GapShape influence_of_force() const override;
  reduce::GapShape influence_of_loads(std::size_t roll, const std::vector<StackLoad> &unit) const override;
  reduce::GapShape influence_of_radius(std::size_t roll,
                                       const std::function<double(double)> &departure) const override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
