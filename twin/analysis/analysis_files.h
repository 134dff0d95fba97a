#pragma once
#include "core/records/csv.h"
#include "twin/analysis/analysis.h"
#include <map>
#include <string>

namespace mill::twin {
/// analysis.json: the form of results.json with "findings", "cleaning", "notes", "record" and "conventions" beside
/// the values.
/// @param stand  nullptr: no case was named
std::string analysis_json(const CleanRecord &record, const Analysis &analysis, const CaseModel *stand);

/// Tables by name without ".csv": spectrum, waterfall, distance (with a speed), modes, poles.
std::map<std::string, Table> analysis_tables(const Analysis &analysis);
}  // namespace mill::twin
