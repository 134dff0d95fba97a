#include "app/study/optimum_search.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

namespace mill {
namespace {
constexpr std::size_t most_starts = 3;
constexpr int rows_of_input = 30, rows_of_valley_input = 15, valley_points = 11;
constexpr double first_step = 0.1, last_step = 1e-4, apart = 0.2, bound_width = 1e-3;  // of the range of an input

// A search in inputs between 0 and 1, of values of which the least is wanted.
class Searcher {
public:
  Searcher(const SearchSettings &asked, const std::vector<TriedRow> &starts, const Objective &wanted)
      : settings(asked), objective(wanted)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const TriedRow &start : starts)
      if (std::isfinite(start.value)) {
        low  = std::min(low, signed_value(start.value));
        high = std::max(high, signed_value(start.value));
      }
    instead_of_failed = high + (high - low) + 1e-3 * std::abs(high);
  }

  double signed_value(const double value) const
  {
    return settings.greatest ? -value : value;
  }

  std::vector<double> inputs_of(const std::vector<double> &x) const
  {
    std::vector<double> inputs;
    for (std::size_t k = 0; k < x.size(); ++k)
      inputs.push_back(settings.low[k] + std::clamp(x[k], 0.0, 1.0) * (settings.high[k] - settings.low[k]));
    return inputs;
  }

  std::vector<double> place_of(const std::vector<double> &inputs) const
  {
    std::vector<double> x;
    for (std::size_t k = 0; k < inputs.size(); ++k)
      x.push_back((inputs[k] - settings.low[k]) / (settings.high[k] - settings.low[k]));
    return x;
  }

  TriedRow tried(const std::vector<double> &x)
  {
    TriedRow row{inputs_of(x), 0};
    row.value = objective(row.inputs);
    all.push_back(row);
    return row;
  }

  bool is_better(const TriedRow &a, const TriedRow &b) const
  {
    return std::isfinite(a.value) && (!std::isfinite(b.value) || signed_value(a.value) < signed_value(b.value));
  }

  // From a row over the free inputs; the others stay.
  TriedRow local(const TriedRow &from, const std::vector<std::size_t> &free, const int most_rows)
  {
    TriedRow best             = from;
    std::vector<double> all_x = place_of(from.inputs), x;
    for (const std::size_t k : free)
      x.push_back(all_x[k]);
    std::exception_ptr thrown;
    auto value = [&](const std::vector<double> &inside) {
      for (std::size_t i = 0; i < free.size(); ++i)
        all_x[free[i]] = inside[i];
      try {
        const TriedRow row = tried(all_x);
        if (is_better(row, best))
          best = row;
        return std::isfinite(row.value) ? signed_value(row.value) : instead_of_failed;
      } catch (...) {  // NLopt is C: an exception does not pass through it
        thrown = std::current_exception();
        throw nlopt::forced_stop();
      }
    };
    using Value = decltype(value);
    nlopt::opt search(free.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, unsigned(free.size()));
    search.set_min_objective([](const std::vector<double> &inside, std::vector<double> &,
                                void *data) { return (*static_cast<Value *>(data))(inside); },
                             &value);
    search.set_lower_bounds(0.0);
    search.set_upper_bounds(1.0);
    search.set_initial_step(first_step);
    search.set_xtol_abs(last_step);
    search.set_maxeval(most_rows);
    double least = 0;
    try {
      search.optimize(x, least);
    } catch (const nlopt::forced_stop &) {
    } catch (const nlopt::roundoff_limited &) {  // the best row is kept
    } catch (const std::runtime_error &) {       // no further progress from here
    }
    if (thrown)
      std::rethrow_exception(thrown);
    return best;
  }

  const SearchSettings &settings;
  const Objective &objective;
  std::vector<TriedRow> all;
  double instead_of_failed = 0;
};

// The best rows that are apart from each other.
std::vector<TriedRow> chosen_starts(const Searcher &searcher, std::vector<TriedRow> starts)
{
  std::stable_sort(starts.begin(), starts.end(),
                   [&](const TriedRow &a, const TriedRow &b) { return searcher.is_better(a, b); });
  std::vector<TriedRow> chosen;
  for (const TriedRow &start : starts) {
    const auto x     = searcher.place_of(start.inputs);
    const bool alone = std::all_of(chosen.begin(), chosen.end(), [&](const TriedRow &other) {
      const auto y = searcher.place_of(other.inputs);
      double most  = 0;
      for (std::size_t k = 0; k < x.size(); ++k)
        most = std::max(most, std::abs(x[k] - y[k]));
      return most > apart;
    });
    if (std::isfinite(start.value) && alone && chosen.size() < most_starts)
      chosen.push_back(start);
  }
  if (chosen.empty())
    throw InputError("no start row has a value of the objective; 'millstand study merge' lists the reasons");
  return chosen;
}

// One input through its bounds; each point starts at the neighbour that is nearer to the optimum.
std::vector<ValleyPoint> valley_of(Searcher &searcher, const TriedRow &best, const std::size_t key)
{
  const std::size_t n = best.inputs.size();
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < n; ++k)
    if (k != key)
      others.push_back(k);
  const double middle = searcher.place_of(best.inputs)[key];
  std::vector<ValleyPoint> valley(valley_points);
  const auto along = [&](const int from, const int to, const int step) {
    TriedRow neighbour = best;
    for (int i = from; i != to; i += step) {
      auto x       = searcher.place_of(neighbour.inputs);
      x[key]       = double(i) / (valley_points - 1);
      TriedRow row = searcher.tried(x);
      if (searcher.settings.search_valley && !others.empty())
        row = searcher.local(row, others, rows_of_valley_input * int(others.size()));
      valley[std::size_t(i)] = {row.inputs, row.value};
      if (searcher.settings.search_valley)
        neighbour = row;
    }
  };
  const int first_above = int(std::ceil(middle * (valley_points - 1)));
  along(first_above, valley_points, 1);
  along(first_above - 1, -1, -1);
  return valley;
}
}  // namespace

Optimum search_optimum(const SearchSettings &settings, const std::vector<TriedRow> &starts,
                       const Objective &objective)
{
  Searcher searcher(settings, starts, objective);
  const std::size_t n = settings.low.size();
  std::vector<std::size_t> every;
  for (std::size_t k = 0; k < n; ++k)
    every.push_back(k);
  Optimum optimum;
  for (const TriedRow &start : chosen_starts(searcher, starts)) {
    const TriedRow minimum = searcher.local(start, every, rows_of_input * int(n + 1));
    if (searcher.is_better(minimum, optimum.best) || optimum.best.inputs.empty())
      optimum.best = minimum;
  }
  // Once more from there: a first trust region may have closed early in a narrow valley.
  optimum.best = searcher.local(optimum.best, every, rows_of_input * int(n + 1));
  for (std::size_t k = 0; k < n; ++k)
    optimum.valley.push_back(valley_of(searcher, optimum.best, k));
  for (const auto &valley : optimum.valley)
    for (const ValleyPoint &point : valley)
      if (searcher.is_better({point.inputs, point.value}, optimum.best))
        optimum.best = {point.inputs, point.value};
  optimum.searched_valley = settings.search_valley;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = searcher.place_of(optimum.best.inputs)[k];
    optimum.at_bound.push_back(x < bound_width || x > 1 - bound_width);
  }
  optimum.tried = std::move(searcher.all);
  return optimum;
}
}  // namespace mill
