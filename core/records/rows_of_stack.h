#pragma once
#include "core/records/result_row.h"

// Results of stacks of rolls that bend.
namespace mill::row {
namespace stack {
inline constexpr RowOf<0> force{"stack.force", "N", "51.5", "rolling force"};
inline constexpr RowOf<0> crown{"stack.crown", "m", "51.2", "crown of the strip, positive: thicker in the middle"};
inline constexpr RowOf<0> edge_drop{"stack.edge_drop", "m", "51.2", "edge drop of the strip, mean of both sides"};
inline constexpr RowOf<0> wedge{"stack.wedge", "m", "51.2", "wedge of the strip, drive less operator side"};
inline constexpr RowOf<0> profile_rms{"stack.profile_rms", "m", "51.2",
                                      "root mean square of the exit thickness about its mean over the width"};
inline constexpr RowOf<0> opening{"stack.opening", "m", "51.2",
                                  "opening of the gap by the force, middle of the strip"};
inline constexpr RowOf<0> gap{"stack.gap", "m", "51.2", "gap between the unloaded work rolls"};
inline constexpr RowOf<0> modulus_mid{"stack.modulus.mid", "N/m", "51.9",
                                      "modulus of the stack, force per thickness in the middle"};
inline constexpr RowOf<0> modulus_mean{"stack.modulus.mean", "N/m", "51.9",
                                       "modulus of the stack, force per thickness that the line load weighs"};
inline constexpr RowOf<0> flatness_min{"stack.flatness.min", "1", "51.12", "flatness in I-units, shortest fibre"};
inline constexpr RowOf<0> flatness_max{"stack.flatness.max", "1", "51.12", "flatness in I-units, longest fibre"};
inline constexpr RowOf<1> frequency{"stack.f{n}", "Hz", "51.22", "natural frequency {n} of the stack"};
inline constexpr RowOf<0> strip_stiffness{"stack.strip_stiffness", "N/m", "51.22",
                                          "strip between the work rolls as a spring, with their flattening"};
inline constexpr const ResultRow *all[]{&force,        &crown,     &edge_drop,      &wedge,        &profile_rms,
                                        &opening,      &gap,       &modulus_mid,    &modulus_mean, &flatness_min,
                                        &flatness_max, &frequency, &strip_stiffness};
}  // namespace stack

namespace pair {
inline constexpr RowOf<1> force{"pair.{pair}.force", "N", "51.9", "contact {pair}, its force"};
inline constexpr RowOf<1> load_centre{"pair.{pair}.load_centre", "m", "51.9",
                                      "contact {pair}, place of its resultant along z"};
inline constexpr RowOf<1> q_max{"pair.{pair}.q_max", "N/m", "51.3", "contact {pair}, largest line load"};
inline constexpr RowOf<1> peak_pressure{"pair.{pair}.peak_pressure", "Pa", "51.3",
                                        "contact {pair}, largest contact pressure"};
inline constexpr RowOf<1> touching{"pair.{pair}.touching", "1", "51.1",
                                   "contact {pair}, share of the length that touches"};
inline constexpr RowOf<1> uniform_tangent{"pair.{pair}.uniform_tangent", "N/m", "51.4",
                                          "contact {pair}, tangent for an even approach"};
inline constexpr RowOf<1> tangent{
    "pair.{pair}.tangent", "N/m", "51.21",
    "contact {pair}, change of the force over that of the approach that the line load weighs"};
inline constexpr RowOf<1> secant{"pair.{pair}.secant", "N/m", "51.3",
                                 "contact {pair}, force divided by the approach that the line load weighs"};
inline constexpr const ResultRow *all[]{&force,    &load_centre,     &q_max,   &peak_pressure,
                                        &touching, &uniform_tangent, &tangent, &secant};
}  // namespace pair

namespace roll {
inline constexpr RowOf<1> deflection{
    "roll.{roll}.deflection", "m", "51.9",
    "roll {roll}, deflection upwards of the middle against the ends of the barrel"};
inline constexpr RowOf<1> bending_stress{"roll.{roll}.bending_stress", "Pa", "51.24",
                                         "roll {roll}, largest bending stress"};
inline constexpr RowOf<1> bearing_stiffness{
    "roll.{roll}.bearing_stiffness", "N/m", "5.23",
    "roll {roll}, radial stiffness of the heavier of its bearings under its load"};
inline constexpr RowOf<1> reaction_drive{
    "roll.{roll}.reaction_drive", "N", "51.9",
    "roll {roll}, force of the bearing on the drive side, upwards on the roll"};
inline constexpr RowOf<1> reaction_operator{
    "roll.{roll}.reaction_operator", "N", "51.9",
    "roll {roll}, force of the bearing on the operator side, upwards on the roll"};
inline constexpr RowOf<2> reaction_saddle{"roll.{roll}.reaction_saddle{n}", "N", "51.9",
                                          "roll {roll}, force of saddle {n}, upwards on the roll"};
inline constexpr const ResultRow *all[]{&deflection,     &bending_stress,    &bearing_stiffness,
                                        &reaction_drive, &reaction_operator, &reaction_saddle};
}  // namespace roll

namespace influence {
inline constexpr RowOf<1> force{"influence.{profile}.force", "m/N", "51.9",
                                "change of the {profile} with the rolling force"};
inline constexpr RowOf<2> crown{"influence.{profile}.{roll}.crown", "1", "51.9",
                                "roll {roll}, change of the {profile} with its own crown on the diameter, both "
                                "halves"};
inline constexpr RowOf<2> bending_force{"influence.{profile}.{roll}.bending_force", "m/N", "51.9",
                                        "roll {roll}, change of the {profile} with the bending force of each "
                                        "chock, both halves"};
inline constexpr RowOf<2> shift{"influence.{profile}.{roll}.shift", "1", "51",
                                "roll {roll}, change of the {profile} with its shift to the drive side; a turned "
                                "lower roll moves the other way"};
inline constexpr RowOf<3> eccentric{"influence.{profile}.{roll}.eccentric{n}", "1", "51.9",
                                    "roll {roll}, change of the {profile} with the eccentric of saddle {n}"};
inline constexpr const ResultRow *all[]{&force, &crown, &bending_force, &shift, &eccentric};
}  // namespace influence
}  // namespace mill::row
