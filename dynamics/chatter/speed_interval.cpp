#include "dynamics/chatter/speed_interval.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "dynamics/chatter/excess_growth.h"
#include "dynamics/chatter/speed_slopes.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
// Growth beyond rounding, (25.9), as the search takes it; NaN without a bite.
double growth_at(const SpeedQuestion &q, const double speed)
{
  try {
    return excess_growth(eigenvalues(chatter_matrix(q.stand, working_point(q.bite, speed, q.scheme).by)));
  } catch (const InputError &) {
    return not_given;
  } catch (const SolverError &) {
    return not_given;
  }
}

DampingOfModes damping_of_modes(const SpeedQuestion &q)
{
  return {q.modal_damping, q.loss};
}

StructureNumber structure_number(const SpeedQuestion &q, const UncertainNumber &number)
{
  StructureNumber s;
  const StandStructure &stand = q.stand.structure;
  if (number.structure.dK.size() || number.structure.dM.size()) {
    s.K_by                            = number.structure.dK;
    s.M_by                            = number.structure.dM;
    const Eigen::VectorXd frequencies = stand.K.diagonal().cwiseSqrt() / (2 * M_PI);
    s.C_by                            = damping_by(frequencies, damping_of_modes(q), number.structure);
  }
  if (number.damping)
    s.C_by = damping_matrix(stand.K, stand.M, damping_of_modes(q));
  return s;
}

bool is_of_structure(const UncertainNumber &number)
{
  return number.damping || number.structure.dK.size() || number.structure.dM.size();
}
}  // namespace

SpeedQuestion moved(const SpeedQuestion &question, const std::vector<UncertainNumber> &numbers,
                    const Eigen::VectorXd &s)
{
  SpeedQuestion q = question;
  ModalChange change;
  bool damping_moves = false;
  double on_damping  = 1;
  const auto add     = [](Eigen::MatrixXd &sum, const double factor, const Eigen::MatrixXd &by) {
    if (by.size())
      sum = sum.size() ? Eigen::MatrixXd(sum + factor * by) : Eigen::MatrixXd(factor * by);
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const UncertainNumber &n = numbers[i];
    const double factor      = std::exp(s[Eigen::Index(i)] * n.error);
    for (const bite::PassNumber number : n.bite)
      q.bite = with_number_scaled(q.bite, number, factor);
    add(change.dK, factor - 1, n.structure.dK);
    add(change.dM, factor - 1, n.structure.dM);
    if (q.loss.size())
      add(q.loss, factor - 1, n.structure.dL);
    on_damping *= n.damping ? factor : 1;
    q.stand.entry_distance *= n.entry_distance ? factor : 1;
    q.stand.exit_distance *= n.exit_distance ? factor : 1;
    damping_moves = damping_moves || n.damping;
  }
  q.modal_damping *= on_damping;
  q.loss *= on_damping;
  if (change.dK.size() || change.dM.size() || damping_moves)
    q.stand.structure =
        moved_structure(q.stand.structure, damping_of_modes(question), damping_of_modes(q), change);
  return q;
}

double crossing_near(const SpeedQuestion &q, const double near)
{
  constexpr double step = 1.04;
  const double start    = std::clamp(near, q.range.from, q.range.to);
  double speed = start, growth = growth_at(q, start);
  if (std::isnan(growth))
    return not_given;
  const bool upward = growth < 0;  // the crossing is above
  for (;;) {
    const double next = std::clamp(upward ? speed * step : speed / step, q.range.from, q.range.to);
    if (next == speed)
      return not_given;
    const double there = growth_at(q, next);
    if (std::isnan(there))
      return not_given;
    if ((there > 0) != (growth > 0))
      return root_between(
                 {speed, growth}, {next, there}, [&](const double s) { return growth_at(q, s); }, 1e-7)
          .value_or(not_given);
    speed  = next;
    growth = there;
  }
}

SpeedInterval speed_interval(const SpeedQuestion &q, const StandSpeed &critical,
                             const std::vector<UncertainNumber> &numbers)
{
  SpeedInterval interval;
  const Slopes slopes = slopes_at(q.stand, q.bite, q.scheme, critical.speed, &critical_crossing(critical));
  Eigen::VectorXd move(Eigen::Index(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const UncertainNumber &n        = numbers[i];
    const StructureNumber structure = structure_number(q, n);
    VariedInput varied;
    varied.bite           = n.bite;
    varied.structure      = is_of_structure(n) ? &structure : nullptr;
    varied.entry_distance = n.entry_distance;
    varied.exit_distance  = n.exit_distance;
    const double slope    = speed_slope(slopes, varied);
    move[Eigen::Index(i)] = slope * n.error;
    interval.shares.push_back({n.name, n.error, slope, slope * n.error});
  }
  interval.error = move.norm();  // (27.11)
  if (!std::isfinite(interval.error))
    return interval;  // a slope that has no value: neither end is known
  std::stable_sort(interval.shares.begin(), interval.shares.end(),
                   [](const auto &a, const auto &b) { return std::abs(a.move) > std::abs(b.move); });
  if (interval.error == 0) {
    interval.low = interval.high = critical.speed;
    return interval;
  }
  const Eigen::VectorXd direction = move / interval.error;  // (27.12)
  const double factor             = std::exp(interval.error);
  interval.low                    = crossing_near(moved(q, numbers, -direction), critical.speed / factor);
  interval.high                   = crossing_near(moved(q, numbers, direction), critical.speed * factor);
  return interval;
}
}  // namespace mill::dynamics
