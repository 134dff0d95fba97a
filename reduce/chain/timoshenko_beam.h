#pragma once
#include "reduce/chain/beam_shapes.h"
#include <Eigen/Core>
#include <vector>

namespace mill::reduce {
/// A piece of a beam with one section.
struct BeamSpan {
  double length = 0;           ///< m
  int elements  = 24;          ///< of equal length
  BeamSection section;         ///< stiffness
  double mass_per_length = 0;  ///< kg/m
};

/// A beam that is the same on both sides of z = 0, unsupported, reduced to the deflections of its nodes: they
/// carry the mass, the rotations carry none and have been eliminated.  Both halves are counted.
struct SymmetricBeam {
  Eigen::VectorXd z;     ///< (k) m, nodes from mid-length to the end
  Eigen::MatrixXd K;     ///< (k, k) N/m, one rigid motion
  Eigen::VectorXd mass;  ///< (k) kg
};

/// Timoshenko beam of the given spans, from mid-length (no rotation) to the free end.  Two-node elements that are
/// exact under end loads, lumped mass, no rotary inertia: frequencies converge as the square of the element
/// length. theory.md (22.1), (22.2)
/// @throws InputError  no span, or a length, bending stiffness or mass not positive
/// Cost O(k^3): some ms for 100 nodes.
/// Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis (1968), section 5.6.
SymmetricBeam symmetric_beam(const std::vector<BeamSpan> &spans);
}  // namespace mill::reduce
