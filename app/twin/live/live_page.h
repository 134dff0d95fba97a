#pragma once
#include "app/command/command_line.h"
#include "app/twin/live/live_alarms.h"
#include "app/twin/live/live_console.h"
#include "twin/live/compare/low_priority_task.h"
#include "twin/live/display/page_feed.h"
#include "twin/live/display/place_spectrum.h"
#include "twin/live/engine/command_queue.h"
#include "twin/live/engine/engine.h"
#include "twin/live/page/page_server.h"
#include <mutex>
#include <optional>
#include <string>

namespace mill {
struct Case;

/// The page of a run: its server, its commands, and what it shows of the twin (stand, numbers, motion, spectrum,
/// parameters, advice).  In the thread of the engine.  The server asks for commands and /metrics in its thread; an
/// advice is computed at lowest priority in another.
class LivePage {
public:
  /// @param limit  m/s2, 0-peak: the mill's own
  LivePage(const Case &the_case, std::optional<double> limit, const live::Engine &engine, LiveAlarms &alarms);

  /// Nothing with --listen none; then nothing is published.
  /// @param token  empty: the server makes one
  /// @throws InputError  an address that cannot be had
  void open(const CommandLine &command, const std::string &token, LiveConsole &console);
  void publish(const std::string &event, const std::string &json);
  void set_metrics(std::string text);
  std::int64_t forgotten() const;  ///< alarms and proposals that a browser that connects now does not get
  live::CommandQueue &commands()
  {
    return commands_;
  }

  void begin(const live::LiveSource &source);
  void take(const live::LiveBlock &block);
  void motion(std::int64_t first, double step, const Eigen::MatrixXd &motion);
  void tick(double now);  ///< s, steady
  void twin_changed();
  void apply(const live::PageCommand &command);  ///< an advice, another place

private:
  live::CommandReply take_command(const std::string &json);
  live::PageStand stand() const;
  void show_stand();
  void publish_parameters();
  void begin_advice();

  const Case &the_case_;
  std::optional<double> limit_;
  const live::Engine &engine_;
  LiveAlarms &alarms_;
  live::PageFeed feed_;
  live::PlaceSpectrum spectrum_;
  std::string place_ = "upper_work_roll";  // whose spectrum is shown
  std::string adopted_;                    // springs that the stand of the page has
  live::LowPriorityTask<live::PageAdvice> advice_;
  live::CommandQueue commands_;
  std::mutex metrics_lock_;
  std::string metrics_;
  std::optional<live::PageServer> server_;
};
}  // namespace mill
