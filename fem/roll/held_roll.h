#pragma once
#include "fem/roll/condensed_roll.h"
#include <Eigen/Core>

namespace mill::fem {
/// A condensed roll with the supports that balance the contact force on it.  theory.md (2.4), (2.10)
///
/// One quarter (x >= 0, z >= 0) when the loads are the same on both sides of mid-length, with one resultant: the
/// force.  One half (x >= 0) otherwise, with two: the force, and its moment about mid-length, positive when the
/// side z > 0 carries more.  Forces are those on that quarter or half.
struct HeldRoll {
  PatchGrid grid;
  Eigen::VectorXd axis_z;        ///< (n_a) m
  Eigen::MatrixXd flexibility;   ///< (n, n) m/N: displacement of the patch towards the axis
  Eigen::MatrixXd support;       ///< (n, k) of the patch under what balances a unit of each resultant
  Eigen::MatrixXd axis;          ///< (n_a, n) m/N: of the axis, away from the contact
  Eigen::MatrixXd axis_support;  ///< (n_a, k)
  Eigen::MatrixXd bend;          ///< (n, 0, 1 or 2) m/N: of the patch under a unit force on the chocks towards the
                                 ///< contact, both sides together, or z > 0 and z < 0; balanced by the strip
  Eigen::MatrixXd axis_bend;     ///< (n_a, 0, 1 or 2) m/N
};

/// How far the model reaches.
enum class Extent {
  quarter,  ///< the same load on both sides
  whole     ///< any load: the roll must be condensed for both sides
};

HeldRoll held_by_necks(const CondensedRoll &roll, Extent extent = Extent::quarter);  ///< bearings carry the force
/// Strip on the line of the surface opposite the contact, its middle at `strip_centre` (m, of the whole only) from
/// the roll's mid-length.
HeldRoll held_by_strip(const CondensedRoll &roll, double strip_width, Extent extent = Extent::quarter,
                       double strip_centre = 0);
/// The same contact on the opposite line of the surface.
HeldRoll held_by_mirror(const CondensedRoll &roll, Extent extent = Extent::quarter);
}  // namespace mill::fem
