#include "dynamics/response/record_walk.h"
#include <algorithm>

namespace mill::dynamics {
void RecordSurvey::add(const double time, const double force)
{
  if (n == 0) {
    first       = time;
    first_force = smallest = largest = force;
  }
  last     = time;
  smallest = std::min(smallest, force);
  largest  = std::max(largest, force);
  // Neumaier's sum: the carry holds what rounding takes away.
  const double term = force - first_force, sum = sum_ + term;
  carry_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
  sum_ = sum;
  if (n > 0) {
    // |(t - t0)/s - i| < evenness, solved for the spacing s
    const double i = double(n), passed = time - first;
    least_ = std::max(least_, passed / (i + evenness));
    most_  = std::min(most_, passed / (i - evenness));
  }
  ++n;
}

bool RecordSurvey::is_even() const
{
  return n > 1 && spacing() > least_ && spacing() < most_;
}

double RecordSurvey::spacing() const
{
  return (last - first) / double(n - 1);
}

double RecordSurvey::mean() const
{
  return first_force + (sum_ + carry_) / double(n);
}

RecordWalk::RecordWalk(const RecordSurvey &survey, const double output_rate)
    : grid_(output_grid(survey.first, survey.last, output_rate)), n_(survey.n)
{
  if (survey.is_even())
    common_ = common_grid(Eigen::Index(survey.n - 1), survey.spacing(), grid_);
}
}  // namespace mill::dynamics
