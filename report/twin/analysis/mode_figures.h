#pragma once
#include "core/records/csv.h"
#include <string>

// Modes of a record as tables and drawings.
namespace mill::report {
/// @param modes  modes.csv
std::string mode_rows(const Table &modes);
/// Modes of the response to the force with their intervals.  @param modes  modes_h1.csv
std::string forced_mode_rows(const Table &modes);
/// Poles over the order: confirmed, stable, other; behind them the first singular value, scaled to the height.
/// @param poles     poles.csv
/// @param singular  singular.csv; nullptr: none
std::string stability_drawing(const Table &poles, const Table *singular);
/// |H1| of every channel over the frequency, confirmed modes marked.
/// @param response  h1.csv  @param modes  modes_h1.csv; nullptr: none
std::string response_drawing(const Table &response, const Table *modes);
/// Coherence of every channel with the force.
std::string coherence_drawing(const Table &response);
}  // namespace mill::report
