#pragma once
#include <Eigen/Core>

namespace mill::bite {
/// K4 of the path form: nodal force over nodal displacement along the contact.  theory.md 20
struct PathStiffness {
  /// N/m, mean of the nodal quotients without the trimmed ends.  A nodal force is a share of the force that
  /// shrinks with the element, so this falls as 1/nodes: it describes a mesh and is never compared across meshes.
  double plateau  = 0;    ///< N/m
  double smallest = 0;    ///< N/m, of the quotients averaged
  double largest  = 0;    ///< N/m
  double sum      = 0;    ///< N/m, sum of all forces over the mean displacement: does not depend on the mesh
  int nodes       = 0;    ///< that carry pressure
  int averaged    = 0;    ///< of these, not trimmed
  Eigen::VectorXd nodal;  ///< (nodes) N/m, from the exit to the entry
};

/// @param position      (n) m, rising, of the contact nodes
/// @param pressure      (n) Pa; nodes without pressure at both ends do not belong to the path
/// @param displacement  (n) m, of the roll's surface towards the roll's axis, > 0 where there is pressure
/// @param width         m, of the strip
/// @param trim          -, share of the nodes left out at each end, below one half
/// @throws InputError  sizes that differ, positions that do not rise, trim outside 0 .. 0.5, fewer than three
///                     nodes with pressure or none left after trimming, a node that is pressed and does not give
///                     way
/// Cost O(n).
PathStiffness path_stiffness(const Eigen::VectorXd &position, const Eigen::VectorXd &pressure,
                             const Eigen::VectorXd &displacement, double width, double trim = 0.2);
}  // namespace mill::bite
