#pragma once
#include "reduce/stand/stand_assembly.h"

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// The stand with rolls as stepped Timoshenko beams on distributed contact springs, with chocks and cylinder
/// apart: model "beam".  About 300 unknowns with the default mesh.  theory.md 22.1, 22.2
/// @param elements  per span of a roll (barrel, neck, overhang)
/// @throws InputError  as symmetric_beam and assemble_stand
/// Cost: some 10 ms.
StandModel beam_stand(const FourHigh &stand, const StandSprings &springs, int elements = 24);
}  // namespace mill::reduce
