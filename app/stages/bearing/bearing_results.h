#pragma once
#include "app/stages/bearing/bearing_study.h"
#include "core/records/key_list.h"
#include "core/records/result_row.h"
#include <functional>

namespace mill {
/// The keys behind a result of a bearing, by its row.
using KeysOfRow = std::function<KeyList(const ResultRow &row)>;

/// The radial tangent with error, checks and load.
Parameter tangent_of(const BearingStudy &study, const std::vector<std::string> &inputs);

/// The tangent across the load, the same.
Parameter across_of(const BearingStudy &study, const std::vector<std::string> &inputs);

/// All scalar results of a bearing under `prefix` ("Kzc", "Kzc2").
/// @param of_closing_angle  inputs of the cup angle that the rollers ask for
void add_bearing_results(RunContext &run, const std::string &prefix, const BearingStudy &study,
                         const KeysOfRow &inputs, const KeyList &of_closing_angle);

/// Sentences about what was filled in and what is open, and warnings: rows whose arrangement is not given, and
/// where the result leaves its range: few rollers loaded, pressure beyond yield, rows on the far side.
void note_bearing(RunContext &run, const std::string &prefix, const BearingStudy &study);
}  // namespace mill
