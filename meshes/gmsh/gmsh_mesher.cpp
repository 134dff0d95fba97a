#include "meshes/gmsh/gmsh_mesher.h"

namespace mill::meshes {
// For a program that is linked with Gmsh; one that opens it has that of meshes/common/opened_mesher.cpp.
const Mesher &mesher()
{
  return *millstand_mesher();
}
}  // namespace mill::meshes

extern "C" __attribute__((visibility("default"))) const mill::meshes::Mesher *millstand_mesher()
{
  using namespace mill::meshes;
  static const Mesher all{gmsh_write_plain, gmsh_mesh_roll, gmsh_mesh_meridian};
  return &all;
}
