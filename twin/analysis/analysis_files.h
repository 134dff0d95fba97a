#pragma once
#include "core/records/csv.h"
#include "twin/analysis/analysis.h"
#include <map>
#include <string>

namespace mill::twin {
/// analysis.json: the values in the form of results.json, with "findings", "account", "cleaning", "notes",
/// "record" and "conventions".
/// @param stand     nullptr: no case was named
/// @param settings  those of analyse()
std::string analysis_json(const CleanRecord &record, const Analysis &analysis, const CaseModel *stand,
                          const AnalysisSettings &settings = {});

/// candidates.csv: every peak above the threshold and every pole, with its one fate and the reason.
std::string candidates_csv(const Analysis &analysis);

/// Tables by name without ".csv": spectrum, waterfall, distance (with a speed), modes, poles,
/// singular (behind the poles), h1 and modes_h1 (with a recorded force).
std::map<std::string, Table> analysis_tables(const Analysis &analysis);
}  // namespace mill::twin
