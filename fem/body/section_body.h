#pragma once
#include "fem/body/on_mesh.h"
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace mill::fem {
/// Linear elastic body in a plane or meridian section: quadrilaterals of degree 1 or 2.  theory.md 11
class SectionBody {
public:
  /// @param mesh     Gmsh quadrilaterals in the plane z = 0; groups: name -> physical group of boundary lines
  /// @param degree   1 or 2
  /// @param circles  groups with a true circle; all other boundaries are straight from corner to corner
  /// @throws InputError  the mesh cannot be read, or has nothing but quadrilaterals to read
  SectionBody(const MeshFile &mesh, const Material &material, int degree, Section section,
              const std::vector<Circle> &circles = {});
  ~SectionBody();
  SectionBody(SectionBody &&) noexcept;

  /// (2N, 2N) upper triangle; unknown 2 n + c is the displacement of node n along x, y (N/m per metre of
  /// thickness), or along r, z (N/m, whole circumference).  Axisymmetric: nodes on the axis need u_r = 0.
  const SymmetricSparse &stiffness() const;

  /// (3N, 3N) N/m, upper triangle, of an axisymmetric body for the displacements
  ///     u_r = U cos(m theta) ,  u_theta = V sin(m theta) ,  u_z = W cos(m theta)
  /// unknown 3 n + c is U, V, W of node n; m = 0: V is the uniform twist.  The product of a force and a
  /// displacement is the work over the whole circumference.  On the axis a single-valued field has
  ///     m = 0: U = V = 0 ;   m = 1: U + V = 0, W = 0 ;   m >= 2: U = V = W = 0
  /// which the caller imposes.  Cost: assembled once for all m, then a sum of three matrices.
  SymmetricSparse harmonic_stiffness(int m) const;

  const Eigen::Matrix<double, Eigen::Dynamic, 2> &nodes() const;  ///< (N, 2) m
  const std::vector<int> &group(const std::string &name) const;   ///< nodes of a boundary group, ascending
  /// Line of a boundary group; each face runs with the body on its left.  Degree 2: corner, middle, corner.
  Surface surface(const std::string &group) const;
  int degree() const;
  Section section() const;
  /// Quadrature of the stiffness, cell by cell: visit(nodes of the cell, its points).
  void each_cell(const VisitSection &visit) const;
  /// m2: area of the section; m3: volume of the solid of revolution.
  double measure() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
