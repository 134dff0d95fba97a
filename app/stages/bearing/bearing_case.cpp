#include "core/model/bearing_case.h"
#include "app/run/curve_files.h"
#include "app/stages/bearing/bearing_files.h"
#include "app/stages/bearing/bearing_published.h"
#include "app/stages/bearing/bearing_ratings.h"
#include "app/stages/bearing/bearing_results.h"
#include "app/stages/bearing/bearing_stage.h"
#include "app/stages/bearing/oil_film_results.h"
#include "core/case/bearing_inputs.h"
#include "core/model/case.h"
#include "core/numerics/log_spacing.h"
#include "core/records/csv.h"
#include "core/records/rows_of_bearing.h"
#include "dynamics/bearing/dynamics.h"
#include "reduce/bearing/clearance.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// The mass swings on the computed curve; its force is the same in every direction, as that of a round bearing.
void drive_mass(RunContext &run, const BearingCase &spec, const BearingStudy &study)
{
  const BearingExcitation &e = spec.motion;
  if (std::isnan(e.mass))
    return;
  StageTimer timer(run, "bearing dynamics");
  dynamics::BearingOscillator mass;
  mass.mass    = e.mass;
  mass.damping = e.damping;
  const auto n = Eigen::Index(study.curve.states.size());
  mass.curve.displacement.resize(n);
  mass.curve.force.resize(n);
  mass.curve.tangent.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto &state          = study.curve.states[std::size_t(i)];
    mass.curve.displacement[i] = state.motion[0];
    mass.curve.force[i]        = state.load[0];
    mass.curve.tangent[i]      = bearing::radial_tangent(state, study.loading);
  }
  mass.mean_load    = {spec.load.radial, 0};
  mass.direction    = {std::cos(e.direction), std::sin(e.direction)};
  mass.amplitude    = e.amplitude;
  mass.frequency    = e.frequency;
  const auto motion = dynamics::simulate(mass, e.duration, e.output_rate);
  run.out.write_table("response/bearing-" + slug(spec.load.bearing), dynamics::bearing_response_table(motion));
  write_curve(run, curve::bearing_spectrum, slug(spec.load.bearing), dynamics::bearing_spectrum_table(motion));
  const auto add = [&](const RowOf<0> &row, const double value, const std::string &method,
                       std::vector<Check> checks = {}) {
    Parameter p;
    p.value  = value;
    p.unit   = row.unit;
    p.method = method;
    p.at     = {"{}, {} at {}",
                {{spec.load.radial, "kN", ".4g"}, {e.amplitude, "kN", ".4g"}, {e.frequency, "Hz", ".4g"}}};
    p.checks = std::move(checks);
    p.inputs = bearing_case_keys(*run.keys, {BearingAsks::motion});
    run.results.add(row.of(), p);
  };
  const double linear = std::sqrt(study.numbers.tangent.value / e.mass) / (2 * M_PI);
  add(row::motion::frequency, motion.frequency_along, "small motions about the load, on the interpolated curve",
      {{"tangent of the assembled bearing", linear, ""}});
  add(row::motion::frequency_across, motion.frequency_across,
      "small motions across the load, on the interpolated curve",
      {{"tangent of the assembled bearing across the load",
        std::sqrt(study.numbers.tangent_across.value / e.mass) / (2 * M_PI),
        "a bearing in a chock is not the same all round"}});
  add(row::motion::spectrum_peak, motion.spectrum_peak, "highest line of the acceleration's spectrum");
  add(row::motion::peak_acceleration, motion.peak_acceleration, "time integration on the bearing's curve");
  add(row::motion::peak_force, motion.peak_force, "time integration on the bearing's curve");
  add(row::motion::without_contact, motion.without_contact,
      "share of the time, from the instants of loss and return");
  for (const std::string &note : motion.notes)
    run.assume(note);
}
}  // namespace

BearingStudy add_bearing_case(RunContext &run, const BearingCase &spec)
{
  BearingQuestion q = question_of(spec);
  if (spec.load.radial > 0)
    q.loads = evenly_in_logarithm(spec.load.loads[0], spec.load.loads[1], spec.load.samples);
  q.published            = spec.published;
  q.published_total      = "Kzc";
  const auto parts       = bearing_parts(run, q.bearing, bearing::largest_roller_load(q.bearing, q));
  BearingStudy study     = study_bearing(run, parts, q);
  const KeysOfRow inputs = [&run](const ResultRow &row) {
    return bearing_case_keys(*run.keys, reading_of_bearing(row));
  };
  add_bearing_results(run, "Kzc", study, inputs, bearing_case_closing_angle_keys(*run.keys));
  add_published_results(run, "Kzc", study, inputs);
  add_rating_results(run, study, inputs);
  return study;
}

void solve_bearing_case(RunContext &run, const BearingCase &spec)
{
  if (const OilFilmBearing *film = oil_film_of(spec.oil_films, spec.load.bearing))
    return solve_oil_film_case(run, spec, *film);
  const BearingStudy study = add_bearing_case(run, spec);
  note_bearing(run, "Kzc", study);
  write_bearing(run, study);
  study.readings->keep(run);
  if (study.question.cage_angle == 0)  // the field is symmetric about the load line
    write_chock(run, study.question.bearing, study.at.roller_load);
  drive_mass(run, spec, study);
}
}  // namespace mill
