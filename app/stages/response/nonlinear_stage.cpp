#include "app/stages/response/nonlinear_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/stand/mode_results.h"
#include "core/model/pass.h"
#include "core/records/chain_number.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include "dynamics/response/spectrum.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
double g_of(const double acceleration)
{
  return acceleration / dynamics::standard_gravity;
}

constexpr std::array<std::pair<const char *, int>, 2> rolls{
    {{"upper_work_roll", dynamics::upper_work_roll}, {"lower_work_roll", dynamics::lower_work_roll}}};

std::string in_words(const NonlinearMode &mode)
{
  return mode.name.empty() ? fmt::format("the mode at {:.1f} Hz", mode.frequency)
                           : fmt::format("{}, {:.1f} Hz", mode.name, mode.frequency);
}

void say_verdict(NonlinearRecord &record)
{
  const auto verdict = dynamics::linear_verdict(record);
  std::string parted;
  for (const NonlinearSpring &spring : record.springs)
    if (spring.parted > 0)
      parted += fmt::format("{}{} parts {} times", parted.empty() ? "" : ", ", spring.name, spring.parted);
  record.linear_enough = verdict.enough;
  const std::string levels =
      std::isfinite(verdict.furthest)
          ? fmt::format("peaks and rms of the work rolls differ from the linear run by {:.2g} % at most",
                        100 * std::abs(verdict.furthest))
          : "a peak or an rms of the work rolls has no ratio to that of the linear run";
  const std::string forces = verdict.parts      ? parted
                             : !verdict.softest ? "no force of a contact falls"
                                                : fmt::format("the force of {} falls to {:.3g} % of that at rest",
                                                              verdict.softest->name, 100 * verdict.softest->least);
  record.found             = levels + "; " + forces;
  record.verdict           = fmt::format("Linear springs were {}enough at this load: {}.",
                               record.linear_enough ? "" : "not ", record.found);
}

void note_ranges(NonlinearRecord &record)
{
  for (const NonlinearSpring &spring : record.springs)
    if (dynamics::leaves_samples(spring))
      record.notes.push_back({WarningId::curve_left, "",
                              fmt::format("{} leaves the samples of its curve, {} .. {}", spring.name,
                                          in_kN(spring.low), in_kN(spring.high)),
                              "beyond them it goes on by the power law of the last one"});
}

NonlinearRecord record_of(const CurveDrive &drive, const dynamics::CurveRuns &runs, const DrivenPass &driven)
{
  NonlinearRecord record = dynamics::curve_study(drive, runs, driven.force, driven.settings.output_rate);
  record.pass            = driven.pass.name;
  record.model           = driven.method;
  record.load            = drive.load;
  for (NonlinearMode &mode : record.modes)
    if (const auto i = std::size_t(mode.number - 1); i < drive.mode_names.size())
      mode.name = drive.mode_names[i];
  note_ranges(record);
  say_verdict(record);
  return record;
}

