#include "app/stages/response/nonlinear_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/stand/mode_results.h"
#include "core/model/pass.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include "dynamics/nonlinear/mode_study.h"
#include "dynamics/response/spectrum.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double matters      = 0.01;   // of a level, from which linear springs are not enough
constexpr double bend_of_note = 0.001;  // of a frequency, from which a backbone is drawn

double g_of(const double acceleration)
{
  return acceleration / dynamics::standard_gravity;
}

constexpr std::array<std::pair<const char *, int>, 2> rolls{
    {{"upper_work_roll", dynamics::upper_work_roll}, {"lower_work_roll", dynamics::lower_work_roll}}};

std::vector<NonlinearRoll> roll_records(const CurveRuns &runs)
{
  std::vector<NonlinearRoll> records;
  for (const auto &roll : rolls) {
    const auto level = [&](const dynamics::Response &r) {
      return dynamics::level(r.acceleration.col(roll.second));
    };
    const auto curve = level(runs.curve.response), linear = level(runs.linear), fixed = level(runs.fixed.response);
    records.push_back({runs.linear.labels[std::size_t(roll.second)], curve.peak, curve.rms, linear.peak,
                       linear.rms, fixed.peak, fixed.rms});
  }
  return records;
}

std::vector<NonlinearSpring> spring_records(const CurveDrive &drive, const dynamics::CurveRun &run)
{
  std::vector<NonlinearSpring> records = drive.springs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].least    = run.springs[i].least;
    records[i].least_at = run.springs[i].least_at;
    records[i].largest  = run.springs[i].largest;
    records[i].parted   = int(run.springs[i].parted);
  }
  return records;
}

// Frequency of a mode over the one it has at vanishing amplitude, furthest from 1 up to where a spring parts.
double bend_of(const NonlinearMode &mode)
{
  return std::isnan(mode.bend) ? 0 : mode.bend;
}

std::string in_words(const NonlinearMode &mode)
{
  return mode.name.empty() ? fmt::format("the mode at {:.1f} Hz", mode.frequency)
                           : fmt::format("{}, {:.1f} Hz", mode.name, mode.frequency);
}

void judge(NonlinearRecord &record)
{
  double furthest = 0;
  std::string parted;
  for (const NonlinearRoll &roll : record.rolls)
    for (const double ratio : {roll.rms / roll.linear_rms, roll.peak / roll.linear_peak})
      if (!(std::abs(ratio - 1) <= std::abs(furthest)))  // an undefined ratio is treated as far
        furthest = ratio - 1;
  double least = 1;
  std::string softest;
  for (const NonlinearSpring &spring : record.springs) {
    if (spring.parted > 0)
      parted += fmt::format("{}{} parts {} times", parted.empty() ? "" : ", ", spring.name, spring.parted);
    if (spring.least < least) {
      least   = spring.least;
      softest = spring.name;
    }
  }
  record.linear_enough     = parted.empty() && std::abs(furthest) <= matters;
  const std::string levels = fmt::format(
      "peaks and rms of the work rolls differ from the linear run by {:.2g} % at most", 100 * std::abs(furthest));
  const std::string forces =
      !parted.empty()   ? parted
      : softest.empty() ? "no force of a contact falls"
                        : fmt::format("the force of {} falls to {:.3g} % of that at rest", softest, 100 * least);
  record.found   = levels + "; " + forces;
  record.verdict = fmt::format("Linear springs were {}enough at this load: {}.",
                               record.linear_enough ? "" : "not ", record.found);
}

void note_ranges(NonlinearRecord &record)
{
  for (const NonlinearSpring &spring : record.springs)
    if (spring.largest * spring.rest > spring.high ||
        (spring.parted == 0 && spring.least * spring.rest < spring.low))
      record.notes.push_back({WarningId::curve_left, "",
                              fmt::format("{} leaves the samples of its curve, {} .. {}", spring.name,
                                          in_kN(spring.low), in_kN(spring.high)),
                              "beyond them it goes on by the power law of the last one"});
}

NonlinearRecord record_of(const CurveDrive &drive, const CurveRuns &runs, const Pass &pass,
                          const ForceRecord &force, const std::string &method, const double output_rate)
{
  NonlinearRecord record;
  record.pass        = pass.name;
  record.model       = method;
  record.load        = drive.load;
  record.force_range = force.force.maxCoeff() - force.force.minCoeff();
  record.balance     = runs.curve.balance;
  record.duration    = force.time[force.time.size() - 1] - force.time[0];
  record.springs     = spring_records(drive, runs.curve);
  record.rolls       = roll_records(runs);
  record.modes = dynamics::mode_study(drive.stand, drive.modal, runs.curve, record.force_range / 2, drive.highest);
  for (NonlinearMode &mode : record.modes)
    if (const auto i = std::size_t(mode.number - 1); i < drive.mode_names.size())
      mode.name = drive.mode_names[i];
  double least = 1;
  for (const NonlinearSpring &spring : record.springs)
    least = std::min(least, spring.least);
  record.scale_to_part = dynamics::scale_to_part(drive.stand, drive.modal, force, output_rate, least);
  note_ranges(record);
  judge(record);
  return record;
}

