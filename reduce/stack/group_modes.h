#pragma once
#include "reduce/stack/roll_group.h"
#include <Eigen/Core>

namespace mill::reduce {
/// Lowest modes of a group of rolls about its solved state, without a strip.
struct GroupModes {
  Eigen::VectorXd square;  ///< (n) 1/s2, squared circular frequencies, ascending, to 1e-10 of the last
  Eigen::MatrixXd shape;   ///< (size, n) mass-normalised
};
/// By subspace iteration with the factorised stiffness.
GroupModes lowest_modes(const RollGroup &group, int wanted);

/// (2 stations, 2 + k) shapes of a free roll in one plane, mass-normalised: translation, tilting about its centre
/// of mass, then bending, softest first.  They are a basis: the last bending shapes are approximate.
/// @param z  (stations) m
Eigen::MatrixXd free_shapes(const RollGroup::FreeBeam &beam, const Eigen::VectorXd &z, int bending);
}  // namespace mill::reduce
