#pragma once
#include "core/model/four_high.h"
#include <cstddef>
#include <string>

// What the mill modulus reads of a drawing in addition to the springs of the chain, as text; as
// core/case/contact_inputs.h.
namespace mill {
/// Work rolls that touch each other at the load of a pass.
std::string text_of_touching_rolls(const FourHigh &stand, std::size_t pass);

/// Work rolls that bend between strip and contact.
/// @param solid  by finite elements where the case asks for them; false: beams
std::string text_of_bent_work_rolls(const FourHigh &stand, bool solid);
}  // namespace mill
