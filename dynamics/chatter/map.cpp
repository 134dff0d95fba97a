#include "dynamics/chatter/map.h"
#include "core/base/errors.h"
#include "core/process/parallel.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/flattening.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace mill::dynamics {
bite::RollBite with_quantity(bite::RollBite bite, const MapQuantity quantity, const double value)
{
  Strip &strip = bite.strip;
  switch (quantity) {
  case MapQuantity::reduction:
    if (!(value > 0 && value < 1))
      throw InputError(fmt::format("a reduction of {:g} has to lie between 0 and 1", value));
    strip.exit_thickness = strip.entry_thickness * (1 - value);
    break;
  case MapQuantity::tension:
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError(fmt::format("a factor of {:g} on the tensions must not be negative", value));
    strip.entry_tension *= value;
    strip.exit_tension *= value;
    break;
  case MapQuantity::viscosity:
    if (!has_film(strip.friction))
      throw InputError("a map over the viscosity needs the film law of an oil, but strip.friction.law = \"" +
                       name_of(strip.friction.law) + "\"");
    if (!(value > 0 && std::isfinite(value)))
      throw InputError(fmt::format("a viscosity of {:g} Pa s must be positive", value));
    strip.friction.viscosity = value;
    break;
  }
  return bite;
}

double quantity_of(const bite::RollBite &bite, const MapQuantity quantity)
{
  switch (quantity) {
  case MapQuantity::reduction:
    return 1 - bite.strip.exit_thickness / bite.strip.entry_thickness;
  case MapQuantity::tension:
    return 1;
  case MapQuantity::viscosity:
    return bite.strip.friction.viscosity;
  }
  return not_given;
}

std::string quantity_name(const MapQuantity quantity)
{
  return quantity == MapQuantity::reduction ? "reduction"
         : quantity == MapQuantity::tension ? "factor on both tensions"
                                            : "viscosity of the oil";
}

std::string reason_of(const NoBite reason)
{
  switch (reason) {
  case NoBite::none:
    return "there is a bite";
  case NoBite::flattening:
    return "the rolls flatten faster than the gap closes";
  case NoBite::not_drawn_in:
    return "the rolls skid: the neutral point would lie beyond the exit";
  case NoBite::torn_through:
    return "the rolls skid: the neutral point would lie before the entry";
  case NoBite::entry_tension:
    return "the entry tension reaches the flow stress";
  case NoBite::exit_tension:
    return "the exit tension reaches the flow stress";
  case NoBite::film:
    return "film and speeds do not settle";
  case NoBite::other:
    return "another reason";
  }
  return "";
}

namespace {
using bite::RollBite;

/// Where the neutral point lies on an arc that carries its force but has none inside.
NoBite side_of_skid(const RollBite &bite)
{
  double speed     = bite.roll_speed * bite.strip.exit_thickness / bite.strip.entry_thickness;
  const auto rules = hill_rules(bite);
  const auto state = [&](const double radius) {
    return bland_ford_state(bite, bite::pass_inputs<double>(bite, radius), speed, rules);
  };
  const auto arc        = flattened_arc(bite, [&](const double radius) { return state(radius).force; });
  const auto &c         = state(arc.radius).contact;
  const double position = c.free_neutral_angle;
  return position <= c.exit_angle    ? NoBite::not_drawn_in
         : position >= c.entry_angle ? NoBite::torn_through
                                     : NoBite::other;
}

/// Why the bite has no steady state.
NoBite classify(const RollBite &bite)
{
  const Strip &s = bite.strip;
  try {
    const auto in = bite::pass_inputs<double>(bite, bite.roll_radius);
    if (s.entry_tension > 0 && s.entry_tension >= stress_at(s.flow_stress, in, in.entry_thickness))
      return NoBite::entry_tension;
    if (s.exit_tension >= stress_at(s.flow_stress, in, in.exit_thickness))
      return NoBite::exit_tension;
    return side_of_skid(bite);
  } catch (const InputError &) {
    return NoBite::other;
  } catch (const bite::NoFlattenedRadius &) {
    return NoBite::flattening;
  } catch (const SolverError &) {
    return NoBite::film;
  }
}

void fill_cell(StabilityMap &map, std::string &message, const Eigen::Index i, const Eigen::Index j,
               const ChatterStandModel &stand, RollBite bite, const Linearisation scheme)
{
  try {
    const WorkingPoint point        = working_point(bite, map.speed[i], scheme);
    const std::complex<double> root = eigenvalues(chatter_matrix(stand, point.by))[0];
    map.growth(i, j)                = root.real();
    map.frequency(i, j)             = std::abs(root.imag()) / (2 * M_PI);
    return;
  } catch (const InputError &error) {
    message = error.problems.front().message;
  } catch (const SolverError &error) {
    message = error.report.what + ": " + error.report.where;
  }
  bite.roll_speed  = map.speed[i];
  map.reason(i, j) = int(classify(bite));
}

void fill_boundary(StabilityMap &map, const Eigen::Index j, const ChatterStandModel &stand, const RollBite &bite,
                   const Linearisation scheme)
{
  const Eigen::Index n = map.speed.size();
  if (n < 2)
    return;
  SpeedRange range;
  range.from                   = map.speed[0];
  range.to                     = map.speed[n - 1];
  const CriticalSpeed critical = critical_speed(stand, bite, scheme, range);
  if (critical.verdict != Verdict::crossing)
    return;
  map.critical_speed[j]     = critical.speed;
  map.critical_frequency[j] = critical.frequency;
}
}  // namespace

StabilityMap stability_map(const ChatterStandModel &stand, const RollBite &bite, const Linearisation scheme,
                           const Eigen::VectorXd &speed, const MapQuantity quantity, const Eigen::VectorXd &value,
                           const int threads)
{
  const Eigen::Index n = speed.size(), m = value.size();
  if (n == 0 || m == 0)
    throw InputError("a stability map needs at least one speed and one value of its quantity");
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(speed[i] > (i ? speed[i - 1] : 0)))
      throw InputError("the speeds of a stability map have to be positive and rising");
  std::vector<RollBite> columns;
  for (Eigen::Index j = 0; j < m; ++j)
    columns.push_back(with_quantity(bite, quantity, value[j]));

  StabilityMap map;
  map.quantity = quantity;
  map.speed    = speed;
  map.value    = value;
  map.growth = map.frequency = Eigen::MatrixXd::Constant(n, m, not_given);
  map.reason                 = Eigen::MatrixXi::Zero(n, m);
  map.critical_speed = map.critical_frequency = Eigen::VectorXd::Constant(m, not_given);
  std::vector<std::string> messages(std::size_t(n * m));

  share_tasks(m, threads, [&](const Eigen::Index j) {  // every column has its own places
    const RollBite &column = columns[std::size_t(j)];
    for (Eigen::Index i = 0; i < n; ++i)
      fill_cell(map, messages[std::size_t(i * m + j)], i, j, stand, column, scheme);
    fill_boundary(map, j, stand, column, scheme);
  });

  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const auto reason = std::size_t(map.reason(i, j));
      if (map.cells[reason]++ == 0)
        map.examples[reason] = messages[std::size_t(i * m + j)];
    }
  return map;
}
}  // namespace mill::dynamics
