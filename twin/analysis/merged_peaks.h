#pragma once
#include "twin/analysis/analysis.h"
#include <vector>

namespace mill::twin {
/// A line or a resonance of the record: one for each frequency, at the channel where it stands out most.
struct MergedPeak {
  Peak peak;
  std::size_t channel;  ///< number of that channel
  struct Place {
    std::size_t channel, candidate;
  };
  std::vector<Place> seen;  ///< every channel that shows it
};

/// Lines of all channels and resonances of the vibrations, those that stand out most first.
std::vector<MergedPeak> merged_peaks(const Analysis &analysis);

/// Writes down what became of a peak, for every channel that shows it.
void give_fate(Analysis &analysis, const MergedPeak &peak, FindingKind fate, const std::string &reason);
}  // namespace mill::twin
