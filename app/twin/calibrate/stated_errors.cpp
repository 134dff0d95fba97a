#include "app/twin/calibrate/stated_errors.h"
#include "app/review/closed_form_modes.h"
#include "app/review/estimate_review.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/stored_run.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "core/records/number_in_chain.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/chain/spring_chain.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
constexpr double law_error = 0.05;  // of a computed spring: contact laws differ by that
constexpr double step      = 1e-3;  // of a frame value, for its slope

using Errors = std::map<std::string, double>;

/// Every spring and mass of the chain by its name.
std::map<std::string, Parameter> numbers_of(const LumpedModel &chain)
{
  std::map<std::string, Parameter> numbers;
  for (std::size_t i = 0; i < chain.K.size(); ++i)
    numbers["K" + std::to_string(i + 1)] = chain.K[i];
  for (std::size_t i = 0; i < chain.M.size(); ++i)
    numbers["M" + std::to_string(i + 1)] = chain.M[i];
  return numbers;
}

Errors errors_of_run(const StoredRun &run, const std::map<std::string, Parameter> &numbers)
{
  Errors errors;
  for (const auto &[name, number] : numbers) {
    const auto error = run.errors.find(name), value = run.values.find(name);
    if (error == run.errors.end() || value == run.values.end() || !std::isfinite(error->second))
      continue;
    const double apart =
        value->second > 0 && number.value > 0 ? std::abs(std::log(number.value / value->second)) : 0;
    errors[name] = error->second + apart;
  }
  return errors;
}

std::optional<StoredRun> run_of_this_case(const Case &the_case)
{
  try {
    auto run = stored_run(folder_of_run("", the_case), the_case);
    if (run && run->same_inputs)
      return run;
  } catch (const InputError &) {  // a folder whose run is not finished states nothing
  }
  return {};
}

/// Adds half the change of each number between the two ends of an interval.
void add_moves(Errors &errors, const std::vector<ClosedFormResult> &low, const std::vector<ClosedFormResult> &high,
               const std::map<std::string, Parameter> &numbers, const double share)
{
  for (const auto &entry : numbers) {
    const ClosedFormResult *a = find(low, entry.first), *b = find(high, entry.first);
    if (!a || !b || !(a->parameter.value > 0) || !(b->parameter.value > 0))
      continue;
    const double move = share * 0.5 * std::abs(std::log(b->parameter.value / a->parameter.value));
    if (move > 1e-5)
      errors[entry.first] += move;
  }
}

void add_tolerances(Errors &errors, const FourHigh &stand, const double load,
                    const std::map<std::string, Parameter> &numbers)
{
  for (const reduce::FrameValue &part : reduce::frame_values(stand.frame)) {
    if (!(part.error > 0))
      continue;
    FourHigh low = stand, high = stand;
    low.frame.*part.member *= 1 - step;
    high.frame.*part.member *= 1 + step;
    add_moves(errors, closed_form_stand(low, load), closed_form_stand(high, load), numbers, part.error / step);
  }
  if (!reduce::is_closed(stand.frame))
    return;
  FourHigh low = stand, high = stand;
  low.frame.modulus *= 1 - step;
  high.frame.modulus *= 1 + step;
  add_moves(errors, closed_form_stand(low, load), closed_form_stand(high, load), numbers,
            stand.frame.modulus_error / step);
}

Errors errors_of_inputs(const FourHigh &stand, const double load, const std::map<std::string, Parameter> &numbers)
{
  Errors errors;
  for (const EstimateRecord &record : ranked_estimates(stand, load))
    for (const auto &[name, move] : record.moves)
      if (numbers.count(name) && record.estimate.key.rfind("frame.", 0) != 0)  // those have a tolerance, below
        errors[name] += move;
  add_tolerances(errors, stand, load, numbers);
  for (auto &[name, error] : errors)
    if (const auto number = choice_named<ChainNumber>(name); number && is_spring_of_chain(*number))
      error += law_error;
  return errors;
}
}  // namespace

StatedErrors stated_errors(const Case &the_case, const LumpedModel &chain, const double load)
{
  StatedErrors stated;
  const auto numbers = numbers_of(chain);
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec)) {
    if (const auto run = run_of_this_case(the_case)) {
      stated.error  = errors_of_run(*run, numbers);
      stated.source = "the run in " + run->folder;
    }
    for (const auto &[name, error] : errors_of_inputs(*stand, load, numbers))
      stated.error.emplace(name, error);
    if (stated.source.empty() && !stated.error.empty())
      stated.source = "estimates and tolerances of the case";
  }
  for (const auto &[name, number] : numbers)
    if (std::isfinite(number.error_estimate))
      stated.error[name] = number.error_estimate;
  return stated;
}
}  // namespace mill
