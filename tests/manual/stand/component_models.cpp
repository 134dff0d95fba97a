#include "tests/manual/stand/component_models.h"
#include "fem/roll/roll_component.h"
#include "tests/manual/contact/meshed.h"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill::verify {
RollPart meshed_part(const std::string &name, const RollGeometry &on_mesh, const RollGeometry &geometry,
                     const meshes::RollMeshSize &size, const int n_barrel)
{
  const ScratchFile file("component");
  const MeshFile mesh = meshes::mesh_roll(name, on_mesh, size, file.path);
  RollPart roll;
  roll.geometry  = geometry;
  roll.body      = std::make_shared<fem::ElasticBody>(mesh, demo_roll_steel, 2);
  roll.part      = std::make_shared<fem::PartModel>(name, *roll.body, fem::roll_support(*roll.body));
  roll.interface = fem::roll_interface(*roll.body, geometry, n_barrel);
  return roll;
}

RollPart roll_part(const std::string &name, const RollGeometry &geometry, const int elements_per_radius,
                   const int n_barrel)
{
  return meshed_part(name, geometry, geometry, meshes::vibration_mesh_size(geometry, elements_per_radius),
                     n_barrel);
}

RollPart plain_roll_part(const std::string &name, const RollGeometry &geometry, const int elements_per_radius)
{
  RollGeometry bar{geometry.radius, geometry.half_length + geometry.neck_length, 0, 0, 0, geometry.half_length};
  RollGeometry read = geometry;
  read.neck_radius  = geometry.radius;
  return meshed_part(name, bar, read, meshes::vibration_mesh_size(bar, elements_per_radius), 6);
}

Eigen::VectorXd frequencies(const Eigen::MatrixXd &M, const Eigen::MatrixXd &K, const int k, const int skip)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M, Eigen::EigenvaluesOnly);
  return modes.eigenvalues().segment(skip, k).cwiseMax(0).cwiseSqrt() / (2 * M_PI);
}
}  // namespace mill::verify
