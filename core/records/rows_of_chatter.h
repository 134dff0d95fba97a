#pragma once
#include "core/records/result_row.h"

// Results of chatter, of a pass, a condition or a tandem.
namespace mill::row::chatter {
inline constexpr RowOf<1> critical_speed{"chatter.{pass}.critical_speed", "m/s", "25.9",
                                         "chatter, {pass}, roll speed at which vibration begins to grow"};
inline constexpr RowOf<1> critical_speed_highest{
    "chatter.{pass}.critical_speed_highest", "m/s", "25",
    "chatter, {pass}, roll speed at which vibration begins to grow, by the most stable model of the stand"};
inline constexpr RowOf<1> critical_speed_low{"chatter.{pass}.critical_speed_low", "m/s", "27.13",
                                             "chatter, {pass}, critical speed, lower end of its 95 % interval"};
inline constexpr RowOf<1> critical_speed_high{"chatter.{pass}.critical_speed_high", "m/s", "27.13",
                                              "chatter, {pass}, critical speed, upper end of its 95 % interval"};
inline constexpr RowOf<1> frequency{"chatter.{pass}.frequency", "Hz", "25.4",
                                    "chatter, {pass}, frequency of the critical mode"};
inline constexpr RowOf<1> growth_rate{"chatter.{pass}.growth_rate", "1/s", "25.4",
                                      "chatter, {pass}, growth rate at the working speed"};
inline constexpr RowOf<1> gap_mode_frequency{"chatter.{pass}.gap_mode_frequency", "Hz", "25.4",
                                             "chatter, {pass}, frequency of the gap mode at the working speed"};
inline constexpr RowOf<1> gap_mode_damping{"chatter.{pass}.gap_mode_damping", "1", "25.4",
                                           "chatter, {pass}, damping ratio of the gap mode at the working speed"};
inline constexpr RowOf<1> working_frequency{
    "chatter.{pass}.working_frequency", "Hz", "25.4",
    "chatter, {pass}, frequency of the least stable mode at the working speed"};
inline constexpr RowOf<1> unstable_roots{"chatter.{pass}.unstable_roots", "1", "25.4",
                                         "chatter, {pass}, roots that grow at the working speed, both of a pair"};
inline constexpr RowOf<1> margin{"chatter.{pass}.margin", "1/s", "25.9",
                                 "chatter, {pass}, growth rate nearest to the other verdict"};
inline constexpr RowOf<1> margin_speed{
    "chatter.{pass}.margin_speed", "m/s", "25.9",
    "chatter, {pass}, roll speed of the growth rate nearest to the other verdict"};
inline constexpr RowOf<1> lowest_speed_with_bite{"chatter.{pass}.lowest_speed_with_bite", "m/s", "25",
                                                 "chatter, {pass}, lowest roll speed with a steady bite"};
inline constexpr RowOf<1> work_roll_ratio{
    "chatter.{pass}.work_roll_ratio", "1", "25",
    "chatter, {pass}, amplitude of the upper over that of the lower work roll"};
inline constexpr RowOf<1> force_phase{"chatter.{pass}.force_phase", "deg", "25.12",
                                      "chatter, {pass}, phase of the force against the gap"};
inline constexpr RowOf<1> entry_tension_phase{"chatter.{pass}.entry_tension_phase", "deg", "25",
                                              "chatter, {pass}, phase of the back tension against the gap"};
inline constexpr RowOf<1> exit_tension_phase{"chatter.{pass}.exit_tension_phase", "deg", "25",
                                             "chatter, {pass}, phase of the front tension against the gap"};
inline constexpr RowOf<1> friction_phase{"chatter.{pass}.friction_phase", "deg", "25.12",
                                         "chatter, {pass}, phase of the friction against the gap"};
inline constexpr RowOf<1> process_damping{
    "chatter.{pass}.process_damping", "N s/m", "25.6",
    "chatter, {pass}, damping that strip and bite take away (positive) or add"};
inline constexpr RowOf<1> limit_cycle_amplitude{"chatter.{pass}.limit_cycle_amplitude", "m", "26",
                                                "chatter, {pass}, limit cycle, half the gap's peak to peak"};
inline constexpr RowOf<1> limit_cycle_frequency{"chatter.{pass}.limit_cycle_frequency", "Hz", "26",
                                                "chatter, {pass}, limit cycle, frequency"};
inline constexpr RowOf<1> critical_speed_without_delay{
    "chatter.{pass}.critical_speed_without_delay", "m/s", "28.2",
    "chatter, {pass}, roll speed at which vibration begins to grow, with shared tension alone"};
inline constexpr RowOf<1> speed_stable_for_any_distance{
    "chatter.{pass}.speed_stable_for_any_distance", "m/s", "28.8",
    "chatter, {pass}, roll speed that is stable whatever the distance of the stands"};
/// The same search by another linearisation, on another stand of the case, by another model of this stand.
inline constexpr RowOf<2> scheme_critical_speed{
    "chatter.{pass}.scheme.{scheme}.critical_speed", "m/s", "25.9",
    "chatter, {pass}, {scheme} linearisation, roll speed at which vibration begins to grow"};
inline constexpr RowOf<2> scheme_frequency{
    "chatter.{pass}.scheme.{scheme}.frequency", "Hz", "25.4",
    "chatter, {pass}, {scheme} linearisation, frequency of the critical mode"};
inline constexpr RowOf<2> scheme_work_roll_ratio{
    "chatter.{pass}.scheme.{scheme}.work_roll_ratio", "1", "25",
    "chatter, {pass}, {scheme} linearisation, amplitude of the upper over that of the lower work roll"};
inline constexpr RowOf<2> variant_critical_speed{
    "chatter.{pass}.variant.{variant}.critical_speed", "m/s", "25.9",
    "chatter, {pass}, variant {variant}, roll speed at which vibration begins to grow"};
inline constexpr RowOf<2> variant_frequency{"chatter.{pass}.variant.{variant}.frequency", "Hz", "25.4",
                                            "chatter, {pass}, variant {variant}, frequency of the critical mode"};
inline constexpr RowOf<2> variant_work_roll_ratio{
    "chatter.{pass}.variant.{variant}.work_roll_ratio", "1", "25",
    "chatter, {pass}, variant {variant}, amplitude of the upper over that of the lower work roll"};
inline constexpr RowOf<2> structure_critical_speed{
    "chatter.{pass}.structure.{structure}.critical_speed", "m/s", "25.9",
    "chatter, {pass}, stand as {structure}, roll speed at which vibration begins to grow"};
inline constexpr RowOf<2> structure_frequency{
    "chatter.{pass}.structure.{structure}.frequency", "Hz", "25.4",
    "chatter, {pass}, stand as {structure}, frequency of the critical mode"};
inline constexpr RowOf<2> structure_work_roll_ratio{
    "chatter.{pass}.structure.{structure}.work_roll_ratio", "1", "25",
    "chatter, {pass}, stand as {structure}, amplitude of the upper over that of the lower work roll"};
inline constexpr RowOf<2> friction_slope{
    "chatter.{pass}.friction_slope.{key}", "1", "27.1",
    "chatter, {pass}, relative change of the friction per relative change of {key}"};
inline constexpr RowOf<2> speed_slope{
    "chatter.{pass}.speed_slope.{key}", "1", "27.4",
    "chatter, {pass}, relative change of the critical speed per relative change of {key}"};

/// Rows of the searches of one group.
struct Search {
  const RowOf<2> *critical_speed, *frequency, *work_roll_ratio;
};
inline constexpr Search by_scheme{&scheme_critical_speed, &scheme_frequency, &scheme_work_roll_ratio};
inline constexpr Search of_variant{&variant_critical_speed, &variant_frequency, &variant_work_roll_ratio};
inline constexpr Search of_structure{&structure_critical_speed, &structure_frequency, &structure_work_roll_ratio};

/// Of other searches and by one input, of which a reader wants many side by side.
inline constexpr const ResultRow *of_variants[]{
    &scheme_critical_speed,    &scheme_frequency,    &scheme_work_roll_ratio,
    &variant_critical_speed,   &variant_frequency,   &variant_work_roll_ratio,
    &structure_critical_speed, &structure_frequency, &structure_work_roll_ratio,
    &friction_slope,           &speed_slope};

inline constexpr const ResultRow *all[]{&critical_speed,
                                        &critical_speed_highest,
                                        &critical_speed_low,
                                        &critical_speed_high,
                                        &frequency,
                                        &growth_rate,
                                        &gap_mode_frequency,
                                        &gap_mode_damping,
                                        &working_frequency,
                                        &unstable_roots,
                                        &margin,
                                        &margin_speed,
                                        &lowest_speed_with_bite,
                                        &work_roll_ratio,
                                        &force_phase,
                                        &entry_tension_phase,
                                        &exit_tension_phase,
                                        &friction_phase,
                                        &process_damping,
                                        &limit_cycle_amplitude,
                                        &limit_cycle_frequency,
                                        &critical_speed_without_delay,
                                        &speed_stable_for_any_distance,
                                        &scheme_critical_speed,
                                        &scheme_frequency,
                                        &scheme_work_roll_ratio,
                                        &variant_critical_speed,
                                        &variant_frequency,
                                        &variant_work_roll_ratio,
                                        &structure_critical_speed,
                                        &structure_frequency,
                                        &structure_work_roll_ratio,
                                        &friction_slope,
                                        &speed_slope};
}  // namespace mill::row::chatter
