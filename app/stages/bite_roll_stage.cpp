#include "app/stages/bite_roll_stage.h"
#include "meshes/roll/bite_roll.h"
#include <cmath>
#include <cstdio>

namespace mill {
namespace {
MeshFile meshed(const RunContext &run, const meshes::BiteRollSize &size, const std::string &name)
{
  return meshes::mesh_bite_roll(size, run.out.staging() + "/" + name + ".msh");
}
}  // namespace

fem::BiteRollResult roll_flexibility(RunContext &run, const BiteQuestion &q)
{
  StageTimer timer(run, "bite, section of the roll, " + q.pass);
  const Strip &strip = q.bite.strip;
  meshes::BiteRollSize size;
  size.radius = q.bite.roll_radius;
  size.arc    = std::sqrt(size.radius * (strip.entry_thickness - strip.exit_thickness));
  // Elastic zones and the flattening make the contact of a light pass much longer than its rigid arc.
  if (q.setup.strip == "elastic-plastic")
    size.reach = 4.8;
  const auto points = meshes::arc_points(size);
  fem::BiteRoll roll;
  roll.radius               = size.radius;
  roll.material             = q.bite.roll;
  roll.arc                  = size.arc;
  roll.position             = Eigen::Map<const Eigen::VectorXd>(points.data(), Eigen::Index(points.size()));
  roll.backup_half_width    = q.backup_half_width;
  meshes::BiteRollSize fine = size;
  fine.elements_per_spacing = 2;
  fine.far_growth           = std::sqrt(size.far_growth);
  const std::string name    = "bite-roll-" + slug(q.pass);
  const MeshFile mesh = meshed(run, fine, name), coarse = meshed(run, size, name + "-coarse");
  auto result = fem::bite_roll_flexibility(roll, mesh, &coarse);
  std::remove(mesh.path.c_str());
  std::remove(coarse.path.c_str());
  return result;
}
}  // namespace mill
