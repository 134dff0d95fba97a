#pragma once
#include <ctime>
#include <limits>
#include <optional>

namespace mill {
/// Share of one processor that this program takes with all its threads.
class ProcessorShare {
public:
  /// @param now  s, steady
  /// @return -, NaN at the first call
  double since_last_call(const double now)
  {
    const double used  = double(std::clock()) / CLOCKS_PER_SEC;
    const double share = before_ && now > before_->now ? (used - before_->used) / (now - before_->now)
                                                       : std::numeric_limits<double>::quiet_NaN();
    before_            = Moment{now, used};
    return share;
  }

private:
  struct Moment {
    double now, used;  // s
  };
  std::optional<Moment> before_;
};
}  // namespace mill
