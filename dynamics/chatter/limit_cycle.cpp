#include "core/base/errors.h"
#include "dynamics/chatter/run.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
// Samples at which the signal passes its level upwards, with the part of the step.
std::vector<double> upward_passes(const Eigen::VectorXd &signal, const double level)
{
  std::vector<double> positions;
  for (Eigen::Index k = 1; k < signal.size(); ++k)
    if (signal[k - 1] < level && signal[k] >= level)
      positions.push_back(double(k - 1) + (level - signal[k - 1]) / (signal[k] - signal[k - 1]));
  return positions;
}

// Top of the parabola through the largest sample and its neighbours.
double highest(const Eigen::VectorXd &signal)
{
  Eigen::Index k   = 0;
  const double top = signal.maxCoeff(&k);
  if (k == 0 || k == signal.size() - 1)
    return top;
  const double slope = 0.5 * (signal[k + 1] - signal[k - 1]), bend = signal[k + 1] - 2 * top + signal[k - 1];
  return bend < 0 ? top - 0.5 * slope * slope / bend : top;
}

double half_swing(const Eigen::VectorXd &signal)
{
  return 0.5 * (highest(signal) + highest(-signal));
}

Eigen::Index point_of(const StandStructure &s, const std::string &label)
{
  const auto position = std::find(s.labels.begin(), s.labels.end(), label);
  if (position == s.labels.end())
    throw InputError("the stand has no point \"" + label + "\" at which rolls could part");
  return position - s.labels.begin();
}
}  // namespace

const char *in_words(const ChatterChange change)
{
  switch (change) {
  case ChatterChange::entry_slack:
    return "entry strip slack";
  case ChatterChange::entry_taut:
    return "entry strip taut";
  case ChatterChange::exit_slack:
    return "exit strip slack";
  case ChatterChange::exit_taut:
    return "exit strip taut";
  case ChatterChange::strip_free:
    return "strip free of the rolls";
  case ChatterChange::strip_gripped:
    return "strip gripped by the rolls";
  case ChatterChange::skid_exit:
    return "rolls skid, neutral point at the exit";
  case ChatterChange::skid_entry:
    return "rolls skid, neutral point at the entry";
  case ChatterChange::grip:
    return "neutral point back on the arc";
  case ChatterChange::rolls_part:
    return "work and backup roll part";
  case ChatterChange::rolls_meet:
    return "work and backup roll meet";
  }
  return "";
}

std::vector<RollContact> roll_contacts(const StandStructure &s, const double upper, const double lower,
                                       const double rolling_force)
{
  const auto contact = [&](const std::string &side, const double stiffness) {
    const Eigen::VectorXd row =
        s.point.row(point_of(s, side + " work roll")) - s.point.row(point_of(s, side + " backup roll"));
    return RollContact{side + " backup roll on " + side + " work roll", row, stiffness, rolling_force};
  };
  return {contact("upper", upper), contact("lower", lower)};
}

std::vector<RollContact> roll_contacts(const StandStructure &s, const double rolling_force)
{
  if (s.n() != 6 || s.point.cwiseAbs() != Eigen::MatrixXd::Identity(6, 6))
    throw InputError("the stiffness between the rolls can be read off six masses only; the stand \"" + s.name +
                     "\" has " + std::to_string(s.n()) + " unknowns: give both stiffnesses");
  return roll_contacts(s, -s.K(1, 2), -s.K(3, 4), rolling_force);
}

LimitCycle limit_cycle(const ChatterRun &run, const int cycles, const double settled_drift)
{
  LimitCycle c;
  c.frequency                = not_given;
  c.drift                    = not_given;
  const Eigen::VectorXd &gap = run.history.gap;
  const Eigen::Index n       = gap.size();
  if (n < 3)
    return c;
  const std::vector<double> pass = upward_passes(gap, gap.tail(n / 2).mean());
  const auto wanted              = std::size_t(cycles);
  if (pass.size() < 2 * wanted + 1) {
    c.amplitude = half_swing(gap);
    return c;
  }
  const double step = run.history.time[1] - run.history.time[0];
  const double end = pass.back(), middle = pass[pass.size() - 1 - wanted],
               begin = pass[pass.size() - 1 - 2 * wanted];
  const auto window  = [&](const double from, const double to) -> Eigen::VectorXd {
    const auto first = Eigen::Index(std::ceil(from)), last = Eigen::Index(std::floor(to));
    return gap.segment(first, last - first + 1);
  };
  const double before = half_swing(window(begin, middle));
  c.amplitude         = half_swing(window(middle, end));
  c.frequency         = cycles / ((end - middle) * step);
  c.drift             = std::log(c.amplitude / before) / (0.5 * (end - begin) * step);
  c.settled           = std::abs(c.drift) <= settled_drift;
  for (const ChatterEvent &e : run.events) {
    if (e.time < run.history.time[0] + middle * step)
      continue;
    const std::string words = in_words(e.change);
    if (std::find(c.limits.begin(), c.limits.end(), words) == c.limits.end())
      c.limits.push_back(words);
  }
  return c;
}
}  // namespace mill::dynamics
