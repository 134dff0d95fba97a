#pragma once
#include "app/run/run_context.h"
#include "core/model/stack.h"
#include "fem/stack/roll_kernel.h"
#include <memory>
#include <vector>

namespace mill {
using StackKernels = std::vector<std::shared_ptr<const fem::RollKernel>>;

/// Every roll of a stack for the engine of condensed rolls.  A shape of roll is condensed once and kept in the
/// cache under its geometry, its material and the places of its supports and forces; shafts that are no solid with
/// one neck are beams.  Cost: some seconds for each new shape on one processor.
StackKernels stack_kernels(RunContext &run, const Stack &stack);
}  // namespace mill
