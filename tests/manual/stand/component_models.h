#pragma once
#include "fem/body/component_modes.h"
#include "meshes/roll/roll.h"
#include <memory>
#include <string>

namespace mill::verify {
const Material demo_roll_steel{2.1e11, 0.28, 7700};
/// Rolls of the demo stand as drawn (entry demo.inputs), m.
const RollGeometry demo_work_roll{0.21, 0.7, 0.13335, 0.46, 1.0, 0},
    demo_backup_roll{0.725, 0.7, 0.475, 0.95, 1.225, 0};
constexpr double demo_bearings = 102286583389.26591;  ///< N/m, K_Zy: two backup bearings (bearing.backup.K_Zy)
constexpr double demo_contact  = 40191831577.696884;  ///< N/m, K3 at 976 kN (demo.stiffness)

/// A meshed roll, factorised, with its interface.
struct RollPart {
  std::shared_ptr<fem::ElasticBody> body;
  RollGeometry geometry;
  std::shared_ptr<fem::PartModel> part;
  fem::PartInterface interface;
};
RollPart roll_part(const std::string &name, const RollGeometry &geometry, int elements_per_radius = 3,
                   int n_barrel = 6);
/// The same interface on a roll of one diameter from end to end.
RollPart plain_roll_part(const std::string &name, const RollGeometry &geometry, int elements_per_radius = 3);
RollPart meshed_part(const std::string &name, const RollGeometry &on_mesh, const RollGeometry &geometry,
                     const meshes::RollMeshSize &size, int n_barrel);

/// (k) Hz, of M x'' + K x = 0; with `skip` rigid motions left out.
Eigen::VectorXd frequencies(const Eigen::MatrixXd &M, const Eigen::MatrixXd &K, int k, int skip = 0);
}  // namespace mill::verify
