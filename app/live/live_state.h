#pragma once
#include "live/engine/engine.h"
#include "live/recording/background.h"
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mill {
/// The state of a twin beside its recording, FOLDER/state.json, written aside and renamed.
class LiveState {
public:
  explicit LiveState(std::string folder);
  /// What was stored; nothing where there is none that can be read.
  std::optional<nlohmann::json> read() const;
  /// In the background, unless an earlier one is still being written.
  void write(const nlohmann::json &state, live::Background &background,
             std::function<void(const std::string &)> failed) const;

private:
  std::string path_;
};

/// Number behind the last sample that recordings of this source hold, of those that begin at `from` or later:
/// files whose start is that of the source at their first number.  Nothing when there are none.
std::optional<std::int64_t> recorded_up_to(const std::string &folder, const live::LiveSource &source,
                                           std::int64_t from);
}  // namespace mill
