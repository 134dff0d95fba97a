#pragma once
#include "core/case/provenance.h"

// Keys behind the frequency response and the Campbell diagram; as core/case/provenance.h, for both run and
// trace.
namespace mill {
/// What a frequency response has beside the model that answers.
KeyList frequency_response_keys();

/// What a Campbell diagram has beside modes, rolls and bearings: its ranges, and which lines are drawn.
/// @param orders  number of [[drive.order]]
KeyList campbell_keys(std::size_t orders);
}  // namespace mill
