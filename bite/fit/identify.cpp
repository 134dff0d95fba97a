#include "bite/fit/identify.h"

namespace mill::bite {
namespace {
// Takes the number out that the worst known direction is most one of.
void keep_worst_known(FitAnswer &answer)
{
  const FitDirection worst = directions_of(answer.best).front();
  Eigen::Index which;
  worst.unit.cwiseAbs().maxCoeff(&which);
  auto &unknowns = answer.problem.unknowns;
  answer.kept.push_back({unknowns[std::size_t(which)], unknowns, worst});
  // It is held where the search for a possible pass has left it.
  const FitPoint point = answer.best;
  std::vector<FitUnknown> moved{unknowns[std::size_t(which)]};
  Eigen::VectorXd by(1), x(point.x.size() - 1);
  by[0] = point.x[which];
  for (auto &pass : answer.problem.passes)
    pass.bite.strip = with_factors(pass.bite.strip, moved, by);
  unknowns.erase(unknowns.begin() + which);
  for (Eigen::Index j = 0, k = 0; j < point.x.size(); ++j)
    if (j != which)
      x[k++] = point.x[j];
  answer.best = *fit_point(answer.problem, x);
}

bool told(const FitAnswer &answer, const bool one_number)
{
  if (answer.problem.unknowns.size() == 1)
    return true;
  return !one_number && directions_of(answer.best).front().deviation <= told_apart;
}
}  // namespace

FitAnswer identify(FitProblem problem, const bool one_number)
{
  FitAnswer answer;
  answer.problem = std::move(problem);
  answer.best    = feasible_start(answer.problem);
  while (!told(answer, one_number))  // before the first step: a direction without end leads anywhere
    keep_worst_known(answer);
  answer.best = least_misfit(answer.problem, answer.best);
  while (!told(answer, one_number)) {
    FitAnswer again  = answer;
    again.best       = feasible_start(again.problem);  // the number to keep is that of the case
    again.best.slope = answer.best.slope;
    keep_worst_known(again);
    again.best = least_misfit(again.problem, again.best);
    answer     = std::move(again);
  }
  return answer;
}

void find_intervals(FitAnswer &answer)
{
  answer.intervals.clear();
  for (std::size_t i = 0; i < answer.problem.unknowns.size(); ++i)
    answer.intervals.push_back(profile_interval(answer.problem, answer.best, i));
}
}  // namespace mill::bite
