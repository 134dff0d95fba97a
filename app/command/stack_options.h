#pragma once
#include <string>
#include <vector>

namespace mill {
/// Flags of `millstand stack`, as written.
struct StackOptions {
  std::string action;                ///< optimise
  std::vector<std::string> targets;  ///< --target crown=20um
  std::vector<std::string> bounds;   ///< --bound "W.bending_force=-200 kN..600 kN"
};
}  // namespace mill
