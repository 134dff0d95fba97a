#pragma once
#include "fem/body/on_mesh.h"
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mill::fem {
/// Linear elastic body on a mesh: nodes of the chosen degree, stiffness, boundary groups.  Unknown 3 n + c is the
/// displacement of node n in direction c.  theory.md 1
class ElasticBody {
public:
  /// Reads the mesh and puts the faces of barrel, contact and neck on the true cylinder.
  /// @param degree  1 or 2: trilinear or triquadratic hexahedra
  /// @throws InputError  the mesh cannot be read
  ElasticBody(const MeshFile &mesh, const Material &material, int degree);
  ~ElasticBody();
  ElasticBody(ElasticBody &&) noexcept;

  /// (3N, 3N) upper triangle, in units of stiffness_unit(): of a body as large as its mesh on disk and of modulus
  /// one, so that rounding is the same for every size, unit and modulus of the body.  Assembled when first
  /// asked for, about 0.1 ms per quadratic element and thread.
  const SymmetricSparse &unit_stiffness() const;
  double stiffness_unit() const;  ///< N/m
  const SymmetricSparse &
  stiffness() const;  ///< (3N, 3N) N/m, upper triangle; a second matrix, made when first asked for
  /// (N, N) upper triangle, kg: consistent mass of the meshed part, the same for each of the three directions; its
  /// sum (both triangles) is density times volume().  By a rule that is exact on curved cells; made when first
  /// asked for.
  const SymmetricSparse &mass() const;
  const Eigen::Matrix<double, Eigen::Dynamic, 3> &nodes() const;  ///< (N, 3) m
  const std::vector<int> &group(const std::string &name) const;   ///< nodes of a boundary group, ascending
  Surface surface(const std::string &group) const;                ///< faces of a boundary group, outward
  const std::vector<int> &axis() const;                           ///< nodes on x = y = 0, by ascending z

  /// (N) m2: integral of each node's shape function over a group; sums to its area.  For pressure from nodal
  /// forces.
  Eigen::VectorXd face_weights(const std::string &group) const;
  /// (N) integral of shape function times weight(z) over a group: nodal shares of a distributed load.
  Eigen::VectorXd face_load(const std::string &group, double (*weight)(double z, const void *context),
                            const void *context) const;
  /// (N) m3: integral of each node's shape function times weight(x) over the volume: nodal shares of a body force,
  /// or the weights of a mean displacement.  A jump of the weight must lie between cells.
  /// @param weight  of a point, m
  Eigen::VectorXd volume_load(const std::function<double(const Eigen::Vector3d &)> &weight) const;
  int degree() const;
  /// Quadrature of the stiffness, cell by cell: visit(nodes of the cell, its points).
  void each_cell(const VisitSolid &visit) const;
  double volume() const;  ///< m3, by the quadrature of the assembly

  /// (6N, k) Pa: stress xx yy zz xy xz yz at the nodes, mean of the cells around, by displacements (3N, k) m.
  Eigen::MatrixXd nodal_stress(const Eigen::MatrixXd &displacement) const;
  /// Displacement, stress (xx yy zz xy xz yz, von Mises) and a nodal scalar as VTU for ParaView.
  /// @param displacement (3N) m
  /// @param pressure     (N) Pa, contact pressure, zero off the contact
  void write_vtu(const std::string &path, const Eigen::VectorXd &displacement,
                 const Eigen::VectorXd &pressure) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
