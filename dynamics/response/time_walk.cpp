#include "dynamics/response/time_walk.h"
#include <algorithm>

namespace mill::dynamics {
namespace {
// Times written with few digits are even to about a millionth of their spacing; the force read there is that much
// of one sample's change beside the straight line.
constexpr double evenness = 1e-6;

bool evenly_spaced(const Eigen::VectorXd &time, const double spacing)
{
  const auto n = time.size();
  return ((time.array() - time[0]) / spacing - Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1))).abs().maxCoeff() <
         evenness;
}
}  // namespace

OutputGrid output_grid(const ForceRecord &force, const double output_rate)
{
  const double duration = force.time[force.time.size() - 1] - force.time[0];
  const double last     = std::floor(duration * output_rate + evenness);
  return {force.time[0], 1 / output_rate, Eigen::Index(last) + 1};
}

CommonGrid common_grid(const ForceRecord &force, const OutputGrid &grid)
{
  const Eigen::Index n_lines = force.time.size() - 1;
  const double spacing       = (force.time[n_lines] - force.time[0]) / double(n_lines);
  if (!evenly_spaced(force.time, spacing))
    return {};
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
