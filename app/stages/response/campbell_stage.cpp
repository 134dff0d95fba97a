#include "app/stages/response/campbell_stage.h"
#include "app/stages/response/turning_rolls.h"
#include "core/case/moving_keys.h"
#include "core/records/campbell_record.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include "core/records/rows_of_stand.h"
#include "dynamics/response/campbell.h"
#include "reduce/bearing/pass_frequencies.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
std::array<double, 2> working_speeds(const CampbellSettings &settings, const std::vector<Pass> &passes)
{
  if (!std::isnan(settings.working_speeds[0]))
    return settings.working_speeds;
  std::array<double, 2> range = {not_given, not_given};
  for (const Pass &pass : passes)
    if (!std::isnan(pass.speed))
      range = {std::fmin(range[0], pass.speed), std::fmax(range[1], pass.speed)};  // the number of the two
  return range;
}

namespace {
std::vector<CampbellMode> named_modes(const RunContext &run, const reduce::StandWithModes &model)
{
  std::vector<CampbellMode> modes;
  for (const reduce::ModeName &mode : model.names)
    if (const Parameter *f = run.find(row::modes::frequency.of("", mode.key)); f && !mode.key.empty())
      modes.push_back({mode.key, mode.name, f->value, f->error_estimate});
  return modes;
}

// "work-roll bearing": group of the lines of a roll's bearing.
std::string bearing_title(const TurningRoll &roll)
{
  switch (roll.kind) {
  case RollKind::backup_roll:
    return "backup-roll bearing";
  case RollKind::work_roll:
    return "work-roll bearing";
  }
  return "";
}

std::string line_name(const std::string &order)
{
  return "drive, " + order;
}

void add_bearing_lines(CampbellRecord &record, const TurningRoll &roll, const int harmonics)
{
  const RollerBearing &b = *roll.bearing;
  const auto per_turn    = bearing::pass_frequencies(b);
  if (std::isnan(per_turn.cage)) {
    record.notes.push_back(fmt::format("the bearing of the {}s has no roller or pitch diameter: its cage and pass "
                                       "frequencies are not known",
                                       word_of(roll.kind)));
    return;
  }
  const std::string title = bearing_title(roll);
  // A defect of a roller meets both raceways in each of its turns.
  const std::pair<const char *, double> parts[] = {{"cage", per_turn.cage},
                                                   {"outer raceway", per_turn.outer},
                                                   {"inner raceway", per_turn.inner},
                                                   {"roller, both sides", 2 * per_turn.roller}};
  for (const auto &[part, events] : parts)
    for (int h = 1; h <= harmonics; ++h)
      record.lines.push_back(
          dynamics::line_of(fmt::format("{}, {}{}", title, part, h == 1 ? "" : fmt::format(", harmonic {}", h)),
                            title, word_of(roll.kind), h * events, roll.diameter));
}

void add_roll_lines(CampbellRecord &record, const TurningRoll &roll, const CampbellSettings &settings)
{
  if (std::isnan(roll.diameter)) {
    record.notes.push_back(
        fmt::format("{} is not given: the orders of the {}s are left out", roll.diameter_key, word_of(roll.kind)));
    return;
  }
  for (int order = 1; order <= settings.roll_orders; ++order)
    record.lines.push_back(dynamics::line_of(order == 1 ? fmt::format("{}, once per turn", word_of(roll.kind))
                                                        : fmt::format("{}, order {}", word_of(roll.kind), order),
                                             word_of(roll.kind), word_of(roll.kind), order, roll.diameter));
  if (roll.bearing)
    add_bearing_lines(record, roll, settings.bearing_harmonics);
}

void add_drive_lines(CampbellRecord &record, const TurningStand &stand)
{
  for (const DriveOrder &order : stand.drive)
    for (const TurningRoll &roll : stand.rolls)
      if (order.per_turn_of == roll.kind && !std::isnan(roll.diameter))
        record.lines.push_back(
            dynamics::line_of(line_name(order.name), "drive", word_of(roll.kind), order.count, roll.diameter));
}

std::string number(const double value)
{
  return std::isnan(value) ? "" : fmt::format("{:.10g}", value);
}

// One row for every crossing.
std::string crossings_csv(const CampbellRecord &record)
{
  std::string text = "mode,frequency [Hz],line,shaft,per turn,speed [m/s],distance to working range [-]\n";
  for (const CampbellCrossing &c : record.crossings) {
    const CampbellMode &mode = record.modes[std::size_t(c.mode)];
    const CampbellLine &line = record.lines[std::size_t(c.line)];
    text += fmt::format("{},{},{},{},{},{},{}\n", quoted_cell(mode.name), number(mode.frequency),
                        quoted_cell(line.name), quoted_cell(line.shaft), number(line.per_turn), number(c.speed),
                        number(c.distance));
  }
  return text;
}

// Keys behind the crossing of a line with a mode: those of the mode, and of what turns.
KeyList keys_of(const RunContext &run, const CampbellMode &mode, const CampbellLine &line,
                const std::vector<DriveOrder> &drive)
{
  std::string name = line.name;
  for (std::size_t i = 0; i < drive.size(); ++i)
    if (name == line_name(drive[i].name))
      name = line_name(std::to_string(i));
  return joined(run.find(row::modes::frequency.of("", mode.key))->inputs,
                run.keys->of("line " + name, [&](const CaseSpec &spec) { return text_of_line(spec, name); }));
}

void add_results(RunContext &run, const CampbellRecord &record, const std::vector<DriveOrder> &drive)
{
  for (std::size_t m = 0; m < record.modes.size(); ++m) {
    const auto crossing = dynamics::nearest(record, int(m));
    if (!crossing)
      continue;
    const CampbellMode &mode = record.modes[m];
    const CampbellLine &line = record.lines[std::size_t(crossing->line)];
    Parameter p;
    p.value = crossing->speed;
    p.unit  = "m/s";
    p.method =
        fmt::format("{} ({:.5g} per turn of the {}) meets {}", line.name, line.per_turn, line.shaft, mode.name);
    p.at = {"working range {} .. {}", {{record.working[0], "m/s", "g"}, {record.working[1], "m/s", "g"}}};
    p.error_estimate = mode.error_estimate;
    if (std::isnan(p.error_estimate))
      p.error_lacks = run.find(row::modes::frequency.of("", mode.key))->error_lacks;
    p.inputs    = keys_of(run, mode, line, drive);
    Parameter d = p;
    d.value     = crossing->distance;
    d.unit      = "1";
    if (crossing->distance != 0) {  // of a number near zero the relative error says little, but it is that
      const double end = crossing->distance < 0 ? record.working[0] : record.working[1];
      d.error_estimate = p.error_estimate * std::abs(crossing->speed / (end * crossing->distance));
    } else {
      d.error_estimate = not_given;
      d.error_lacks    = {"a distance of zero has no relative error"};
    }
    run.results.add(row::response::campbell_speed.of(mode.key), p);
    run.results.add(row::response::campbell_distance.of(mode.key), d);
  }
}
}  // namespace

CampbellRecord turning_lines(const CampbellSettings &settings, const TurningStand &stand)
{
  CampbellRecord record;
  for (const TurningRoll &roll : stand.rolls)
    add_roll_lines(record, roll, settings);
  add_drive_lines(record, stand);
  return record;
}

void add_campbell(RunContext &run, const CampbellSettings &settings, const TurningStand &stand)
{
  CampbellRecord record;
  record.model   = stand.model->model.name;
  record.working = working_speeds(settings, stand.passes);
  record.speeds  = settings.speeds;
  if (std::isnan(record.speeds[0]))
    record.speeds = {0, 1.5 * record.working[1]};
  if (std::isnan(record.speeds[1]))
    return;
  record.modes           = named_modes(run, *stand.model);
  CampbellRecord turning = turning_lines(settings, stand);
  record.lines           = std::move(turning.lines);
  record.notes           = std::move(turning.notes);
  if (record.modes.empty() || record.lines.empty())
    return;
  record.crossings = dynamics::crossings(record.modes, record.lines, record.speeds, record.working);
  run.out.write("curves/campbell.json", json_of_record(record));
  run.out.write("campbell.csv", crossings_csv(record));
  add_results(run, record, stand.drive);
}
}  // namespace mill
