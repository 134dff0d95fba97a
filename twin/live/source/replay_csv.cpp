#include "twin/live/source/csv_feed.h"
#include "twin/live/source/file_sources.h"
#include "twin/records/line_source.h"
#include <chrono>
#include <cmath>
#include <thread>

namespace mill::live {
namespace {
using Clock = std::chrono::steady_clock;

// Gives blocks away when their last sample is due.
class Pace {
public:
  explicit Pace(const double speed) : speed_(speed) {}
  // The numbers of a new head begin again, or have another unit.
  void restart()
  {
    begun_.reset();
  }
  void wait(const SourceBlock &block, const double rate, const std::atomic<bool> &stop)
  {
    if (!std::isfinite(speed_))
      return;
    if (!begun_) {
      begun_ = Clock::now();
      first_ = block.first;
    }
    const double due = double(block.first + block.value.rows() - first_) / rate / speed_;
    const auto when  = *begun_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due));
    while (!stop && Clock::now() < when)
      std::this_thread::sleep_until(std::min(when, Clock::now() + std::chrono::milliseconds(50)));
  }

private:
  double speed_;
  std::optional<Clock::time_point> begun_;
  std::int64_t first_ = 0;
};
}  // namespace

void replay_csv(const FileSource &source, SampleQueue &queue, const std::atomic<bool> &stop)
{
  twin::LineSource lines(source.path);
  CsvFeed feed(source.path, source.rules);
  if (source.resumed)
    feed.resume(*source.resumed);
  Pace pace(source.speed);
  double rate        = 0;  // Hz, of the blocks that follow
  const auto pass_on = [&] {
    for (Message &message : feed.take()) {
      if (const auto *block = std::get_if<SourceBlock>(&message))
        pace.wait(*block, rate, stop);
      else if (const auto *head = std::get_if<SourceHead>(&message)) {
        rate = head->rate;
        pace.restart();
      }
      if (stop || !queue.push(std::move(message)))
        return false;
    }
    return true;
  };
  std::string_view line;
  while (!feed.closed() && lines.next(line)) {
    feed.line(line, lines.number());
    if (!pass_on())
      return;
  }
  feed.finish();
  pass_on();
}
}  // namespace mill::live
