#pragma once
#include "twin/cleaning/clean_record.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Channels side by side at a lower rate, one matrix for each piece that all of them share.
struct DecimatedRecord {
  double rate = 0;                     ///< Hz
  std::vector<Eigen::MatrixXd> piece;  ///< (p, n) in the units of the channels
  double duration() const;             ///< s
};

/// Low-pass by a windowed sinc at half the new rate, which is about 4 times `highest`.
/// @param channels  of one record
DecimatedRecord decimated(const std::vector<const CleanChannel *> &channels, double rate, double highest);

/// The first and the second half.
std::vector<DecimatedRecord> halves(const DecimatedRecord &record);
}  // namespace mill::twin
