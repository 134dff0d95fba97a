#pragma once
#include "app/twin/advice/advised_model.h"
#include "twin/advice/advice_files.h"
#include "twin/records/raw_record.h"
#include <string>

namespace mill {
struct Case;

/// Advice on the level of a place of a stand, as [advice] of its case asks for it.
/// @param measured  folder of records whose force shakes it; empty: white force, and only ratios are given
/// @param rolled      of kind four-high, rolled_advice_of() its file
/// @param components  called where advice.model asks for them
/// @throws InputError  places, bands, records; @see advised_model
twin::AdviceRecord stand_advice(const Case &the_case, const std::string &measured,
                                const twin::ReadOptions &reading, const RolledAdvice &rolled,
                                const Components &components);
}  // namespace mill
