#pragma once
#include "core/case/chain_inputs.h"
#include <array>
#include <map>
#include <string>
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// Keys of the case file, as a Parameter lists them.
using Keys = std::vector<std::string>;

/// What the springs that other computations bring along were made from.
struct SpringKeys {
  Keys K3, K4, K5;
  Keys K_Zy_upper, K_Zy_lower;
};

/// Keys behind every number of the chain, M1..M6 and then K1..K7: the terms of theory.md (4.1a) and (4.13)-(4.16).
/// A given K1, K7 or K_ZW stands for the parts that it replaces.
/// @param keys   of the case
/// @param stand  with its given values
/// @param solid  rolls by finite elements, not beams
std::array<Keys, 13> chain_keys(MovingKeys &keys, const FourHigh &stand, const SpringKeys &springs, bool solid,
                                ChainReading reading = ChainReading::run);
}  // namespace mill::reduce
