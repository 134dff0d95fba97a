#pragma once
#include "core/records/result_names.h"

// Names of what a run of kind "stack" writes.
namespace mill {
namespace family {
/// stack.crown, pair.W-B.force, roll.B.reaction_drive, influence.crown.force
constexpr const char *stack = "stack", *pair = "pair", *roll = "roll", *influence = "influence";
}  // namespace family

/// The drawn stack with the resultants of its contacts, as a ClusterRecord.
constexpr const char *stack_file = "curves/stack.json";

/// The roll that is made of a listed one: its mirror image in the lower half.
inline std::string made_roll_name(const std::string &listed)
{
  return "lower_" + listed;
}

/// "W-B": rolls that touch, the one nearer to the strip first.
inline std::string pair_name(const std::string &nearer, const std::string &other)
{
  return nearer + "-" + other;
}

namespace curve {
/// Change of the gap with one unit of each input: columns "W.bending_force", "force".
inline constexpr CurveKind stack_influence{
    "influence", false, "", "change of the loaded gap with each input", Figure::section, {{{"z", "m"}}}, true};
inline constexpr CurveKind stack_modulus{
    "modulus",
    false,
    "",
    "modulus of the stack over the rolling force",
    Figure::section,
    {{{"force", "N"}, {"opening", "m"}, {"mid", "N/m"}, {"mean", "N/m"}, {"crown", "m"}}}};
/// Row by row of a setting: touching is the smallest share of all contacts, 1: all are closed.
inline constexpr CurveKind stack_settings{
    "settings",
    false,
    "",
    "crown over bending force and shift",
    Figure::section,
    {{{"shift", "m"}, {"bending_force", "N"}, {"crown", "m"}, {"edge_drop", "m"}, {"touching", ""}}}};
inline constexpr CurveKind stack_window{"window",
                                        false,
                                        "",
                                        "operating window over width and rolling force",
                                        Figure::section,
                                        {{{"width", "m"},
                                          {"force", "N"},
                                          {"crown", "m"},
                                          {"edge_drop", "m"},
                                          {"peak_pressure", "Pa"},
                                          {"touching", ""}}}};
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
/// Of a mode by its number: rolls one below the other, by their places in the case.
inline constexpr CurveKind stack_mode{
    "mode", true, "", "axes of the rolls in a mode", Figure::section, {{{"roll", ""}, {"z", "m"}, {"y", ""}}}};
inline constexpr CurveKind stack_roll{"roll",
                                      true,
                                      "",
                                      "deflection of a roll, moments and shear forces of its sections",
                                      Figure::section,
                                      {{{"z", "m"},
                                        {"x", "m"},
                                        {"y", "m"},
                                        {"moment_x", "N m"},
                                        {"moment_y", "N m"},
                                        {"shear_x", "N"},
                                        {"shear_y", "N"},
                                        {"bending_stress", "Pa"}}}};
}  // namespace curve
}  // namespace mill
