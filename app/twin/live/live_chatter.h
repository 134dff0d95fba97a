#pragma once
#include "core/model/monitoring.h"
#include "twin/live/compare/chatter_watch.h"
#include "twin/live/compare/onset_monitor.h"
#include "twin/live/engine/twin_model.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// Model of the critical speed that `millstand live` watches.
struct LiveChatter {
  live::ChatterWatch::Setup setup;
  std::vector<std::string> notes;  ///< assumptions where the case has no value
};
/// Bands of [monitoring] that are watched for every kind: third and fifth octave.
std::vector<live::WatchedBand> watched_bands(const Monitoring &monitoring);
/// Of kind chatter: its first condition.  Of kind four-high: its first pass on the six masses of the twin, where
/// the case says enough of the strip for a steady bite.  Nothing for others.
std::optional<LiveChatter> live_chatter(const Case &the_case, const live::TwinModel &model);
}  // namespace mill
