#pragma once
#include <string>

namespace mill::report {
/// The page of a study: intervals of every watched result, histograms, which input to measure better first,
/// scatter, failed rows.
/// @param json  text of report.json
/// @throws InputError  no report.json of a study
std::string study_page(const std::string &directory, const std::string &json);
}  // namespace mill::report
