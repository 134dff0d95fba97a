#pragma once
#include "core/records/result_row.h"

// Results of the stand: the chain of six masses, modes, frame, mill modulus.
namespace mill::row {
namespace chain {
inline constexpr RowOf<1> K1{"[pass.]K1", "N/m", "4.1a", "ground to M1: upper frame, screw-down"};
inline constexpr RowOf<1> K2{"[pass.]K2", "N/m", "4.1b", "M1 to M2: oil column, cylinder, chock, bearing, roll"};
inline constexpr RowOf<1> K3{"[pass.]K3", "N/m", "3.7", "upper backup roll on upper work roll"};
inline constexpr RowOf<1> K4{"[pass.]K4", "N/m", "8.13", "bite, between the work rolls"};
inline constexpr RowOf<1> K5{"[pass.]K5", "N/m", "3.7", "lower work roll on lower backup roll"};
inline constexpr RowOf<1> K6{"[pass.]K6", "N/m", "4.1c", "M5 to M6: roll, bearing, chock"};
inline constexpr RowOf<1> K7{"[pass.]K7", "N/m", "4.1d", "M6 to ground: lower frame"};
inline constexpr RowOf<0> K_ZW{"K_ZW", "N/m", "4.8a", "bending and shear of a backup roll"};
inline constexpr RowOf<0> K_Zy{"K_Zy", "N/m", "4.1b", "two upper backup bearings, part of K2"};
inline constexpr RowOf<0> K_Zy_lower{"K_Zy_lower", "N/m", "4.1c", "two lower backup bearings, part of K6"};
inline constexpr RowOf<1> C{"[pass.]C", "N s/m", "6.3", "damper parallel to K4"};
inline constexpr RowOf<1> M1{"[pass.]M1", "kg", "4.13", "upper frame and screw-down"};
inline constexpr RowOf<1> M2{"[pass.]M2", "kg", "4.14", "upper backup roll with bearings, chocks, cylinders"};
inline constexpr RowOf<1> M3{"[pass.]M3", "kg", "4.16", "upper work roll"};
inline constexpr RowOf<1> M4{"[pass.]M4", "kg", "4.16", "lower work roll"};
inline constexpr RowOf<1> M5{"[pass.]M5", "kg", "4.15", "lower backup roll with bearings, chocks"};
inline constexpr RowOf<1> M6{"[pass.]M6", "kg", "4.13", "lower frame, load cell"};
inline constexpr RowOf<2> Kzc{"[pass.]{seat}", "N/m", "5.23", "{seat}"};
inline constexpr RowOf<2> Kzc_across{"[pass.]{seat}_across", "N/m", "5.23", "{seat}, across its load"};
/// In their order.
inline constexpr const RowOf<1> *M[]{&M1, &M2, &M3, &M4, &M5, &M6};
inline constexpr const RowOf<1> *K[]{&K1, &K2, &K3, &K4, &K5, &K6, &K7};
inline constexpr const ResultRow *all[]{&K1, &K2, &K3, &K4, &K5, &K6, &K7, &K_ZW, &K_Zy,      &K_Zy_lower,
                                        &C,  &M1, &M2, &M3, &M4, &M5, &M6, &Kzc,  &Kzc_across};
}  // namespace chain

namespace modes {
inline constexpr RowOf<2> vertical{"[open.]f{n}", "Hz", "6.11", "natural frequency {n}, vertical"};
inline constexpr RowOf<1> horizontal{"fh{n}", "Hz", "6.9", "natural frequency {n}, horizontal"};
inline constexpr RowOf<3> of_model{"[open.]{stand_model}.f{n}", "Hz", "22.3",
                                   "{stand_model}, natural frequency {n}"};
inline constexpr RowOf<2> frequency{"[open.]mode.{mode}.frequency", "Hz", "22.24",
                                    "mode {mode}, natural frequency"};
inline constexpr RowOf<2> gap_share{"[open.]mode.{mode}.gap_share", "1", "22.23",
                                    "mode {mode}, share of the static compliance of the gap"};
inline constexpr RowOf<1> of_housing{"housing.f{n}", "Hz", "23.12",
                                     "bare housing on its feet, natural frequency {n}"};
inline constexpr const ResultRow *all[]{&vertical, &horizontal, &of_model, &frequency, &gap_share, &of_housing};
}  // namespace modes

namespace frame {
inline constexpr RowOf<1> stiffness{"frame.{frame_part}_stiffness", "N/m", "23",
                                    "frame, stiffness of the {frame_part}"};
inline constexpr RowOf<1> mass{"frame.{housing_part}_mass", "kg", "4.13a",
                               "frame, mass of the {housing_part} at the chain's point"};
inline constexpr const ResultRow *all[]{&stiffness, &mass};
}  // namespace frame

namespace stand {
inline constexpr RowOf<1> K_ww_tangent{"stand.[pass.]K_ww.tangent", "N/m", "3.5b",
                                       "the stand, contact of the two work rolls, tangent dF/d\u03b4"};
inline constexpr RowOf<1> K_ww_secant{"stand.[pass.]K_ww.secant", "N/m", "3.5a",
                                      "the stand, contact of the two work rolls, secant F/\u03b4"};
inline constexpr RowOf<1> K_bend{"stand.[pass.]K_bend", "N/m", "30.3",
                                 "the stand, bending of both work rolls under the strip"};
inline constexpr RowOf<1> modulus_kiss{"stand.[pass.]modulus.kiss", "N/m", "30.1",
                                       "the stand, mill modulus, work rolls touching, tangent"};
inline constexpr RowOf<1> modulus_kiss_secant{"stand.[pass.]modulus.kiss_secant", "N/m", "30.2",
                                              "the stand, mill modulus, work rolls touching, secant"};
inline constexpr RowOf<1> modulus_tangent{"stand.[pass.]modulus.tangent", "N/m", "30.1",
                                          "the stand, mill modulus with the strip, tangent dF/d\u03b4"};
inline constexpr RowOf<1> modulus_secant{"stand.[pass.]modulus.secant", "N/m", "30.2",
                                         "the stand, mill modulus with the strip, secant F/\u03b4"};
inline constexpr RowOf<1> modulus_by_width{"stand.[pass.]modulus.by_width", "N/m2", "30.10",
                                           "the stand, mill modulus, change with the width of the strip"};
inline constexpr RowOf<1> screw_sensitivity{"stand.[pass.]screw_sensitivity", "1", "30.7",
                                            "the stand, exit thickness per motion of the screw"};
inline constexpr RowOf<1> thickness_by_eccentricity{"stand.[pass.]thickness_by.eccentricity", "1", "30.7",
                                                    "the stand, exit thickness per growth of a roll's radius"};
inline constexpr RowOf<1> thickness_by_entry_thickness{"stand.[pass.]thickness_by.entry_thickness", "1", "30.8",
                                                       "the stand, exit thickness per entry thickness"};
inline constexpr RowOf<1> thickness_by_entry_tension{"stand.[pass.]thickness_by.entry_tension", "m/Pa", "30.8",
                                                     "the stand, exit thickness per back tension"};
inline constexpr RowOf<1> thickness_by_exit_tension{"stand.[pass.]thickness_by.exit_tension", "m/Pa", "30.8",
                                                    "the stand, exit thickness per front tension"};
inline constexpr RowOf<1> thickness_by_friction{"stand.[pass.]thickness_by.friction", "m", "30.8",
                                                "the stand, exit thickness per friction in the bite"};
inline constexpr RowOf<1> thickness_by_flow_stress{"stand.[pass.]thickness_by.flow_stress", "m", "30.8",
                                                   "the stand, exit thickness per factor on the flow stress"};
inline constexpr RowOf<1> thickness_by_roll_speed{"stand.[pass.]thickness_by.roll_speed", "s", "30.8",
                                                  "the stand, exit thickness per speed of the rolls"};
inline constexpr RowOf<1> force_by_screw{"stand.[pass.]force_by.screw", "N/m", "30.9",
                                         "the stand, rolling force per motion of the screw"};
inline constexpr RowOf<1> force_by_entry_thickness{"stand.[pass.]force_by.entry_thickness", "N/m", "30.9",
                                                   "the stand, rolling force per entry thickness"};
inline constexpr const ResultRow *all[]{&K_ww_tangent,
                                        &K_ww_secant,
                                        &K_bend,
                                        &modulus_kiss,
                                        &modulus_kiss_secant,
                                        &modulus_tangent,
                                        &modulus_secant,
                                        &modulus_by_width,
                                        &screw_sensitivity,
                                        &thickness_by_eccentricity,
                                        &thickness_by_entry_thickness,
                                        &thickness_by_entry_tension,
                                        &thickness_by_exit_tension,
                                        &thickness_by_friction,
                                        &thickness_by_flow_stress,
                                        &thickness_by_roll_speed,
                                        &force_by_screw,
                                        &force_by_entry_thickness};
}  // namespace stand
}  // namespace mill::row
