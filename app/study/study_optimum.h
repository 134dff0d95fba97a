#pragma once
#include "app/command/command_line.h"
#include "app/process/cut_signal.h"
#include "app/study/optimum_search.h"
#include "app/study/study_statistics.h"
#include <optional>

namespace mill {
/// What a search has found, with the watched results of every row it asked for.
struct StoredOptimum {
  Optimum optimum;
  std::vector<std::vector<double>> results;  ///< (tried) of (watched); empty: failed
  std::vector<std::string> failures;         ///< (tried)
  std::vector<double> best_results;          ///< (watched)
};

/// Searches from the start rows of a study by `optimise`, in this process: rows that are kept are not computed
/// again, every other one is committed before the next begins.
/// @return 0; 128 and the number of the signal that asked for an end
/// @throws InputError  no start row has a value
int run_search(const Study &study, const CommandLine &command, const CutSignal &signal);

/// The same from what is kept.  Nothing: a row is missing, the search is not over.
std::optional<StoredOptimum> stored_optimum(const Study &study, const StudyRows &rows);
}  // namespace mill
