#pragma once
#include "core/model/ring_sections.h"
#include <string>

namespace mill::meshes {
/// How fine the rings are meshed.
struct RingMeshSize {
  double sections = 1;  ///< -, elements per length of the meridian sections; 1: 8 quadratic ones on a raceway
  double chock    = 1;  ///< -, elements per length of the block; 1: 3 on a raceway, 13 degrees around
};

/// Coarser meshes of the same bodies, whose answer tells how far this size is from the limit.
RingMeshSize coarsened(const RingMeshSize &size);

/// Meshes cone with neck, cup with round housing, one raceway of each on a rigid back, and the block around the
/// cup (kind block only); files folder/name.*.msh.
/// @throws SolverError  an element is inverted
RingMeshes mesh_rings(const RingSections &sections, const RingMeshSize &size, const std::string &folder,
                      const std::string &name = "rings");

/// Removes the files of such meshes.
void remove_meshes(const RingMeshes &meshes);
}  // namespace mill::meshes
