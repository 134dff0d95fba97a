#pragma once
#include "core/model/housing.h"
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
  std::map<std::string, Keys> given = {};     ///< given_springs()
  bool drawn_housing                = false;  ///< posts and beams come from a drawing
  Keys closure                      = {};     ///< closure_keys(), with them every spring on the path
};

/// Keys behind every number of the chain, M1..M6 and then K1..K7: the terms of theory.md (4.1a) and (4.13)-(4.16).
/// @param solid  rolls by finite elements, not beams
std::array<Keys, 13> chain_keys(const SpringKeys &springs, bool solid = false);

/// The same keys with those of [frame] that a drawing replaces exchanged for the keys of the drawing.
Keys as_drawn(const Keys &keys, const FourHigh &stand);

/// Stiffnesses or masses of a drawn [housing]; what it does not give is that of the rolls.
Keys housing_keys(const MillHousing &housing, bool mass);

/// What a frame on its modulus is made from in addition to the springs of the chain: the modulus and the contact
/// of the work rolls at the load of the first pass.  Empty where the modulus is not given.
Keys closure_keys(const FourHigh &stand);

/// What stands behind K1, K7 and K_ZW, as far as the case gives them.
std::map<std::string, Keys> given_springs(const FourHigh &stand);

/// Keys behind the stiffness of the backup roll on its bearing centres: of a beam (4.8a), or of its meshes
/// (22.13).
Keys backup_roll_keys(bool solid);
}  // namespace mill::reduce
