#pragma once
#include "core/records/component.h"

namespace mill::reduce {
/// A component with its first `kept` modes only; what the others contribute goes into the residual.  theory.md
/// (22.20)
Component with_modes(const Component &component, Eigen::Index kept);
}  // namespace mill::reduce
