#pragma once
#include "twin/calibration/fitted_stand.h"
#include "twin/live/compare/proposals.h"
#include "twin/live/engine/twin_model.h"

namespace mill {
struct Case;

/// Puts a detailed stand into the twin: of a drawing rolls as beams and all else by closed forms, of a case with
/// matrices these.  Its springs become those of the twin.  theory.md 48.7
/// @param model  of the six masses, or empty where there are matrices
/// Cost: 0.1 s.
void add_detail(live::TwinModel &model, const Case &the_case);

/// -, seven springs of the twin at another rolling force, N, over those at its own.
std::array<double, 7> detail_at_load(const Case &the_case, const live::TwinModel &model, double load);

/// The detailed stand with the springs of `chain`, as a re-calibration fits it.
/// @param damping  -, ratio of critical of its modes
twin::FittedStand fitted_detail(const live::TwinModel &model, const LumpedModel &chain, double damping);

/// A case of kind lumped with the matrices of a proposal, which are written into FOLDER/<name of the case>/.
/// @throws SystemError  they cannot be written
std::string adopted_detail(const live::TwinModel &model, const live::Proposal &proposal, const Case &origin,
                           const std::string &folder);
}  // namespace mill
