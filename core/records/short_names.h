#pragma once
#include <string>

namespace mill {
/// The name of a result behind a short one that users say: "gap_mode.frequency" is the frequency of the gap mode
/// of the first kind, the third octave; any other name stays.
std::string full_result_name(const std::string &written);
}  // namespace mill
