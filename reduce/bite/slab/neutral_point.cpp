#include "reduce/bite/slab/neutral_point.h"
#include <cmath>

namespace mill::bite {
int find_neutral_point(BiteState &s, const double least)
{
  const Eigen::Index n = s.slip.size();
  double previous = 0, first_change = 0, last_change = 0;
  Eigen::Index before = 0;
  int changes         = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(s.slip[i]) < least)
      continue;
    if (previous * s.slip[i] < 0) {
      const double t = previous / (previous - s.slip[i]);
      last_change    = (1 - t) * s.position[before] + t * s.position[i];
      first_change   = changes == 0 ? last_change : first_change;
      ++changes;
    }
    previous = s.slip[i];
    before   = i;
  }
  s.neutral_position  = changes ? 0.5 * (first_change + last_change) : not_given;
  s.neutral_thickness = not_given;
  for (Eigen::Index i = 1; i < n; ++i)
    if (s.position[i - 1] <= s.neutral_position && s.neutral_position <= s.position[i])
      s.neutral_thickness = s.thickness[i - 1] + (s.thickness[i] - s.thickness[i - 1]) *
                                                     (s.neutral_position - s.position[i - 1]) /
                                                     (s.position[i] - s.position[i - 1]);
  return changes;
}

double neutral_angle(const RollBite &bite, const BiteState &state)
{
  return std::asin(state.neutral_position / bite.roll_radius);
}
}  // namespace mill::bite
