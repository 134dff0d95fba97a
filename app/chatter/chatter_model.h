#pragma once
#include "app/stages/chatter_study.h"
#include "core/model/dynamics_settings.h"
#include "core/records/lumped_model.h"
#include "twin/chatter/critical_track.h"
#include <string>
#include <vector>

// A stand with its bite, for those who search or follow its critical speed alone.
namespace mill {
struct Case;
struct FourHigh;
struct Pass;

/// Keys that a steady bite needs and a case of kind four-high does not say, with commas; empty: it says enough.
std::string missing_of_bite(const Case &the_case);

/// Strip before and behind a stand.
struct FreeStrip {
  double entry_distance = 0, exit_distance = 0;  ///< m
  std::vector<std::string> assumed;              ///< what the case does not say, one sentence each
};
/// As the case says; 5 m where it does not.
FreeStrip free_strip(const FourHigh &stand);

/// Range that analysis.speeds asks for, with its steps.
dynamics::SpeedRange chatter_range(const ChatterAnalysis &analysis);

twin::ChatterModel chatter_model(const ChatterQuestion &question);

/// The chain without the spring and the damper of the strip: the bite is what chatter adds.
DynamicsSettings without_strip(DynamicsSettings settings);

/// A pass on six masses, whatever the case means by its force.
twin::ChatterModel chatter_model(const FourHigh &stand, const Pass &pass, const LumpedModel &chain,
                                 const DynamicsSettings &settings, const FreeStrip &strip);
}  // namespace mill
