#include "tests/support/condensed_rolls.h"
#include "core/records/record_text.h"
#include "fem/members.h"
#include "meshes/bearing/meridian.h"
#include <filesystem>
#include <map>
#include <unistd.h>

namespace {
std::shared_ptr<const mill::fem::RollKernel> condensed(const mill::RollGeometry &geometry,
                                                       const mill::Material &material,
                                                       const mill::fem::FourierOptions &options,
                                                       const CondensedMesh mesh)
{
  mill::meshes::MeridianSize size = mill::meshes::even_meridian_size(options.half_width);
  if (mesh == CondensedMesh::coarse) {
    size.largest_share = 0.03;
    size.radial_growth = 2.5;
  }
  const auto path =
      (std::filesystem::temp_directory_path() / ("millstand-stack-" + std::to_string(getpid()) + ".msh")).string();
  const mill::fem::SectionBody body(mill::meshes::mesh_meridian("roll", geometry, size, path), material, 2,
                                    mill::fem::Section::axisymmetric);
  std::filesystem::remove(path);
  return std::make_shared<const mill::fem::RollKernel>(
      mill::fem::fourier_kernel(std::make_shared<const mill::fem::FourierRoll>(
          mill::fem::fourier_roll(body, geometry, material, mill::fem::stations_of(body), options))));
}
}  // namespace

std::vector<std::shared_ptr<const mill::fem::RollKernel>> condensed_rolls(const mill::Stack &stack,
                                                                          const CondensedMesh mesh)
{
  static std::map<std::string, std::shared_ptr<const mill::fem::RollKernel>> made;
  std::vector<std::shared_ptr<const mill::fem::RollKernel>> kernels;
  for (const mill::StackRoll &roll : stack.rolls) {
    const auto solid = mill::fem::solid_of(roll);
    if (!solid) {
      kernels.push_back(std::make_shared<const mill::fem::RollKernel>(mill::fem::beam_kernel(roll, 0.01)));
      continue;
    }
    mill::fem::FourierOptions options;
    options.half_width = mill::fem::condensed_half_width(*solid);
    options.both_sides = true;
    options.points     = mill::fem::points_of(roll);
    auto &kernel       = made[mill::record_text(*solid, mill::at_rest(roll.material), options, int(mesh))];
    if (!kernel)
      kernel = condensed(*solid, roll.material, options, mesh);
    kernels.push_back(kernel);
  }
  return kernels;
}
