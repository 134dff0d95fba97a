#pragma once
#include "core/model/roll_geometry.h"
#include "meshes/common/section.h"
#include <map>
#include <string>
#include <vector>

// All that the meshes ask of Gmsh.  Behind it stands meshes/gmsh/, which the program opens with the first mesh
// (core/process/own_library.h); so nothing of Gmsh is in these types, and no error of ours is thrown on its side.
namespace mill::meshes {
std::string library_version();  ///< of Gmsh, "4.8.0"; known without opening it

/// A mesh by its cells and boundary faces, with node tags from 1 in the order of the coordinates.
struct PlainMesh {
  int dimension = 3;                                            ///< of the cells: 2 quadrilaterals, 3 hexahedra
  std::vector<double> coordinates;                              ///< (3 n) m
  std::vector<std::size_t> cells;                               ///< tags of the corners, cell by cell
  std::map<std::string, std::vector<std::size_t>> group_faces;  ///< tags of the corners, face by face
  std::map<std::string, int> groups;                            ///< ids of the boundary groups
};

/// Layers along a roll in the order in which they are extruded from mid-length.
struct RollLayers {
  std::vector<double> facing;  ///< m, under the contact
  std::vector<double> beyond;  ///< m, on to the barrel end; empty: the contact ends there
  std::vector<double> neck;    ///< m; empty: no neck
};

/// An eighth of a roll as it is to be meshed; lengths in radii.
struct RollDrawing {
  RollGeometry geometry;
  SectionSize section;
  int plain_elements = 0;             ///< per radius; 0: `section`
  double patch       = 0;             ///< half width of what may touch
  RollLayers layers;                  ///< along the axis
  std::map<std::string, int> groups;  ///< boundary groups and their ids
};

/// Half of a meridian section as it is to be meshed.
struct MeridianDrawing {
  RollGeometry geometry;
  std::vector<double> radii;  ///< m, places along r, the innermost first
  RollLayers layers;          ///< along the axis
};

/// What Gmsh made.  A mesh that is not sound is not written.
struct Meshed {
  bool one_kind            = false;   ///< no other elements than those asked for
  double smallest_jacobian = -1;      ///< -, least over the cells of the least at its corners over the largest
  int n_nodes              = 0;       ///< corner nodes
  int n_cells              = 0;       ///< elements
  std::string empty_group;            ///< a group that has no face, or ""
  std::map<std::string, int> groups;  ///< ids of the boundary groups
  std::string not_written;            ///< what Gmsh says why not, or ""
};

struct Mesher {
  /// Writes it as Gmsh 4.1; returns what kept Gmsh from it, or "".
  std::string (*write_plain)(const PlainMesh &mesh, const std::string &path);
  Meshed (*mesh_roll)(const RollDrawing &roll, const std::string &path);
  Meshed (*mesh_meridian)(const MeridianDrawing &roll, const std::string &path);
};

/// Numbers the groups of a plain mesh from 1 in alphabetical order and writes it by write_mesh(); returns the ids.
std::map<std::string, int> write_plain(PlainMesh mesh, const std::string &path);

/// Opened at the first call.  One caller at a time: see write_mesh().
/// @throws SystemError  the library is not in the folder of the program
const Mesher &mesher();
}  // namespace mill::meshes
