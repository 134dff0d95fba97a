#pragma once
#include "core/records/results.h"
#include "reduce/stand/lumped_stand.h"

namespace mill {
struct Case;
struct FourHigh;
class MovingKeys;

/// Results that a run adds to those of a trace and that state this key; they are not in the chain of springs and
/// masses: "K3.friction_tangent" of "contact.upper.friction".
std::vector<std::string> results_outside_the_chain(const Case &the_case, const std::string &key);

/// The computed springs of a chain with their keys.
/// @param pass  whose load they belong to
/// @param keys  of the case
void set_inputs(reduce::ChainInputs &springs, const FourHigh &stand, std::size_t pass, MovingKeys &keys);
}  // namespace mill
