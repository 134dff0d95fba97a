#pragma once
#include <string>

namespace mill::report {
/// The page of a sweep: curves of every watched result over the first varied key, the table, failed rows.
/// @param json  text of sweep.json
/// @throws InputError  no sweep.json of this program
std::string sweep_page(const std::string &directory, const std::string &json);

/// The same from the file of a folder.
std::string sweep_page(const std::string &directory);
}  // namespace mill::report
