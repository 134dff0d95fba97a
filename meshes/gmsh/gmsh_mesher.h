#pragma once
#include "meshes/common/mesher.h"

// The functions of Mesher, and the one name by which a library that holds them is asked for it.
namespace mill::meshes {
std::string gmsh_write_plain(const PlainMesh &mesh, const std::string &path);
Meshed gmsh_mesh_roll(const RollDrawing &roll, const std::string &path);
Meshed gmsh_mesh_meridian(const MeridianDrawing &roll, const std::string &path);
}  // namespace mill::meshes

extern "C" const mill::meshes::Mesher *millstand_mesher();