void write_backbones(RunContext &run, const NonlinearRecord &record, const std::string &item)
{
  std::vector<double> mode, amplitude, frequency, least;
  for (const NonlinearMode &m : record.modes)
    if (dynamics::bends(m))
      for (std::size_t i = 0; i < m.amplitude.size(); ++i) {
        mode.push_back(m.number);
        amplitude.push_back(m.amplitude[i]);
        frequency.push_back(m.followed[i]);
        least.push_back(m.least[i]);
      }
  if (mode.empty())
    return;
  const auto column = [](const std::vector<double> &v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  Table table;
  table.add("mode", "", column(mode)).add("amplitude", "m", column(amplitude));
  table.add("frequency", "Hz", column(frequency)).add("least_force", "", column(least));
  write_curve(run, curve::backbone, item, table);
}

void write_spectra(RunContext &run, const dynamics::CurveRuns &runs, const double rate, const std::string &item)
{
  Table table;
  for (const auto &[name, row] : rolls) {
    const auto column_of = [&, column = row](const dynamics::Response &r) {
      return dynamics::amplitude_spectral_density(r.acceleration.col(column), rate);
    };
    const auto curve = column_of(runs.curve.response), linear = column_of(runs.linear);
    if (table.names.empty())
      table.add("frequency", "Hz", curve.frequency);
    table.add(name, "g/sqrt(Hz)", curve.density / dynamics::standard_gravity)
        .add(std::string(name) + "_linear", "g/sqrt(Hz)", linear.density / dynamics::standard_gravity);
  }
  write_curve(run, curve::nonlinear_spectrum, item, table);
}

void write_events(RunContext &run, const CurveDrive &drive, const dynamics::CurveRun &curve,
                  const std::string &item)
{
  const auto n = Eigen::Index(curve.events.size());
  if (n == 0)
    return;
  Eigen::VectorXd time(n), spring(n), parts(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const dynamics::SpringEvent &event = curve.events[std::size_t(i)];
    time[i]                            = event.time;
    const auto number                  = choice_named<ChainNumber>(drive.stand.springs[event.spring].name);
    spring[i]                          = number ? 1 + int(*number) - int(ChainNumber::K1) : not_given;  // K3: 3
    parts[i]                           = event.parts;
  }
  Table table;
  table.add("time", "s", time).add("spring_of_chain", "", spring).add("parts", "", parts);
  run.out.write_table("response/" + item + "-parted", std::move(table));
}

void add_results(RunContext &run, const NonlinearRecord &record, const DrivenPass &driven)
{
  const auto made = [&](const ResultRow &row, const double value, const std::string &method, const double error) {
    Parameter p;
    p.value          = value;
    p.unit           = row.unit;
    p.method         = record.model + ", " + method;
    p.at             = at_force(record.load);
    p.inputs         = driven.inputs;
    p.error_estimate = error;
    if (std::isnan(error))
      p.error_lacks = {"dynamics.modal_damping", "curves of the contacts"};
    return p;
  };
  const auto add = [&](const auto &row, const Parameter &p, const auto &...places) {
    if (!std::isnan(p.value))
      run.results.add(row.of(driven.pass.name, places...), p);
  };
  for (std::size_t i = 0; i < record.rolls.size(); ++i) {
    const NonlinearRoll &roll = record.rolls[i];
    Parameter p               = made(row::nonlinear::level, roll.rms / roll.linear_rms,
                                     "rms on the curves over that of the linear run", dynamics::level_error(roll));
    p.checks.push_back({"by fixed steps", roll.fixed_rms / roll.linear_rms, "implicit, of second order (36.7)"});
    add(row::nonlinear::level, p, rolls[i].first);
  }
  for (const NonlinearSpring &spring : record.springs) {
    Parameter p =
        made(row::nonlinear::least_force, spring.least, "smallest force of the run over that at rest", not_given);
    add(row::nonlinear::least_force, p, spring.name);
  }
  Parameter scale = made(row::nonlinear::scale_to_part, record.scale_to_part,
                         "times the fluctuation of the record until a contact parts", not_given);
  add(row::nonlinear::scale_to_part, scale);
  for (const NonlinearMode &mode : record.modes)
    if (dynamics::bends(mode))
      add(row::nonlinear::bend,
          made(row::nonlinear::bend, mode.bend,
               fmt::format("frequency at which {} parts over that of small motion, less "
                           "1, harmonic balance",
                           mode.opens),
               not_given),
          std::to_string(mode.number));
  const NonlinearMode *first = dynamics::first_to_part(record);
  if (!first)
    return;
  add(row::nonlinear::parting_force,
      made(row::nonlinear::parting_force, first->parting_force,
           fmt::format("amplitude of a harmonic bite force at {}, harmonic balance", in_words(*first)),
           not_given));
  add(row::nonlinear::parting_frequency,
      made(row::nonlinear::parting_frequency, first->frequency, "of that force", not_given));
}
}  // namespace

std::vector<Check> checks_of_level(const dynamics::CurveRuns &runs, const int column, const bool peak)
{
  const auto value = [&](const dynamics::Response &r) {
    const auto level = dynamics::level(r.acceleration.col(column));
    return g_of(peak ? level.peak : level.rms);
  };
  return {{"linear springs", value(runs.linear), "slopes of the curves at rest"},
          {"curves by fixed steps", value(runs.fixed.response), "implicit, of second order (36.7)"}};
}

void add_nonlinear(RunContext &run, const CurveDrive &drive, const dynamics::CurveRuns &runs,
                   const DrivenPass &driven)
{
  const Pass &pass  = driven.pass;
  const double rate = driven.settings.output_rate;
  StageTimer timer(run, "curves of the contacts, " + pass.name);
  const std::string item       = slug(pass.name);
  const NonlinearRecord record = record_of(drive, runs, driven);
  run.out.write("curves/nonlinear-" + item + ".json", json_of_record(record));
  write_backbones(run, record, item);
  write_spectra(run, runs, rate, item);
  write_events(run, drive, runs.curve, item);
  add_results(run, record, driven);
  const std::vector<std::string> concerned{result_name({family::nonlinear, pass.name}), pass.name};
  if (!record.linear_enough)
    run.warn({WarningId::springs_not_linear, pass.name, "linear springs were not enough at this load",
              record.found, "", concerned});
  run.progress.note(pass.name + ": " + record.verdict);
  for (Warning note : record.notes) {
    note.subject  = pass.name;
    note.concerns = concerned;
    run.warn(std::move(note));
  }
}
}  // namespace mill
