#include "app/stand_components.h"
#include "core/files.h"
#include "fem/component_cache.h"
#include "fem/housing_component.h"
#include "fem/roll_component.h"
#include "meshes/gmsh_scope.h"
#include "meshes/housing.h"
#include "meshes/roll.h"
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <unistd.h>

namespace mill {
namespace {
// Raised by hand when meshing or reduction changes what it computes.
constexpr const char *stage_version = "components 1";

Component cached(RunContext &run, const std::string &name, const std::string &inputs,
                 const std::function<Component()> &make)
{
  StageTimer timer(run, "components, " + name);
  const std::string key  = hash_of(fmt::format("{} {} {} {} {}", stage_version, fem::library_version(),
                                               meshes::library_version(), name, inputs));
  const std::string file = run.cache + "/component-" + key + ".bin";
  std::string note;
  auto stored = run.fresh && !run.made.count(key) ? std::nullopt : fem::load_component(file, key, &note);
  if (!note.empty())
    run.progress.note(note);
  if (stored) {
    timer.cached = true;
    return *stored;
  }
  const Component made = make();
  run.progress.note(fmt::format("{}: {}, {} interface displacements, {} modes to {:.0f} Hz, shows up to {:.0f} Hz",
                                name, made.source, made.n_interface(), made.fixed_frequency.size(),
                                made.fixed_frequency.size() > 0 ? made.fixed_frequency.maxCoeff() : 0.,
                                made.reach));
  try {
    fem::save_component(file, key, made);
    run.made.insert(key);
  } catch (const InputError &e) {
    run.warn(std::string("a reduced body could not be kept for the next run: ") + e.what());  // but it is good
  }
  return made;
}

std::string text_of(const Material &m)
{
  return fmt::format("{} {} {}", m.youngs_modulus, m.poisson_ratio, m.density);
}

Component roll(RunContext &run, const std::string &name, const Roll &drawn, const FourHigh &stand,
               const int elements)
{
  const RollGeometry g = fem::vibrating_roll(drawn);
  fem::RollComponentOptions options;
  options.frequency_limit = stand.dynamics.frequency_limit;
  const std::string inputs =
      fmt::format("{} {} {} {} {} | {} | {} {} {}", g.radius, g.half_length, g.neck_radius, g.neck_length,
                  g.seat_centre, text_of(stand.steel), elements, options.n_barrel, options.frequency_limit);
  return cached(run, name + (elements == stand.dynamics.elements_per_radius ? "" : ", coarse mesh"), inputs, [&] {
    const std::string path = fmt::format("{}/{}-{}.msh", run.out.staging(), slug(name), ::getpid());
    const MeshFile mesh    = meshes::mesh_roll(name, g, meshes::vibration_mesh_size(g, elements), path);
    const fem::ElasticBody body(mesh, stand.steel, 2);
    const Component made = fem::roll_component(name, body, g, stand.steel, options).component;
    std::remove(path.c_str());
    return made;
  });
}

Component housing(RunContext &run, const FourHigh &stand, const bool fine)
{
  const MillHousing &h = stand.housing;
  meshes::HousingMeshSize size;
  size.longest = fem::longest_housing_element(h, stand.dynamics.frequency_limit);
  if (!fine)
    size.through = std::max(2, size.through - 1);
  const std::string inputs = fmt::format(
      "{} {} {} {} {} {} {} {} {} {} | {} | {} {} {} {}", h.thickness, h.post_width, h.window_width,
      h.window_height, h.upper_beam_height, h.lower_beam_height, h.fillet_radius, h.foot_height, h.screw_pad,
      h.seat_pad, text_of(h.steel), size.through, size.stretch, size.longest, stand.dynamics.frequency_limit);
  return cached(run, fine ? "housing" : "housing, coarse mesh", inputs, [&] {
    const std::string path = fmt::format("{}/housing-{}.msh", run.out.staging(), ::getpid());
    const MeshFile mesh    = meshes::mesh_housing(h, size, path);
    const fem::ElasticBody body(mesh, h.steel, 2);
    fem::HousingComponentOptions options;
    options.frequency_limit = stand.dynamics.frequency_limit;
    const Component made    = fem::housing_component(h, body, options);
    std::remove(path.c_str());
    return made;
  });
}
}  // namespace

namespace {
// What the meshes cannot show is the case's frequency limit.
[[noreturn]] void refuse_limit(const RunContext &run, const FourHigh &stand, const InputError &e)
{
  const auto place = run.the_case.places.find("dynamics.frequency_limit");
  throw InputError(place == run.the_case.places.end() ? Place{run.the_case.path} : place->second,
                   fmt::format("dynamics.frequency_limit = {:g} Hz: {}; rolls get finer meshes by "
                               "dynamics.elements_per_radius = {} and more",
                               stand.dynamics.frequency_limit, e.what(), stand.dynamics.elements_per_radius + 1));
}
}  // namespace

ComponentSets stand_components(RunContext &run, const FourHigh &stand)
{
  const int elements = stand.dynamics.elements_per_radius;
  ComponentSets sets;
  for (const bool fine : {false, true}) {
    reduce::StandComponents &set = fine ? sets.fine : sets.coarse;
    const int n                  = fine ? elements : elements - 1;
    try {
      set.work_roll   = roll(run, "work roll", stand.work_roll, stand, n);
      set.backup_roll = roll(run, "backup roll", stand.backup_roll, stand, n);
      if (stand.housing.present())
        set.housing = housing(run, stand, fine);
    } catch (const InputError &e) {
      refuse_limit(run, stand, e);
    }
    run.progress.at("components", fine ? 1 : 0.3);
  }
  return sets;
}
}  // namespace mill
