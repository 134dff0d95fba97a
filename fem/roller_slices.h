#pragma once
#include "bearing/roller_law.h"
#include "fem/roller_contact.h"
#include <functional>

namespace mill::fem {
/// Law of one roller in slices from its condensed matrices: line-contact form of RollerLaw.  theory.md 14
/// @param slices  equal, over the contact length
/// @param drop    (x from mid-roller, m) -> m, profile of one contact; the law's drop is that of both.  Empty:
/// none
/// @param reference_load  N, at which the spread of every slice load is that of Hertz; 0: e times
/// setup.largest_load, below which
///                        each slice yields more the more it carries, whatever the others do
/// Cost: two products of the flexibilities with (nodes, slices) matrices.
bearing::RollerLaw fe_roller_law(const CondensedRoller &roller, int slices,
                                 const std::function<double(double)> &drop = {}, double reference_load = 0);
}  // namespace mill::fem
