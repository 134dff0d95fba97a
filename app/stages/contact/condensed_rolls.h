#pragma once
#include "app/run/run_context.h"
#include "fem/roll/condensed_roll.h"
#include "meshes/roll/roll.h"
#include <memory>
#include <string>

namespace mill {
/// A roll condensed on the wanted mesh and on one about twice as coarse, which tells the discretisation error and
/// carries the displacement fields for ParaView, with its mesh.
struct CondensedPair {
  std::shared_ptr<const fem::CondensedRoll> fine, coarse;
};

/// What the contact needs of a roll in addition to the loads that are the same on both sides, on both meshes.
struct RollOptions {
  bool slab       = false;  ///< plane strain
  bool both_sides = false;  ///< loads that differ between the sides; the coarse mesh always has them
  bool tractions  = false;  ///< friction
  std::string smaller;      ///< what needs less memory: "a smaller contact.upper.elements_per_half_width"
};

/// Everything that a condensed roll depends on, as text; its hash is the key of the cache.
/// @param companion  on the coarse mesh, whose size is given
std::string roll_inputs(const RollGeometry &geometry, const meshes::RollMeshSize &size, const Material &steel,
                        const RollOptions &wanted, bool companion);

/// Meshes and condenses a roll, or takes both from the cache.
/// @param name  as the user calls the roll: "backup roll"
CondensedPair condensed_pair(RunContext &run, const std::string &name, const RollGeometry &geometry,
                             const meshes::RollMeshSize &size, const Material &steel, const RollOptions &wanted);
}  // namespace mill
