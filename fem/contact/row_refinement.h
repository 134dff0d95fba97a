#pragma once
#include "fem/contact/half_space_contact.h"

namespace mill::contact {
/// Edges of the rows of a grid after one round of refinement along the face.  theory.md 33.3
/// A row is halved, and both its neighbours, where the line load bends: where its second difference over three
/// rows exceeds `bend` times the largest line load.  Then rows are halved until none is twice as long as its
/// neighbour.
///
/// @param grid   that the state was solved on
/// @param bend   -, largest second difference that stays
/// @param least  m, no row becomes shorter
/// @return (n) m; the edges of the grid where nothing is left to refine
/// Cost: small compared with one solution.
Eigen::VectorXd refined_rows(const QuarterGrid &grid, const HalfSpaceState &state, double bend, double least);
}  // namespace mill::contact
