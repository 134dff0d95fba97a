#pragma once
#include "app/run/run_context.h"
#include "core/model/four_high.h"
#include "core/records/key_list.h"
#include "core/records/result_row.h"
#include "reduce/chain/mill_modulus.h"
#include <string>

namespace mill {
/// "stand.modulus.kiss" of the first pass, "stand.pass 2.modulus.kiss" of a later one.
ResultName stand_result(const FourHigh &stand, std::size_t pass, const RowOf<1> &row);

/// A stand with strip between its work rolls.
struct StretchedStand {
  reduce::LoadDeflection stretch;  ///< over the rolling force
  KeyList inputs;                  ///< keys behind its modulus, the bite among them
};

/// stand.screw_sensitivity, stand.thickness_by.*, stand.force_by.* of a pass from its stand.modulus.tangent, its
/// plastic slope and bite.*, compared with differences of the coupled solution.  theory.md (30.6)-(30.9)
/// Nothing where the bite has no plastic slope.
void add_gauge(RunContext &run, const FourHigh &stand, std::size_t pass, const Parameter &plastic_slope,
               const StretchedStand &stretched);
}  // namespace mill
