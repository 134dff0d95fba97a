#include "tests/support/roll_pair.h"
#include <filesystem>
#include <unistd.h>

using namespace mill;

namespace {
std::string mesh_path(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / ("millstand-" + std::to_string(getpid()) + "-" + name + ".msh"))
      .string();
}

MeshedBody finish(MeshFile mesh, const Material &steel, const fem::CondenseOptions &options, const int degree = 2)
{
  MeshedBody out{mesh, std::make_shared<fem::ElasticBody>(mesh, steel, degree), {}};
  out.roll = fem::condense(*out.body, mesh.geometry, options);
  std::filesystem::remove(mesh.path);
  return out;
}
}  // namespace

MeshedBody meshed_slab(const std::string &name, const double diameter, const double smallest, const double largest,
                       const int per_half_width, const double thickness, const Material &steel, const int degree)
{
  RollGeometry geometry;
  geometry.radius      = diameter / 2;
  geometry.half_length = thickness;
  auto size            = meshes::slab_contact_size(smallest, largest, per_half_width);
  size.end_layer = size.largest_layer = geometry.half_length;
  fem::CondenseOptions options;
  options.slab = true;
  return finish(meshes::mesh_roll(name, geometry, size, mesh_path(name)), steel, options, degree);
}

MeshedBody meshed_roll(const std::string &name, const RollGeometry &geometry, const meshes::RollMeshSize &size,
                       const Material &steel, const fem::CondenseOptions &options)
{
  return finish(meshes::mesh_roll(name, geometry, size, mesh_path(name)), steel, options);
}

fem::ContactPair slab_pair(const MeshedBody &first, const MeshedBody &second)
{
  auto pair = fem::make_pair("line", first.roll, fem::held_by_mirror(first.roll), second.roll,
                             fem::held_by_mirror(second.roll), Eigen::VectorXd::Zero(first.roll.grid.n_z));
  return pair;
}
