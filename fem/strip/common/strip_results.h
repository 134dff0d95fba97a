#pragma once
#include "fem/strip/common/strip_state.h"

// What both solvers read off a solved strip in the same way.
namespace mill::fem {
/// Strain ln(h0/h) with which the strip comes.
double entry_strain(const Strip &strip);

/// Every field zero at (columns, rows) nodes.
void size_fields(StripFlow &flow, int columns, int rows);

/// Peak of the pressure: the edge of entry is singular, so from there down to the first trough, then the highest
/// behind it; without a trough the largest.
/// @param edge  point of the arc from which the pressure falls
void find_peak(StripFlow &flow, int edge);

/// Radius of the circle through both ends and the thinnest place of an arc of any shape, m.
double radius_of_arc(const bite::BiteState &state);

/// What slip and sticking tell.
/// @param drawn  the speed of the strip is prescribed, which may leave no neutral point
void add_slip_notes(StripFlow &flow, bool drawn);
}  // namespace mill::fem
