#include "meshes/gmsh/gmsh_mesher.h"
#include "meshes/gmsh/gmsh_scope.h"
#include <gmsh.h>

namespace mill::meshes {
std::string gmsh_write_plain(const PlainMesh &mesh, const std::string &path)
{
  const GmshScope gmsh_is_open;
  namespace model = gmsh::model;
  const int dim   = mesh.dimension;
  std::vector<std::size_t> tags(mesh.coordinates.size() / 3);
  for (std::size_t i = 0; i < tags.size(); ++i)
    tags[i] = i + 1;
  model::addDiscreteEntity(dim, 1);
  model::mesh::addNodes(dim, 1, tags, mesh.coordinates);
  model::mesh::addElementsByType(1, dim == 3 ? hex_type : quad_type, {}, mesh.cells);
  model::addPhysicalGroup(dim, {1}, 1);
  for (const auto &[name, faces] : mesh.group_faces) {
    const int id = mesh.groups.at(name);
    model::addDiscreteEntity(dim - 1, id);
    model::mesh::addElementsByType(id, dim == 3 ? quad_type : line_type, {}, faces);
    model::addPhysicalGroup(dim - 1, {id}, id);
    model::setPhysicalName(dim - 1, id, name);
  }
  return write_model(path);
}
}  // namespace mill::meshes
