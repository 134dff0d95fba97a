#pragma once
#include "fem/bearing/roller_contact.h"
#include "reduce/bearing/roller_law.h"
#include <functional>

namespace mill::fem {
/// Law of one roller in slices from its condensed matrices: line-contact form of RollerLaw.  theory.md 14
/// @param slices          equal, over the contact length
/// @param drop            (x from mid-roller, m) -> m, profile of one contact; the law's is that of both.  May be
///                        empty
/// @param reference_load  N, at which every slice load is spread as Hertz has it.  0: e times setup.largest_load,
///                        below which each slice yields more the more it carries, independent of the others
/// @throws InputError  no slice, or a reference load that spreads wider than the mesh of the contact
/// Cost: two products of the flexibilities with (nodes, slices) matrices.
bearing::RollerLaw fe_roller_law(const CondensedRoller &roller, int slices,
                                 const std::function<double(double)> &drop = {}, double reference_load = 0);
}  // namespace mill::fem
