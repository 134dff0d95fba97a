#pragma once
#include "twin/analysis/analysis.h"
#include <string>
#include <vector>

namespace mill {
/// What the console says about an analysed record: at most 25 lines.  First the largest peak of every channel with
/// its source, then findings, those that need action first, then notes; the rest is in the files of the folder.
std::vector<std::string> analysis_lines(const twin::Analysis &analysis, const std::string &folder);
}  // namespace mill
