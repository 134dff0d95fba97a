#pragma once
#include "twin/live/compare/chatter_watch.h"
#include "twin/live/compare/onset_monitor.h"
#include "twin/live/engine/twin_model.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// What `millstand live` watches the critical speed with.
struct LiveChatter {
  live::ChatterWatch::Setup setup;
  std::vector<live::WatchedBand> bands;  ///< third and fifth octave
  std::vector<std::string> notes;        ///< what the case leaves open
};
/// Of kind chatter: its first condition.  Of kind four-high: its first pass on the six masses of the twin, where
/// the case says enough of the strip for a steady bite.  Nothing for others.
std::optional<LiveChatter> live_chatter(const Case &the_case, const live::TwinModel &model);
}  // namespace mill
