#pragma once
#include "app/stages/bearing/bearing_study.h"

namespace mill {
/// The radial tangent with error, checks and load.
Parameter tangent_of(const BearingStudy &study, const std::vector<std::string> &inputs);

/// The tangent across the load, the same.
Parameter across_of(const BearingStudy &study, const std::vector<std::string> &inputs);

/// All scalar results of a bearing under `prefix` ("Kzc", "Kzc2").
/// @param of_closing_angle  inputs of the cup angle that the rollers ask for
void add_bearing_results(RunContext &run, const std::string &prefix, const BearingStudy &study,
                         const std::vector<std::string> &inputs, const std::vector<std::string> &of_closing_angle);

/// Sentences about what was filled in and what is open, and warnings: rows whose arrangement is not given, and
/// where the result leaves its range: few rollers loaded, pressure beyond yield, rows on the far side.
void note_bearing(RunContext &run, const std::string &prefix, const BearingStudy &study);
}  // namespace mill
