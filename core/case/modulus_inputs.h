#pragma once
#include "core/model/four_high.h"
#include "core/records/key_list.h"
#include <cstddef>
#include <string>

// What the mill modulus reads of a drawing in addition to the springs of the chain, as text; as
// core/case/contact_inputs.h.
namespace mill {
class MovingKeys;

/// Work rolls that touch each other at the load of a pass.
std::string text_of_touching_rolls(const FourHigh &stand, std::size_t pass);

/// Work rolls that bend between strip and contact.
/// @param solid  by finite elements where the case asks for them; false: beams
std::string text_of_bent_work_rolls(const FourHigh &stand, bool solid);

/// Work rolls that touch each other at the load of a pass, and their bending under the strip.
/// @param solid  by finite elements where the case asks for them; false: beams
KeyList touching_roll_keys(MovingKeys &keys, std::size_t p);
KeyList bent_work_roll_keys(MovingKeys &keys, bool solid);
}  // namespace mill
