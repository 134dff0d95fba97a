#pragma once
#include "app/run_context.h"
#include "fem/condensed_roll.h"
#include "meshes/roll.h"
#include <memory>
#include <string>

namespace mill {
/// A roll condensed on the wanted mesh and on one about twice as coarse, which tells the discretisation error and
/// carries the displacement fields for ParaView.
struct CondensedPair {
  std::shared_ptr<const fem::CondensedRoll> fine, coarse;
  MeshFile coarse_mesh;
};

/// Meshes and condenses a roll, or takes both from the cache; the key is everything the result depends on.
/// @param name  as the user calls the roll: "backup roll"
CondensedPair condensed_pair(RunContext &run, const std::string &name, const RollGeometry &geometry,
                             const meshes::RollMeshSize &size, const Material &steel, bool slab);
}  // namespace mill
