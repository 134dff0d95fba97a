#include "dynamics/response/time_walk.h"
#include <algorithm>

namespace mill::dynamics {
namespace {
bool evenly_spaced(const Eigen::VectorXd &time, const double spacing)
{
  const auto n = time.size();
  return ((time.array() - time[0]) / spacing - Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1))).abs().maxCoeff() <
         evenness;
}
}  // namespace

OutputGrid output_grid(const ForceRecord &force, const double output_rate)
{
  return output_grid(force.time[0], force.time[force.time.size() - 1], output_rate);
}

OutputGrid output_grid(const double first, const double last, const double output_rate)
{
  return {first, 1 / output_rate, Eigen::Index(std::floor((last - first) * output_rate + evenness)) + 1};
}

CommonGrid common_grid(const ForceRecord &force, const OutputGrid &grid)
{
  const Eigen::Index n_lines = force.time.size() - 1;
  const double spacing       = (force.time[n_lines] - force.time[0]) / double(n_lines);
  return evenly_spaced(force.time, spacing) ? common_grid(n_lines, spacing, grid) : CommonGrid{};
}

CommonGrid common_grid(const Eigen::Index n_lines, const double spacing, const OutputGrid &grid)
{
  // A grid finer than 16 times what samples and outputs need costs more than steps of changing length.
  const double finest = 16 * (1 + grid.step / spacing);
  for (Eigen::Index per_sample = 1; double(per_sample) * grid.step / spacing < finest + 0.5; ++per_sample) {
    const double steps    = double(per_sample) * grid.step / spacing;
    const auto per_output = Eigen::Index(std::llround(steps));
    // over the whole record the two grids may drift apart by the same millionth of a spacing
    if (per_output < 1 || std::abs(steps / double(per_output) - 1) * double(n_lines) > evenness)
      continue;
    return {spacing / double(per_sample), per_sample, per_output};
  }
  return {};
}
}  // namespace mill::dynamics
