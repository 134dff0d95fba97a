#include "dynamics/response/campbell.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
CampbellLine line_of(std::string name, std::string group, std::string shaft, const double per_turn,
                     const double diameter)
{
  return {std::move(name), std::move(group), std::move(shaft), per_turn, per_turn / (M_PI * diameter)};
}

double distance_from(const double speed, const std::array<double, 2> &range)
{
  if (std::isnan(range[0]))
    return not_given;
  if (speed < range[0])
    return speed / range[0] - 1;
  return speed > range[1] ? speed / range[1] - 1 : 0;
}

std::vector<CampbellCrossing> crossings(const std::vector<CampbellMode> &modes,
                                        const std::vector<CampbellLine> &lines,
                                        const std::array<double, 2> &speeds, const std::array<double, 2> &working)
{
  std::vector<CampbellCrossing> all;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const auto first = std::ptrdiff_t(all.size());
    for (std::size_t l = 0; l < lines.size(); ++l) {
      const double speed = modes[m].frequency / lines[l].per_length;  // (32.9)
      if (speed >= speeds[0] && speed <= speeds[1])
        all.push_back({int(m), int(l), speed, distance_from(speed, working)});
    }
    std::stable_sort(all.begin() + first, all.end(),
                     [](const auto &a, const auto &b) { return a.speed < b.speed; });
  }
  return all;
}

std::optional<CampbellCrossing> nearest(const CampbellRecord &record, const int mode)
{
  const double middle = (record.working[0] + record.working[1]) / 2;
  const auto further  = [&](const CampbellCrossing &a, const CampbellCrossing &b) {
    if (a.distance == 0 && b.distance == 0)
      return std::abs(a.speed - middle) > std::abs(b.speed - middle);
    return std::abs(a.distance) > std::abs(b.distance);
  };
  std::optional<CampbellCrossing> best;
  for (const CampbellCrossing &c : record.crossings)
    if (c.mode == mode && !std::isnan(c.distance) && (!best || further(*best, c)))
      best = c;
  return best;
}
}  // namespace mill::dynamics