void write_backbones(RunContext &run, const NonlinearRecord &record, const std::string &item)
{
  std::vector<double> mode, amplitude, frequency, least;
  for (const NonlinearMode &m : record.modes)
    if (std::abs(bend_of(m)) > bend_of_note)
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

void write_spectra(RunContext &run, const CurveRuns &runs, const double rate, const std::string &item)
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
    spring[i]                          = std::stod(drive.stand.springs[event.spring].name.substr(1));  // "K3"
    parts[i]                           = event.parts;
  }
  Table table;
  table.add("time", "s", time).add("spring_of_chain", "", spring).add("parts", "", parts);
  run.out.write_table("response/" + item + "-parted", std::move(table));
}

class ResultsOfPass {
public:
  ResultsOfPass(RunContext &run, const NonlinearRecord &record, const DrivenPass &driven)
      : run_(run), driven_(driven), record_(record)
  {
  }

  Parameter of(const ResultRow &row, const double value, const std::string &method, const double error) const
  {
    Parameter p;
    p.value          = value;
    p.unit           = row.unit;
    p.method         = record_.model + ", " + method;
    p.at             = at_force(record_.load);
    p.inputs         = driven_.inputs;
    p.error_estimate = error;
    if (std::isnan(error))
      p.error_lacks = {"dynamics.modal_damping", "curves of the contacts"};
    return p;
  }
  template <class Row, class... Part> void add(const Row &row, const Parameter &p, const Part &...part)
  {
    if (!std::isnan(p.value))
      run_.results.add(row.of(driven_.pass.name, part...), p);
  }

private:
  RunContext &run_;
  const DrivenPass &driven_;
  const NonlinearRecord &record_;
};

void add_results(RunContext &run, const NonlinearRecord &record, const DrivenPass &driven)
{
  ResultsOfPass results(run, record, driven);
  for (std::size_t i = 0; i < record.rolls.size(); ++i) {
    const NonlinearRoll &roll = record.rolls[i];
    Parameter p =
        results.of(row::nonlinear::level, roll.rms / roll.linear_rms,
                   "rms on the curves over that of the linear run", std::abs(roll.fixed_rms / roll.rms - 1));
    p.checks.push_back({"by fixed steps", roll.fixed_rms / roll.linear_rms, "implicit, of second order (36.7)"});
    results.add(row::nonlinear::level, p, rolls[i].first);
  }
  for (const NonlinearSpring &spring : record.springs) {
    Parameter p = results.of(row::nonlinear::least_force, spring.least,
                             "smallest force of the run over that at rest", not_given);
    results.add(row::nonlinear::least_force, p, spring.name);
  }
  Parameter scale = results.of(row::nonlinear::scale_to_part, record.scale_to_part,
                               "times the fluctuation of the record until a contact parts", not_given);
  results.add(row::nonlinear::scale_to_part, scale);
  const NonlinearMode *first = nullptr;
  for (const NonlinearMode &mode : record.modes) {
    if (std::abs(bend_of(mode)) > bend_of_note)
      results.add(row::nonlinear::bend,
                  results.of(row::nonlinear::bend, mode.bend,
                             fmt::format("frequency at which {} parts over that of small motion, less "
                                         "1, harmonic balance",
                                         mode.opens),
                             not_given),
                  std::to_string(mode.number));
    if (!std::isnan(mode.parting_force) && (!first || mode.parting_force < first->parting_force))
      first = &mode;
  }
  if (!first)
    return;
  results.add(
      row::nonlinear::parting_force,
      results.of(row::nonlinear::parting_force, first->parting_force,
                 fmt::format("amplitude of a harmonic bite force at {}, harmonic balance", in_words(*first)),
                 not_given));
  results.add(row::nonlinear::parting_frequency,
              results.of(row::nonlinear::parting_frequency, first->frequency, "of that force", not_given));
}
}  // namespace

CurveRuns run_on_curves(const CurveDrive &drive, const dynamics::DrivenModel &linear, const ForceRecord &force,
                        const double output_rate)
{
  return {dynamics::curve_response(drive.stand, drive.modal, force, output_rate),
          dynamics::fixed_step_response(drive.stand, drive.modal, force, output_rate),
          dynamics::mill_response(linear, force, output_rate)};
}

std::vector<Check> checks_of_level(const CurveRuns &runs, const int column, const bool peak)
{
  const auto value = [&](const dynamics::Response &r) {
    const auto level = dynamics::level(r.acceleration.col(column));
    return g_of(peak ? level.peak : level.rms);
  };
  return {{"linear springs", value(runs.linear), "slopes of the curves at rest"},
          {"curves by fixed steps", value(runs.fixed.response), "implicit, of second order (36.7)"}};
}

void add_nonlinear(RunContext &run, const CurveDrive &drive, const CurveRuns &runs, const DrivenPass &driven)
{
  const Pass &pass  = driven.pass;
  const double rate = driven.settings.output_rate;
  StageTimer timer(run, "curves of the contacts, " + pass.name);
  const std::string item       = slug(pass.name);
  const NonlinearRecord record = record_of(drive, runs, pass, driven.force, driven.method, rate);
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
