#pragma once
#include "core/base/each_member.h"
#include "core/model/mesh_file.h"
#include "core/process/progress.h"
#include "fem/body/elastic_body.h"
#include <Eigen/Core>

namespace mill::fem {
/// Nodes of the contact patch of a roll, as a grid; node i_z * n_x + i_x.  Forces and gaps live on its half x >=
/// 0.
struct PatchGrid {
  int n_x = 0, n_z = 0;
  Eigen::VectorXd x;     ///< (n_x) m, from the contact line
  Eigen::VectorXd z;     ///< (n_z) m, from mid-length; from 0, or over both sides when `whole`
  Eigen::VectorXd area;  ///< (n_x n_z) m2, integral of each node's shape function over x >= 0
  int degree = 2;        ///< of the shape functions
  bool whole = false;    ///< both sides of mid-length
};

template <class Io, class R, if_record<R, PatchGrid> = 0> void each_member(Io &&io, R &record)
{
  auto &[n_x, n_z, x, z, area, degree, whole] = record;
  io("n_x", n_x);
  io("n_z", n_z);
  io("x", x);
  io("z", z);
  io("area", area);
  io("degree", degree);
  io("whole", whole);
}

/// Flexibility of an eighth of a roll for one symmetry case of loads and displacements about the planes y = 0 and
/// z = 0, even about x = 0.  Forces and displacements of the patch are positive towards the axis.
struct CaseFlexibility {
  Eigen::MatrixXd patch;  ///< (n, n) m/N, normal
  Eigen::MatrixXd
      traction;  ///< (3n, 3n) m/N, normal, along x, along z; what a plane holds is zero; unless asked: empty
  Eigen::MatrixXd axis;  ///< (n_a, n) m/N, antisymmetric: displacement of the axis
  Eigen::VectorXd
      seat_patch;  ///< (n) m/N, antisymmetric: of the patch, along y, under a unit load on the bearing seat
  Eigen::VectorXd seat_axis;  ///< (n_a) m/N, of the axis under it
  Eigen::MatrixXd field;      ///< (3N, n) m/N, whole displacement field; empty unless asked for
};

template <class Io, class R, if_record<R, CaseFlexibility> = 0> void each_member(Io &&io, R &record)
{
  auto &[patch, traction, axis, seat_patch, seat_axis, field] = record;
  io("patch", patch);
  io("traction", traction);
  io("axis", axis);
  io("seat_patch", seat_patch);
  io("seat_axis", seat_axis);
  io("field", field);
}

/// A roll reduced to its contact line: flexibilities of an eighth of it for the parities about y = 0 and z = 0,
/// from which every load on the two generators and on the necks is put together.  theory.md (2.4)
///   symmetric    both generators are pressed towards the axis; the axis stays where it is
///   antisymmetric  both generators are pushed the same way; the roll bends and moves
///   odd        the loads on the two sides of mid-length are opposite
struct CondensedRoll {
  RollGeometry geometry;
  PatchGrid grid;                                    ///< of the eighth: x >= 0, z >= 0
  Eigen::VectorXd axis_z;                            ///< (n_a) m, from 0 to the end of the roll
  CaseFlexibility symmetric, antisymmetric;          ///< even about mid-length; a slab has no antisymmetric
  CaseFlexibility symmetric_odd, antisymmetric_odd;  ///< empty unless asked for; the first may stand alone
  double seat_lever = 0;    ///< m, from mid-length to the resultant of the bearing seat's load
  int n_unknowns    = 0;    ///< of the eighth, all parities about the same
  std::string field_mesh;   ///< Gmsh file of the mesh, where displacement fields are kept; else empty
  double factor_bytes = 0;  ///< bytes, of one symmetry case
  double factor_flops = 0;  ///< of one symmetry case
  bool both_sides() const   ///< any load that differs between the sides, however the roll is held
  {
    return symmetric_odd.patch.size() > 0 && antisymmetric_odd.patch.size() > 0;
  }
};

template <class Io, class R, if_record<R, CondensedRoll> = 0> void each_member(Io &&io, R &record)
{
  auto &[geometry, grid, axis_z, symmetric, antisymmetric, symmetric_odd, antisymmetric_odd, seat_lever,
         n_unknowns, field_mesh, factor_bytes, factor_flops] = record;
  io("geometry", geometry);
  io("grid", grid);
  io("axis_z", axis_z);
  io("symmetric", symmetric);
  io("antisymmetric", antisymmetric);
  io("symmetric_odd", symmetric_odd);
  io("antisymmetric_odd", antisymmetric_odd);
  io("seat_lever", seat_lever);
  io("n_unknowns", n_unknowns);
  io("field_mesh", field_mesh);
  io("factor_bytes", factor_bytes);
  io("factor_flops", factor_flops);
}

struct CondenseOptions {
  bool slab          = false;  ///< plane strain: both faces held in z, symmetric only
  bool both_sides    = false;  ///< the odd parities too, for loads that differ between the two sides
  bool odd_symmetric = false;  ///< of them the symmetric alone: enough between mirrored contacts (joint stiffness)
  bool tractions     = false;  ///< tangential components too, of the symmetric parities
  bool keep_fields   = false;  ///< keep the displacement fields of symmetric
  double memory      = 0;      ///< bytes it may take, 0: what the process has left
};

/// Condenses a meshed roll.  Cost: one factorisation per symmetry case.
/// @param threads  parities that are factorised side by side
/// @throws SolverError  predicted memory too large; matrix not positive definite
CondensedRoll condense(const ElasticBody &body, const RollGeometry &geometry, const CondenseOptions &options,
                       const Progress &progress = {}, int threads = 1);

/// One of the four parities.
struct SymmetryCase {
  bool symmetric = true;   ///< else antisymmetric
  bool odd       = false;  ///< about mid-length
};

/// Unknowns held by the symmetry planes and by the symmetry case.  Where the symmetry case leaves a rigid motion
/// free, one unknown on the axis is pinned; it carries nothing once the loads balance.
std::vector<char> constrained_unknowns(const ElasticBody &body, const SymmetryCase &symmetry, bool slab);
/// Nodes of the group contact, by z, then by x.
std::vector<int> patch_in_grid_order(const ElasticBody &body);
/// (n_z) m: integral of the axial shape functions of the given degree (1 or 2) from `from` to `to`; sums to the
/// part of it that the stations cover.
Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, double from, double to, int degree);
/// From -length to length.
Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, double length, int degree);
}  // namespace mill::fem
