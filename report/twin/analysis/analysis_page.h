#pragma once
#include "core/records/csv.h"
#include <map>
#include <string>

namespace mill::report {
/// The page of an analysed record: findings, cleaning, spectra with their convention, maps, modes, values.
/// @param json    text of analysis.json
/// @param tables  by name without ".csv"
/// @throws InputError  no analysis.json of this program
std::string analysis_page(const std::string &directory, const std::string &json,
                          const std::map<std::string, Table> &tables);

/// The same from the files of a folder.
std::string analysis_page(const std::string &directory);
}  // namespace mill::report
