#include "app/twin/live/live_sources.h"
#include "app/twin/live/live_clock.h"
#include "app/twin/stand/record_options.h"
#include "core/base/errors.h"
#include "core/case/monitoring.h"
#include "twin/live/source/file_sources.h"
#include "twin/live/steady_clock.h"
#include "twin/web/server/listen_address.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
live::ClockReading clock_now()
{
  return {live::steady_now(), utc_now()};
}
// The file goes on where the engine does.
void resume(live::FileSource &file, const live::Engine &engine)
{
  live::ResumedFile from;
  from.next = engine.resumed_at();
  from.rate = engine.source()->rate;
  if (engine.start_known())
    from.start = engine.source()->start_time;
  if (const auto &read_last = engine.file()) {
    from.first = read_last->first;
    file.print = read_last->print;
  }
  file.resumed = from;
}
}  // namespace

LiveSources::LiveSources(LiveInput input) : input_(std::move(input))
{
  if (input_.kind != LiveInput::Kind::replay)
    arrival_.emplace();
}

live::SourceRules LiveSources::rules(const CommandLine &command, const std::string &token,
                                     const live::Engine &engine) const
{
  live::SourceRules rules;
  rules.places  = live::places_of(live::stepped(engine.model(), {}));
  rules.reading = read_options(command, monitoring_of(command.target, command.sets));
  rules.token   = input_.kind == LiveInput::Kind::tcp ? token : "";
  rules.next    = [this](const live::SourceHead &head) { return next_of(head); };
  if (input_.kind == LiveInput::Kind::mqtt && engine.resumed_at() != 0) {
    const live::LiveSource &source = *engine.source();
    rules.assumed = live::SourceHead{source.rate, source.start_time, source.name, source.channels, source.factor};
  }
  return rules;
}

void LiveSources::open(const CommandLine &command, const std::string &token, const live::Engine &engine)
{
  const live::SourceRules rules = this->rules(command, token, engine);
  const double speed            = replay_speed(command.live.speed);
  if (!command.live.speed.empty() && input_.kind != LiveInput::Kind::replay)
    throw InputError(
        "--speed belongs to a record that is played (--input FILE.csv); other sources set their own pace");
  live::FileSource file{input_.target, rules, speed, {}, ""};
  if (engine.resumed_at() != 0) {
    next_ = engine.resumed_at();
    if (engine.source()->name == input_.target)
      resume(file, engine);
  }
  const auto start = [&](auto read) { thread_ = std::make_unique<live::SourceThread>(queue_, std::move(read)); };
  using Kind       = LiveInput::Kind;
  switch (input_.kind) {
  case Kind::replay:
    if (!fs::is_regular_file(input_.target))
      throw InputError("the file " + input_.target + " does not exist");
    description_ = "record " + input_.target;
    start([file, this](const std::atomic<bool> &stop) { live::replay_csv(file, queue_, stop); });
    break;
  case Kind::tail:
    description_ = "growing file " + input_.target;
    start([file, this](const std::atomic<bool> &stop) { live::follow_csv(file, queue_, stop); });
    break;
  case Kind::lines:
    description_ = "standard input";
    start([rules, this](const std::atomic<bool> &stop) { live::read_json_lines(0, rules, queue_, stop); });
    break;
  case Kind::tcp: {
    const auto listen = web::address_and_port("--input", input_.target, "tcp:127.0.0.1:8461");
    port_ = std::make_unique<live::DataPort>(live::DataPortSettings{listen.address, listen.port, rules}, queue_);
    description_ = fmt::format("tcp {}:{}", listen.address, port_->port());
    break;
  }
  case Kind::mqtt: {
    live::MqttSettings settings = live::mqtt_settings(input_.target);
    settings.rules              = rules;
    description_                = fmt::format("mqtt {}:{}/{}", settings.host, settings.port, settings.stand);
    mqtt_                       = std::make_unique<live::MqttSource>(settings, queue_);
    break;
  }
  }
}

void LiveSources::begin(const live::LiveSource &source, const bool start_known)
{
  next_ = -1;  // of the source before
  {
    const std::lock_guard lock(begun_lock_);
    begun_       = source;
    start_known_ = start_known;
  }
  if (arrival_)
    arrival_->begin(source.rate);
}

LiveSources::News LiveSources::arrived(const std::int64_t next, const std::int64_t n, const double rate)
{
  return arrival_ ? arrival_->arrived(next, n, clock_now(), double(queue_.samples()) / rate) : std::nullopt;
}

LiveSources::News LiveSources::look()
{
  return arrival_ ? arrival_->look(clock_now()) : std::nullopt;
}

double LiveSources::arrival_rate() const
{
  return arrival_ ? arrival_->rate() : std::numeric_limits<double>::quiet_NaN();
}

void LiveSources::set_next(const std::int64_t next)
{
  next_ = next;
}

std::optional<std::int64_t> LiveSources::next() const
{
  const std::int64_t next = next_;
  return next < 0 ? std::nullopt : std::optional(next);
}

std::optional<std::int64_t> LiveSources::next_of(const live::SourceHead &head) const
{
  const auto ours = next();
  const std::lock_guard lock(begun_lock_);
  const auto above = begun_ ? live::offset_of(head, *begun_, start_known_) : std::nullopt;
  return ours && above ? std::optional(std::max<std::int64_t>(0, *ours - *above)) : std::nullopt;
}

bool LiveSources::connected() const
{
  return port_ ? port_->has_sender() : mqtt_ ? mqtt_->connected() : bool(thread_);
}

std::string LiveSources::notice() const
{
  return port_ ? port_->notice() : "";
}

void LiveSources::publish(const std::string &json)
{
  if (mqtt_)
    mqtt_->publish(json);
}

void LiveSources::rethrow() const
{
  if (thread_)
    thread_->rethrow();
}
}  // namespace mill
