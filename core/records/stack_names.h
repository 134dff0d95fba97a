#pragma once
#include "core/records/result_names.h"

// Names of what a run of kind "stack" writes.
namespace mill {
namespace family {
/// stack.crown, pair.W-B.force, roll.B.reaction_drive, influence.crown.force
constexpr const char *stack = "stack", *pair = "pair", *roll = "roll", *influence = "influence";
}  // namespace family

namespace curve {
inline constexpr CurveKind stack_strip{"strip",
                                       false,
                                       "",
                                       "thickness profile and line load of the strip",
                                       Figure::section,
                                       {{{"z", "m"}, {"opening", "m"}, {"profile", "m"}, {"line_load", "N/m"}}},
                                       true};
inline constexpr CurveKind stack_pair{
    "pair",
    true,
    "",
    "line load of two rolls",
    Figure::section,
    {{{"z", "m"}, {"line_load", "N/m"}, {"half_width", "m"}, {"peak_pressure", "Pa"}, {"tangent", "N/m2"}}}};
inline constexpr CurveKind stack_roll{
    "roll", true, "", "deflection of a roll", Figure::section, {{{"z", "m"}, {"x", "m"}, {"y", "m"}}}};
}  // namespace curve
}  // namespace mill
