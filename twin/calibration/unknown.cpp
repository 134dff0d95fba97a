#include "twin/calibration/unknown.h"
#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace mill::twin {
namespace {
/// Mode of "f2" or "zeta2", from 0; -1: the name does not continue as a number from 1.
Eigen::Index numbered_mode(const std::string_view name, const std::string_view head)
{
  if (name.size() <= head.size() || name.substr(0, head.size()) != head)
    return -1;
  return std::atoi(name.data() + head.size()) - 1;
}
}  // namespace

std::string ratio_name(const Eigen::Index mode)
{
  return ratios_name + std::to_string(mode + 1);
}

Moved moved_by(const std::string &name)
{
  if (name == ratios_name)
    return {Moves::ratios};
  if (name == gain_name)
    return {Moves::gain};
  if (name == delay_name)
    return {Moves::delay};
  if (const Eigen::Index mode = numbered_mode(name, ratios_name); mode >= 0)
    return {Moves::ratio, mode};
  if (const Eigen::Index mode = numbered_mode(name, "f"); mode >= 0)
    return {Moves::frequency, mode};
  return {};
}
}  // namespace mill::twin
