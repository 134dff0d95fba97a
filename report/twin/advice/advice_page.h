#pragma once
#include "core/records/csv.h"
#include <map>
#include <string>

namespace mill::report {
/// The page of an advice: answer, ranked actions, before and after, tuned damper, slopes, values.
/// @param json    text of advice.json
/// @param tables  by name without ".csv"
/// @throws InputError  no advice.json of this program
std::string advice_page(const std::string &directory, const std::string &json,
                        const std::map<std::string, Table> &tables);

/// The same from the files of a folder.
std::string advice_page(const std::string &directory);
}  // namespace mill::report
