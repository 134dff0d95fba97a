#pragma once
#include "core/records/component.h"
#include "fem/body/component_modes.h"
#include "fem/housing/housing.h"

namespace mill::fem {
/// How a meshed quarter of a housing is held: planes of symmetry, and one motion up and down that the feet hold.
PartSupport housing_support(const ElasticBody &quarter);

/// Mean vertical displacement of "screw", "seat" and "foot".
PartInterface housing_interface(const ElasticBody &quarter);

/// Highest frequency the mesh shows, Hz: of bending waves of post and beams that are four elements long.
double housing_reach(const MillHousing &housing, const ElasticBody &quarter);

/// Longest element along posts and beams of a mesh that shows waves up to the limit, m.
double longest_housing_element(const MillHousing &housing, double frequency_limit);

/// How many modes a housing keeps.
struct HousingComponentOptions {
  double frequency_limit = 1000;  ///< Hz
  int n_modes            = -1;    ///< -1: by the limit
  /// As in ModeChoice.  What the pads are pressed in is nearly static up to far above the limit, and many modes
  /// would each bring a little of it; the bound is 10 to 30 times what the housing's own modes really are off.
  double residual_share = 1e-2;  ///< -
};

/// Both housings of a stand as one component with the interface "screw" and "seat", standing on feet whose mean
/// does not move.  The motion is the same on both sides of the pass line and of mid-length.  theory.md 23.5
/// @param basis  its columns: screw, seat; modes
/// @throws as component_modes; InputError also when the mesh has no feet: part and direction are named
Component housing_component(const MillHousing &housing, const ElasticBody &quarter,
                            const HousingComponentOptions &options = {}, ComponentBasis *basis = nullptr);
}  // namespace mill::fem
