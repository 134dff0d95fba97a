#pragma once
#include "app/study/spread.h"
#include <string>
#include <vector>

// What OpenTURNS does for a study.  Its headers stay in this folder, and its library in a program of its own: it
// brings Ipopt and with it a second MUMPS, whose names are also those of deal.II's libraries.
namespace OT {
class Distribution;
}
namespace mill {
/// A correlation of two inputs, by their places among the keys.
struct Correlation {
  std::size_t a = 0, b = 0;
  double value = 0;  ///< -, of the normal copula, -1 < value < 1
};

/// The law of one input.
OT::Distribution distribution_of(const Spread &spread);

enum class DrawMethod {
  latin_hypercube,  ///< one row in each of n equal strata of every input; of correlated ones see theory (52.12)
  monte_carlo,      ///< independent rows
  saltelli          ///< n (d + 2) rows on points of Sobol's sequence: A, B, and B with one column of A each
};

/// Rows of inputs in the units of their keys.
/// @param n     rows, > 0; for saltelli the size of a group, a power of two
/// @param seed  of latin_hypercube and monte_carlo: the same seed gives the same rows
/// @return (rows, keys)
/// @throws InputError  correlations that no distribution has, or correlated inputs with saltelli
/// Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270, for the last.
std::vector<std::vector<double>> drawn_rows(DrawMethod method, const std::vector<Spread> &spreads,
                                            const std::vector<Correlation> &correlations, long n, int seed);

/// Sobol indices of one result.
struct SobolIndices {
  std::vector<double> first, total;                                  ///< (keys) -
  std::vector<double> first_low, first_high, total_low, total_high;  ///< (keys) -, 95 % intervals
  long groups = 0;  ///< of rows, without those that have a failure
};

/// From results that were computed elsewhere.  Lists are empty where the rows of group A all have the same result.
/// @param rows    (n (d + 2), d) of drawn_rows(saltelli)
/// @param result  (n (d + 2)); NaN: failed, and its whole group of d + 2 rows is left out
/// @throws InputError  fewer than 16 groups remain
SobolIndices sobol_indices(const std::vector<std::vector<double>> &rows, const std::vector<double> &result,
                           long n);
}  // namespace mill
