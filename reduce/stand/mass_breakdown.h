#pragma once
#include "core/records/models_record.h"
#include "core/records/stand_model.h"
#include "reduce/stand/lumped_stand.h"
#include <string>
#include <vector>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// M1..M6 by the shapes of the chain, before given values replace any.  theory.md 22.5
std::vector<MassBreakdown> chain_breakdown(const FourHigh &stand, const LumpedStand &chain);

/// M1..M6 by the static shape of a stand model: the integrals of (4.14)-(4.16) part by part.
/// @param reference  of the backup rolls
std::vector<MassBreakdown> model_breakdown(const FourHigh &stand, const StandModel &model,
                                           MassReference reference = MassReference::mid);
}  // namespace mill::reduce
