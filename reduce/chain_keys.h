#pragma once
#include "core/stand.h"
#include <array>
#include <string>
#include <vector>

namespace mill::reduce {
/// Keys of the case file, as a Parameter lists them.
using Keys = std::vector<std::string>;

/// What the springs that other computations bring along were made from.
struct SpringKeys {
  Keys K3, K4, K5;
  Keys K_Zy_upper, K_Zy_lower;
  Keys given         = {};     ///< given_springs()
  bool drawn_housing = false;  ///< posts and beams come from a drawing
};

/// Keys behind every number of the chain, M1..M6 and then K1..K7: the terms of theory.md (4.1a) and (4.13)-(4.16).
std::array<Keys, 13> chain_keys(const SpringKeys &springs);

/// The same keys with those of [frame] that a drawing replaces exchanged for the keys of the drawing.
Keys as_drawn(const Keys &keys, const FourHigh &stand);

/// Stiffnesses or masses of a drawn [housing]; what it does not give is that of the rolls.
Keys housing_keys(const MillHousing &housing, bool mass);

/// "given.K1", "given.K7", "given.K_ZW", as far as the case gives them.
Keys given_springs(const FourHigh &stand);

/// Keys behind the stiffness of the backup roll on its bearing centres, (4.8).
Keys backup_beam_keys();
}  // namespace mill::reduce
