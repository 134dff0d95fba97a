#include "app/chatter/chatter_files.h"
#include "app/chatter/chatter_question.h"
#include "app/chatter/chatter_stage.h"
#include "app/run/curve_files.h"
#include "app/run/error_warnings.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/records/chatter_record.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "core/records/rows_of_chatter.h"
#include "dynamics/tandem/tandem.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
OperatingPoint at_last_stand(const double speed)
{
  return {"{} of the last stand", {{speed, "m/s", ".4g"}}};
}

// Conditions from the first stand to the last one, by what comes after what; empty: no tandem.
std::vector<std::size_t> stands_in_order(const std::vector<RollingCondition> &all)
{
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].after.empty())
      continue;
    const auto before = std::size_t(
        std::find_if(all.begin(), all.end(), [&](const auto &c) { return c.name == all[i].after; }) - all.begin());
    if (order.empty())
      order.push_back(before);
    order.push_back(i);
  }
  return order;
}

void add_results(RunContext &run, const dynamics::TandemStudy &study, const dynamics::TandemLine &line,
                 const KeyList &inputs)
{
  std::vector<Check> checks;
  for (std::size_t i = 0; i < study.stand.size(); ++i)
    if (!std::isnan(study.stand[i].speed))
      checks.push_back({"stand " + line.stands[i].name + " alone", study.stand[i].speed,
                        "the strip to its neighbours ends at constant speed"});
  if (!std::isnan(study.tension.speed))
    checks.push_back({"shared tension, no thickness from the stand before", study.tension.speed, ""});
  const auto add = [&](const RowOf<1> &row, const double value, const char *method,
                       std::vector<Check> checks = {}) {
    if (std::isnan(value))
      return;
    Parameter p;
    p.value  = value;
    p.unit   = row.unit;
    p.method = method;
    p.at     = at_last_stand(is_in(row.unit, SiUnit::speed) ? value : study.full.speed);
    p.inputs = inputs;
    p.checks = std::move(checks);
    run.results.add(row.of(tandem_item), p);
  };
  add(row::chatter::critical_speed, study.full.speed, "roots of the coupled stands with the delay of the strip",
      std::move(checks));
  add(row::chatter::frequency, study.full.frequency, "roots of the coupled stands with the delay of the strip");
  add(row::chatter::critical_speed_without_delay, study.tension.speed, "eigenvalues, shared tension only");
  add(row::chatter::speed_stable_for_any_distance, study.any_delay, "gain of the regenerative loop below one");
}

Warning no_bite(const double speed, const std::string &why)
{
  return {WarningId::no_steady_bite,
          "",
          fmt::format("the tandem has no steady bite at {:.4g} m/s of its last stand", speed),
          why,
          "",
          {"chatter.tandem"}};
}

// The steady state of the line; without one the run says so.
std::optional<dynamics::TandemPoint> steady_point(RunContext &run, const dynamics::TandemLine &line,
                                                  const double speed)
{
  try {
    return dynamics::tandem_point(line, speed);
  } catch (const InputError &e) {
    run.warn(no_bite(speed, e.problems.front().message));
  } catch (const SolverError &e) {
    run.warn(no_bite(speed, e.report.what));
  }
  return std::nullopt;
}

