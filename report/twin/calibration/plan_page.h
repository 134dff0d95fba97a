#pragma once
#include <string>

namespace mill::report {
/// The page of a planned record: assumed record, unknowns before and after, damping ratios, directions that are
/// not seen, further sensors.  Numbers have their full digits.
/// @param json  text of plan.json
/// @throws InputError  no plan.json of this program
std::string plan_page(const std::string &directory, const std::string &json);

/// The same from the file of a folder.
std::string plan_page(const std::string &directory);
}  // namespace mill::report
