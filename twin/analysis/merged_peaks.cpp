#include "twin/analysis/merged_peaks.h"
#include "twin/analysis/channel_analysis.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
bool is_one_peak(const Peak &a, const Peak &b)
{
  const double apart = std::abs(a.frequency - b.frequency), bins = std::max(a.resolution, b.resolution);
  if (a.line && b.line)
    return apart <= 1.2 * bins;
  if (a.line || b.line)  // a broad resonance may hold a line; a narrow one is the same peak seen in noise
    return apart <= 2 * bins && (a.line ? b.width : a.width) < 3 * bins;
  return apart <= std::max({a.width, b.width, 2 * bins});
}

// Two lines of one channel are two lines however close they are.
bool holds_line_of(const MergedPeak &peak, const MergedPeak &one)
{
  return peak.peak.line && one.peak.line &&
         std::any_of(peak.seen.begin(), peak.seen.end(),
                     [&](const MergedPeak::Place &place) { return place.channel == one.seen.front().channel; });
}
}  // namespace

std::vector<MergedPeak> merged_peaks(const Analysis &analysis)
{
  std::vector<MergedPeak> all;
  for (std::size_t c = 0; c < analysis.channels.size(); ++c) {
    const auto &candidates = analysis.channels[c].detected.candidates;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (candidates[i].fate == FindingKind::line ||
          (candidates[i].fate == FindingKind::resonance && is_vibration(analysis.channels[c].quantity)))
        all.push_back({candidates[i].peak, c, {{c, i}}});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const MergedPeak &a, const MergedPeak &b) { return a.peak.prominence > b.peak.prominence; });
  std::vector<MergedPeak> kept;
  for (const MergedPeak &one : all) {
    MergedPeak *same = nullptr;  // the nearest
    for (MergedPeak &other : kept)
      if (is_one_peak(other.peak, one.peak) && !holds_line_of(other, one) &&
          (!same || std::abs(other.peak.frequency - one.peak.frequency) <
                        std::abs(same->peak.frequency - one.peak.frequency)))
        same = &other;
    if (!same)
      kept.push_back(one);
    else
      same->seen.insert(same->seen.end(), one.seen.begin(), one.seen.end());
  }
  return kept;
}

void give_fate(Analysis &analysis, const MergedPeak &peak, const FindingKind fate, const std::string &reason)
{
  for (const MergedPeak::Place &place : peak.seen) {
    SpectralCandidate &candidate = analysis.channels[place.channel].detected.candidates[place.candidate];
    candidate.fate               = fate;
    candidate.reason             = reason;
  }
}
}  // namespace mill::twin
