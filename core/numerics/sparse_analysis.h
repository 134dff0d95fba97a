#pragma once
#include "core/base/errors.h"
#include "core/numerics/sparse.h"
#include "core/process/memory.h"
#include <cstdint>

// What of a factorisation does not hang on the values of the matrix; for CondensingFactor only.  theory.md 2
struct cholmod_factor_struct;
struct cholmod_common_struct;

namespace mill {
struct FreeSymbolic {
  void operator()(cholmod_factor_struct *L) const;
};

/// Order, symbolic factor and permutation of one pattern.
struct FactorAnalysis {
  std::unique_ptr<cholmod_factor_struct, FreeSymbolic> symbolic;  ///< supernodal, without values
  double n_nonzeros = 0;                                          ///< of the factor
  double n_flops    = 0;                                          ///< of the factorisation
  std::vector<std::int64_t> column, row;                          ///< lower triangle in the order of the factor
  std::vector<int> value_of;  ///< (nonzeros) place in the matrix as it was given
};

/// Kept for the patterns asked for last: the same pattern has the same analysis, so the results are the same.
/// @param K, node_of, retained  as CondensingFactor
/// @throws SolverError  no memory
/// Cost: a third of a factorisation of 30 000 unknowns of a section; a comparison of the pattern where it is
/// known.
std::shared_ptr<const FactorAnalysis> analysis_of(const SymmetricSparse &K, const std::vector<int> &node_of,
                                                  const std::vector<int> &retained, cholmod_common_struct &common);

/// @param available  what the caller leaves for it, byte; 0: everything
OutOfMemory no_memory(const std::string &what, double needed, double available = 0);
std::string name_of_matrix(int n);
}  // namespace mill
