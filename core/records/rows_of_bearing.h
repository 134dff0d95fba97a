#pragma once
#include "core/records/result_row.h"

// Results of roller bearings, alone ("Kzc") and in the stand ("Kzc1" .. "Kzc4"), their ratings, and oil films.
namespace mill::row {
namespace bearing {
inline constexpr RowOf<1> tangent{"{bearing_spring}.tangent", "N/m", "5.23",
                                  "{bearing_spring}, tangent dF/d\u03b4"};
inline constexpr RowOf<1> secant{"{bearing_spring}.secant", "N/m", "5", "{bearing_spring}, secant F/\u03b4"};
inline constexpr RowOf<1> tangent_across{"{bearing_spring}.tangent_across", "N/m", "5.23",
                                         "{bearing_spring}, tangent across the load"};
inline constexpr RowOf<1> axial{"{bearing_spring}.axial", "N/m", "5.23",
                                "{bearing_spring}, axial tangent, other motions held"};
inline constexpr RowOf<1> tilting{"{bearing_spring}.tilting", "N m/rad", "5.23",
                                  "{bearing_spring}, tangent against tilt in the plane of the load"};
inline constexpr RowOf<1> axial_load{"{bearing_spring}.axial_load", "N", "5.22",
                                     "{bearing_spring}, axial force under the imposed axial displacement"};
inline constexpr RowOf<1> axial_displacement{"{bearing_spring}.axial_displacement", "m", "5.22",
                                             "{bearing_spring}, axial displacement of the inner ring"};
inline constexpr RowOf<1> tilt{"{bearing_spring}.tilt", "rad", "5.22",
                               "{bearing_spring}, tilt of the inner ring under the moment"};
inline constexpr RowOf<1> moment{"{bearing_spring}.moment", "N m", "5.22",
                                 "{bearing_spring}, moment that holds the imposed tilt"};
inline constexpr RowOf<1> roller_secant{"{bearing_spring}.roller_secant", "N/m", "5",
                                        "{bearing_spring}, most loaded roller between its raceways, secant"};
inline constexpr RowOf<1> roller_tangent{"{bearing_spring}.roller_tangent", "N/m", "5",
                                         "{bearing_spring}, most loaded roller between its raceways, tangent"};
inline constexpr RowOf<1> roller_max{"{bearing_spring}.roller_max", "N", "5.22",
                                     "{bearing_spring}, load of the most loaded roller"};
inline constexpr RowOf<2> row_share{"{bearing_spring}.row{n}_share", "1", "5.22",
                                    "{bearing_spring}, share of row {n} in the load"};
inline constexpr RowOf<2> row_axial{"{bearing_spring}.row{n}_axial", "N", "5.22",
                                    "{bearing_spring}, axial force of row {n}"};
inline constexpr RowOf<1> rib_max{"{bearing_spring}.rib_max", "N", "5.24",
                                  "{bearing_spring}, largest force of a roller on the rib"};
inline constexpr RowOf<1> heaviest_angle{"{bearing_spring}.heaviest_angle", "rad", "5",
                                         "{bearing_spring}, angle of the heaviest roller from the load line"};
inline constexpr RowOf<1> loaded_rollers{"{bearing_spring}.loaded_rollers", "1", "5",
                                         "{bearing_spring}, rollers that carry load in the fullest row"};
inline constexpr RowOf<1> closing_cup_angle{"{bearing_spring}.closing_cup_angle", "rad", "5.1",
                                            "{bearing_spring}, cup angle that closes the apex condition"};
inline constexpr RowOf<1> rollers_times_Z5{
    "{bearing_spring}.rollers_times_Z5", "N/m", "5",
    "{bearing_spring}, sum of the tangents of one roller per row, times Z/5"};
inline constexpr RowOf<1> rollers_times_stribeck{
    "{bearing_spring}.rollers_times_stribeck", "N/m", "5.15",
    "{bearing_spring}, sum of the tangents of one roller per row, times Z cos\u00b2\u03b1/4.085"};
inline constexpr RowOf<1> load_that_fits_tangent{
    "{bearing_spring}.load_that_fits_tangent", "N", "5",
    "{bearing_spring}, load at which the tangent takes the published value"};
inline constexpr RowOf<1> load_that_fits_secant{
    "{bearing_spring}.load_that_fits_secant", "N", "5",
    "{bearing_spring}, load at which the secant takes the published value"};
inline constexpr const ResultRow *all[]{&tangent,
                                        &secant,
                                        &tangent_across,
                                        &axial,
                                        &tilting,
                                        &axial_load,
                                        &axial_displacement,
                                        &tilt,
                                        &moment,
                                        &roller_secant,
                                        &roller_tangent,
                                        &roller_max,
                                        &row_share,
                                        &row_axial,
                                        &rib_max,
                                        &heaviest_angle,
                                        &loaded_rollers,
                                        &closing_cup_angle,
                                        &rollers_times_Z5,
                                        &rollers_times_stribeck,
                                        &load_that_fits_tangent,
                                        &load_that_fits_secant};
}  // namespace bearing

namespace motion {
inline constexpr RowOf<0> frequency{"Kzc.motion.frequency", "Hz", "16.2",
                                    "the bearing at its load, a mass on it, natural frequency along the load"};
inline constexpr RowOf<0> frequency_across{
    "Kzc.motion.frequency_across", "Hz", "16.2",
    "the bearing at its load, a mass on it, natural frequency across the load"};
inline constexpr RowOf<0> spectrum_peak{
    "Kzc.motion.spectrum_peak", "Hz", "16",
    "the bearing at its load, a mass on it, frequency of the highest line of the spectrum"};
inline constexpr RowOf<0> peak_acceleration{"Kzc.motion.peak_acceleration", "m/s2", "16.1",
                                            "the bearing at its load, a mass on it, largest acceleration"};
inline constexpr RowOf<0> peak_force{"Kzc.motion.peak_force", "N", "16.1",
                                     "the bearing at its load, a mass on it, largest force of the bearing"};
inline constexpr RowOf<0> without_contact{
    "Kzc.motion.without_contact", "1", "16.4",
    "the bearing at its load, a mass on it, share of the time without contact"};
inline constexpr const ResultRow *all[]{&frequency,         &frequency_across, &spectrum_peak,
                                        &peak_acceleration, &peak_force,       &without_contact};
}  // namespace motion

namespace rating {
inline constexpr RowOf<1> C{"bearing.{bearing}.C", "N", "5.29", "bearing {bearing}, basic dynamic rating"};
inline constexpr RowOf<1> C0{"bearing.{bearing}.C0", "N", "5.29", "bearing {bearing}, basic static rating"};
inline constexpr RowOf<1> P{"bearing.{bearing}.P", "N", "5.32", "bearing {bearing}, equivalent dynamic load"};
inline constexpr RowOf<1> S0{"bearing.{bearing}.S0", "1", "5.33", "bearing {bearing}, static safety"};
inline constexpr RowOf<1> L10{"bearing.{bearing}.L10", "1", "5.34",
                              "bearing {bearing}, basic rating life in revolutions"};
inline constexpr RowOf<1> L10r{"bearing.{bearing}.L10r", "1", "5.37",
                               "bearing {bearing}, reference rating life by slices in revolutions"};
inline constexpr RowOf<1> L10mr{"bearing.{bearing}.L10mr", "1", "5.39",
                                "bearing {bearing}, modified reference rating life in revolutions"};
inline constexpr RowOf<1> L10_time{"bearing.{bearing}.L10_time", "s", "5.34",
                                   "bearing {bearing}, basic rating life at the speed"};
inline constexpr RowOf<1> L10r_time{"bearing.{bearing}.L10r_time", "s", "5.37",
                                    "bearing {bearing}, reference rating life by slices at the speed"};
inline constexpr RowOf<1> L10mr_time{"bearing.{bearing}.L10mr_time", "s", "5.39",
                                     "bearing {bearing}, modified reference rating life at the speed"};
inline constexpr RowOf<1> cage_speed{"bearing.{bearing}.cage_speed", "Hz", "32.10",
                                     "bearing {bearing}, speed of the cage"};
inline constexpr RowOf<1> centrifugal_force{"bearing.{bearing}.centrifugal_force", "N", "5",
                                            "bearing {bearing}, centrifugal force of a roller"};
inline constexpr RowOf<1> rollers_per_row{
    "bearing.{bearing}.rollers_per_row", "1", "5.41",
    "bearing {bearing}, rollers of a row, estimated from the published ratings"};
inline constexpr RowOf<1> roller_diameter{
    "bearing.{bearing}.roller_diameter", "m", "5.41",
    "bearing {bearing}, diameter of a roller, estimated from the published ratings"};
inline constexpr RowOf<1> roller_length{
    "bearing.{bearing}.roller_length", "m", "5.40",
    "bearing {bearing}, length of a roller, estimated from the published ratings"};
inline constexpr RowOf<1> cup_angle{"bearing.{bearing}.cup_angle", "rad", "5.41",
                                    "bearing {bearing}, cup angle, estimated from the published ratings"};
inline constexpr RowOf<1> stiffness_spread{
    "bearing.{bearing}.stiffness_spread", "1", "5.30",
    "bearing {bearing}, spread of the stiffness over the estimated rollers"};
inline constexpr const ResultRow *all[]{&C,
                                        &C0,
                                        &P,
                                        &S0,
                                        &L10,
                                        &L10r,
                                        &L10mr,
                                        &L10_time,
                                        &L10r_time,
                                        &L10mr_time,
                                        &cage_speed,
                                        &centrifugal_force,
                                        &rollers_per_row,
                                        &roller_diameter,
                                        &roller_length,
                                        &cup_angle,
                                        &stiffness_spread};
}  // namespace rating

namespace film {
inline constexpr RowOf<1> eccentricity{"bearing.{bearing}.film.eccentricity", "1", "29.2",
                                       "bearing {bearing}, oil film, eccentricity divided by the clearance"};
inline constexpr RowOf<1> attitude{"bearing.{bearing}.film.attitude", "rad", "29.2",
                                   "bearing {bearing}, oil film, angle between load and narrowest gap"};
inline constexpr RowOf<1> minimum_film{"bearing.{bearing}.film.minimum_film", "m", "29.1",
                                       "bearing {bearing}, oil film, thinnest film"};
inline constexpr RowOf<1> peak_pressure{"bearing.{bearing}.film.peak_pressure", "Pa", "29.2",
                                        "bearing {bearing}, oil film, largest pressure"};
inline constexpr RowOf<1> power_loss{"bearing.{bearing}.film.power_loss", "W", "29.10",
                                     "bearing {bearing}, oil film, power lost to friction"};
inline constexpr RowOf<1> friction_torque{"bearing.{bearing}.film.friction_torque", "N m", "29.10",
                                          "bearing {bearing}, oil film, torque of the friction"};
inline constexpr RowOf<1> side_flow{"bearing.{bearing}.film.side_flow", "m3/s", "29.9",
                                    "bearing {bearing}, oil film, oil that leaves at both ends"};
inline constexpr RowOf<1> temperature{"bearing.{bearing}.film.temperature", "K", "29.12",
                                      "bearing {bearing}, oil film, temperature of the film"};
inline constexpr RowOf<1> outlet_temperature{"bearing.{bearing}.film.outlet_temperature", "K", "29.12",
                                             "bearing {bearing}, oil film, temperature of the oil that leaves"};
inline constexpr RowOf<1> viscosity{"bearing.{bearing}.film.viscosity", "Pa s", "29.11",
                                    "bearing {bearing}, oil film, viscosity at the film's temperature"};
inline constexpr RowOf<1> sommerfeld{"bearing.{bearing}.film.sommerfeld", "1", "29.5",
                                     "bearing {bearing}, oil film, Sommerfeld number"};
inline constexpr RowOf<1> k_xx{"bearing.{bearing}.film.k_xx", "N/m", "29.7",
                               "bearing {bearing}, oil film, stiffness along the load"};
inline constexpr RowOf<1> b_xx{"bearing.{bearing}.film.b_xx", "N s/m", "29.7",
                               "bearing {bearing}, oil film, damping along the load"};
inline constexpr RowOf<1> k_xy{"bearing.{bearing}.film.k_xy", "N/m", "29.7",
                               "bearing {bearing}, oil film, stiffness, force along by motion across"};
inline constexpr RowOf<1> b_xy{"bearing.{bearing}.film.b_xy", "N s/m", "29.7",
                               "bearing {bearing}, oil film, damping, force along by motion across"};
inline constexpr RowOf<1> k_yx{"bearing.{bearing}.film.k_yx", "N/m", "29.7",
                               "bearing {bearing}, oil film, stiffness, force across by motion along"};
inline constexpr RowOf<1> b_yx{"bearing.{bearing}.film.b_yx", "N s/m", "29.7",
                               "bearing {bearing}, oil film, damping, force across by motion along"};
inline constexpr RowOf<1> k_yy{"bearing.{bearing}.film.k_yy", "N/m", "29.7",
                               "bearing {bearing}, oil film, stiffness across the load"};
inline constexpr RowOf<1> b_yy{"bearing.{bearing}.film.b_yy", "N s/m", "29.7",
                               "bearing {bearing}, oil film, damping across the load"};
inline constexpr RowOf<1> k_static{"bearing.{bearing}.film.k_static", "N/m", "29.7",
                                   "bearing {bearing}, oil film, slope of the load over the displacement at rest"};
inline constexpr RowOf<1> least_speed{"bearing.{bearing}.film.least_speed", "Hz", "29",
                                      "bearing {bearing}, oil film, speed from which a film carries"};
inline constexpr RowOf<1> tilting_stiffness{"bearing.{bearing}.film.tilting_stiffness", "N m/rad", "29.7",
                                            "bearing {bearing}, oil film, moment per tilt"};
inline constexpr RowOf<1> layer_stiffness{"bearing.{bearing}.film.layer_stiffness", "N/m", "29.16",
                                          "bearing {bearing}, oil film, stiffness of bush and sleeve"};
inline constexpr RowOf<1> series_stiffness{"bearing.{bearing}.film.series_stiffness", "N/m", "29.16",
                                           "bearing {bearing}, oil film, rigid film and layers in series"};
/// Along the load (0) and across it (1): k_xy is the force along it by motion across.
inline constexpr const RowOf<1> *stiffness[2][2]{{&k_xx, &k_xy}, {&k_yx, &k_yy}};
inline constexpr const RowOf<1> *damping[2][2]{{&b_xx, &b_xy}, {&b_yx, &b_yy}};
inline constexpr const ResultRow *all[]{&eccentricity,
                                        &attitude,
                                        &minimum_film,
                                        &peak_pressure,
                                        &power_loss,
                                        &friction_torque,
                                        &side_flow,
                                        &temperature,
                                        &outlet_temperature,
                                        &viscosity,
                                        &sommerfeld,
                                        &k_xx,
                                        &b_xx,
                                        &k_xy,
                                        &b_xy,
                                        &k_yx,
                                        &b_yx,
                                        &k_yy,
                                        &b_yy,
                                        &k_static,
                                        &least_speed,
                                        &tilting_stiffness,
                                        &layer_stiffness,
                                        &series_stiffness};
}  // namespace film
}  // namespace mill::row
