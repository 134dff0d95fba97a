#include "twin/chatter/critical_slopes.h"
#include "dynamics/chatter/chatter.h"

namespace mill::twin {
const InputDoubt *doubt_of(const std::vector<InputDoubt> &doubts, const std::string &key)
{
  const InputDoubt *best = nullptr;
  for (const InputDoubt &doubt : doubts)
    if (key.compare(0, doubt.key.size(), doubt.key) == 0 && (!best || doubt.key.size() > best->key.size()))
      best = &doubt;
  return best;
}

std::optional<CriticalPoint> critical_point(const dynamics::CriticalSpeed &critical)
{
  if (critical.verdict == dynamics::Verdict::crossing)
    for (const dynamics::Crossing &c : critical.crossings)
      if (c.speed == critical.speed && c.slope > 0)
        return CriticalPoint{c.speed, c.frequency, c.root, c.slope};
  return {};
}

std::vector<CriticalSlope> critical_slopes(const ChatterModel &model, const bite::RollBite &bite,
                                           const CriticalPoint &critical)
{
  const auto point     = dynamics::working_point(bite, critical.speed, model.scheme);
  const auto pass      = bite::linear_sensitivity(point.bite, point.state, model.scheme);
  const auto A         = dynamics::chatter_matrix(model.stand, point.by);
  const auto root      = dynamics::slope_of_eigenvalue(A, critical.root);
  const Eigen::Index n = model.stand.structure.n();
  const auto of_number = [&](const bite::PassNumber number) {
    return root.by(dynamics::chatter_matrix_by(model.stand, pass.by[std::size_t(number)])).real();
  };
  const double by_speed = of_number(bite::PassNumber::roll_speed);
  std::vector<CriticalSlope> slopes;
  const auto add = [&](const std::string &key, const std::string &name, const double growth) {
    slopes.push_back({key, name, -growth / by_speed});  // (27.4)
  };
  for (const bite::PassNumber number : bite::numbers_of(point.bite))
    if (number != bite::PassNumber::roll_speed) {
      const auto name = name_of(number);
      add(name.key, name.name, of_number(number));
    }
  for (const auto &number : model.numbers)
    add(number.key, number.name, root.by(dynamics::chatter_matrix_by(model.stand, point.by, number)).real());
  const char *span[][2] = {{"stand.entry_distance", "distance to the stand before"},
                           {"stand.exit_distance", "distance to the stand behind"}};
  for (int side = 0; side < 2; ++side) {  // the row of a tension goes with E/L, (27.7)
    Eigen::MatrixXd row   = Eigen::MatrixXd::Zero(A.rows(), A.cols());
    row.row(2 * n + side) = -A.row(2 * n + side);
    add(span[side][0], span[side][1], root.by(row).real());
  }
  return slopes;
}
}  // namespace mill::twin
