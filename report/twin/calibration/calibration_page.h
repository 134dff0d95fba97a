#pragma once
#include "core/records/csv.h"
#include <map>
#include <string>

namespace mill::report {
/// The page of a calibration: verdict, unknowns and which of them are identified, before and after on the check
/// records, residuals per third octave, profiles, correlation.
/// @param json    text of calibration.json
/// @param tables  by name without ".csv"
/// @throws InputError  no calibration.json of this program
std::string calibration_page(const std::string &directory, const std::string &json,
                             const std::map<std::string, Table> &tables);

/// The same from the files of a folder.
std::string calibration_page(const std::string &directory);
}  // namespace mill::report
