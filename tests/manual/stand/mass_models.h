#pragma once
#include "core/model/case.h"
#include "reduce/stand/lumped_stand.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/stand/demo_drawing.h"
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::verify {
/// Its chain at 976.2175 kN with the contact springs and bearing stiffness of the reference, without the bite.
reduce::LumpedStand demo_chain(const FourHigh &stand, const reduce::SolidRolls &rolls = {});

/// Cases of the stand of beams and of components, theory.md 22; part of mass_cases().
std::vector<Case> stand_model_cases();
}  // namespace mill::verify
