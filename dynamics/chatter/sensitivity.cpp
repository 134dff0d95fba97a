#include "dynamics/chatter/sensitivity.h"
#include "core/base/errors.h"
#include "core/process/parallel.h"
#include "dynamics/chatter/speed_slopes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::dynamics {
namespace {
using bite::PassNumber;

VariedInput varied_input_of(const bite::RollBite &bite, const PassNumber number)
{
  const auto [key, name, unit] = name_of(number);
  const double diameter        = number == PassNumber::roll_radius ? 2 : 1;
  return {key, name, unit, diameter * value_of(bite, number), {number}};
}

std::vector<VariedInput> varied_inputs_of(const ChatterStandModel &stand,
                                          const std::vector<StructureNumber> &numbers, const bite::RollBite &bite)
{
  std::vector<VariedInput> all;
  for (const PassNumber number : numbers_of(bite))
    all.push_back(varied_input_of(bite, number));
  const auto together = [&](const char *key, const char *name, const PassNumber a, const PassNumber b) {
    if (value_of(bite, a) != 0 && value_of(bite, b) != 0)
      all.push_back({key, name, "1", 1, {a, b}});
  };
  together("condition.tensions", "both tensions", PassNumber::entry_tension, PassNumber::exit_tension);
  if (has_film(bite.strip.friction))
    together("oil.friction", "friction as a whole", PassNumber::mu0, PassNumber::mu1);
  for (const StructureNumber &number : numbers) {
    VariedInput varied{number.key, number.name, number.unit, number.value, {}};
    varied.structure = &number;
    all.push_back(varied);
  }
  VariedInput entry{"stand.entry_distance", "distance to the stand before", "m", stand.entry_distance, {}};
  entry.entry_distance = true;
  VariedInput exit{"stand.exit_distance", "distance to the stand behind", "m", stand.exit_distance, {}};
  exit.exit_distance = true;
  VariedInput both{"stand.distances", "both distances", "1", 1, {}};
  both.entry_distance = both.exit_distance = true;
  VariedInput modulus{"strip.youngs_modulus", "Young's modulus of the strip", "Pa", stand.strip_modulus, {}};
  modulus.strip_modulus = true;
  for (const VariedInput &varied : {entry, exit, both, modulus})
    all.push_back(varied);
  return all;
}

/// The stand and its bite with one input times a factor.
struct Changed {
  ChatterStandModel stand;
  bite::RollBite bite;
};

Changed changed(const ChatterStandModel &stand, const bite::RollBite &bite, const VariedInput &varied,
                const double factor)
{
  Changed c{stand, bite};
  for (const PassNumber number : varied.bite)
    c.bite = with_number_scaled(c.bite, number, factor);
  if (varied.structure)
    c.stand.structure = varied.structure->scaled(factor);
  c.stand.entry_distance *= varied.entry_distance ? factor : 1;
  c.stand.exit_distance *= varied.exit_distance ? factor : 1;
  c.stand.strip_modulus *= varied.strip_modulus ? factor : 1;
  return c;
}

bool is_speed(const VariedInput &varied)
{
  return varied.bite == std::vector<PassNumber>{PassNumber::roll_speed};
}

FiniteChange finite_change(const ChatterStandModel &stand, const bite::RollBite &bite, const VariedInput &varied,
                           const double factor, const SensitivityRequest &request, const SensitivityTable &base)
{
  FiniteChange change;
  const auto note = [&](const std::string &text) {
    if (change.outcome.empty())
      change.outcome = text;
  };
  try {
    const Changed c = changed(stand, bite, varied, factor);
    if (varied.bite.empty())
      change.friction = 0;  // the bite is the same
    else
      try {
        const double speed = is_speed(varied) ? factor * request.working_speed : request.working_speed;
        change.friction    = working_point(c.bite, speed, request.scheme).state.friction / base.friction - 1;
      } catch (const InputError &error) {
        note(error.problems.front().message);
      } catch (const SolverError &error) {
        note(error.report.what + ": " + error.report.where);
      }
    if (is_speed(varied))
      return change;
    const CriticalSpeed critical = critical_speed(c.stand, c.bite, request.scheme, request.range);
    if (critical.verdict != Verdict::crossing)
      note(sentence(critical, request.range));
    else if (std::isnan(base.critical_speed))
      note(fmt::format("critical speed {:.3f} m/s, the unchanged stand has none", critical.speed));
    else {
      change.critical_speed = critical.speed / base.critical_speed - 1;
      if (!varied.structure)  // whose matrices do not know how they move from the changed structure on
        change.slope = speed_slope(
            slopes_at(c.stand, c.bite, request.scheme, critical.speed, &critical_crossing(critical)), varied);
    }
  } catch (const InputError &error) {
    note(error.problems.front().message);
  } catch (const SolverError &error) {
    note(error.report.what + ": " + error.report.where);
  }
  return change;
}

/// The critical speed goes one way: slopes here and at both changes, and both changes, have one sign.  Below 1e-9
/// is the rounding of a search.
bool goes_one_way(const double slope, const FiniteChange &lowered, const FiniteChange &raised)
{
  bool up = false, down = false;
  for (const double x : {slope, lowered.slope, raised.slope, -lowered.critical_speed, raised.critical_speed}) {
    up   = up || x > 1e-9;
    down = down || x < -1e-9;
  }
  return !(up && down);
}

void fill_finite_changes(SensitivityTable &table, const std::vector<VariedInput> &varied_inputs,
                         const ChatterStandModel &stand, const bite::RollBite &bite,
                         const SensitivityRequest &request)
{
  share_tasks(2 * long(varied_inputs.size()), request.threads, [&](const long i) {
    const bool raised               = i % 2;
    const auto varied               = std::size_t(i / 2);
    const double factor             = raised ? 1 + request.change : 1 - request.change;
    ChatterSensitivity &s           = table.inputs[varied];
    (raised ? s.raised : s.lowered) = finite_change(stand, bite, varied_inputs[varied], factor, request, table);
  });
  for (ChatterSensitivity &s : table.inputs)
    s.monotone = goes_one_way(s.critical_speed, s.lowered, s.raised);
}

/// The same stand under Coulomb friction of the working point: what is left without the way over the friction.
void fill_held_friction(SensitivityTable &table, const std::vector<VariedInput> &varied_inputs,
                        const ChatterStandModel &stand, bite::RollBite bite, const SensitivityRequest &request)
{
  bite.strip.friction             = Friction{};
  bite.strip.friction.coefficient = table.friction;
  const StandSpeed critical       = critical_speed(stand, bite, request.scheme, request.range);
  if (critical.verdict != Verdict::crossing)
    return;
  table.critical_speed_at_held_friction = critical.speed;
  const Slopes slopes = slopes_at(stand, bite, request.scheme, critical.speed, &critical_crossing(critical));
  for (std::size_t i = 0; i < varied_inputs.size(); ++i)
    if (!is_speed(varied_inputs[i]))
      table.inputs[i].critical_speed_at_held_friction = speed_slope(slopes, varied_inputs[i]);
}

void sort_by_size(SensitivityTable &table)
{
  const bool critical = !std::isnan(table.critical_speed);
  const auto size     = [&](const ChatterSensitivity &s) {
    const double slope = critical ? s.critical_speed : s.growth;
    return std::isnan(slope) ? -1 : std::abs(slope);
  };
  std::stable_sort(table.inputs.begin(), table.inputs.end(),
                   [&](const auto &a, const auto &b) { return size(a) > size(b); });
}
}  // namespace

