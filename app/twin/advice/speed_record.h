#pragma once
#include "twin/advice/advice_files.h"
#include <string>
#include <vector>

namespace mill {
/// Answer, results, slopes, table of growth and actions of an advice on a critical speed.
/// @param inputs  keys behind the critical speed
void fill_speed_record(twin::AdviceRecord &record, const twin::CriticalAdvice &advice,
                       const twin::CriticalQuestion &question, const std::vector<std::string> &inputs);

/// What is said where advice.torque_rise is not given.
Note no_torque_limit();
}  // namespace mill
