#pragma once
#include "app/command/live_options.h"
#include "app/twin/live/live_console.h"
#include "app/twin/live/live_state.h"
#include "twin/live/recording/recorder.h"
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// The folder of --record: its lock, the recording, the stored state.  In the thread of the engine; writes in the
/// background.
class LiveRecording {
public:
  /// Makes the folder and finishes what a killed program left there.
  /// @param account  of the samples, for the files; called until the end of this object
  /// @throws InputError  a folder that cannot be made, or another program records there
  LiveRecording(const LiveOptions &options, const std::string &case_name, const std::string &case_hash,
                LiveConsole &console, live::AccountText account);

  /// The state that an earlier program left.
  std::optional<nlohmann::json> stored() const;
  /// Rows that are on the disk already are not recorded again.
  /// @param engine    after its resume()
  /// @param recorded  number up to which the stored state says so
  /// @param file      source of this run; decides where an earlier program was killed before it stored a state
  void resume(const live::Engine &engine, std::int64_t recorded, const std::string &file);
  void store(const nlohmann::json &state);
  std::int64_t states() const  ///< written
  {
    return states_;
  }
  live::Recorder &recorder()
  {
    return recorder_;
  }

private:
  std::string folder_;
  LiveConsole &console_;
  RecordLock lock_;  // held until the background has written all
  live::Background background_;
  LiveState state_;
  std::vector<live::FinishedPart> finished_;  // of a program that was killed
  live::Recorder recorder_;
  std::int64_t states_ = 0;
};
}  // namespace mill
