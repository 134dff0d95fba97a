#pragma once
#include "core/case/provenance.h"
#include <string>
#include <vector>

namespace mill {
/// Where a number of the chain comes from.
struct Station {
  std::string relation;           ///< "springs in series"
  std::string file;               ///< that computes it
  std::string equation;           ///< of docs/theory.md
  std::vector<std::string> from;  ///< numbers of the chain it is made of
  KeyList own_keys;               ///< further keys that enter
};

/// Of M1..M6, K1, K2, K6, K7 and K_ZW.
/// @param reference  dynamics.mass_reference
/// @param keys       of the stand; nullptr: without lists of keys
Station station_of(const std::string &name, MassReference reference, MovingKeys *keys);
}  // namespace mill
