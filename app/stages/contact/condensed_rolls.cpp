#include "app/stages/contact/condensed_rolls.h"
#include "app/run/kept_part.h"
#include "core/base/files.h"
#include "core/records/record_text.h"
#include "fem/members.h"
#include "meshes/common/mesher.h"
#include "meshes/members.h"
#include "meshes/roll/contact_mesh_size.h"
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Raised by hand when meshing or condensation changes what it computes.
constexpr const char *stage_version = "condensation 3";

fem::CondenseOptions options_of(const RollOptions &wanted, const bool companion)
{
  fem::CondenseOptions options;
  options.slab          = wanted.slab;
  options.both_sides    = !wanted.slab && (wanted.both_sides || companion);
  options.odd_symmetric = !wanted.slab;  // for the joint stiffness
  options.tractions     = wanted.tractions;
  options.keep_fields   = companion;
  return options;
}

std::shared_ptr<const fem::CondensedRoll> condensed(RunContext &run, const std::string &name,
                                                    const RollGeometry &geometry, const meshes::RollMeshSize &size,
                                                    const Material &steel, const RollOptions &wanted,
                                                    const bool companion)
{
  const fem::CondenseOptions options = options_of(wanted, companion);
  const std::string key              = hash_of(roll_inputs(geometry, size, steel, wanted, companion));
  const std::string file             = run.cache + "/roll-" + key + ".bin";
  const auto make                    = [&] {
    const std::string mesh_file = run.out.staging() + "/roll-" + key + ".msh";
    const MeshFile mesh         = meshes::mesh_roll(name, geometry, size, mesh_file);
    const fem::ElasticBody body(mesh, steel, 2);
    fem::CondensedRoll roll;
    try {
      roll = fem::condense(body, geometry, options, run.progress, run.threads);
    } catch (SolverError &e) {
      e.report.what = name + ": " + e.report.what;
      throw;
    }
    if (options.keep_fields)
      roll.field_mesh = read_text(mesh_file);
    fs::remove(mesh_file);
    run.progress.note(fmt::format("{}: {} elements, {} unknowns, {} retained, factor {:.0f} MB", name,
                                                     mesh.n_cells, roll.n_unknowns, roll.grid.area.size(), roll.factor_bytes / 1e6));
    return roll;
  };
  return std::make_shared<const fem::CondensedRoll>(kept_part<fem::CondensedRoll>(
      run, "condensation, " + name + (companion ? ", coarse mesh" : ""), file, key, make, wanted.smaller));
}
}  // namespace

std::string roll_inputs(const RollGeometry &geometry, const meshes::RollMeshSize &size, const Material &steel,
                        const RollOptions &wanted, const bool companion)
{
  return record_text(stage_version, fem::library_version(), meshes::library_version(), geometry, size,
                     at_rest(steel), options_of(wanted, companion));
}

CondensedPair condensed_pair(RunContext &run, const std::string &name, const RollGeometry &geometry,
                             const meshes::RollMeshSize &size, const Material &steel, const RollOptions &wanted)
{
  CondensedPair pair;
  run_side_by_side(
      run,
      {[&](RunContext &part_run) { pair.fine = condensed(part_run, name, geometry, size, steel, wanted, false); },
       [&](RunContext &part_run) {
         pair.coarse = condensed(part_run, name, geometry, meshes::coarsened(size), steel, wanted, true);
       }});
  return pair;
}
}  // namespace mill
