#include "twin/cleaning/long_gaps.h"
#include "twin/cleaning/time_grid.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
void shorten_long_gaps(RawRecord &record)
{
  const Eigen::Index n = record.time.size();
  if (n < 3)
    return;
  const double step = median_step(record);
  if (!(step > 0) || (record.time[n - 1] - record.time[0]) / step < double(std::max(largest_grid_of_gaps, 2 * n)))
    return;
  double moved = 0;  // s
  for (Eigen::Index i = 1; i < n; ++i) {
    const double gap     = record.time[i] - moved - record.time[i - 1];
    const double samples = std::round(gap / step);
    if (samples > double(shortened_gap)) {
      const double less = (samples - double(shortened_gap)) * step;
      moved += less;
      record.notes.push_back(
          fmt::format("the gap of {:.6g} s at {:.6g} s is shortened to {:.6g} s, since an even grid "
                      "over it would take {:.2g} GB for each channel; later times are {:.6g} s "
                      "earlier than recorded",
                      gap, record.time[i - 1], gap - less, 8e-9 * samples, moved));
    }
    record.time[i] -= moved;
  }
}
}  // namespace mill::twin
