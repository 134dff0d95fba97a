#pragma once
#include "core/mesh_file.h"
#include "core/progress.h"
#include "core/stand.h"
#include "fem/elastic_body.h"
#include <Eigen/Core>

namespace mill::fem {
/// A roll reduced to its contact line: flexibilities of an eighth of it for two parities about the plane y = 0,
/// from which every load on the two generators and on the necks is put together.  theory.md (2.4)
///   squeeze    both generators are pressed towards the axis; the axis stays where it is
///   translate  both generators are pushed the same way; the roll bends and moves
/// Displacements and forces are positive towards the axis from the generator y = +radius.
struct CondensedRoll {
  RollGeometry geometry;
  int n_x = 0, n_z = 0;        ///< the patch is a grid of n_x x n_z nodes, node i_z * n_x + i_x
  Eigen::VectorXd x;           ///< (n_x) m, from the contact line
  Eigen::VectorXd z;           ///< (n_z) m, from mid-length
  Eigen::VectorXd area;        ///< (n) m2, integral of each node's shape function
  Eigen::MatrixXd squeeze;     ///< (n, n) m/N
  Eigen::MatrixXd translate;   ///< (n, n) m/N, pinned at one axis node; empty for a slab
  Eigen::VectorXd axis_z;      ///< (n_a) m
  Eigen::MatrixXd axis;        ///< (n_a, n) m/N, translate: displacement of the axis
  Eigen::VectorXd seat_patch;  ///< (n) m/N, translate: of the patch under a unit load on the bearing seat
  Eigen::VectorXd seat_axis;   ///< (n_a) m/N, of the axis under it
  Eigen::MatrixXd field_squeeze,
      field_translate;                        ///< (3N, n) m/N, whole displacement field; empty unless asked for
  int degree          = 2;                    ///< of the elements
  int n_unknowns      = 0;                    ///< of the eighth, both parities about the same
  double factor_bytes = 0, factor_flops = 0;  ///< of one parity
};

struct CondenseOptions {
  bool slab        = false;  ///< plane strain: both faces held in z, squeeze only
  bool keep_fields = false;  ///< keep field_squeeze and field_translate
  double memory    = 0;      ///< bytes a factor may take, 0: do not check
};

/// Condenses a meshed roll.  Cost: one factorisation per parity.
/// @throws SolverError  predicted memory too large; matrix not positive definite
CondensedRoll condense(const ElasticBody &body, const RollGeometry &geometry, const CondenseOptions &options,
                       const Progress &progress = {});

/// Unknowns held by the symmetry planes and by the parity about y = 0; translate also pins one axis node along y.
std::vector<char> held_unknowns(const ElasticBody &body, bool squeeze, bool slab);
/// Nodes of the group contact, by z, then by x.
std::vector<int> patch_in_grid_order(const ElasticBody &body);

/// How a roll is held against the contact force.
struct HeldRoll {
  Eigen::MatrixXd
      flexibility;  ///< (n, n) m/N per quarter-roll nodal force: displacement of the patch towards the axis
  Eigen::VectorXd support;       ///< (n) m/N: of the patch under the balancing load of 1 N per quarter
  Eigen::MatrixXd axis;          ///< (n_a, n) m/N: of the axis, away from the contact
  Eigen::VectorXd axis_support;  ///< (n_a) m/N
};
HeldRoll held_by_necks(const CondensedRoll &roll);  ///< backup roll: bearings carry the force
HeldRoll held_by_strip(const CondensedRoll &roll,
                       double strip_width);          ///< work roll: strip on the other generator
HeldRoll held_by_mirror(const CondensedRoll &roll);  ///< the same contact on the other generator

/// (n_z) m: integral of the axial shape functions of the given degree (1 or 2) from 0 to `length`; sums to length.
Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, double length, int degree);
}  // namespace mill::fem
