#include "twin/drift/mode_watch.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
std::vector<ExpectedMode> ModesAtLoad::at(const double force) const
{
  std::vector<ExpectedMode> modes;
  const Eigen::Index k = load.size();
  Eigen::Index i       = 0;
  double share         = 0;
  if (k > 1 && force > load[0]) {
    while (i + 2 < k && force > load[i + 1])
      ++i;
    share = std::min(1.0, std::log(force / load[i]) / std::log(load[i + 1] / load[i]));
  }
  for (Eigen::Index m = 0; m < frequency.cols(); ++m)
    modes.push_back(
        {k > 1 ? frequency(i, m) + share * (frequency(i + 1, m) - frequency(i, m)) : frequency(0, m), damping[m]});
  return modes;
}

ModeWatch::ModeWatch(const double twin_sd_, const CusumRule &rule_, const int reference_blocks)
    : rule(rule_), twin_sd(twin_sd_), wanted(reference_blocks), cusum(rule_)
{
}

void ModeWatch::restart(const double twin_sd_)
{
  *this = ModeWatch(twin_sd_, rule, wanted);
}

double ModeWatch::reference() const
{
  return weight > 0 ? mean : 0;
}

ModeRow ModeWatch::take(const ModeFit &measured, const ExpectedMode &twin)
{
  ModeRow row;
  row.measured = measured;
  row.twin     = twin;
  if (measured.why_not.empty()) {
    const double off = std::log(measured.frequency / twin.frequency), sd = measured.sd;
    row.deviation = off / std::hypot(sd, twin_sd);
    if (reference_is == Reference::undecided)
      reference_is = twin_sd <= sd ? Reference::twin : Reference::first_blocks;
    if (reference_is == Reference::twin) {
      row.z     = off / std::hypot(sd, twin_sd);
      row.shift = cusum.take(row.z);
    } else if (n < wanted) {
      row.learning = true;
      ++n;
      const double w = 1 / (sd * sd), before = mean;
      weight += w;
      mean += w / weight * (off - mean);
      squares += w * (off - before) * (off - mean);
      if (n == wanted)
        scatter = std::max(1.0, std::sqrt(squares / (n - 1)));
    } else {
      row.z     = (off - mean) / (scatter * std::sqrt(sd * sd + 1 / weight));
      row.shift = cusum.take(row.z);
    }
  }
  row.up   = cusum.upward();
  row.down = cusum.downward();
  return row;
}
}  // namespace mill::twin
