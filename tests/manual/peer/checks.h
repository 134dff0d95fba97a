#pragma once
#include "tests/manual/check/verification.h"
#include "tests/manual/peer/mesh.h"

// What the comparisons with the peer have in common.
namespace mill::verify::peer {
/// A quantity of the peer on two meshes, both shown with the value extrapolated with the order of convergence,
/// and ours against that value.
struct PeerPair {
  std::string quantity, unit;
  double coarse, fine, ours;
};

/// How the two meshes differ.
struct Refinement {
  int coarse_nodes = 0, fine_nodes = 0;  ///< elements of the second are half as large
  double order = 2;                      ///< of convergence
};

void add(std::vector<Check> &checks, const PeerPair &pair, const Refinement &meshes, double tolerance);

/// Nodes in the plane where the coordinate 0..2 is `at` (m).
std::vector<int> plane(const Mesh &mesh, int axis, double position = 0);
}  // namespace mill::verify::peer
