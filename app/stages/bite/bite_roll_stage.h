#pragma once
#include "app/stages/bite/bite_study.h"
#include "fem/strip/bite_roll.h"

namespace mill {
/// Is there a section of the work roll for this bite?  Asks for no file.
/// @throws InputError  none: an arc past 40 degrees of the roll, a contact with the back-up roll as wide as the
/// roll
void require_section(const BiteQuestion &question);

/// Flexibility of the work roll's surface in the bite, from its section on two meshes.
fem::BiteRollResult roll_flexibility(RunContext &run, const BiteQuestion &question);

/// Everything that the section depends on, as text; its hash is the key of the cache.
std::string section_inputs(const BiteQuestion &question);
}  // namespace mill
