#pragma once
#include "twin/live/compare/comparison.h"
#include "twin/live/engine/engine.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// What /metrics tells of a run.
struct MetricsInput {
  const live::LiveSource *source     = nullptr;  ///< nullptr: none yet
  const live::AccountBook *book      = nullptr;
  const live::Comparison *comparison = nullptr;
  std::vector<live::PageAlarm> own_alarms;     ///< of source and recording, that are open
  std::string adopted;                         ///< file of the adopted springs; empty: the case's own
  std::optional<double> limit;                 ///< m/s2, 0-peak
  double arrival_rate        = live::unknown;  ///< Hz; NaN: not measured
  std::int64_t refused_lines = 0, queued = 0;  ///< -, samples
  std::int64_t states = 0;                     ///< written
};

/// OpenMetrics text without its end: account, alarms, drift, growth, proposals, arrival.
std::string metrics_text(const MetricsInput &input);
}  // namespace mill
