#pragma once
#include "reduce/stand/stand_comparison.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// What a mode of a stand is called in a rolling mill, and why.  theory.md 22.9
struct ModeName {
  std::string name;     ///< "third octave, upper stack"
  std::string key;      ///< of results: "third_octave_upper"
  std::string decided;  ///< "backup and work roll in phase, K2, K6 and frame 97 % of the strain energy"
};

/// One name for each mode, by the same rules for six masses, beams and component modes; parts are summed.
std::vector<ModeName> mode_names(const StandWithModes &stand);
}  // namespace mill::reduce
