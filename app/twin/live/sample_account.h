#pragma once
#include "twin/live/engine/engine.h"
#include "twin/live/page/event_text.h"
#include <string>
#include <vector>

namespace mill {
/// The engine's account of samples by channel.  Empty before the first source.
std::vector<live::AccountRow> account_rows(const live::Engine &engine);
/// As JSON, for the sidecar of a recording.
std::string account_json(const live::Engine &engine);
/// As a table, for the end of the run.  Empty before the first source.
std::string account_table(const live::Engine &engine);
}  // namespace mill