SensitivityTable chatter_sensitivities(const ChatterStandModel &stand, const std::vector<StructureNumber> &numbers,
                                       const bite::RollBite &bite, const SensitivityRequest &request)
{
  if (!(request.working_speed > 0))
    throw InputError(
        fmt::format("sensitivities need a working speed above zero, not {:g} m/s", request.working_speed));
  if (!(request.change >= 0 && request.change < 1))
    throw InputError(fmt::format("a finite change of {:g} has to lie between 0 and 1", request.change));
  bite::RollBite pass      = bite;
  pass.roll_speed          = request.working_speed;
  const auto varied_inputs = varied_inputs_of(stand, numbers, pass);
  const Slopes work        = slopes_at(stand, pass, request.scheme, request.working_speed, nullptr);

  SensitivityTable table;
  table.working_speed = request.working_speed;
  table.friction      = work.point.state.friction;
  table.force         = work.point.state.force;
  table.growth        = work.eigenvalue.value.real();
  for (const VariedInput &varied : varied_inputs) {
    ChatterSensitivity s;
    s.key      = varied.key;
    s.name     = varied.name;
    s.unit     = varied.unit;
    s.value    = varied.value;
    s.friction = work.friction(varied);
    s.force    = work.force(varied);
    s.growth   = work.growth(varied);
    table.inputs.push_back(s);
  }

  const StandSpeed critical = critical_speed(stand, pass, request.scheme, request.range);
  table.verdict             = sentence(critical, request.range);
  if (critical.verdict == Verdict::crossing) {
    table.critical_speed = critical.speed;
    table.frequency      = critical.frequency;
    const Slopes slopes  = slopes_at(stand, pass, request.scheme, critical.speed, &critical_crossing(critical));
    table.growth_by_log_speed = slopes.growth(roll_speed_input());
    for (std::size_t i = 0; i < varied_inputs.size(); ++i)
      if (!is_speed(varied_inputs[i]))
        table.inputs[i].critical_speed = speed_slope(slopes, varied_inputs[i]);
  }
  fill_held_friction(table, varied_inputs, stand, pass, request);
  if (request.change > 0)
    fill_finite_changes(table, varied_inputs, stand, pass, request);
  sort_by_size(table);
  return table;
}
}  // namespace mill::dynamics
