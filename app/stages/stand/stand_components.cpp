#include "app/stages/stand/stand_components.h"
#include "app/run/kept_part.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_stand.h"
#include "fem/housing/housing_component.h"
#include "fem/members.h"
#include "fem/roll/roll_component.h"
#include "meshes/common/mesher.h"
#include "meshes/housing/housing.h"
#include "meshes/members.h"
#include "meshes/roll/roll.h"
#include "reduce/chain/chain_keys.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mill {
namespace {
// Raised by hand when meshing or reduction changes what it computes.
constexpr const char *component_stage_version = "components 2";

Component cached(RunContext &run, const std::string &name, const std::string &inputs,
                 const std::function<Component()> &make)
{
  const std::string key = hash_of(fmt::format("{} {} {} {} {}", component_stage_version, fem::library_version(),
                                              meshes::library_version(), name, inputs));
  const auto made       = [&] {
    Component c = make();
    run.progress.note(
              fmt::format("{}: {}, {} interface displacements, {} modes to {:.0f} Hz, shows up to {:.0f} Hz", name,
                          c.source, c.n_interface(), c.fixed_frequency.size(),
                    c.fixed_frequency.size() > 0 ? c.fixed_frequency.maxCoeff() : 0., c.reach));
    return c;
  };
  return kept_part<Component>(
      run, "components, " + name, run.cache + "/component-" + key + ".bin", key, made,
      "a smaller dynamics.elements_per_radius or dynamics.frequency_limit, dynamics.model = \"beam\"");
}

// A mesh that follows waves to the frequency limit: as fine as the case says, or finer.
struct RollMesh {
  std::unique_ptr<fem::ElasticBody> body;
  double reach = 0;  // Hz
};

constexpr int finest = 6;  // elements per radius that are chosen unasked: more take minutes

RollMesh mesh_of(RunContext &run, const std::string &name, const RollGeometry &g, const Material &steel,
                 const int n)
{
  const std::string path = fmt::format("{}/{}-{}.msh", run.out.staging(), slug(name), n);
  const MeshFile mesh    = meshes::mesh_roll(name, g, meshes::vibration_mesh_size(g, n), path);
  RollMesh made{std::make_unique<fem::ElasticBody>(mesh, steel, 2), 0};
  made.reach = fem::roll_reach(*made.body, g, steel);
  std::remove(path.c_str());
  return made;
}

[[noreturn]] void refuse_limit(const RunContext &run, const double limit, const std::string &name,
                               const double reach, const std::string &remedy)
{
  const auto place = run.the_case.places.find("dynamics.frequency_limit");
  throw InputError(
      place == run.the_case.places.end() ? Place{run.the_case.path} : place->second,
      fmt::format("dynamics.frequency_limit = {:g} Hz is above what the mesh of the {} can follow, {:.0f} Hz "
                  "with four elements per wave; lower the limit{}",
                  limit, name, reach, remedy));
}

// The same of the housing, whose meshes are of second order (housing-mesh-order).
double housing_mesh_gain()
{
  const int through = meshes::HousingMeshSize().through;
  return std::pow(double(through) / std::max(2, through - 1), 2);
}

struct ReducedRoll {
  Component fine, coarse;
};

ReducedRoll roll(RunContext &run, const std::string &name, const Roll &drawn, const FourHigh &stand)
{
  const RollGeometry g = roll_geometry(drawn);
  const double limit   = stand.dynamics.frequency_limit;
  fem::RollComponentOptions options;
  options.frequency_limit = limit;
  const int asked         = stand.dynamics.elements_per_radius;
  int used                = asked;
  const auto fine_mesh    = [&] {
    RollMesh mesh = mesh_of(run, name, g, stand.steel, used);
    while (mesh.reach < limit && used < finest)
      mesh = mesh_of(run, name, g, stand.steel, ++used);
    if (mesh.reach < limit)
      refuse_limit(run, limit, name, mesh.reach,
                      fmt::format(" or give dynamics.elements_per_radius above {}, which takes long", used));
    if (used != asked)
      run.progress.note(fmt::format("{}: {} elements per radius, for waves of {:g} Hz", name, used, limit));
    return mesh;
  };
  ReducedRoll reduced;
  const auto made = [&](const RollMesh &mesh, const int elements) {
    Component component           = fem::roll_component(name, *mesh.body, g, stand.steel, options).component;
    component.elements_per_radius = elements;
    return component;
  };
  reduced.fine   = cached(run, name, roll_component_inputs(drawn, stand, false), [&] {
    const RollMesh mesh = fine_mesh();
    return made(mesh, used);
  });
  reduced.coarse = cached(run, name + ", coarse mesh", roll_component_inputs(drawn, stand, true), [&] {
    const int coarser   = reduced.fine.elements_per_radius - 1;
    const RollMesh mesh = mesh_of(run, name, g, stand.steel, coarser);
    // It only shows what the mesh moves: as many modes, whether or not it follows them as well.
    options.surface         = false;
    options.n_modes         = int(reduced.fine.fixed_frequency.size());
    options.frequency_limit = std::min(limit, mesh.reach);
    return made(mesh, coarser);
  });
  return reduced;
}

meshes::HousingMeshSize housing_size(const FourHigh &stand, const bool coarse)
{
  meshes::HousingMeshSize size;
  size.longest = fem::longest_housing_element(stand.housing, stand.dynamics.frequency_limit);
  if (coarse)
    size.through = std::max(2, size.through - 1);
  return size;
}

Component housing(RunContext &run, const FourHigh &stand, const bool fine)
{
  const MillHousing &h = stand.housing;
  const auto size      = housing_size(stand, !fine);
  return cached(run, fine ? "housing" : "housing, coarse mesh", housing_component_inputs(stand, !fine), [&] {
    const std::string path = fmt::format("{}/housing-{}.msh", run.out.staging(), fine ? "fine" : "coarse");
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

std::string roll_component_inputs(const Roll &drawn, const FourHigh &stand, const bool coarse)
{
  fem::RollComponentOptions options;
  options.frequency_limit = stand.dynamics.frequency_limit;
  options.surface         = !coarse;
  return record_text(roll_geometry(drawn), stand.steel, stand.dynamics.elements_per_radius, coarse, options);
}

std::string housing_component_inputs(const FourHigh &stand, const bool coarse)
{
  return record_text(stand.housing, housing_size(stand, coarse), stand.dynamics.frequency_limit);
}

ComponentSets stand_components(RunContext &run, const FourHigh &stand, const bool with_housing)
{
  ReducedRoll work, backup;
  std::optional<Component> fine_housing, coarse_housing;
  const bool housed = with_housing && stand.housing.present();
  std::vector<IndependentStage> stages{
      [&](RunContext &part_run) { work = roll(part_run, "work roll", stand.work_roll, stand); },
      [&](RunContext &part_run) { backup = roll(part_run, "backup roll", stand.backup_roll, stand); }};
  if (housed) {
    stages.push_back([&](RunContext &part_run) { fine_housing = housing(part_run, stand, true); });
    stages.push_back([&](RunContext &part_run) { coarse_housing = housing(part_run, stand, false); });
  }
  run_side_by_side(run, std::move(stages));
  ComponentSets sets{{std::move(work.fine), std::move(backup.fine), std::move(fine_housing)},
                     {std::move(work.coarse), std::move(backup.coarse), std::move(coarse_housing)}};
  sets.present = true;
  run.progress.at("components", 1);
  return sets;
}

double roll_mesh_gain(const ComponentSets &c)
{
  const auto ratio = [](const Component &fine, const Component &coarse) {
    return double(fine.elements_per_radius) / double(coarse.elements_per_radius);
  };
  return std::pow(
      std::min(ratio(c.fine.work_roll, c.coarse.work_roll), ratio(c.fine.backup_roll, c.coarse.backup_roll)),
      fem::shoulder_order);
}

reduce::SolidRolls solid_rolls(const ComponentSets &c)
{
  if (!c.present)
    return {};
  return {&c.fine.work_roll, &c.fine.backup_roll, &c.coarse.work_roll, &c.coarse.backup_roll, roll_mesh_gain(c)};
}

void add_housing_frequencies(RunContext &run, const FourHigh &stand, const ComponentSets &components)
{
  if (!components.fine.housing)
    return;
  const Component &fine = *components.fine.housing, &coarse = *components.coarse.housing;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(fine.K, fine.M),
      coarse_modes(coarse.K, coarse.M);
  const auto n = std::min(modes.eigenvalues().size(), coarse_modes.eigenvalues().size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const double squared = modes.eigenvalues()[i], f = std::sqrt(squared) / (2 * M_PI);
    if (f > stand.dynamics.frequency_limit)
      break;
    const Eigen::VectorXd q = modes.eigenvectors().col(i).head(fine.n_interface());
    Parameter p;
    p.value  = f;
    p.unit   = "Hz";
    p.method = "bare housing on its feet, alike on both sides, " + fine.source;
    p.error_estimate =
        mesh_pair_error(f, std::sqrt(coarse_modes.eigenvalues()[i]) / (2 * M_PI), housing_mesh_gain()) +
        0.5 * squared * q.dot(fine.residual * q);  // (22.9)
    p.inputs = bare_housing_keys(*run.keys);
    run.results.add(row::modes::of_housing.of(std::to_string(i + 1)), p);
  }
}
}  // namespace mill
