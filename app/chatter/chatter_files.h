#pragma once
#include "app/chatter/chatter_study.h"

namespace mill {
/// curves/chatter-*.csv and .json, response/chatter-*.csv of one condition.
void write_chatter(RunContext &run, const ChatterStudy &study);
}  // namespace mill
