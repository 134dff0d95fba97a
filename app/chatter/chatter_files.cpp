#include "app/chatter/chatter_files.h"
#include "app/chatter/chatter_results.h"
#include "app/run/curve_files.h"
#include "core/records/csv.h"
#include "core/records/json_archive.h"
#include "dynamics/chatter/loop.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using dynamics::Verdict;

std::string base_of(const ChatterStudy &s)
{
  return "chatter-" + slug(s.question.condition.name);
}

// Growth, frequency and bite over speed; the process damping at the frequency of the mode in question.
void write_speeds(RunContext &run, const ChatterStudy &s)
{
  const ChatterQuestion &q  = s.question;
  const auto n              = Eigen::Index(s.found.points.size());
  const double at_frequency = s.mode ? s.mode->frequency : 0;
  Eigen::VectorXd speed(n), growth(n), frequency(n), force(n), friction(n), film(n), damping(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto &point = s.found.points[std::size_t(i)];
    const auto &state = s.found.states[std::size_t(i)];
    const bool bite   = point.no_bite.empty();
    speed[i]          = point.speed;
    growth[i]         = point.growth;
    frequency[i]      = point.frequency;
    force[i]          = bite ? state.force / 1e3 : not_given;
    friction[i]       = bite ? state.friction : not_given;
    film[i]           = bite ? 1e6 * state.film_thickness : not_given;
    damping[i]        = not_given;
    if (bite && at_frequency > 0) {
      const auto by = dynamics::working_point(q.bite, point.speed, q.scheme).by;
      damping[i]    = dynamics::process_damping(q.stand, by, at_frequency) / 1e6;
    }
  }
  Table table;
  table.add("speed", "m/s", speed).add("growth_rate", "1/s", growth).add("frequency", "Hz", frequency);
  table.add("force", "kN", force).add("friction", "-", friction);
  if (!film.array().isNaN().all())
    table.add("film_thickness", "um", film);
  if (at_frequency > 0)
    table.add("process_damping", "MN s/m", damping);
  write_curve(run, curve::chatter_speed, slug(s.question.condition.name), table);
}

// One branch of each pair of roots.
void write_locus(RunContext &run, const ChatterStudy &s)
{
  const auto &locus = s.locus;
  Table table;
  table.add("speed", "m/s", locus.speed);
  int mode = 0;
  for (Eigen::Index b = 0; b < locus.branch.rows(); ++b) {
    const Eigen::VectorXd imaginary = locus.branch.row(b).imag(), real = locus.branch.row(b).real();
    const double mean = imaginary.array().isNaN().select(0, imaginary).sum();
    if (mean < 0)
      continue;  // the other half of a pair
    const std::string name = "mode" + std::to_string(++mode);
    table.add(name + "_growth", "1/s", real).add(name + "_frequency", "Hz", imaginary / (2 * M_PI));
  }
  if (mode > 0)
    write_curve(run, curve::chatter_locus, slug(s.question.condition.name), table);
}

struct MapAxis {
  std::string name, unit;
  double factor;
};

MapAxis axis_of(const dynamics::MapQuantity quantity)
{
  switch (quantity) {
  case dynamics::MapQuantity::reduction:
    return {"reduction", "%", 100};
  case dynamics::MapQuantity::tension:
    return {"tension", "%", 100};
  case dynamics::MapQuantity::viscosity:
    break;
  }
  return {"viscosity", "mPa s", 1e3};
}

void write_maps(RunContext &run, const ChatterStudy &s)
{
  for (const dynamics::StabilityMap &map : s.maps) {
    const MapAxis axis   = axis_of(map.quantity);
    const Eigen::Index n = map.speed.size(), m = map.value.size();
    Eigen::VectorXd speed(n * m), value(n * m), growth(n * m), frequency(n * m);
    for (Eigen::Index j = 0; j < m; ++j) {
      speed.segment(j * n, n)     = map.speed;
      value.segment(j * n, n)     = Eigen::VectorXd::Constant(n, axis.factor * map.value[j]);
      growth.segment(j * n, n)    = map.growth.col(j);
      frequency.segment(j * n, n) = map.frequency.col(j);
    }
    Table table, boundary;
    table.add("speed", "m/s", speed).add(axis.name, axis.unit, value);
    table.add("growth_rate", "1/s", growth).add("frequency", "Hz", frequency);
    boundary.add(axis.name, axis.unit, axis.factor * map.value);
    boundary.add("critical_speed", "m/s", map.critical_speed).add("frequency", "Hz", map.critical_frequency);
    if (const auto empty = growth.array().isNaN().count(); empty > 0)
      run.warn({WarningId::map_has_gaps, s.question.label,
                fmt::format("{} of the {} points of the map over speed and {} have no growth rate, because no "
                            "steady bite exists there",
                            empty, n * m, axis.name),
                "their cells are empty"});
    write_curve(run, curve::chatter_map, slug(s.question.condition.name), table, axis.name);
    write_curve(run, curve::chatter_boundary, slug(s.question.condition.name), boundary, axis.name);
  }
}

