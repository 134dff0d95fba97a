#pragma once
#include "core/model/stack.h"
#include "reduce/stack/stack_state.h"
#include <Eigen/Core>

namespace mill::reduce {
/// What the sections of a roll carry, at the stations of its deflection: by statics from the line loads of its
/// contacts, the strip, its bearings and its bending forces.  theory.md (51.24)
struct SectionForces {
  Eigen::VectorXd z;              ///< (n) m, mill frame
  Eigen::MatrixXd moment, shear;  ///< (n, 2) N m, N, in the planes x and y
  Eigen::VectorXd stress;         ///< (n) Pa, of bending at the surface of the section
};
SectionForces section_forces(const Stack &stack, const StackState &state, std::size_t roll);

/// Pa, largest bending stress of a roll, ends of its sections and places of its forces among the places looked at.
double largest_bending_stress(const Stack &stack, const StackState &state, std::size_t roll);
}  // namespace mill::reduce
