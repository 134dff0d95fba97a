#pragma once
#include "twin/live/engine/engine.h"
#include "twin/live/live_block.h"
#include "twin/live/page/event_text.h"
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace mill::live {
/// Numbers and motion for the page from the blocks of the engine.
class PageFeed {
public:
  void begin(const LiveSource &source);
  void take(const LiveBlock &block);
  /// Numbers since the last call, at most 20 times a second.  @param now  s, steady
  std::optional<PageNumbers> numbers(double now);
  /// @param motion  (places, instants) m;  @param step  s between instants
  PageMotion motion(std::int64_t first, double step, const Eigen::MatrixXd &motion) const;

private:
  std::optional<LiveSource> source_;
  std::vector<Eigen::Index> channel_of_place_;             // -1: not measured
  Eigen::Index speed_ = -1;                                // column
  std::vector<std::vector<double>> measured_, simulated_;  // (places) since the last event
  std::vector<double> displacement_;
  double sent_ = 0, arrived_ = 0, force_ = 0, last_speed_ = unknown;
  std::int64_t n_ = 0, end_ = 0;
  bool gap_ = false, settling_ = false, said_waiting_ = false;
};
}  // namespace mill::live
