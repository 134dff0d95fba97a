#pragma once
#include "core/model/ring_sections.h"
#include "meshes/bearing/ring_grid.h"
#include <string>

namespace mill::meshes {
/// Whether the rows are mirror images in the bearing's mid-plane z = 0: then half the block is enough.
bool mirrored_rows(const RingSection &cup);

/// Meshes the half y >= 0 of the block with the cup in its bore, load line along +x, axis z: the cup's meridian
/// section turned around the axis, its outer part stretched to the faces of the block.  The cup and the chock are
/// one body (a fit without clearance).  Only z >= 0 if the rows are mirrored.  A housing of kind round gives a
/// round block held at its radius: the same body as its meridian section, for checks. Groups: contact (rolling
/// surface of the cup; on true cones), neck (bore or outside diameter that is bare at the ends), barrel (round
/// outside), support, symmetry.y, symmetry.z, as far as there are.
/// @param refinement  elements per length; 1: 3 on a raceway, some 13 degrees around
/// @throws SolverError  an element is inverted
MeshFile mesh_chock(const RingSection &cup, const Housing &housing, double refinement, const std::string &path);

/// How fine the block's meridian is: the grid of cup_grid that mesh_chock turns around the axis.
RingGridSize chock_grid_size(const RingSection &cup, double refinement);
}  // namespace mill::meshes
