#include "app/stack/stack_kernels.h"
#include "app/run/kept_part.h"
#include "core/base/files.h"
#include "core/records/record_text.h"
#include "fem/members.h"
#include "meshes/bearing/meridian.h"
#include "meshes/common/mesher.h"
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace mill {
namespace {
// Raised by hand when the condensation of a roll of a stack changes what it computes.
constexpr const char *stack_kernel_version = "stack 1";
constexpr double beam_element              = 0.01;  // m

fem::FourierRoll kept_roll(RunContext &run, const StackRoll &roll, const RollGeometry &geometry,
                           const fem::FourierOptions &options, const std::string &key)
{
  const std::string file = run.cache + "/fourier-" + key + ".bin";
  const auto make        = [&] {
    const std::string mesh_file = run.out.staging() + "/fourier-" + key + ".msh";
    const MeshFile mesh         = meshes::mesh_meridian("roll " + roll.name, geometry,
                                                               meshes::even_meridian_size(options.half_width), mesh_file);
    const fem::SectionBody body(mesh, roll.material, 2, fem::Section::axisymmetric);
    std::filesystem::remove(mesh_file);
    return fem::fourier_roll(body, geometry, roll.material, fem::stations_of(body), options, run.progress);
  };
  return kept_part<fem::FourierRoll>(run, "condensed roll " + roll.name, file, key, make,
                                     "fewer programs at the same time");
}
}  // namespace

StackKernels stack_kernels(RunContext &run, const Stack &stack)
{
  std::map<std::string, std::shared_ptr<const fem::RollKernel>> made;
  StackKernels kernels;
  for (const StackRoll &roll : stack.rolls) {
    const auto solid = fem::solid_of(roll);
    if (!solid) {
      if (roll.supports.size() <= 2 && roll.made_of.empty())
        run.assume(fmt::format("roll {} is a beam among the condensed rolls too, since its shaft is more than a "
                               "barrel with one neck on either side",
                               roll.name));
      kernels.push_back(std::make_shared<const fem::RollKernel>(fem::beam_kernel(roll, beam_element)));
      continue;
    }
    fem::FourierOptions options;
    options.half_width = fem::condensed_half_width(*solid);
    options.both_sides = true;
    options.points     = fem::points_of(roll);
    const std::string key =
        hash_of(record_text(stack_kernel_version, fem::library_version(), meshes::library_version(), *solid,
                            at_rest(roll.material), options));
    auto &kernel = made[key];
    if (!kernel)
      kernel = std::make_shared<const fem::RollKernel>(fem::fourier_kernel(
          std::make_shared<const fem::FourierRoll>(kept_roll(run, roll, *solid, options, key))));
    kernels.push_back(kernel);
  }
  return kernels;
}
}  // namespace mill
