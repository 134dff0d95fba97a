#pragma once
#include "app/command/command_line.h"
#include "app/twin/live/live_alarms.h"
#include "app/twin/live/live_comparison.h"
#include "app/twin/live/live_console.h"
#include "app/twin/live/live_page.h"
#include "app/twin/live/live_recording.h"
#include "app/twin/live/live_sources.h"
#include "app/twin/live/processor_share.h"
#include "app/twin/live/response_file.h"
#include "twin/live/engine/engine.h"
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace mill {
struct Case;

/// Connects a source with the engine and the engine with its observers.  Made and run by one thread, that of the
/// engine.
class LiveRun {
public:
  LiveRun(const CommandLine &command, const Case &the_case);
  int until_the_end();
  bool leaves_old_response() const;  ///< the --response file that was there is as it was

private:
  struct Start;
  LiveRun(const CommandLine &command, const Case &the_case, const Start &start);
  live::EngineHooks hooks();
  void begin(const live::LiveSource &source);
  void take(const live::LiveBlock &block);
  void publish(const std::string &event, const std::string &json);
  void report_arrival(const LiveSources::News &news);
  void tick(double now);
  void each_second();
  live::PageAccount page_account();
  std::string metrics();

  void store_state();
  void resume(const std::string &file);
  std::int64_t take_over(const nlohmann::json &stored);

  // Each is used by those after it and by their threads, and ends after them.
  const CommandLine &command_;
  std::optional<double> limit_;  // m/s2, 0-peak: the mill's own
  LiveSources sources_;
  live::Engine engine_;
  LiveAlarms alarms_;
  LiveConsole console_;
  LiveComparison comparison_;
  LivePage page_;
  std::optional<ResponseFile> response_;    // with --response
  std::optional<LiveRecording> recording_;  // with --record
  bool has_state_     = false;
  double last_second_ = 0;  // s, steady, of the last each_second()
  ProcessorShare load_;
};
}  // namespace mill
