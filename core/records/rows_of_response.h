#pragma once
#include "core/records/result_row.h"

// Results of motion: levels of the passes, frequency response, Campbell diagram, curves of contacts, marks,
// advice; values of measured records and of a calibration.
namespace mill::row {
namespace response {
inline constexpr RowOf<2> peak{"{pass}.peak_g.{work_roll}", "g", "6.1",
                               "{pass}, largest acceleration, {work_roll}"};
inline constexpr RowOf<2> rms{"{pass}.rms_g.{work_roll}", "g", "6.1", "{pass}, rms acceleration, {work_roll}"};
inline constexpr RowOf<2> frf_peak{"frf.{excited}.{place}.peak", "1/kg", "32.3",
                                   "accelerance at the {place} under a {excited}, largest magnitude"};
inline constexpr RowOf<2> frf_frequency{
    "frf.{excited}.{place}.frequency", "Hz", "32.3",
    "accelerance at the {place} under a {excited}, frequency of the largest magnitude"};
inline constexpr RowOf<1> campbell_speed{"campbell.{mode}.speed", "m/s", "32.9",
                                         "resonance of mode {mode} with what turns, speed of the rolls' surface"};
inline constexpr RowOf<1> campbell_distance{
    "campbell.{mode}.distance", "1", "32.9",
    "resonance of mode {mode} with what turns, distance from the working range"};
inline constexpr const ResultRow *all[]{
    &peak, &rms, &frf_peak, &frf_frequency, &campbell_speed, &campbell_distance};
}  // namespace response

namespace nonlinear {
inline constexpr RowOf<2> level{"nonlinear.{pass}.level.{work_roll}", "1", "36.4",
                                "contacts and bearings on their curves, {pass}, rms acceleration of the "
                                "{work_roll} over that of the linear run"};
inline constexpr RowOf<2> least_force{"nonlinear.{pass}.least_force.{spring}", "1", "36.4",
                                      "contacts and bearings on their curves, {pass}, smallest force of {spring} "
                                      "over that at rest"};
inline constexpr RowOf<1> scale_to_part{"nonlinear.{pass}.scale_to_part", "1", "36",
                                        "contacts and bearings on their curves, {pass}, multiple of the record at "
                                        "which a contact parts"};
inline constexpr RowOf<2> bend{
    "nonlinear.{pass}.bend.f{n}", "1", "36.9",
    "contacts and bearings on their curves, {pass}, change of the frequency of mode {n} "
    "until a contact parts"};
inline constexpr RowOf<1> parting_force{"nonlinear.{pass}.parting_force", "N", "36.10",
                                        "contacts and bearings on their curves, {pass}, amplitude of a harmonic "
                                        "force that parts a contact"};
inline constexpr RowOf<1> parting_frequency{"nonlinear.{pass}.parting_frequency", "Hz", "36.10",
                                            "contacts and bearings on their curves, {pass}, frequency of the "
                                            "harmonic force that parts a contact"};
inline constexpr const ResultRow *all[]{&level, &least_force,   &scale_to_part,
                                        &bend,  &parting_force, &parting_frequency};
}  // namespace nonlinear

namespace marks {
inline constexpr RowOf<0> frequency{"marks.frequency", "Hz", "40.1", "frequency of the marks on the strip"};
inline constexpr RowOf<1> per_turn{"marks.{body}.per_turn", "1", "40.2", "marks on one turn of the {body}"};
inline constexpr RowOf<1> rotation{"marks.{body}.rotation", "Hz", "40.1", "turns of the {body} in a second"};
inline constexpr RowOf<1> speed{"marks.{mode}.speed", "m/s", "40.1",
                                "{mode}, speed of the strip at which it makes this spacing"};
inline constexpr const ResultRow *all[]{&frequency, &per_turn, &rotation, &speed};
}  // namespace marks

namespace advice {
inline constexpr RowOf<1> level{"advice.level.{place}", "m/s2", "46.2",
                                "rms acceleration of the {place} under the measured force"};
inline constexpr RowOf<0> best_change{"advice.best.change", "1", "46",
                                      "relative change of the goal by the best action"};
inline constexpr RowOf<0> best_critical_speed{"advice.best.critical_speed", "m/s", "46",
                                              "critical speed with the best action"};
inline constexpr RowOf<0> critical_speed{"advice.critical_speed", "m/s", "25.9",
                                         "critical speed without any action"};
inline constexpr RowOf<1> tuned_mass{"advice.tuned_damper.[n.]mass", "kg", "46", "tuned damper, its mass"};
inline constexpr RowOf<1> tuned_frequency{"advice.tuned_damper.[n.]frequency", "Hz", "46",
                                          "tuned damper, its frequency"};
inline constexpr RowOf<1> tuned_damping{"advice.tuned_damper.[n.]damping", "1", "46",
                                        "tuned damper, its damping ratio"};
inline constexpr RowOf<1> tuned_change{"advice.tuned_damper.[n.]change", "1", "46",
                                       "tuned damper, relative change of the level"};
inline constexpr const ResultRow *all[]{&level,      &best_change,     &best_critical_speed, &critical_speed,
                                        &tuned_mass, &tuned_frequency, &tuned_damping,       &tuned_change};
}  // namespace advice

namespace record {
inline constexpr RowOf<1> rms{"{channel}.rms", "", "41", "channel {channel}, rms without offset and drift"};
inline constexpr RowOf<1> peak{"{channel}.peak", "", "41", "channel {channel}, largest sample"};
inline constexpr RowOf<1> crest{"{channel}.crest", "1", "41", "channel {channel}, peak over rms"};
inline constexpr RowOf<1> drift{"{channel}.drift", "", "41", "channel {channel}, slope of the line through it"};
inline constexpr RowOf<1> clipped{"{channel}.clipped", "1", "41",
                                  "channel {channel}, share of the samples at a clip level"};
inline constexpr RowOf<1> velocity_rms{
    "{channel}.velocity_rms", "m/s", "41",
    "channel {channel}, rms velocity from 10 to 1000 Hz, or to where the record ends"};
inline constexpr RowOf<1> velocity_rms_ratio{"{channel}.velocity_rms_ratio", "1", "41",
                                             "channel {channel}, rms velocity over that of the baseline"};
inline constexpr RowOf<2> band_rms{"{channel}.{band}_rms", "", "41", "channel {channel}, rms in the band {band}"};
inline constexpr const ResultRow *all[]{
    &rms, &peak, &crest, &drift, &clipped, &velocity_rms, &velocity_rms_ratio, &band_rms};
}  // namespace record

namespace calibration {
inline constexpr RowOf<1> factor{"factor.{key}", "1", "44", "calibrated factor on {key}"};
inline constexpr RowOf<0> delay{"delay", "s", "44", "calibrated delay of the force against the accelerations"};
inline constexpr RowOf<0> misfit_before{"misfit.check.before", "1", "44",
                                        "misfit of the check records, case without changes"};
inline constexpr RowOf<0> misfit_after{"misfit.check.after", "1", "44",
                                       "misfit of the check records, calibrated case"};
inline constexpr RowOf<0> worst_band_fit{
    "worst_band.fit", "1", "44", "residual over noise and model error, over its limit, worst band of the fit"};
inline constexpr RowOf<0> worst_band_check{
    "worst_band.check", "1", "44",
    "residual over noise and model error, over its limit, worst band of the check records"};
inline constexpr const ResultRow *all[]{&factor,       &delay,          &misfit_before,
                                        &misfit_after, &worst_band_fit, &worst_band_check};
}  // namespace calibration
}  // namespace mill::row
