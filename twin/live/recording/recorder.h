#pragma once
#include "twin/live/engine/engine.h"
#include "twin/live/recording/background.h"
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace mill::live {
/// How much of a recording is kept.
struct KeptRecords {
  std::optional<double> age;    ///< s
  std::optional<double> bytes;  ///< byte
};
/// "24h", "7d", "90min", "50GB", "500MB".  @throws InputError
KeptRecords kept_records(const std::string &text);

struct RecorderSettings {
  std::string folder;
  std::string case_name, case_hash;
  double seconds_per_file = 60;   ///< s of samples
  double longest_unsaved  = 0.1;  ///< s
  KeptRecords kept;
};

/// What a recording says of itself in the sidecar: made by the engine when a file is finished.
using AccountText = std::function<std::string()>;

/// Writes rows as they come: `<UTC>_<s>.npy.part`, whose header is right after each tenth of a second, with a
/// sidecar `<UTC>_<s>.json`; every minute it is put on the disk and takes its name.  theory.md 48.5
/// A write that the system refuses ends the recording with a note; the twin goes on.
class Recorder {
public:
  /// @param note  notes, from this thread and that of the background
  Recorder(RecorderSettings settings, Background &background,
           std::function<void(const std::string &kind, const std::string &text)> note, AccountText account);
  ~Recorder();
  Recorder(const Recorder &)            = delete;
  Recorder &operator=(const Recorder &) = delete;

  void begin(const LiveSource &source);
  /// Rows before `next` are on the disk already, from before a restart: of the source that records, or of the one
  /// that begins next.
  void resume(std::int64_t next);
  /// @param rows  (n, channels), samples first, first + 1, ..
  void add(std::int64_t first, const Eigen::MatrixXd &rows);
  /// Saves what has waited for a tenth of a second.  @param now  s, steady
  void tick(double now);
  void save();    ///< all that has waited, at once; tick() is as before
  void finish();  ///< the file takes its name

  std::int64_t next() const;           ///< rows before it are not recorded again
  double seconds() const;              ///< s of record written
  const std::string &trouble() const;  ///< what the disk refused, which ended the recording; empty: nothing

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What an interrupted program left in a folder.
struct FinishedPart {
  std::string file;       ///< that it became
  std::int64_t rows = 0;  ///< -
  std::int64_t next = 0;  ///< number behind its last sample
  std::string source;     ///< as its sidecar names it
};
/// Finishes the files of programs that were killed: whole rows are counted into the header, the rest is cut off.
/// Those of a living program stay.  @param note  what was done
std::vector<FinishedPart> finish_parts(const std::string &folder,
                                       const std::function<void(const std::string &)> &note);

/// Removes the oldest recordings of a folder beyond what is kept; nothing that no recorder wrote.
/// @param now  s since 1970
/// @return names of files
std::vector<std::string> remove_old_records(const std::string &folder, const KeptRecords &kept, double now);

/// "2026-01-05T10:00:02.000050Z" of seconds since 1970.
std::string utc_text(double seconds);
/// "20260105T100002Z"
std::string utc_name(double seconds);
}  // namespace mill::live
