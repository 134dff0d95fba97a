#pragma once
#include <string>

namespace mill {
/// A force with the digits that it has: those of a given one up to five, else four, and never less than whole kN:
/// "976.2 kN", "18000 kN".
/// @param force  N
std::string force_text(double force);

/// The same as the form of a number in kN, ".1f", for StatedQuantity.
const char *force_form(double force);
}  // namespace mill
