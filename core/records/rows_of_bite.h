#pragma once
#include "core/records/result_row.h"

// Results of the roll bite: K4, every pass, every model of it, its derivatives, the fit to measured values.
namespace mill::row {
namespace bite_spring {
inline constexpr RowOf<0> plastic_slope{"K4.plastic_slope", "N/m", "8.10",
                                        "bite, between the work rolls, plastic slope of the pass"};
inline constexpr RowOf<0> flattening{"K4.flattening", "N/m", "8.12",
                                     "bite, between the work rolls, elastic flattening of one roll"};
inline constexpr RowOf<0> combined{
    "K4.combined", "N/m", "8.13",
    "bite, between the work rolls, plastic slope and flattening of both rolls in series"};
inline constexpr RowOf<0> path_plateau{"K4.path_plateau", "N/m", "20.5",
                                       "bite, between the work rolls, mean force per displacement of the nodes "
                                       "along the contact, which depends on the mesh"};
inline constexpr const ResultRow *all[]{&plastic_slope, &flattening, &combined, &path_plateau};
}  // namespace bite_spring

namespace bite {
inline constexpr RowOf<1> force{"bite.{pass}.force", "N", "8.8", "bite, {pass}, roll force"};
inline constexpr RowOf<1> torque{"bite.{pass}.torque", "N m", "8.19", "bite, {pass}, torque of one roll"};
inline constexpr RowOf<1> friction{"bite.{pass}.friction", "1", "8", "bite, {pass}, friction in the bite"};
inline constexpr RowOf<1> film_thickness{"bite.{pass}.film_thickness", "m", "8.20", "bite, {pass}, mean oil film"};
inline constexpr RowOf<1> flattened_radius{"bite.{pass}.flattened_radius", "m", "8.9",
                                           "bite, {pass}, radius of the flattened roll"};
inline constexpr RowOf<1> arc_length{"bite.{pass}.arc_length", "m", "8.2",
                                     "bite, {pass}, projected length of the arc"};
inline constexpr RowOf<1> sticking_length{"bite.{pass}.sticking_length", "m", "17.2",
                                          "bite, {pass}, part of the arc on which friction is at its limit"};
inline constexpr RowOf<1> forward_slip{"bite.{pass}.forward_slip", "1", "8.7", "bite, {pass}, forward slip"};
inline constexpr RowOf<1> neutral_angle{"bite.{pass}.neutral_angle", "rad", "8.7",
                                        "bite, {pass}, neutral angle at the axis of the roll"};
inline constexpr RowOf<1> neutral_position{"bite.{pass}.neutral_position", "m", "8.7",
                                           "bite, {pass}, where strip and roll run equally fast"};
inline constexpr RowOf<1> peak_pressure{"bite.{pass}.peak_pressure", "Pa", "8",
                                        "bite, {pass}, largest pressure apart from the edge of the contact"};
inline constexpr RowOf<1> exit_thickness{"bite.{pass}.exit_thickness", "m", "19",
                                         "bite, {pass}, thickness of the strip that leaves the stand"};
inline constexpr RowOf<1> smallest_thickness{"bite.{pass}.smallest_thickness", "m", "19",
                                             "bite, {pass}, smallest thickness of the strip, under load"};
inline constexpr RowOf<1> entry_speed{"bite.{pass}.entry_speed", "m/s", "8.15",
                                      "bite, {pass}, speed of the strip at the entry"};
inline constexpr RowOf<1> exit_speed{"bite.{pass}.exit_speed", "m/s", "8.15",
                                     "bite, {pass}, speed of the strip at the exit"};
inline constexpr RowOf<1> force_by_entry_thickness{"bite.{pass}.force_by_entry_thickness", "N/m", "8",
                                                   "bite, {pass}, force per entry thickness"};
inline constexpr RowOf<1> force_by_exit_thickness{"bite.{pass}.force_by_exit_thickness", "N/m", "8.10",
                                                  "bite, {pass}, force per exit thickness"};
inline constexpr RowOf<1> force_by_entry_tension{"bite.{pass}.force_by_entry_tension", "m2", "8",
                                                 "bite, {pass}, force per back tension"};
inline constexpr RowOf<1> force_by_exit_tension{"bite.{pass}.force_by_exit_tension", "m2", "8",
                                                "bite, {pass}, force per front tension"};
inline constexpr RowOf<1> force_by_friction{"bite.{pass}.force_by_friction", "N", "8",
                                            "bite, {pass}, force per coefficient of friction"};
inline constexpr RowOf<1> force_by_flow_stress{"bite.{pass}.force_by_flow_stress", "N", "8",
                                               "bite, {pass}, force per unit factor on the flow stress"};
inline constexpr RowOf<1> force_by_roll_speed{"bite.{pass}.force_by_roll_speed", "N s/m", "8",
                                              "bite, {pass}, force per speed of the rolls"};
inline constexpr RowOf<1> friction_margin{"bite.{pass}.friction_margin", "1", "8.36",
                                          "bite, {pass}, friction divided by the least that draws the strip in"};
inline constexpr RowOf<1> elastic_share{"bite.{pass}.elastic_share", "1", "8.35",
                                        "bite, {pass}, length of the elastic zones divided by that of the arc"};
inline constexpr RowOf<1> arc_over_thickness{"bite.{pass}.arc_over_thickness", "1", "8.34",
                                             "bite, {pass}, projected arc of a rigid roll over mean thickness"};
inline constexpr const ResultRow *all[]{&force,
                                        &torque,
                                        &friction,
                                        &film_thickness,
                                        &flattened_radius,
                                        &arc_length,
                                        &sticking_length,
                                        &forward_slip,
                                        &neutral_angle,
                                        &neutral_position,
                                        &peak_pressure,
                                        &exit_thickness,
                                        &smallest_thickness,
                                        &entry_speed,
                                        &exit_speed,
                                        &force_by_entry_thickness,
                                        &force_by_exit_thickness,
                                        &force_by_entry_tension,
                                        &force_by_exit_tension,
                                        &force_by_friction,
                                        &force_by_flow_stress,
                                        &force_by_roll_speed,
                                        &friction_margin,
                                        &elastic_share,
                                        &arc_over_thickness};
}  // namespace bite

namespace bite_model {
inline constexpr RowOf<2> force{"bite.{pass}.{bite_model}.force", "N", "8.8",
                                "bite, {pass}, {bite_model}, roll force"};
inline constexpr RowOf<2> torque{"bite.{pass}.{bite_model}.torque", "N m", "8.19",
                                 "bite, {pass}, {bite_model}, torque of one roll"};
inline constexpr RowOf<2> forward_slip{"bite.{pass}.{bite_model}.forward_slip", "1", "8.7",
                                       "bite, {pass}, {bite_model}, forward slip"};
inline constexpr RowOf<2> neutral_angle{"bite.{pass}.{bite_model}.neutral_angle", "rad", "8.7",
                                        "bite, {pass}, {bite_model}, neutral angle at the axis of the roll"};
inline constexpr RowOf<2> flattened_radius{"bite.{pass}.{bite_model}.flattened_radius", "m", "8.9",
                                           "bite, {pass}, {bite_model}, radius of the flattened roll"};
inline constexpr RowOf<2> plastic_slope{"bite.{pass}.{bite_model}.plastic_slope", "N/m", "8.10",
                                        "bite, {pass}, {bite_model}, plastic slope of the pass"};
inline constexpr RowOf<2> flux_balance{"bite.{pass}.{bite_model}.flux_balance", "1", "18",
                                       "bite, {pass}, {bite_model}, flow out over flow in, less 1"};
inline constexpr RowOf<2> force_balance{
    "bite.{pass}.{bite_model}.force_balance", "1", "18.16",
    "bite, {pass}, {bite_model}, horizontal forces on the strip that do not balance"};
inline constexpr RowOf<2> power_balance{
    "bite.{pass}.{bite_model}.power_balance", "1", "18.16",
    "bite, {pass}, {bite_model}, power brought in over power dissipated, less 1"};
inline constexpr RowOf<2> exit_thickness{
    "bite.{pass}.{bite_model}.exit_thickness", "m", "19",
    "bite, {pass}, {bite_model}, thickness of the strip that leaves the stand"};
inline constexpr RowOf<2> entry_position{"bite.{pass}.{bite_model}.entry_position", "m", "18",
                                         "bite, {pass}, {bite_model}, where the contact begins"};
inline constexpr RowOf<2> exit_position{"bite.{pass}.{bite_model}.exit_position", "m", "18",
                                        "bite, {pass}, {bite_model}, where the contact ends"};
inline constexpr RowOf<2> smallest_thickness{
    "bite.{pass}.{bite_model}.smallest_thickness", "m", "19",
    "bite, {pass}, {bite_model}, smallest thickness of the strip, under load"};
inline constexpr RowOf<2> elastic_entry{
    "bite.{pass}.{bite_model}.elastic_entry", "m", "19",
    "bite, {pass}, {bite_model}, length of contact before the surface of the strip yields"};
inline constexpr RowOf<2> elastic_exit{
    "bite.{pass}.{bite_model}.elastic_exit", "m", "19",
    "bite, {pass}, {bite_model}, length of contact behind the last yielding of the strip"};
inline constexpr RowOf<2> elastic_power{
    "bite.{pass}.{bite_model}.elastic_power", "1", "19",
    "bite, {pass}, {bite_model}, elastic energy carried off divided by the power spent"};
inline constexpr const ResultRow *all[]{
    &force,          &torque,        &forward_slip,       &neutral_angle, &flattened_radius,
    &plastic_slope,  &flux_balance,  &force_balance,      &power_balance, &exit_thickness,
    &entry_position, &exit_position, &smallest_thickness, &elastic_entry, &elastic_exit,
    &elastic_power};
}  // namespace bite_model

// Derivatives of a vibrating mill: P and Q are the speeds of the strip, F is the roll force.
namespace bite_slope {
inline constexpr RowOf<2> speed_by_gap{"bite.{pass}.{strip_speed}.gap", "1/s", "8.31",
                                       "bite, {pass}, {strip_speed}, derivative by gap"};
inline constexpr RowOf<1> force_by_gap{"bite.{pass}.F.gap", "N/m", "8.32",
                                       "bite, {pass}, roll force, derivative by gap"};
inline constexpr RowOf<2> speed_by_gap_rate{"bite.{pass}.{strip_speed}.gap_rate", "1", "8.31",
                                            "bite, {pass}, {strip_speed}, derivative by opening rate of the gap"};
inline constexpr RowOf<1> force_by_gap_rate{"bite.{pass}.F.gap_rate", "N s/m", "8.33",
                                            "bite, {pass}, roll force, derivative by opening rate of the gap"};
inline constexpr RowOf<2> speed_by_entry_tension{"bite.{pass}.{strip_speed}.entry_tension", "m/(s Pa)", "8.31",
                                                 "bite, {pass}, {strip_speed}, derivative by back tension"};
inline constexpr RowOf<1> force_by_entry_tension{"bite.{pass}.F.entry_tension", "m2", "8.32",
                                                 "bite, {pass}, roll force, derivative by back tension"};
inline constexpr RowOf<2> speed_by_exit_tension{"bite.{pass}.{strip_speed}.exit_tension", "m/(s Pa)", "8.31",
                                                "bite, {pass}, {strip_speed}, derivative by front tension"};
inline constexpr RowOf<1> force_by_exit_tension{"bite.{pass}.F.exit_tension", "m2", "8.33",
                                                "bite, {pass}, roll force, derivative by front tension"};
inline constexpr RowOf<2> speed_by_entry_thickness{"bite.{pass}.{strip_speed}.entry_thickness", "1/s", "8.31",
                                                   "bite, {pass}, {strip_speed}, derivative by entry thickness"};
inline constexpr RowOf<1> force_by_entry_thickness{"bite.{pass}.F.entry_thickness", "N/m", "8.32",
                                                   "bite, {pass}, roll force, derivative by entry thickness"};
/// By gap, its rate, back tension, front tension, entry thickness: the order of the linear bite.
inline constexpr const RowOf<2> *speed_by[]{&speed_by_gap, &speed_by_gap_rate, &speed_by_entry_tension,
                                            &speed_by_exit_tension, &speed_by_entry_thickness};
inline constexpr const RowOf<1> *force_by[]{&force_by_gap, &force_by_gap_rate, &force_by_entry_tension,
                                            &force_by_exit_tension, &force_by_entry_thickness};
inline constexpr const ResultRow *all[]{&speed_by_gap,
                                        &force_by_gap,
                                        &speed_by_gap_rate,
                                        &force_by_gap_rate,
                                        &speed_by_entry_tension,
                                        &force_by_entry_tension,
                                        &speed_by_exit_tension,
                                        &force_by_exit_tension,
                                        &speed_by_entry_thickness,
                                        &force_by_entry_thickness};
}  // namespace bite_slope

namespace bite_fit {
inline constexpr RowOf<1> number{"bite.fit.{number}", "", "31.2", "bite, fit to measured values, {number}"};
inline constexpr RowOf<1> number_low{"bite.fit.{number}_low", "", "31.6",
                                     "bite, fit to measured values, {number}, low end"};
inline constexpr RowOf<1> number_high{"bite.fit.{number}_high", "", "31.6",
                                      "bite, fit to measured values, {number}, high end"};
inline constexpr RowOf<0> correlation{"bite.fit.correlation", "1", "31.5",
                                      "bite, fit to measured values, correlation of friction and flow stress"};
inline constexpr RowOf<0> misfit{"bite.fit.misfit", "1", "31.2",
                                 "bite, fit to measured values, sum of squares over the deviations"};
inline constexpr RowOf<0> freedom{"bite.fit.freedom", "1", "31",
                                  "bite, fit to measured values, measured values less unknowns"};
inline constexpr RowOf<0> worst_deviation{
    "bite.fit.worst_deviation", "1", "31.5",
    "bite, fit to measured values, deviation along the direction known worst"};
inline constexpr RowOf<1> worst{"bite.fit.worst_{unknown}", "1", "31.5",
                                "bite, fit to measured values, {unknown} in the direction known worst"};
inline constexpr RowOf<2> residual{
    "bite.fit.residual.{pass}.{measure}", "1", "31.2",
    "bite, fit to measured values, distance to a measured value in standard deviations, {pass}, {measure}"};
inline constexpr const ResultRow *all[]{&number,  &number_low,      &number_high, &correlation, &misfit,
                                        &freedom, &worst_deviation, &worst,       &residual};
}  // namespace bite_fit
}  // namespace mill::row
