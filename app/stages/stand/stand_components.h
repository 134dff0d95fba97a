#pragma once
#include "app/run/run_context.h"
#include "core/model/roll.h"
#include "reduce/stand/component_stand.h"

namespace mill {
struct FourHigh;

/// The rolls (and a drawn housing) reduced by finite elements, on the mesh of the case and on a coarser one for
/// the error estimate.
struct ComponentSets {
  reduce::StandComponents fine, coarse;
  bool present = false;
};

/// Everything that a reduced roll or housing depends on, as text; with the names of part and stage its hash is the
/// key of the cache.
std::string roll_component_inputs(const Roll &drawn, const FourHigh &stand, bool coarse);
std::string housing_component_inputs(const FourHigh &stand, bool coarse);

/// Meshes and reduces them, or takes them from the cache.
/// @param with_housing  false: the rolls only
/// @throws InputError  dynamics.frequency_limit above the reach of the meshes
ComponentSets stand_components(RunContext &run, const FourHigh &stand, bool with_housing = true);

/// How many times larger an error of the meshed rolls is on the coarser meshes, for mesh_pair_error(): the corner
/// at the shoulder lets energies converge as h^1.09, as the manual sees (component-mesh).  By the meshes that were
/// made, which the frequency limit may want finer than the case asks; of two rolls the pair that differs less.
double roll_mesh_gain(const ComponentSets &components);

/// The rolls of both meshes, for the chain; none where nothing was meshed.
reduce::SolidRolls solid_rolls(const ComponentSets &components);

/// Frequencies of the bare housing on its feet, up and down: housing.f1.. up to the frequency limit.
void add_housing_frequencies(RunContext &run, const FourHigh &stand, const ComponentSets &components);
}  // namespace mill
