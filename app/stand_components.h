#pragma once
#include "app/run_context.h"
#include "core/stand.h"
#include "reduce/component_stand.h"

namespace mill {
/// How many times larger the error of a roll is on the coarser of two meshes, as seen in the manual
/// (component-mesh).
constexpr double roll_mesh_gain = 1.8;

/// The rolls (and a drawn housing) reduced by finite elements, on the mesh of the case and on a coarser one for
/// the error estimate.
struct ComponentSets {
  reduce::StandComponents fine, coarse;
  bool present = false;
};

/// Meshes and reduces them, or takes them from the cache.
/// @param with_housing  false: the rolls only
/// @throws InputError  dynamics.frequency_limit above the reach of the meshes
ComponentSets stand_components(RunContext &run, const FourHigh &stand, bool with_housing = true);

/// The rolls of both meshes, for the chain; none where nothing was meshed.
reduce::SolidRolls solid_rolls(const ComponentSets &components);

/// Frequencies of the bare housing on its feet, up and down: housing.f1.. up to the frequency limit.
void add_housing_frequencies(RunContext &run, const FourHigh &stand, const ComponentSets &components);
}  // namespace mill
