#pragma once
#include "core/model/surface.h"
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace mill::contact {
/// Unit outward normals at the nodes of a surface: mean over the faces around, weighted with their size.
/// Faces of a line run with the body on their left; a quadrilateral's first parameter turns to its second
/// counter-clockwise as seen from outside.
/// @return (n, d)
Eigen::MatrixXd nodal_normals(const Surface &surface);

/// The same surface after x -> turn x + shift; a reflection reverses the faces, so that normals stay outward.
/// @param turn   (d, d) orthogonal
/// @param shift  (d) m
Surface placed(const Surface &surface, const Eigen::MatrixXd &turn, const Eigen::VectorXd &shift);

/// Two facing surface grids that need not match, coupled by multipliers at the nodes of the slave.  theory.md 12
/// A multiplier is a nodal force along the normal; the gap it closes is the mean of the gap with the weight of the
/// multiplier's function, and the same mean of the displacements makes the work the same.
struct Coupling {
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  std::vector<int> node;  ///< (n) slave node of each multiplier, ascending; a node that faces nothing has none
  Sparse slave;           ///< (n, n_slave) mean of the slave's normal displacements; unit rows where fully covered
  Sparse master;          ///< (n, n_master) mean of the master's
  Eigen::VectorXd weight;  ///< (n) m2 (m in plane strain): pressure = nodal force / weight
  Sparse mean;             ///< (n, q) mean of a function given at the points
  Eigen::MatrixXd points;  ///< (q, d) m, on the slave
  Eigen::VectorXd gap;     ///< (q) m, from there to the master along the slave's normal; 0 for a rigid obstacle
  double covered = 0;      ///< -, share of the slave's measure that faces the master
};

struct CouplingOptions {
  double reach = 0;  ///< m, largest distance along the normal at which surfaces face; 0: a quarter of the extent
};

/// Segments are the overlaps of projected faces: intervals of (curved) lines along the slave's interpolated
/// normal, polygons of quadrilaterals clipped in the plane of each slave face (halves of a quadratic face between
/// its nodes); every integrand is a polynomial on a flat segment and integrated exactly. On a fully covered face
/// the multiplier functions are biorthogonal to the slave's shape functions; where that would give a node no
/// positive weight (a face half covered, a quadratic face at the axis) they are piecewise linear hats, so that
/// weights are positive and a uniform pressure is transmitted exactly everywhere.
/// @throws InputError  the surfaces do not face each other anywhere
/// Cost: one look at every pair of faces, then about 0.15 ms per overlap of quadratic faces in space.
Coupling couple(const Surface &slave, const Surface &master, const CouplingOptions &options = {});

/// One deformable surface against a rigid obstacle, which enters through the initial gap: no master unknowns.
Coupling couple_to_rigid(const Surface &slave);
}  // namespace mill::contact
