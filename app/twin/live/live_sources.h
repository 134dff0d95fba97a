#pragma once
#include "app/command/command_line.h"
#include "app/twin/live/live_input.h"
#include "twin/live/engine/engine.h"
#include "twin/live/queue/sample_queue.h"
#include "twin/live/source/arrival_watch.h"
#include "twin/live/source/data_port.h"
#include "twin/live/source/mqtt_source.h"
#include "twin/live/source/source_thread.h"
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace mill {
/// The source that the user asked for, its queue, and the watch over rate and clocks of a source that sets its own
/// pace.  In the thread of the engine; the readers ask for next_of() from theirs.
class LiveSources {
public:
  using News = std::optional<live::ArrivalWatch::News>;
  explicit LiveSources(LiveInput input);

  /// Starts the reader, at the sample where an engine that was resumed goes on.
  /// @param token  that a head on TCP brings; empty: none
  /// @throws InputError  options, a file or an address that is not there
  void open(const CommandLine &command, const std::string &token, const live::Engine &engine);

  /// @param start_known  the source has said when its sample 0 was
  void begin(const live::LiveSource &source, bool start_known);
  /// @param next  number behind the last sample that came;  @param n  samples that came;  @param rate  Hz
  News arrived(std::int64_t next, std::int64_t n, double rate);
  News look();                  ///< now and then
  double arrival_rate() const;  ///< Hz; NaN: not measured

  void set_next(std::int64_t next);
  std::optional<std::int64_t> next() const;  ///< sample that the twin waits for; from any thread
  /// The same as a sender with this head numbers it, at least 0.  Nothing: the head begins another record.  From
  /// any thread.
  std::optional<std::int64_t> next_of(const live::SourceHead &head) const;
  bool connected() const;  ///< a sender or the broker is connected; a file or a pipe is open
  live::SampleQueue &queue()
  {
    return queue_;
  }
  const std::string &description() const  ///< "tcp 127.0.0.1:8461"; empty before open()
  {
    return description_;
  }
  std::string notice() const;
  /// A result for those who listen at the source (MQTT).
  void publish(const std::string &json);
  /// @throws what the reader threw, after its end
  void rethrow() const;

private:
  live::SourceRules rules(const CommandLine &command, const std::string &token, const live::Engine &engine) const;

  LiveInput input_;
  std::optional<live::ArrivalWatch> arrival_;
  live::SampleQueue queue_;
  std::atomic<std::int64_t> next_{-1};
  mutable std::mutex begun_lock_;          // of the two that follow
  std::optional<live::LiveSource> begun_;  // the source whose samples have the numbers of next()
  bool start_known_ = false;
  std::string description_;
  std::unique_ptr<live::SourceThread> thread_;
  std::unique_ptr<live::DataPort> port_;
  std::unique_ptr<live::MqttSource> mqtt_;
};
}  // namespace mill