// At the speed at which the last condition works; mass flow then sets the speeds of the others.
void judge_working_speed(RunContext &run, const dynamics::TandemLine &line, const double speed)
{
  const auto point = steady_point(run, line, speed);
  if (!point)
    return;
  for (std::size_t i = 0; i + 1 < line.stands.size(); ++i) {
    const double given = line.stands[i].bite.roll_speed, needed = point->stands[i].bite.roll_speed;
    if (std::abs(given / needed - 1) > 0.01)
      run.assume(
          fmt::format("tandem: mass flow makes the rolls of stand {} turn at {:.4g} m/s when the last stand works "
                      "at {:.4g} m/s; its condition gives {:.4g} m/s, and its own results are for that speed",
                      line.stands[i].name, needed, speed, given));
  }
  try {
    const auto root = dynamics::tandem_root(line, speed);
    Parameter growth;
    growth.value  = root.real();
    growth.unit   = "1/s";
    growth.method = "rightmost root of the coupled stands with the delay of the strip";
    growth.at     = at_last_stand(speed);
    run.results.add(row::chatter::growth_rate.of(tandem_item), growth);
    if (root.real() > 1e-9 * std::abs(root))
      run.warn({WarningId::chatters,
                "",
                fmt::format("the tandem chatters at {:.4g} m/s of its last stand", speed),
                fmt::format("vibration of {:.4g} Hz doubles in {:.3g} s", std::abs(root.imag()) / (2 * M_PI),
                            std::log(2) / root.real()),
                "",
                {"chatter.tandem"}});
  } catch (const InputError &e) {
    run.warn(warning_of(WarningId::chatter_refused, e));
  } catch (const SolverError &e) {
    run.warn(warning_of(WarningId::chatter_refused, e));
  }
}

ChatterTandem tandem_record(const dynamics::TandemStudy &study, const dynamics::TandemLine &line,
                            const dynamics::SpeedRange &range)
{
  ChatterTandem record;
  for (const auto &stand : line.stands)
    record.stands.push_back(stand.name);
  record.verdict        = word_of(study.full.verdict);
  record.sentence       = dynamics::sentence(study.full, range);
  record.critical_speed = study.full.speed;
  record.frequency      = study.full.frequency;
  record.without_delay  = study.tension.speed;
  record.any_delay      = study.any_delay;
  for (std::size_t i = 0; i < study.stand.size(); ++i) {
    record.without_tension = std::fmin(record.without_tension, study.stand[i].speed);
    record.single.push_back({line.stands[i].name, "", study.stand[i].speed});
  }
  for (const auto &share : study.share)
    record.shape.push_back({share.stand, share.gap, share.phase});
  record.sentences = study.sentences;
  return record;
}

Table curve_table(const dynamics::TandemCurves &curves)
{
  Table table;
  table.add("speed", "m/s", curves.speed).add("growth_rate", "1/s", curves.full);
  table.add("growth_without_delay", "1/s", curves.tension).add("growth_alone", "1/s", curves.alone);
  table.add("frequency", "Hz", curves.frequency).add("loop_gain", "-", curves.loop_gain);
  return table;
}
}  // namespace

void solve_tandem(RunContext &run, const ChatterCase &spec)
{
  const auto order = stands_in_order(spec.conditions);
  if (order.empty())
    return;
  StageTimer timer(run, "chatter, tandem");
  dynamics::TandemLine line;
  ChatterQuestion last;
  KeyList inputs;
  for (const std::size_t i : order) {
    last   = chatter_question(spec, i, run.keys.get());
    inputs = joined(std::move(inputs), last.inputs);
    line.stands.push_back({spec.conditions[i].name, last.stand.structure, last.bite});
  }
  line.distance.assign(order.size() - 1, spec.stand.exit_distance);
  line.entry_distance = spec.stand.entry_distance;
  line.exit_distance  = spec.stand.exit_distance;
  line.strip_modulus  = spec.strip.youngs_modulus;
  line.scheme         = last.scheme;
  const auto range    = chatter_range(last);
  const auto study    = dynamics::tandem_study(line, range);
  judge_working_speed(run, line, last.condition.speed);
  add_results(run, study, line, inputs);
  run.out.write("curves/chatter-tandem.json", json_of_record(tandem_record(study, line, range)));
  write_curve(run, curve::chatter_speed, tandem_item, curve_table(study.curves));
  write_curve(run, curve::chatter_lobes, tandem_item, curve_table(study.lobes));
  run.summary += "tandem: " + dynamics::sentence(study.full, range) + "\n";
  run.assume(
      "tandem: every stand has the structure of [stand], neighbours are stand.exit_distance apart; speeds are "
      "those of the last stand's rolls");
}
}  // namespace mill
