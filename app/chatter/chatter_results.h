#pragma once
#include "app/chatter/chatter_study.h"
#include "core/records/chatter_record.h"

namespace mill {
/// bite.<condition>.* and chatter.<condition>.* with their checks, and the notes on the condition.
void add_chatter_results(RunContext &run, const ChatterStudy &study);

/// "condition 2: stable below 18.21 m/s and unstable above (128.1 Hz)"
std::string verdict_sentence(const ChatterStudy &study);

/// Computed, published and measured values of one condition.
std::vector<ChatterPublished> published_rows(const ChatterStudy &study);

/// The comparison of all conditions as text; empty when nothing is published of any.
std::string published_table(const std::vector<ChatterStudy> &studies);

/// What a conclusion rests on: does it hold in every variant of the stand?
std::vector<ChatterConclusion> conclusions(const ChatterStudy &study);
}  // namespace mill
