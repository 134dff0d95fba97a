#pragma once
#include <string>
#include <vector>

namespace mill::report {
/// Page that compares analyses of one mill: spectra on one axis, levels in bands, and the change of every mode and
/// line with its interval.  The first folder is the earlier state.
/// @param directories  folders with analysis.json, two at least
/// @throws InputError  a folder holds no analysis.json of this program, or no channel is in all of them
std::string analysis_comparison(const std::vector<std::string> &directories);
}  // namespace mill::report
