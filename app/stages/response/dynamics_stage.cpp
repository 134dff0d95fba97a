#include "app/stages/response/dynamics_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/nonlinear_stage.h"
#include "app/stages/stand/mode_results.h"
#include "core/base/force_text.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include "core/records/rows_of_stand.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/pass_study.h"
#include "dynamics/response/rolling_force.h"
#include "reduce/stand/gap_modes.h"
#include "twin/records/force_record.h"
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace mill {
namespace {
// Keys behind the work rolls of the chain, each driven with its half; one of another model moves with the whole.
std::array<KeyList, 2> inputs_of(const LumpedModel &model, const DynamicsSettings &settings, const bool six_masses)
{
  const bool measured = settings.force_meaning == ForceMeaning::measured;
  const auto half     = [&](const Half one) {
    return joined(chain_number_keys(model, settings, one), measured ? KeyList() : model.C.inputs);
  };
  const KeyList upper = half(Half::upper), lower = half(Half::lower), both = joined(upper, lower);
  return six_masses ? std::array<KeyList, 2>{upper, lower} : std::array<KeyList, 2>{both, both};
}

constexpr std::array<const char *, 2> driven_rolls{"upper_work_roll", "lower_work_roll"};

double in_g(const double acceleration)
{
  return acceleration / dynamics::standard_gravity;
}
}  // namespace

bool has_force(const Pass &pass)
{
  return !pass.force_file.empty() || !std::isnan(pass.synthetic_range[0]);
}

double working_load(const Pass &pass, const ForceRecord &force)
{
  return std::isnan(pass.load) ? force.force.mean() : pass.load;
}

MeasuredRecord measured_of(const Pass &pass, const ForceRecord &force)
{
  MeasuredRecord measured = twin::read_measured(pass.measured_file);
  if (measured.start && force.start)
    measured.time.array() += *measured.start - *force.start;
  else if (measured.start || force.start)
    measured.notes.push_back(
        fmt::format("only the {} record has a date; both are taken to begin at the same moment",
                    measured.start ? "measured" : "force"));
  return measured;
}

ForceRecord force_of(const Pass &pass)
{
  if (!pass.force_file.empty())
    return twin::read_force(pass.force_file);
  dynamics::NoiseSettings noise;
  noise.range     = pass.synthetic_range;
  noise.duration  = pass.synthetic_duration;
  noise.bandwidth = pass.synthetic_bandwidth;
  noise.rate      = 10 * pass.synthetic_bandwidth;
  noise.seed      = std::uint64_t(pass.synthetic_seed);
  if (noise.duration * noise.rate > 2e7)
    throw InputError(
        pass.place,
        fmt::format("{}: synthetic_duration x synthetic_bandwidth asks for {:.3g} samples (ten per period "
                    "of the bandwidth); at most 2e7 are made, lower one of them",
                    pass.name, noise.duration * noise.rate));
  return dynamics::synthetic_force(noise);
}

std::optional<Warning> load_against_record(const Pass &pass, const std::size_t p, const double mean)
{
  if (std::isnan(pass.load) || !(std::abs(pass.load / mean - 1) > 0.05))
    return {};
  return Warning{WarningId::load_off_record,
                 pass.name,
                 fmt::format("pass.load is {}, the mean of its force record {}", in_kN(pass.load), in_kN(mean)),
                 "stiffnesses belong to the first, accelerations to the second",
                 "",
                 {pass.name},
                 fmt::format("pass.{}.load", p)};
}

namespace {
// The damped chain: its poles need not belong to the undamped modes one by one.
void write_poles(RunContext &run, const dynamics::MillModel &chain)
{
  const auto poles = dynamics::poles(chain);
  const auto n     = Eigen::Index(poles.size());
  Eigen::VectorXd frequency(n), damping(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    frequency[i] = poles[std::size_t(i)].frequency;
    damping[i]   = poles[std::size_t(i)].damping;
  }
  Table table;
  table.add("pole", "", Eigen::VectorXd::LinSpaced(n, 1, double(n)))
      .add("frequency", "Hz", frequency)
      .add("damping", "", damping);
  write_curve(run, curve::poles, "", table);
}
}  // namespace

ChainModes chain_modes(const LumpedModel &model, const DynamicsSettings &settings)
{
  ChainModes all;
  all.chain = dynamics::mill_model(model, settings);
  all.modes = dynamics::modes(all.chain);
  for (Eigen::Index i = 0; i < all.modes.frequency.size(); ++i)
    all.half.push_back(all.modes.kinetic_share.row(i).head(3).sum() > 0.5 ? Half::upper : Half::lower);
  return all;
}

HorizontalModes horizontal_modes(const LumpedModel &model, const double chock_seat,
                                 const std::array<double, 2> &chock_mass)
{
  dynamics::ChockSeats seats;
  seats.stiffness  = {chock_seat, chock_seat};
  seats.chock_mass = chock_mass;
  HorizontalModes all;
  all.rolls = dynamics::horizontal_model(model, seats);
  if (all.rolls.M.size() == 0)
    return all;
  all.modes = dynamics::modes(all.rolls);
  for (Eigen::Index i = 0; i < all.modes.frequency.size(); ++i) {
    Eigen::Index most = 0;
    all.modes.kinetic_share.row(i).maxCoeff(&most);
    all.mover.push_back(all.rolls.labels[std::size_t(most)]);
    all.roll.push_back(all.rolls.rolls[std::size_t(most)]);
  }
  return all;
}

namespace {
// Shapes, one a column, over their largest component.
Eigen::MatrixXd to_largest(const Eigen::MatrixXd &shape)
{
  return shape.array().rowwise() / shape.cwiseAbs().colwise().maxCoeff().array();
}

// @param named  state whose names the results get
void add_vertical_modes(RunContext &run, const LumpedModel &model, const DynamicsSettings &settings,
                        const GapState named)
{
  const auto [chain, modes, half] = chain_modes(model, settings);
  const auto n                    = modes.frequency.size();
  Table table;
  table.add("mode", "", Eigen::VectorXd::LinSpaced(n, 1, double(n))).add("frequency", "Hz", modes.frequency);
  table.add("gap_share", "", reduce::gap_shares(modes.frequency, modes.shape, chain.b));
  const Eigen::MatrixXd y = to_largest(modes.shape);
  for (Eigen::Index j = 0; j < n; ++j)
    table.add("y" + std::to_string(j + 1), "", y.row(j).transpose());
  for (std::size_t s = 0; s < chain.springs.size(); ++s)
    table.add("energy_" + chain.springs[s].name, "", modes.strain_share.col(Eigen::Index(s)));
  if (named == GapState::open)
    write_curve(run, curve::modes_of_model, "open", table);
  else {
    write_curve(run, curve::modes, "", table);
    write_poles(run, chain);
  }
  const bool strip = driven_state(settings) == GapState::rolling;
  for (Eigen::Index i = 0; i < n; ++i) {
    Parameter f;
    f.value                   = modes.frequency[i];
    f.unit                    = "Hz";
    f.method                  = strip ? "six-mass chain, K4 between the work rolls" : "six-mass chain, K4 = 0";
    f.at                      = model.at;
    const auto [error, lacks] = dynamics::mode_error(modes, i, model);
    f.error_estimate          = error;
    f.error_lacks             = lacks;
    f.inputs                  = chain_mode_keys(*run.keys, model, settings, half[std::size_t(i)]);
    run.results.add(row::modes::vertical.of(word_of_state(named), std::to_string(i + 1)), f);
  }
}
}  // namespace

void add_modes(RunContext &run, const LumpedModel &model, const DynamicsSettings &settings,
               const double chock_seat, const std::array<double, 2> chock_mass)
{
  StageTimer timer(run, "modes");
  if (knows_strip(model)) {
    add_vertical_modes(run, model, in_state(settings, GapState::rolling), GapState::rolling);
    add_vertical_modes(run, model, in_state(settings, GapState::open), GapState::open);
  } else
    add_vertical_modes(run, model, in_state(settings, GapState::open), GapState::rolling);

  const auto [horizontal, sideways, mover, roll] = horizontal_modes(model, chock_seat, chock_mass);
  if (mover.empty())
    return;
  const auto n_plane = horizontal.M.size();
  Table plane;
  plane.add("mode", "", Eigen::VectorXd::LinSpaced(n_plane, 1, double(n_plane)))
      .add("frequency", "Hz", sideways.frequency);
  const Eigen::MatrixXd x = to_largest(sideways.shape);
  for (Eigen::Index j = 0; j < n_plane; ++j)
    plane.add(slug(horizontal.labels[std::size_t(j)]), "", x.row(j).transpose());
  write_curve(run, curve::modes_horizontal, "", plane);
  for (Eigen::Index i = 0; i < sideways.frequency.size(); ++i) {
    const std::string &label = mover[std::size_t(i)];
    Parameter f;
    f.value       = sideways.frequency[i];
    f.unit        = "Hz";
    f.method      = "rolls on their bearings, " + label + (std::isnan(chock_seat) ? ", chock seats rigid" : "");
    f.at          = model.at;
    f.inputs      = joined(chock_seat_keys(*run.keys, roll[std::size_t(i)]),
                           horizontal_mode_keys(model, roll[std::size_t(i)]));
    f.error_lacks = {"mass that moves along the pass line: the vertical equivalent mass is used"};
    run.results.add(row::modes::horizontal.of(std::to_string(i + 1)), f);
  }
  if (std::isnan(chock_seat))
    run.assume("the seats of the work-roll chocks in the housing are rigid (frame.chock_to_housing_stiffness "
               "is not given); "
               "a seat softer than the bearing lowers the horizontal frequencies");
}

namespace {
// A record must last for some output samples, and its response must fit into memory.
void require_sensible_length(const Pass &pass, const ForceRecord &force, const double output_rate)
{
  const double duration = force.time[force.time.size() - 1] - force.time[0];
  const double samples  = duration * output_rate;
  const auto refuse     = [&](const std::string &why) {
    throw InputError(pass.force_place,
                         fmt::format("{}: the force record lasts {:.4g} s, which is {:.3g} samples at "
                                         "dynamics.output_rate = {:g} kHz; {}",
                                     pass.name, duration, samples, output_rate / 1e3, why));
  };
  if (samples < 16)
    refuse("at least 16 are needed, give a longer record or a higher rate");
  if (samples > 5e6)
    refuse(
        "at most 5e6 are kept; stream it (millstand simulate --stream --force FILE), cut it, or lower the rate");
}
}  // namespace

PassModel pass_model(const LumpedModel &model, const DynamicsSettings &settings)
{
  const auto chain = dynamics::mill_model(model, settings);
  const auto modes = dynamics::modes(chain);
  return {dynamics::driven_model(chain),
          "six-mass chain",
          modes.frequency.maxCoeff(),
          inputs_of(model, settings, true),
          {}};
}

dynamics::ModalModel driven_modes(const reduce::StandWithModes &stand, const LumpedModel &chain,
                                  const DynamicsSettings &settings)
{
  return dynamics::modal_model(
      stand.model, stand.modes.frequency, stand.modes.shape, settings.modal_damping, 2 * settings.frequency_limit,
      settings.force_meaning == ForceMeaning::measured || std::isnan(chain.C.value) ? 0 : chain.C.value);
}

PassModel pass_model(const reduce::StandWithModes &stand, const LumpedModel &chain,
                     const DynamicsSettings &settings)
{
  const double limit = settings.frequency_limit;
  PassModel p{dynamics::driven_model(driven_modes(stand, chain, settings)),
              title_of(stand.model.name),
              limit,
              inputs_of(chain, settings, false),
              {},
              limit};
  // Modes up to the limit are trusted; those above are driven too, since they deflect under slower forces.
  for (Eigen::Index i = 0; i < stand.modes.frequency.size() && stand.modes.frequency[i] <= limit; ++i)
    p.highest_mode = stand.modes.frequency[i];
  return p;
}

namespace {
// The frequencies of a made force are the user's choice, not the mill's.
void say_of_record(RunContext &run, const Pass &pass, const Warning &warning)
{
  pass.synthetic ? run.assume(text_of(warning)) : run.warn(warning);
}

// Modes of the stand that the force excites and the model does not have.
void warn_of_missing_modes(RunContext &run, const PassModel &model, const Pass &pass, const double content)
{
  constexpr int most_listed = 9;
  std::string modes;
  int excited = 0;
  for (const double f : model.missing)
    if (f <= content && ++excited <= most_listed)
      modes += fmt::format("{}{:.0f}", modes.empty() ? "" : ", ", f);
  if (excited > most_listed)
    modes += fmt::format(" and {} more", excited - most_listed);
  if (!modes.empty())
    say_of_record(
        run, pass,
        {WarningId::mode_not_in_chain,
         pass.name,
         fmt::format("the force reaches {:.0f} Hz, but the chain of six masses has no counterpart of the "
                     "stand's modes at {} Hz",
                     content, modes),
         "",
         "drive dynamics.model = \"craig-bampton\" or \"beam\" to see them",
         {pass.name},
         "dynamics.model"});
  if (content > model.limit)
    run.warn({WarningId::force_above_limit,
              pass.name,
              fmt::format("the force reaches {:.0f} Hz, the modes are made to be right up to "
                          "dynamics.frequency_limit = {:g} Hz",
                          content, model.limit),
              "",
              "raise it",
              {pass.name},
              "dynamics.frequency_limit"});
}

Warning repaired(const Pass &pass, const std::string &note, const Place &place)
{
  return {WarningId::record_repaired, pass.name, note, "", "", {pass.name}, "", place};
}
}  // namespace

void simulate_pass(RunContext &run, const PassModel &model, const DynamicsSettings &settings, const Pass &pass,
                   const ForceRecord &force)
{
  StageTimer timer(run, "response, " + pass.name);
  require_sensible_length(pass, force, settings.output_rate);
  const std::string file = "response/" + slug(pass.name);
  const double highest   = model.highest_mode;
  const auto statistics  = dynamics::force_statistics(force);
  warn_of_missing_modes(run, model, pass, statistics.content);
  for (const std::string &note : force.notes)
    say_of_record(run, pass, repaired(pass, note, pass.force_place));
  if (auto warning = dynamics::bandwidth_warning(statistics, highest)) {
    warning->subject  = pass.name;
    warning->concerns = {pass.name};
    warning->place    = pass.force_place;
    run.warn(std::move(*warning));
  }
  if (auto warning = dynamics::output_rate_warning(settings.output_rate, highest))
    run.warn(std::move(*warning));
  std::optional<dynamics::CurveRuns> curves;
  if (model.curves)
    curves = dynamics::curve_runs(*model.curves, model.driven, force, settings.output_rate);
  const auto study     = curves ? dynamics::pass_study(curves->curve.response, settings.output_rate)
                                : dynamics::pass_study(model.driven, force, settings.output_rate);
  const auto &response = study.response;
  if (!response.note.empty())
    run.warn({WarningId::time_integration, pass.name, response.note, "", "", {pass.name}});

  // Half the output rate shows what the sampling does; the remaining uncertainty of a level is not known.
  const auto add = [&](const RowOf<2> &row, const std::size_t roll, const double value, const double second,
                       std::vector<Check> checks) {
    Parameter p;
    p.value  = value;
    p.unit   = row.unit;
    p.method = model.method +
               (curves ? ", curves of the contacts, Runge-Kutta of order 8" : ", exact first-order hold") +
               ", force " + word_of(settings.force_meaning);
    p.at          = {"{} mean, {} peak to peak",
                     {{statistics.mean, "kN", force_form(statistics.mean)},
                      {statistics.largest - statistics.smallest, "kN", ".3f"}}};
    p.error_lacks = {"dynamics.modal_damping", "spectrum of pass.force", "dynamics.model: modes that it lacks"};
    p.inputs      = joined(model.inputs[roll], model.of_pass);
    p.checks      = std::move(checks);
    p.checks.push_back({"half the output rate", second, "what the sampling moves"});
    run.results.add(row.of(pass.name, driven_rolls[roll]), p);
  };
  std::vector<Check> measured_rms[2], measured_peak[2];
  if (!pass.measured_file.empty()) {
    const auto measured = measured_of(pass, force);
    for (const std::string &note : measured.notes)
      run.warn(repaired(pass, "measured record: " + note, pass.measured_place));
    const auto comparison                   = dynamics::compare(response, measured);
    const std::string span                  = fmt::format("{:.3g} .. {:.3g} s", comparison.begin, comparison.end);
    const dynamics::RollComparison *rolls[] = {&comparison.upper_work_roll, &comparison.lower_work_roll};
    for (int r = 0; r < 2; ++r) {
      measured_peak[r].push_back(check(CheckId::measured, in_g(rolls[r]->measured.peak), span));
      measured_rms[r].push_back(check(CheckId::measured, in_g(rolls[r]->measured.rms), span));
    }
    Table record;
    record.add("time", "s", measured.time)
        .add("upper_work_roll", "g", measured.upper_work_roll / dynamics::standard_gravity)
        .add("lower_work_roll", "g", measured.lower_work_roll / dynamics::standard_gravity);
    run.out.write_table(file + "-measured", std::move(record));
  }
  const int columns[] = {dynamics::upper_work_roll, dynamics::lower_work_roll};
  for (std::size_t r = 0; r < 2; ++r) {
    const auto &fine = study.level[r], &half = study.half_rate[r];
    const auto with_runs = [&](std::vector<Check> checks, const bool peak) {
      if (curves)
        for (Check &check : checks_of_level(*curves, columns[r], peak))
          checks.push_back(std::move(check));
      return checks;
    };
    if (!std::isnan(pass.published_peak_g[r]))
      measured_peak[r].insert(measured_peak[r].begin(), check(CheckId::published_model, pass.published_peak_g[r]));
    if (!std::isnan(pass.measured_peak_g[r]))
      measured_peak[r].push_back(
          check(CheckId::measured, pass.measured_peak_g[r], "peak of a record that is not at hand"));
    add(row::response::peak, r, in_g(fine.peak), in_g(half.peak), with_runs(measured_peak[r], true));
    add(row::response::rms, r, in_g(fine.rms), in_g(half.rms), with_runs(measured_rms[r], false));
  }

  run.out.write_table(file, dynamics::response_table(response));
  Table spectrum;
  spectrum.add("frequency", "Hz", study.force.frequency).add("force", "N/sqrt(Hz)", study.force.density);
  for (std::size_t r = 0; r < 2; ++r)
    spectrum.add(driven_rolls[r], "g/sqrt(Hz)", study.rolls[r].density / dynamics::standard_gravity);
  run.out.write_table(file + "-spectrum", std::move(spectrum));
  run.progress.note(fmt::format("{}: spectra of {} segments of {} samples, {} window", pass.name,
                                study.force.n_segments, study.force.segment_length, study.force.window));
  if (pass.synthetic || pass.force_file.empty())
    run.assume(pass.name + ": the force record is synthetic, noise in the stated range; its spectrum is assumed");
  if (curves)
    add_nonlinear(run, *model.curves, *curves,
                  {settings, pass, force, model.method, joined(model.inputs[0], model.inputs[1], model.of_pass)});
}
}  // namespace mill
