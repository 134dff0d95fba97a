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

/// Everything that a reduced roll or housing depends on, as text; with the names of part and stage its hash is the
/// key of the cache.
std::string roll_component_inputs(const Roll &drawn, const FourHigh &stand, bool coarse);
std::string housing_component_inputs(const FourHigh &stand, bool coarse);

/// Meshes and reduces them, or takes them from the cache.
/// @throws InputError  dynamics.frequency_limit above the reach of the meshes
ComponentSets stand_components(RunContext &run, const FourHigh &stand);
}  // namespace mill
