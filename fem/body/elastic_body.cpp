#include "fem/body/elastic_body.h"
#include "core/base/files.h"
#include <algorithm>
#include <limits>

namespace mill::fem {
struct ElasticBody::Implementation {
  MeshFile mesh;
  Material material;
  int degree;
  SolidOnMesh solid;
  UnitStiffness stiffness;  // in units of stiffness_unit(); empty until asked for, as the next two
  SymmetricSparse in_newtons;
  SymmetricSparse mass;  // kg
  std::vector<int> axis;

  void find_axis();
};

void ElasticBody::Implementation::find_axis()
{
  const auto &nodes = solid.nodes;
  const auto &plane = solid.groups["symmetry.y"];
  // What moves with the axis: the axis itself, in a hollow body the line of the bore in the neutral plane.
  double innermost = std::numeric_limits<double>::infinity();
  for (const int node : plane)
    innermost = std::min(innermost, nodes(node, 0));
  for (const int node : plane)
    if (nodes(node, 0) <= innermost + 1e-9 * mesh.geometry.radius)
      axis.push_back(node);
  std::sort(axis.begin(), axis.end(), [&](const int a, const int b) { return nodes(a, 2) < nodes(b, 2); });
}

ElasticBody::ElasticBody(const MeshFile &mesh, const Material &material, const int degree)
{
  require_readable(mesh);
  self = std::make_unique<Implementation>(
      Implementation{mesh, material, degree, on_mesh().solid(mesh, material, degree), {}, {}, {}, {}});
  self->find_axis();
}
ElasticBody::~ElasticBody()                       = default;
ElasticBody::ElasticBody(ElasticBody &&) noexcept = default;

const SymmetricSparse &ElasticBody::unit_stiffness() const
{
  if (self->stiffness.matrix.size() == 0)
    self->stiffness = self->solid.unit_stiffness();
  return self->stiffness.matrix;
}
double ElasticBody::stiffness_unit() const
{
  return self->material.youngs_modulus * self->mesh.unit;
}
const SymmetricSparse &ElasticBody::stiffness() const
{
  if (self->in_newtons.size() == 0)
    self->in_newtons = unit_stiffness() * stiffness_unit();
  return self->in_newtons;
}
const SymmetricSparse &ElasticBody::mass() const
{
  if (self->mass.size() == 0)
    self->mass = self->solid.mass();
  return self->mass;
}
const Eigen::Matrix<double, Eigen::Dynamic, 3> &ElasticBody::nodes() const
{
  return self->solid.nodes;
}
const std::vector<int> &ElasticBody::group(const std::string &name) const
{
  return self->solid.groups.at(name);
}
Surface ElasticBody::surface(const std::string &group) const
{
  return surface_of(nodes(), self->solid.groups.at(group), self->solid.faces(group));
}
const std::vector<int> &ElasticBody::axis() const
{
  return self->axis;
}
Eigen::VectorXd ElasticBody::volume_load(const std::function<double(const Eigen::Vector3d &)> &weight) const
{
  return self->solid.volume_load(weight);
}
int ElasticBody::degree() const
{
  return self->degree;
}
void ElasticBody::each_cell(const VisitSolid &visit) const
{
  self->solid.each_cell(visit);
}
double ElasticBody::volume() const
{
  unit_stiffness();
  return self->stiffness.volume;
}
Eigen::VectorXd ElasticBody::face_weights(const std::string &group) const
{
  return self->solid.face_integral(group, [](double) { return 1.; });
}
Eigen::VectorXd ElasticBody::face_load(const std::string &group, double (*weight)(double, const void *),
                                       const void *context) const
{
  return self->solid.face_integral(group, [&](const double z) { return weight(z, context); });
}
Eigen::MatrixXd ElasticBody::nodal_stress(const Eigen::MatrixXd &displacement) const
{
  return self->solid.nodal_stress(displacement);
}
void ElasticBody::write_vtu(const std::string &path, const Eigen::VectorXd &displacement,
                            const Eigen::VectorXd &pressure) const
{
  write_atomically(path, self->solid.vtu(displacement, pressure));
}
}  // namespace mill::fem
