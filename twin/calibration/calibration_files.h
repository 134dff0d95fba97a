#pragma once
#include "core/base/note.h"
#include "core/records/csv.h"
#include "twin/calibration/calibration.h"
#include <map>
#include <string>
#include <vector>

namespace mill::twin {
/// Facts of calibration.json that are not numbers of the fit.
struct CalibrationFacts {
  std::string case_name, stand;    ///< "six masses as given"
  std::vector<std::string> files;  ///< of the records
  std::vector<Note> notes;
  std::string written;  ///< "calibrated.toml"; empty: no case is written
  bool accepted = false;
};
/// "ok", "agrees", "refused", "accepted": what calibration.json says of the whole.
std::string calibration_status(const Calibration &result, bool accepted);
/// Is there a calibrated case?  Else values and intervals are those of the joint fit.
bool is_written(const Calibration &result, bool accepted);

/// calibration.json: the form of results.json (values: factor.K3 .., misfit.*), with unknowns, basins,
/// correlation, bands and refusals.
std::string calibration_json(const CalibrationInput &input, const Calibration &result,
                             const CalibrationFacts &facts);

/// Tables by name without ".csv": response, profiles; force where none was recorded.
std::map<std::string, Table> calibration_tables(const Calibration &result);
}  // namespace mill::twin
