#pragma once
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// What a result mode.* says of its mode.
struct NamedMode {
  std::string name;   ///< "gap mode, first kind (third octave)"
  std::string why;    ///< the numbers that decided
  std::string model;  ///< "rolls as reduced finite elements"
};
NamedMode named_mode(const Result &mode);
}  // namespace mill::report
