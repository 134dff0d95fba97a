#pragma once
#include "twin/cleaning/clean_record.h"
#include "twin/detection/line_families.h"
#include <optional>
#include <vector>

namespace mill::twin {
/// Samples that a recorder lost at the borders of its blocks: a line becomes a comb of lines rate/block apart.
/// theory.md (41.27)
struct LostSamples {
  Eigen::Index block;  ///< samples of a block
  double spacing;      ///< Hz, rate / block
  double strongest;    ///< Hz, line of the comb that is highest
  double step;         ///< -, mean square of the second difference at the border over the median elsewhere
  std::vector<std::size_t> members;  ///< of the lines
};

/// Looks for a comb among the lines and for the steps at the borders among the samples; both have to be there.
std::optional<LostSamples> lost_samples(const CleanChannel &channel, double rate,
                                        const std::vector<SeenLine> &lines);
}  // namespace mill::twin
