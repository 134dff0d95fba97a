#pragma once
#include "core/model/mesh_file.h"
#include "meshes/common/section.h"
#include <string>
#include <vector>

namespace mill::meshes {
/// How fine a roll is meshed.
struct RollMeshSize {
  SectionSize section;
  double end_layer     = 0;    ///< m, thickness of the last layer at the barrel end
  double layer_growth  = 2;    ///< -, ratio of neighbouring layers towards mid-length
  double largest_layer = 0.1;  ///< m
  int plain_elements   = 0;    ///< per radius; not 0: a section without contact (plain_section), `section` unused
  double break_at = 0;  ///< m, z of a further station with thin layers to both sides, where the other barrel of a
                        ///< shifted pair ends; 0: none
};

/// Heights of the layers between z = 0 and z = length, thinnest at z = length, growing towards z = 0.
std::vector<double> graded_layers(double length, double end_layer, double growth, double largest);

/// Mesh of a roll that vibrates: plain section, layers as long as its elements, thinner at the shoulder.
/// @param elements_per_radius  quadratic elements, 2 or more
RollMeshSize vibration_mesh_size(const RollGeometry &geometry, int elements_per_radius);

/// Meshes an eighth of a roll (barrel and neck) and writes it with the groups contact, symmetry.x, symmetry.y,
/// symmetry.z, barrel, neck, shoulder, end.  A geometry with neck_length 0 is a plain cylinder; one layer of it
/// with both faces held in z is a plane-strain slab.
/// @param name  roll as the user calls it, for messages
/// @throws SolverError  an element is inverted or a group is empty; names the roll
/// Cost: some tenths of a second; the file is written aside and renamed.
MeshFile mesh_roll(const std::string &name, const RollGeometry &geometry, const RollMeshSize &size,
                   const std::string &path);

/// Description of a mesh that mesh_roll wrote earlier, without reading it: path, geometry and the ids of the
/// groups.
MeshFile known_mesh(const std::string &path, const RollGeometry &geometry);
}  // namespace mill::meshes
