#include "dynamics/response/record_times.h"
#include <algorithm>

namespace mill::dynamics {
RecordTimes record_times(const Eigen::VectorXd &time)
{
  constexpr double widest_step = 1.5;  // medians: rounded times differ by less, a lost sample makes two
  RecordTimes r;
  r.samples                   = time.size();
  const Eigen::Index n        = r.samples - 1;
  const Eigen::VectorXd steps = time.tail(n) - time.head(n);
  r.duration                  = time[n] - time[0];
  Eigen::VectorXd sorted      = steps;
  std::nth_element(sorted.data(), sorted.data() + n / 2, sorted.data() + n);
  r.step = sorted[n / 2];
  for (Eigen::Index i = 0; i < n; ++i)
    if (steps[i] > widest_step * r.step) {
      ++r.n_gaps;
      if (steps[i] > r.longest_gap) {
        r.longest_gap = steps[i];
        r.longest_at  = time[i];
      }
    }
  return r;
}
}  // namespace mill::dynamics
