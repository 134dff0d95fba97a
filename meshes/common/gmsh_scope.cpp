#include "meshes/common/gmsh_scope.h"
#include "core/process/parallel.h"
#include <gmsh.h>

namespace mill::meshes {
GmshScope::GmshScope() : alone(random_numbers_of_c())
{
  gmsh::initialize(0, nullptr,
                   false);  // false: do not read the user's Gmsh options, results must not depend on them
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Geometry.Tolerance", 1e-11);  // m; patches have elements of some um on rolls of some m
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 0);
  gmsh::model::add("millstand");
}

std::string library_version()
{
  return GMSH_API_VERSION;
}

GmshScope::~GmshScope()
{
  gmsh::finalize();
}
}  // namespace mill::meshes
