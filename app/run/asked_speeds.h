#pragma once
#include "dynamics/chatter/speed_interval.h"
#include <mutex>
#include <string>
#include <vector>

namespace mill {
/// A question about a critical speed, with all that its answer depends on.
struct AskedSpeed {
  std::string pass;                  ///< name of the pass or condition
  double speed = not_given;          ///< m/s, of it; NaN: not known
  dynamics::SpeedQuestion question;  ///< on the stand that has led
};

/// Those that the stages of a run have asked, for maps after it.
class AskedSpeeds {
public:
  void add(AskedSpeed one)
  {
    const std::lock_guard lock(access);
    asked.push_back(std::move(one));
  }
  std::vector<AskedSpeed> all() const
  {
    const std::lock_guard lock(access);
    return asked;
  }

private:
  mutable std::mutex access;
  std::vector<AskedSpeed> asked;
};
}  // namespace mill
