#pragma once
#include "core/records/result_row.h"
#include <optional>
#include <string_view>

namespace mill {
/// The result that a run solves for a spring of the chain: "K3.tangent" of "K3", "Kzc1.tangent" of "Kzc1",
/// "K4.combined" of "K4".  Nothing for another number, which has its own name alone.
std::optional<ResultName> solved_result_of(std::string_view number);
}  // namespace mill
