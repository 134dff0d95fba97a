#include "app/stages/bite/bite_roll_stage.h"
#include "app/run/kept_part.h"
#include "core/base/files.h"
#include "core/records/record_text.h"
#include "fem/body/elastic_body.h"
#include "meshes/common/mesher.h"
#include "meshes/roll/bite_roll.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mill {
namespace {
MeshFile meshed(const RunContext &run, const meshes::BiteRollSize &size, const std::string &name)
{
  return meshes::mesh_bite_roll(size, run.out.staging() + "/" + name + ".msh");
}

// Raised by hand when the section or its mesh changes what it computes.
constexpr const char *section_version = "bite section 1";

// The section by its size; Hertz' contact with the back-up roll is opposite.
meshes::BiteRollSize section_size(const BiteQuestion &q)
{
  const Strip &strip = q.bite.strip;
  meshes::BiteRollSize size;
  size.radius = q.bite.roll_radius;
  size.arc    = std::sqrt(size.radius * (strip.entry_thickness - strip.exit_thickness));
  // Elastic zones and the flattening make the contact of a light pass much longer than its rigid arc.
  if (q.setup.strip == BiteStrip::elastic_plastic)
    size.reach = std::clamp(0.6 * size.radius / size.arc, 1.2, 4.8);  // within 40 degrees of the roll
  return size;
}

fem::BiteRoll roll_in_section(const BiteQuestion &q, const meshes::BiteRollSize &size)
{
  const auto points = meshes::arc_points(size);
  fem::BiteRoll roll;
  roll.radius            = size.radius;
  roll.material          = q.bite.roll;
  roll.arc               = size.arc;
  roll.position          = Eigen::Map<const Eigen::VectorXd>(points.data(), Eigen::Index(points.size()));
  roll.backup_half_width = q.backup_half_width;
  return roll;
}
}  // namespace

void require_section(const BiteQuestion &q)
{
  fem::require_roll(roll_in_section(q, section_size(q)));
}

std::string section_inputs(const BiteQuestion &q)
{
  const auto size = section_size(q);
  return record_text(section_version, fem::library_version(), meshes::library_version(), size.radius, size.arc,
                     size.reach, at_rest(q.bite.roll), q.backup_half_width);
}

fem::BiteRollResult roll_flexibility(RunContext &run, const BiteQuestion &q)
{
  const meshes::BiteRollSize size = section_size(q);
  const std::string key           = hash_of(section_inputs(q));
  const auto make                 = [&] {
    const fem::BiteRoll roll  = roll_in_section(q, size);
    meshes::BiteRollSize fine = size;
    fine.elements_per_spacing = 2;
    fine.far_growth           = std::sqrt(size.far_growth);
    const std::string name    = "bite-roll-" + key;
    const MeshFile mesh = meshed(run, fine, name), coarse = meshed(run, size, name + "-coarse");
    auto result = fem::bite_roll_flexibility(roll, mesh, &coarse);
    std::remove(mesh.path.c_str());
    std::remove(coarse.path.c_str());
    return result;
  };
  return kept_part<fem::BiteRollResult>(run, "bite, section of the roll, " + q.pass,
                                        run.cache + "/section-" + key + ".bin", key, make,
                                        "bite.method = \"slab\"");
}
}  // namespace mill
