#pragma once
#include "twin/live/engine/engine.h"
#include "twin/live/recording/background.h"
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mill {
/// Held while a program records into a folder: two programs would write into each other's files and state.
class RecordLock {
public:
  /// @throws InputError  another program holds it
  explicit RecordLock(const std::string &folder);
  ~RecordLock();
  RecordLock(const RecordLock &)            = delete;
  RecordLock &operator=(const RecordLock &) = delete;

private:
  std::string path_;
  int file_ = -1;
};

/// The state of a twin in the folder of its recording, FOLDER/state.json, written under another name and renamed.
class LiveState {
public:
  explicit LiveState(const std::string &folder);
  /// The stored state; nothing where there is none, or where it cannot be read: then it is renamed to
  /// state.json.damaged.
  /// @param report  why it cannot be read, a sentence
  std::optional<nlohmann::json> read(const std::function<void(const std::string &)> &report) const;
  /// In the background, unless an earlier one is still being written.
  /// @returns whether it will be written
  bool write(const nlohmann::json &state, live::Background &background,
             std::function<void(const std::string &)> failed) const;

private:
  std::string path_;
};

/// Number after the last sample that recordings of this source hold, of those that begin at `from` or later:
/// files whose start is that of the source at their first number.  Nothing when there are none.
std::optional<std::int64_t> recorded_up_to(const std::string &folder, const live::LiveSource &source,
                                           std::int64_t from);
}  // namespace mill
