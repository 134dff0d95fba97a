#pragma once
#include "app/run_context.h"
#include "core/stand.h"
#include "reduce/component_stand.h"

namespace mill {
/// The rolls (and a drawn housing) reduced by finite elements, on the mesh of the case and on a coarser one for
/// the error estimate.
struct ComponentSets {
  reduce::StandComponents fine, coarse;
};

/// Meshes and reduces them, or takes them from the cache.
/// @throws InputError  dynamics.frequency_limit above the reach of the meshes
ComponentSets stand_components(RunContext &run, const FourHigh &stand);
}  // namespace mill
