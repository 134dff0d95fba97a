#pragma once
#include "app/chatter/chatter_study.h"
#include "app/stages/bite/free_strip.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "twin/chatter/critical_track.h"

// A stand with its bite, for those who search or follow its critical speed alone.
namespace mill {
struct FourHigh;
struct Pass;

twin::ChatterModel chatter_model(const ChatterQuestion &question);

/// A pass on six masses, whatever the case means by its force.
twin::ChatterModel chatter_model(const FourHigh &stand, const Pass &pass, const LumpedModel &chain,
                                 const DynamicsSettings &settings, const FreeStrip &strip);
}  // namespace mill
