#pragma once
#include "app/command/command_line.h"
#include "app/process/cut_signal.h"
#include "app/twin/live/console_lines.h"
#include "app/twin/live/live_sources.h"
#include "app/twin/live/live_state.h"
#include "app/twin/live/response_file.h"
#include "twin/live/compare/comparison.h"
#include "twin/live/compare/low_priority_task.h"
#include "twin/live/display/page_feed.h"
#include "twin/live/display/place_spectrum.h"
#include "twin/live/engine/command_queue.h"
#include "twin/live/engine/engine.h"
#include "twin/live/page/page_server.h"
#include "twin/live/recording/recorder.h"
#include "twin/live/source/arrival_watch.h"
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace mill {
struct Case;
namespace live {
class StoredObject;
}

double utc_now();  ///< s since 1970

/// Joins source, queue, engine, recording, state, page and console.  Made and run by one thread, that of the
/// engine.
class LiveRun {
public:
  LiveRun(const CommandLine &command, const Case &the_case);
  ~LiveRun();
  LiveRun(const LiveRun &)            = delete;
  LiveRun &operator=(const LiveRun &) = delete;
  int until_the_end();
  bool leaves_old_response() const;  ///< the --response file that was there is as it was

private:
  void open_folder();
  live::EngineHooks hooks();
  void resume();
  void resume_alarms(const live::StoredObject &run);
  void resume_recording(std::int64_t recorded);
  live::SourceRules rules() const;
  void open_page();
  std::string token_keeper(int port) const;
  live::CommandReply take_command(const std::string &json);
  void tick(double now);
  void each_second();
  void store_state();
  void tell_arrival(const std::optional<live::ArrivalWatch::News> &news);
  void begin_comparison(const live::LiveSource &source);
  std::optional<live::TwinModel> adopt(std::int64_t proposal);
  void changed_model(const live::TwinModel &model, const live::Tuning &tuning);
  void publish_parameters();
  void begin_advice();
  void show_source(const live::LiveSource &source);
  void publish(const std::string &event, const std::string &json);
  void show_alarm(live::PageAlarm alarm);
  bool acknowledge(std::int64_t id);
  void say(const std::string &kind, const std::string &text);
  void print(const std::string &text);
  void summary();
  std::string account_json() const;
  std::string metrics() const;
  live::PageStand own_stand() const;
  live::PageAccount page_account() const;

  const CommandLine &command_;
  const Case &the_case_;
  LiveInput input_;
  std::string token_;
  std::mutex console_;
  std::unique_ptr<live::Background> background_ = std::make_unique<live::Background>();
  std::optional<RecordLock> record_lock_;
  std::optional<LiveState> state_;
  std::optional<live::Recorder> recorder_;
  std::optional<ResponseFile> response_;
  ConsoleLines lines_;
  live::CommandQueue commands_;
  live::SampleQueue queue_;
  std::optional<live::PageServer> page_;
  live::PageFeed feed_;
  live::LowPriorityTask<live::PageAdvice> advice_;
  live::PlaceSpectrum spectrum_;
  std::optional<live::Comparison> comparison_;
  std::unique_ptr<nlohmann::json> learned_;    // state of the last comparison, for the next one
  std::optional<live::ArrivalWatch> arrival_;  // of a source that sets its own pace
  std::optional<double> limit_;                // m/s2, 0-peak: the mill's own
  std::string critical_of_;                    // adopted springs that the critical speed is computed with
  std::int64_t states_ = 0;                    // written
  live::AlarmBook alarms_{
      1'000'000};  // of source and recording; those of the comparison have numbers of their own
  mutable std::mutex alarm_lock_;
  std::map<std::int64_t, live::PageAlarm> shown_alarms_;  // last state sent to the page
  std::map<std::int64_t, std::string> printed_;           // level of each open alarm on the console
  std::string origin_ = "the case", place_ = "upper_work_roll";
  live::TwinModel model_;
  std::unique_ptr<live::Engine> engine_;
  std::unique_ptr<LiveSources> sources_;
  std::int64_t skip_to_ = 0;
  std::vector<live::FinishedPart> finished_;  // of a program that was killed
  bool has_state_ = false;
  std::optional<live::SourceHead> assumed_;
  std::atomic<std::int64_t> next_{-1};  // sent to senders
  double last_second_ = 0;
  std::string metrics_text_;
  mutable std::mutex metrics_lock_;
  std::map<std::string, std::int64_t> said_;  // how often, by kind
};
}  // namespace mill
