#pragma once
#include "app/trace/closed_form_chain.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"

// What a trace says of the stand as a whole: its mill modulus and its modes by name.  theory.md 24, 30
namespace mill {
/// stand.K_ww.tangent, stand.modulus.kiss and, where the slab theory of the bite has an answer, K4.flattening,
/// K4.plastic_slope, stand.K_bend, stand.modulus.tangent, stand.screw_sensitivity and stand.force_by.screw of the
/// first pass, from its springs in `all`.
/// @param load  N
/// @param keys  of the case; null: no lists are asked for
void add_quick_modulus(std::vector<ClosedFormResult> &all, const FourHigh &stand, double load,
                       const SpringFactors &factors, MovingKeys *keys);

/// mode.<name>.frequency and .gap_share of the six masses, from f1.. in `all`.
/// @param settings    of the state whose modes they are
/// @param named       state whose names they have
/// @param stands_for  what a run takes instead; empty: the same
void add_named_modes_of_chain(std::vector<ClosedFormResult> &all, const LumpedModel &model,
                              const DynamicsSettings &settings, GapState named, const std::string &stands_for,
                              MovingKeys *keys);
}  // namespace mill
