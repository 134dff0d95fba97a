#pragma once
#include <functional>
#include <string>
#include <vector>

namespace mill {
/// A row that a search has asked for: inputs in the order and units of the keys, its number in the order of
/// asking.
struct TriedRow {
  std::vector<double> inputs;
  double value = 0;  ///< of the objective; NaN: the row failed
};

/// A point of the valley of an optimum: one input held, the others searched or left where the optimum is.
struct ValleyPoint {
  std::vector<double> inputs;
  double value = 0;
};

struct Optimum {
  TriedRow best;
  std::vector<TriedRow> tried;                   ///< without the start rows
  std::vector<std::vector<ValleyPoint>> valley;  ///< (keys)(values of the key, from its lower to its upper bound)
  bool searched_valley = false;                  ///< the other inputs were searched at each point
  std::vector<bool> at_bound;                    ///< (keys) of the best row
};

struct SearchSettings {
  std::vector<double> low, high;  ///< (keys) bounds
  bool greatest      = false;     ///< the greatest value is wanted, not the least
  bool search_valley = false;     ///< search the other inputs at each point of the valley
};

/// Value of the objective for inputs; NaN: the row failed.  It may throw, which ends the search.
using Objective = std::function<double(const std::vector<double> &inputs)>;

/// Local searches by quadratic models in a trust region from the best start rows (NLopt, BOBYQA; COBYLA for one
/// input), then the valley: each input goes through its bounds in ten steps.  The same values lead to the same
/// rows, so that a search that was cut is continued from the rows that are kept.
/// @param starts  rows that are computed; at least one with a value
/// @throws InputError  no start row has a value; what the objective throws
/// Cost: some 30 rows for each input and start, 3 starts; the valley 11 rows for each input, searched up to
/// 15 times as many.
/// Source: M.J.D. Powell, The BOBYQA algorithm for bound constrained optimization without derivatives, report
/// DAMTP 2009/NA06, Cambridge 2009.
Optimum search_optimum(const SearchSettings &settings, const std::vector<TriedRow> &starts,
                       const Objective &objective);
}  // namespace mill
