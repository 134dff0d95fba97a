#pragma once
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// "contact FEM" of "computed: contact FEM"; of what is not computed the whole source.
std::string method_of(const Result &result);

/// The name of a mode: "NAME: DECIDED; method of the frequency" up to the colon.
std::string mode_in_words(const std::string &method);

/// What a result mode.* says of its mode.
struct NamedMode {
  std::string name;   ///< "gap mode, first kind (third octave)"
  std::string why;    ///< the numbers that decided
  std::string model;  ///< "rolls as reduced finite elements"
};
NamedMode named_mode(const Result &mode);
}  // namespace mill::report
