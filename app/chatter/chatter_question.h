#pragma once
#include "app/chatter/chatter_study.h"
#include "app/stages/stability/stability_question.h"
#include "app/stages/stand/model_stage.h"
#include "core/model/pass.h"
#include "core/model/strip.h"
#include "reduce/stand/lumped_stand.h"

// From a case to what is asked about chatter.
namespace mill {
struct ChatterCase;
struct FourHigh;
class MovingKeys;

/// @param keys  of the case; nullptr: without lists of inputs
ChatterQuestion chatter_question(const ChatterCase &spec, std::size_t condition, MovingKeys *keys = nullptr);

/// A pass of any stand as a working condition; thicknesses and tensions are those of its bite.
RollingCondition condition_of(const Pass &pass, const Strip &strip);

/// A pass of a four-high stand, asked.
struct StandQuestion {
  ChatterQuestion question;
  std::vector<std::string> assumed;  ///< what the case does not say, one sentence each
};

/// On component modes, beams and six masses; study_chatter() takes the first, as every run does.
StandQuestion chatter_question(const FourHigh &stand, const Pass &pass, const reduce::LumpedStand &chain,
                               const StandModels &models);
}  // namespace mill
