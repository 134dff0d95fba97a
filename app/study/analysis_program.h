#pragma once
#include "app/study/study_folder.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

// Designs and indices by OpenTURNS, in the program millstand-study of the same folder.
namespace mill {
/// Draws rows, each in the units of its keys.
/// @param method  latin_hypercube, monte_carlo or sobol
/// @param n       rows; for sobol the size of a group, of which there are keys + 2
/// @throws InputError  correlations that do not fit, the program is not built; SystemError  it ended by a signal
std::vector<std::vector<double>> draw_rows(const Study &study, StudyMethod method, long n);

/// Sobol indices of one result, each list by key; empty where the result is the same in all rows.
struct IndicesOfResult {
  std::vector<double> first, total;                                  ///< -
  std::vector<double> first_low, first_high, total_low, total_high;  ///< -, 95 % intervals
  long groups = 0;                                                   ///< without those with a failure
};

/// @param rows     (n (keys + 2), keys) in the order of the design
/// @param results  (results)(rows); NaN: failed
/// @param n        size of a group
std::vector<IndicesOfResult> indices_of(const std::vector<std::vector<double>> &rows,
                                        const std::vector<std::vector<double>> &results, long n);

/// Polynomial chaos of every result: a list with the members of ChaosFit (app/study/openturns/chaos.h), null where
/// the result is the same in all rows.
/// @param rows     (rows, keys) in the order of the design
/// @param results  (results)(rows); NaN: failed
/// @param fitted   rows from the start that are fitted; the others are held out
nlohmann::ordered_json chaos_of(const Study &study, const std::vector<std::vector<double>> &rows,
                                const std::vector<std::vector<double>> &results, long fitted);
}  // namespace mill