Table history_table(const ChatterStudy &s, const dynamics::ChatterHistory &h, const double force,
                    const double entry_tension, const double exit_tension, const double friction)
{
  const auto &labels = s.question.stand.structure.labels;
  const auto row_of  = [&](const std::string &label) -> Eigen::VectorXd {
    const auto match = std::find(labels.begin(), labels.end(), label);
    return 1e6 * h.point.row(match - labels.begin()).transpose();
  };
  Table table;
  table.add("time", "s", h.time).add("gap", "um", 1e6 * h.gap);
  for (const char *roll : {"upper work roll", "lower work roll"})
    if (std::find(labels.begin(), labels.end(), roll) != labels.end())
      table.add(std::string(roll).substr(0, 5) + "_work_roll", "um", row_of(roll));
  table.add("force", "kN", (h.force.array() + force) / 1e3);
  table.add("entry_tension", "MPa", (h.entry_tension.array() + entry_tension) / 1e6);
  table.add("exit_tension", "MPa", (h.exit_tension.array() + exit_tension) / 1e6);
  table.add("friction", "-", h.friction.array() + friction);
  return table;
}

void write_histories(RunContext &run, const ChatterStudy &s)
{
  for (const ChatterRecord &record : s.records)
    run.out.write_table("response/" + base_of(s) + "-" + word_of(record.place),
                        history_table(s, record.history, 0, 0, 0, 0));
  if (s.run) {
    const RollingCondition &c = s.question.condition;
    run.out.write_table(
        "response/" + base_of(s) + "-limit-cycle",
        history_table(s, s.run->history, s.run_force, c.entry_tension, c.exit_tension, s.run_friction));
  }
}

std::vector<ChatterVariantInfo> variants_of(const std::vector<OtherSearch> &all)
{
  std::vector<ChatterVariantInfo> variants;
  for (const OtherSearch &o : all) {
    variants.push_back({o.name, word_of(o.found.verdict), o.found.speed, o.found.frequency, o.growth});
    ChatterVariantInfo &one = variants.back();
    if (o.mode) {
      one.ratio               = o.mode->work_roll_ratio;
      one.force_phase         = o.mode->force_phase;
      one.entry_tension_phase = o.mode->entry_tension_phase;
      one.upper_moves_more    = o.mode->work_roll_ratio > 1;
    }
  }
  return variants;
}

ChatterPhases phases_of(const dynamics::ChatterMode &mode)
{
  return {mode.frequency,          mode.work_roll_ratio, mode.force_phase, mode.entry_tension_phase,
          mode.exit_tension_phase, mode.friction_phase,  mode.body};
}

ChatterCritical critical_of(const ChatterStudy &s)
{
  return {word_of(s.found.verdict),
          s.found.speed,
          s.found.frequency,
          s.question.speed_assumed ? not_given : s.growth,
          s.found.margin,
          s.found.margin_speed,
          s.question.analysis.speeds,
          verdict_sentence(s)};
}

LimitCycleInfo limit_cycle_of(const ChatterStudy &s)
{
  LimitCycleInfo cycle{
      s.run_speed, s.cycle.settled, 1e6 * s.cycle.amplitude, s.cycle.frequency, s.run->stopped, "", {}};
  for (const std::string &limit : s.cycle.settled ? s.cycle.limits : std::vector<std::string>{})
    cycle.limited_by += (cycle.limited_by.empty() ? "" : ", ") + limit;
  constexpr std::size_t most = 200;  // the rest repeats what the report shows of them
  for (std::size_t i = 0; i < std::min(most, s.run->events.size()); ++i) {
    const auto &event = s.run->events[i];
    std::string what  = dynamics::in_words(event.change);
    if (event.contact >= 0 && std::size_t(event.contact) < s.contacts.size())
      what += ": " + s.contacts[std::size_t(event.contact)];
    cycle.events.push_back({event.time, what});
  }
  return cycle;
}

ChatterCondition condition_record(const ChatterStudy &s)
{
  const RollingCondition &c = s.question.condition;
  const Friction &friction  = s.question.bite.strip.friction;
  ChatterCondition record;
  record.name      = c.name;
  record.slug      = slug(c.name);
  record.speed     = s.question.speed_assumed ? not_given : c.speed;
  record.scheme    = word_of(s.question.analysis.linearisation);
  record.reduction = 100 * (1 - c.exit_thickness / c.entry_thickness);
  record.viscosity = has_film(friction) ? 1e3 * friction.viscosity : not_given;
  record.structure = s.question.structure;
  record.critical  = critical_of(s);
  for (const ChatterRecord &history : s.records)
    record.histories.push_back(
        {"response/" + base_of(s) + "-" + word_of(history.place), history.speed, history.growth, history.in_time});
  if (s.run)
    record.limit_cycle = limit_cycle_of(s);
  if (s.mode)
    record.phases = phases_of(*s.mode);
  if (s.sensitivities)
    record.sensitivities = s.sensitivities->inputs;
  record.schemes     = variants_of(s.schemes);
  record.variants    = variants_of(s.variants);
  record.structures  = variants_of(s.structures);
  record.conclusions = conclusions(s);
  record.published   = published_rows(s);
  return record;
}
}  // namespace

void write_chatter(RunContext &run, const ChatterStudy &s)
{
  write_speeds(run, s);
  write_locus(run, s);
  write_maps(run, s);
  write_histories(run, s);
  run.out.write("curves/" + base_of(s) + ".json", json_of_record(condition_record(s)));
}
}  // namespace mill
