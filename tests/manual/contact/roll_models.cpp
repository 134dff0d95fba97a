#include "tests/manual/contact/roll_models.h"
#include "meshes/roll/contact_mesh_size.h"
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill::verify {
RollModel roll_model(const std::string &name, const RollGeometry &geometry, const meshes::RollMeshSize &size,
                     const Material &steel, const fem::CondenseOptions &options, const int degree)
{
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("millstand-verify-{}-{}.msh", ::getpid(), name);
  const auto mesh = meshes::mesh_roll(name, geometry, size, file.string());
  RollModel model{std::make_shared<fem::ElasticBody>(mesh, steel, degree), {}};
  std::filesystem::remove(file);
  model.roll = fem::condense(*model.body, geometry, options);
  return model;
}

RollModel slab_model(const std::string &name, const double diameter, const double smallest, const double largest,
                     const int per_half_width, const double thickness, const Material &steel)
{
  RollGeometry geometry;
  geometry.radius      = diameter / 2;
  geometry.half_length = thickness;
  auto size            = meshes::slab_contact_size(smallest, largest, per_half_width);
  size.end_layer = size.largest_layer = thickness;
  fem::CondenseOptions options;
  options.slab = true;
  return roll_model(name, geometry, size, steel, options);
}
}  // namespace mill::verify
