#pragma once
#include "twin/live/engine/engine.h"
#include <string>

namespace mill {
/// What the console says of each second of record: force, levels of measured and twin.
class ConsoleLines {
public:
  void begin(const live::LiveSource &source);
  /// A line when a second of record is over; empty before.
  std::string take(const live::LiveBlock &block);

private:
  std::string line(const live::LiveBlock &block);

  live::LiveSource source_;
  std::int64_t n_ = 0;
  double force_   = 0;
  Eigen::VectorXd measured_, simulated_;  // sums of squares, by channel and place
  Eigen::VectorXd counted_;
};
}  // namespace mill
