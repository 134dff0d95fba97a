#pragma once
#include "core/records/csv.h"
#include "twin/calibration/calibration.h"
#include <map>
#include <string>
#include <vector>

namespace mill::twin {
/// What stands in calibration.json beside the numbers.
struct CalibrationFacts {
  std::string case_name, stand;    ///< "six masses as given"
  std::vector<std::string> files;  ///< of the records
  std::vector<std::string> notes;
  std::string written;  ///< "calibrated.toml"; empty: refused
  bool accepted = false;
};

/// calibration.json: the form of results.json (values: factor.K3 .., misfit.*) with unknowns, basins, correlation,
/// bands and refusals beside them.
std::string calibration_json(const CalibrationInput &input, const Calibration &result,
                             const CalibrationFacts &facts);

/// Tables by name without ".csv": response, profiles; force where none was recorded.
std::map<std::string, Table> calibration_tables(const Calibration &result);
}  // namespace mill::twin
