#pragma once
#include "core/records/result_row.h"

// Results of planar stacks of rolls, of the fits to their frequencies and of the forces of a pass schedule.
namespace mill::row {
namespace cluster {
inline constexpr RowOf<1> force{"cluster.{pass}.force", "N", "39", "{pass}, rolling force"};
inline constexpr RowOf<2> contact_force{"cluster.{pass}.{rolls}.force", "N", "38.11",
                                        "{pass}, contact {rolls}, force"};
inline constexpr RowOf<2> contact_approach{"cluster.{pass}.{rolls}.approach", "m", "38.5",
                                           "{pass}, contact {rolls}, approach of the axes"};
inline constexpr RowOf<2> contact_tangent{"cluster.{pass}.{rolls}.tangent", "N/m", "38.5",
                                          "{pass}, contact {rolls}, tangent dF/d\u03b4"};
inline constexpr RowOf<2> contact_secant{"cluster.{pass}.{rolls}.secant", "N/m", "38.5",
                                         "{pass}, contact {rolls}, secant F/\u03b4"};
inline constexpr RowOf<3> roller_load{"cluster.{pass}.roller_load.{roll}.{n}", "N", "38.11",
                                      "{pass}, support of roll {roll}, load of its roller {n}"};
inline constexpr RowOf<2> x{"cluster.{pass}.{roll}.x", "m", "38.11",
                            "{pass}, roll {roll}, displacement along the rolling direction"};
inline constexpr RowOf<2> y{"cluster.{pass}.{roll}.y", "m", "38.11", "{pass}, roll {roll}, displacement upwards"};
inline constexpr RowOf<2> frequency{"cluster.{pass}.f{n}", "Hz", "38.13", "{pass}, natural frequency {n}"};
inline constexpr RowOf<2> mode{"cluster.{pass}.mode.{mode}", "Hz", "38.14",
                               "{pass}, natural frequency of the mode {mode}, recognised by its shape"};
inline constexpr RowOf<1> buckling_factor{"cluster.{pass}.buckling_factor", "1", "38.24",
                                          "{pass}, factor on the force at which the stack buckles"};
inline constexpr RowOf<2> least_guide{"cluster.{pass}.least_guide.{roll}", "N/m", "38.24",
                                      "{pass}, smallest stiffness of the guide of roll {roll}"};
inline constexpr RowOf<1> leaving_force{"cluster.{pass}.leaving_force", "N", "38",
                                        "{pass}, horizontal force at which a contact opens"};
inline constexpr RowOf<3> velocity{"cluster.{pass}.velocity.{roll}.{axis}", "m/s", "38.16",
                                   "{pass}, roll {roll}, velocity amplitude along {axis} under the dynamic force"};
inline constexpr RowOf<3> acceleration{
    "cluster.{pass}.acceleration.{roll}.{axis}", "m/s2", "38.16",
    "{pass}, roll {roll}, acceleration amplitude along {axis} under the dynamic force"};
inline constexpr RowOf<2> fit{"cluster.fit.{variant}.{key}", "", "38.25", "fitted in variant {variant}, {key}"};
inline constexpr const ResultRow *all[]{&force,
                                        &contact_force,
                                        &contact_approach,
                                        &contact_tangent,
                                        &contact_secant,
                                        &roller_load,
                                        &x,
                                        &y,
                                        &frequency,
                                        &mode,
                                        &buckling_factor,
                                        &least_guide,
                                        &leaving_force,
                                        &velocity,
                                        &acceleration,
                                        &fit};
}  // namespace cluster

namespace schedule {
inline constexpr RowOf<1> flow_stress{"cluster.{pass}.flow_stress", "Pa", "39.2",
                                      "{pass}, flow stress, fitted with flattened rolls"};
inline constexpr RowOf<1> flow_stress_unflattened{"cluster.{pass}.flow_stress_unflattened", "Pa", "39.2",
                                                  "{pass}, flow stress, fitted with rigid rolls"};
inline constexpr RowOf<1> flattened_radius{"cluster.{pass}.flattened_radius", "m", "8.9",
                                           "{pass}, radius of the flattened roll"};
inline constexpr RowOf<1> friction{"cluster.{pass}.friction", "1", "8", "{pass}, friction by its law"};
inline constexpr RowOf<1> deformation_power{"cluster.{pass}.deformation_power", "W", "39.6",
                                            "{pass}, power of homogeneous deformation"};
inline constexpr RowOf<1> deformation_torque{"cluster.{pass}.deformation_torque", "N m", "39.6",
                                             "{pass}, torque of homogeneous deformation, one roll"};
inline constexpr RowOf<1> dynamic_force{"cluster.{pass}.dynamic_force", "N", "39.9",
                                        "{pass}, dynamic force by one constant for all passes"};
inline constexpr RowOf<1> force_per_displacement{"cluster.{pass}.force_per_displacement", "N/m", "39.9",
                                                 "{pass}, force per displacement of a work roll"};
inline constexpr RowOf<1> hardening_stress{"cluster.{passes}.hardening_stress", "Pa", "39.4",
                                           "hardening law of all passes, shear stress at strain 1"};
inline constexpr RowOf<1> hardening_exponent{"cluster.{passes}.hardening_exponent", "1", "39.4",
                                             "hardening law of all passes, exponent"};
inline constexpr RowOf<1> dynamic_constant{"cluster.{passes}.dynamic_constant", "m2/s", "39.8",
                                           "constant of the dynamic force, all passes"};
inline constexpr const ResultRow *all[]{&flow_stress,      &flow_stress_unflattened, &flattened_radius,
                                        &friction,         &deformation_power,       &deformation_torque,
                                        &hardening_stress, &hardening_exponent,      &dynamic_constant,
                                        &dynamic_force,    &force_per_displacement};
}  // namespace schedule
}  // namespace mill::row
