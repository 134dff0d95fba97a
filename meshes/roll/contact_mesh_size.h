#pragma once
#include "meshes/roll/roll.h"

namespace mill::meshes {
/// Sizes for the two rolls of one contact, from the Hertz half widths that the swept loads will produce; the same
/// for both, so that their patches match node by node.
///
/// @param half_width        m, at the largest load
/// @param per_half_width    quadratic elements over it
/// @param reach             half width of the patch over half_width: what touches must not reach its edge
RollMeshSize roll_contact_size(double half_width, int per_half_width, double reach = 1.25);

/// The same mesh about twice as coarse everywhere: its answer tells how far the finer one is from the limit.
RollMeshSize coarsened(const RollMeshSize &size);

/// A plane-strain slab: elements grow with the distance from the contact line, so that every half width between
/// the two is resolved by about as many elements.
RollMeshSize slab_contact_size(double smallest_half_width, double largest_half_width, int per_half_width);
}  // namespace mill::meshes
