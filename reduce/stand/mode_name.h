#pragma once
#include <string>

namespace mill::reduce {
/// What a mode of a stand is called in a rolling mill, and why.  theory.md 22.9
struct ModeName {
  std::string name;     ///< "third octave, upper stack"
  std::string key;      ///< of results: "third_octave_upper"
  std::string decided;  ///< "backup and work roll in phase, K2, K6 and frame 97 % of the strain energy"
  /// Name by the shares of its own model, where the name is that of a more detailed model and differs; else empty.
  std::string own;
};
}  // namespace mill::reduce
