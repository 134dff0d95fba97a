#pragma once
#include "core/case/provenance.h"

// Keys behind the frequency response and the Campbell diagram; as core/case/provenance.h, for both run and
// trace.
namespace mill {
/// Inputs of a frequency response in addition to the model.
KeyList frequency_response_keys();

/// Inputs of a Campbell diagram in addition to modes, rolls and bearings: its ranges, and which lines are drawn.
/// @param orders  number of [[drive.order]]
KeyList campbell_keys(std::size_t orders);
}  // namespace mill
