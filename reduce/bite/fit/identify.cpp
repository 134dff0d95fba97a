#include "reduce/bite/fit/identify.h"
#include <optional>

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
  const auto same = fit_point(answer.problem, x);
  answer.best     = same ? *same : feasible_start(answer.problem);  // a number that stood at its bound
}

// How far the worst known direction reaches at this point.
double worst_deviation(const FitAnswer &answer)
{
  return answer.problem.unknowns.size() == 1 ? 0 : directions_of(answer.best).front().deviation;
}

// The fit without the number that is not identified; nothing where the data refuse the case's value for it: slopes
// that vanish at the fitted point, next to skidding, do not yet leave it open.
std::optional<FitAnswer> without_worst_known(const FitAnswer &answer)
{
  constexpr double refused = 3.84;  // chi-square of one number at 95 %
  FitAnswer other          = answer;
  other.best               = feasible_start(answer.problem);
  other.best.slope         = answer.best.slope;  // says which number it is
  keep_worst_known(other);
  other.best = least_misfit(other.problem, other.best);
  return other.best.misfit - answer.best.misfit > refused ? std::nullopt : std::optional(std::move(other));
}
}  // namespace

FitAnswer identify(FitProblem problem, const bool one_number)
{
  constexpr double endless = 10;  // a step along such a direction leads anywhere
  FitAnswer answer;
  answer.problem = std::move(problem);
  answer.best    = feasible_start(answer.problem);
  while (answer.problem.unknowns.size() > 1 && (one_number || worst_deviation(answer) > endless))
    keep_worst_known(answer);
  answer.best = least_misfit(answer.problem, answer.best);
  while (worst_deviation(answer) > identified_within) {
    auto other = without_worst_known(answer);
    if (!other)
      break;
    answer = std::move(*other);
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
