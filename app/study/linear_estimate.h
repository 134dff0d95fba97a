#pragma once
#include "app/study/row_model.h"
#include "app/study/study_folder.h"
#include <vector>

namespace mill {
/// Spread of a result by its derivatives at the means of the inputs.  theory (52.5)
struct LinearEstimate {
  double sd = not_given;       ///< in the unit of the result
  std::vector<double> shares;  ///< (keys) -, of the variance; their sum is 1
};

/// Derivatives of every watched result by every input, at the means of the inputs and in their units: differences
/// to both sides with two steps, extrapolated to a step of zero (52.6).  NaN where a row on the way has no result.
/// With the full model those of the closed forms, scaled to its value of the base case; a result that they do not
/// have gets none.
/// @param model  that computes the rows of the study
/// Cost: 4 rows of closed forms for each input.
void add_slopes(Study &study, RowModel &model);

/// Of one watched result; nothing given where a derivative is missing.
LinearEstimate linear_estimate(const Study &study, const WatchedResult &result);
}  // namespace mill
