#pragma once
#include "app/stages/bite/bite_study.h"

namespace mill {
/// A finite-element bite as text, so that the next run need not solve it again.
std::string stored_flow(const FlowAnswer &answer);
/// Back again; nothing when the text is damaged or of another version.
std::optional<FlowAnswer> restored_flow(const std::string &text);
}  // namespace mill
