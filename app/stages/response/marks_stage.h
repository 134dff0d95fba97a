#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "dynamics/marks/marks.h"
#include <map>
#include <string>

namespace mill {
/// marks.* results and curves/marks.json; what the record could not say becomes a warning.
/// @param mode_keys  keys of the case behind the frequency of each mode, by its key
void add_marks(RunContext &run, const MarksRecord &record, const dynamics::MarkSources &sources,
               const std::map<std::string, KeyList> &mode_keys);
}  // namespace mill
