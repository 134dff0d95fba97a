#include "meshes/common/mesher.h"
#include "meshes/common/write_mesh.h"

namespace mill::meshes {
std::string library_version()
{
  return MILLSTAND_GMSH_VERSION;
}

std::map<std::string, int> write_plain(PlainMesh mesh, const std::string &path)
{
  int id = 0;
  for (const auto &[name, faces] : mesh.group_faces)
    mesh.groups[name] = ++id;
  write_mesh(path, [&](const std::string &aside) { return mesher().write_plain(mesh, aside); });
  return mesh.groups;
}
}  // namespace mill::meshes
