#pragma once
#include "core/records/csv.h"
#include "twin/analysis/analysis.h"
#include <map>
#include <string>

namespace mill::twin {
/// analysis.json: the form of results.json with "findings", "cleaning", "notes", "record" and "conventions" beside
/// the values.
/// @param stand     nullptr: no case was named
/// @param settings  those of analyse()
std::string analysis_json(const CleanRecord &record, const Analysis &analysis, const CaseModel *stand,
                          const AnalysisSettings &settings = {});

/// Tables by name without ".csv": spectrum, waterfall, distance (with a speed), modes, poles,
/// singular (behind the poles), h1 and modes_h1 (with a recorded force).
std::map<std::string, Table> analysis_tables(const Analysis &analysis);
}  // namespace mill::twin
