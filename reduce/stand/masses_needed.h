#pragma once
#include "core/records/models_record.h"
#include "core/records/stand_model.h"
#include "reduce/stand/stand_comparison.h"
#include <string>
#include <vector>

namespace mill::reduce {
/// How few masses are enough: static (Guyan) reduction of a stand to displacements of points.  Fewer than six: the
/// best choice among the six places for every number.  Six: the places of the chain.  More: the point that helps
/// most is added each time (chocks, cylinder, roll ends, quarter points of the rolls), up to `most`.
/// theory.md 22.8
/// @param stand  with at least its modes below the limit
/// @param limit  Hz
/// @param chain  adds a row for the six lumped masses of the chain; null: no such row
/// @throws InputError  a part that nothing holds
/// Cost: one factorisation and some thousand eigenproblems of the size of the number of masses, below 1 s.
std::vector<MassesRow> masses_needed(const StandWithModes &stand, double limit, int most = 16,
                                     const StandWithModes *chain = nullptr);

/// Number of the least row with every mode below the limit shown within `error`; 0: none.
int masses_enough(const std::vector<MassesRow> &rows, double error);
}  // namespace mill::reduce
