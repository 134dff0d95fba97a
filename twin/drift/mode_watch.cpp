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
  return reference_state.weight > 0 ? reference_state.mean : 0;
}

ModeWatch::State ModeWatch::state() const
{
  State now = reference_state;
  now.sums  = cusum.state;
  return now;
}

void ModeWatch::resume(const State &stored)
{
  reference_state = stored;
  cusum.state     = stored.sums;
}

ModeRow ModeWatch::take(const ModeFit &measured, const ExpectedMode &twin)
{
  ModeRow row;
  row.measured = measured;
  row.twin     = twin;
  if (measured.why_not.empty()) {
    State &s         = reference_state;
    const double off = std::log(measured.frequency / twin.frequency), sd = measured.sd;
    row.deviation = off / std::hypot(sd, twin_sd);
    if (s.reference_is == Reference::undecided)
      s.reference_is = twin_sd <= sd ? Reference::twin : Reference::first_blocks;
    if (s.reference_is == Reference::twin) {
      row.z     = off / std::hypot(sd, twin_sd);
      row.shift = cusum.take(row.z);
    } else if (s.n < wanted) {
      row.learning = true;
      ++s.n;
      const double w = 1 / (sd * sd), before = s.mean;
      s.weight += w;
      s.mean += w / s.weight * (off - s.mean);
      s.squares += w * (off - before) * (off - s.mean);
      if (s.n == wanted)
        s.scatter = std::max(1.0, std::sqrt(s.squares / (s.n - 1)));
    } else {
      row.z     = (off - s.mean) / (s.scatter * std::sqrt(sd * sd + 1 / s.weight));
      row.shift = cusum.take(row.z);
    }
  }
  row.up   = cusum.upward();
  row.down = cusum.downward();
  return row;
}
}  // namespace mill::twin
