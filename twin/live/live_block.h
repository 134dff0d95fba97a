#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mill::live {
/// What one channel of a source means; SI.
struct LiveChannel {
  std::string name;  ///< "force", "load_cell", "speed", a place "upper_work_roll", or the name of the source
  std::string unit;  ///< "N", "m/s", "m/s2", or as the source writes it for what the twin does not know
};

/// Even samples between two gaps, measured and simulated, in SI.
struct LiveBlock {
  std::int64_t first = 0;      ///< number of the first sample
  double rate        = 0;      ///< Hz
  double start_time  = 0;      ///< s since 1970 UTC, of sample 0
  bool after_gap     = false;  ///< samples before this block were lost: the model is in equilibrium again
  bool settling      = false;  ///< less than 5 / (zeta w_1) since the last gap: not compared
  bool driven        = true;   ///< the source has a force, which drives the twin
  Eigen::VectorXd force;       ///< (n) N; NaN: the source has no force, and nothing is simulated
  Eigen::MatrixXd measured;    ///< (n, channels) in the order of the source's channels; NaN: missing
  Eigen::MatrixXd simulated;   ///< (n, places) m/s2, accelerations of the places of the model; NaN without a force
  Eigen::VectorXd displacement;  ///< (places) m, of the model at the end of the block, from its mean state
};

/// Takes what the page shows: name of the event ("numbers", "spectrum", "account", "alarm", "modes", "chatter")
/// and its JSON text.  May be called from any thread.
using Publish = std::function<void(const std::string &event, const std::string &json)>;
}  // namespace mill::live
