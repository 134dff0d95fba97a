#pragma once
#include "app/study/openturns/drawn_design.h"
#include <string>
#include <vector>

namespace mill {
/// A result as a polynomial of the inputs, fitted to rows.  theory 52.5
struct ChaosFit {
  int degree = 0, terms = 0;         ///< largest total degree, terms that were kept
  long rows = 0, held_out_rows = 0;  ///< with results
  double mean = 0, sd = 0;           ///< of the polynomial under the distributions of the inputs
  double leave_one_out = 0;          ///< -, error of a row by the fit to the others, over the variance (52.9)
  double held_out      = not_given;  ///< -, the same of rows that took no part in the fit (52.10)
  std::vector<double> first, total;  ///< (keys) -, Sobol indices from the coefficients (52.8)
  std::vector<double> first_low, first_high, total_low, total_high;  ///< (keys) -, 95 % of refitted resamples
  std::vector<double> computed, predicted;                           ///< (held-out rows) in the unit of the result
  std::size_t map_x = 0, map_y = 0;         ///< keys of the map, the two with the largest T
  std::vector<double> x, y;                 ///< their values, in the units of the keys
  std::vector<std::vector<double>> height;  ///< (y)(x), all other inputs at their means; empty: one input
};

/// Polynomials that are orthogonal for each input's distribution; terms by least angles, degree by the
/// leave-one-out error.
/// @param rows    (rows, keys); the first `fitted` are fitted, the others are held out
/// @param result  (rows); NaN: failed, left out
/// @return without terms where the fitted rows all have the same result
/// @throws InputError  fewer than 2 (keys + 1) fitted rows with a result
/// Source: G. Blatman, B. Sudret, Journal of Computational Physics 230 (2011) 2345-2367; B. Sudret, Reliability
/// Engineering and System Safety 93 (2008) 964-979, for the indices.
ChaosFit chaos_fit(const std::vector<Spread> &spreads, const std::vector<std::vector<double>> &rows,
                   const std::vector<double> &result, long fitted, int seed);
}  // namespace mill
