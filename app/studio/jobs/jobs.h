#pragma once
#include "core/base/choice.h"
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mill::studio {
enum class JobStatus { running, done, failed, cancelled };
constexpr auto words_of(JobStatus)
{
  return choice_words<JobStatus>("running", "done", "failed", "cancelled");
}

/// Progress of the work that runs, or how the last one ended.
struct JobState {
  std::string id;                   ///< "run-3"; empty: none yet
  std::optional<JobStatus> status;  ///< nothing: none yet
  std::string stage;
  int percent    = 0;
  double seconds = 0;   ///< since its begin
  double left    = -1;  ///< s; -1: not known yet
  std::string printed;  ///< last lines that the program printed
  std::string file;     ///< that it makes in the folder `id`; empty: it makes a run
};

/// One program at a time, in a process of its own, so that neither its memory nor its end is ours.
class Jobs {
public:
  /// @param changed  called from a thread of its own with every change
  explicit Jobs(std::function<void(const JobState &)> changed);
  ~Jobs();  ///< as end()
  Jobs(const Jobs &)            = delete;
  Jobs &operator=(const Jobs &) = delete;

  /// Starts the program in the folder of this one.
  /// @param file  JobState::file
  /// @throws InputError  something runs; it cannot be started; end() was called
  void start(const std::string &id, const std::string &program, const std::vector<std::string> &arguments,
             const std::string &file = "");
  void cancel();
  /// Ends what runs, and starts nothing from now on.  `changed` is not called after it has returned.
  void end();
  JobState state() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace mill::studio
