#include "reduce/bite/linear/stiffness_map.h"
#include "core/base/errors.h"
#include "core/process/parallel.h"
#include <algorithm>

namespace mill::bite {
RollBite with_quantity(RollBite bite, const MapQuantity quantity, const double value)
{
  switch (quantity) {
  case MapQuantity::reduction:
    bite.strip.exit_thickness = bite.strip.entry_thickness * (1 - value);
    break;
  case MapQuantity::friction:
    bite.strip.friction = with_number(bite.strip.friction, value);
    break;
  case MapQuantity::entry_tension:
    bite.strip.entry_tension = value;
    break;
  case MapQuantity::exit_tension:
    bite.strip.exit_tension = value;
    break;
  case MapQuantity::roll_speed:
    bite.roll_speed = value;
    break;
  }
  return bite;
}

StiffnessMap stiffness_map(const RollBite &bite, const SlabModel &model, const MapAxis &rows,
                           const MapAxis &columns, const int threads)
{
  const Eigen::Index n = rows.value.size(), m = columns.value.size();
  if (n == 0 || m == 0)
    throw InputError("a map needs at least one value on each axis");
  with_quantity(with_quantity(bite, rows.quantity, rows.value[0]), columns.quantity, columns.value[0]);
  SlabModel lean    = model;
  lean.curve_points = 0;

  StiffnessMap map;
  map.force = map.slope = map.slope_following = map.flattened_radius = Eigen::MatrixXd::Constant(n, m, not_given);
  map.reason                                                         = Eigen::MatrixXi::Constant(n, m, -1);
  std::vector<std::string> why(std::size_t(n * m));  // empty where there is a state
  share_tasks(n, threads, [&](const Eigen::Index i) {
    const RollBite row = with_quantity(bite, rows.quantity, rows.value[i]);
    for (Eigen::Index j = 0; j < m; ++j)
      try {
        const BiteState state      = solve_slab(with_quantity(row, columns.quantity, columns.value[j]), lean);
        map.force(i, j)            = state.force;
        map.slope(i, j)            = -by(state.force_by, Input::exit_thickness);
        map.slope_following(i, j)  = -state.force_by_exit_following;
        map.flattened_radius(i, j) = state.flattened_radius;
      } catch (const InputError &error) {
        why[std::size_t(i * m + j)] = error.problems.front().message;
      } catch (const SolverError &error) {
        why[std::size_t(i * m + j)] = error.report.what + ": " + error.report.where;
      }
  });

  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const std::string &text = why[std::size_t(i * m + j)];
      if (text.empty())
        continue;
      const auto known = std::find(map.reasons.begin(), map.reasons.end(), text);
      map.reason(i, j) = int(known - map.reasons.begin());
      if (known == map.reasons.end())
        map.reasons.push_back(text);
    }
  return map;
}
}  // namespace mill::bite
