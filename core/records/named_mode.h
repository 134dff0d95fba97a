#pragma once
#include "core/records/result_words.h"
#include <optional>
#include <string>

namespace mill {
/// What the method of a result mode.* says of its mode: the results of a run have these three in one text.
struct NamedMode {
  std::string name;   ///< "gap mode, first kind (third octave)"
  std::string why;    ///< the numbers that decided
  std::string model;  ///< "rolls as reduced finite elements"
};
/// "NAME: WHY; MODEL"
std::string mode_method(const NamedMode &mode);
/// The same read back.  A text without these parts is all name.
NamedMode named_mode_of(const std::string &method);

/// The kind of a mode of the gap by the key that its results have, gap_first_kind of
/// "gap_first_kind_lower_work_roll"; nothing for another mode.
std::optional<ResultWord> gap_kind_of(const std::string &mode);
}  // namespace mill
