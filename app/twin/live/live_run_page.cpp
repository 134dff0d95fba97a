#include "app/process/console.h"
#include "app/run/run_setup.h"
#include "app/twin/live/live_advice.h"
#include "app/twin/live/live_input.h"
#include "app/twin/live/live_metrics.h"
#include "app/twin/live/live_run.h"
#include "app/twin/live/live_stand.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/base/visible_text.h"
#include "core/model/case.h"
#include "twin/web/server/listen_address.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

// What of a live run is shown: page, account, alarms, console.
namespace mill {
namespace {
// Notes of the source and of the recorder that raise an alarm.
enum class AlarmingNote { recording, loss, gap, overrun, rate, clock };
constexpr auto words_of(AlarmingNote)
{
  return choice_words<AlarmingNote>("recording", "loss", "gap", "overrun", "rate", "clock");
}

constexpr std::int64_t shown_of_a_kind = 20;  // refusals and the like, on the console
}  // namespace

double utc_now()
{
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// Beside the recording, or in the cache folder: a page that is open finds a program that was started again.  Empty
// where neither can be had.
std::string LiveRun::token_keeper(const int port) const
{
  if (!command_.live.record.empty())
    return command_.live.record + "/page.token";
  const std::string folder = cache_folder(command_, "");
  if (folder.empty() || port == 0)
    return "";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string keeper = fmt::format("{}/live-{}.token", folder, port);
  return error || access(folder.c_str(), W_OK) != 0 ? "" : keeper;
}

live::PageStand LiveRun::own_stand() const
{
  live::PageStand stand = page_stand(the_case_, model_);
  stand.amplitude_limit = limit_.value_or(live::unknown);
  return stand;
}

// What the source measures is known when it has begun.
void LiveRun::show_source(const live::LiveSource &source)
{
  if (!page_)
    return;
  live::PageStand stand = own_stand();
  stand.rate            = source.rate;
  for (live::StandPlace &place : stand.places)
    place.measured = std::any_of(source.channels.begin(), source.channels.end(), [&](const live::LiveChannel &c) {
      return c.name == place.place && is_in(c.unit, SiUnit::acceleration);
    });
  page_->set_stand(live::stand_text(stand));
  publish_parameters();
}

void LiveRun::open_page()
{
  const LiveOptions &options = command_.live;
  if (options.listen == word_of(ListenWord::none))
    return;
  live::PageSettings settings;
  if (!options.listen.empty()) {
    const auto at    = web::address_and_port("--listen", options.listen, "127.0.0.1:8460");
    settings.address = at.address;
    settings.port    = at.port;
  }
  settings.token       = token_;
  settings.token_given = !token_.empty();
  if (!options.host.empty())
    settings.hosts.push_back(options.host);
  if (token_.empty())
    settings.token_keeper = token_keeper(settings.port);
  page_.emplace(
      settings, live::stand_text(own_stand()), [this](const std::string &json) { return take_command(json); },
      [this] {
        const std::lock_guard lock(metrics_lock_);
        return metrics_text_;
      });
  print("page:   " + page_->url() + "\n");
  if (!page_->notice().empty())
    console::say("warning: " + page_->notice() + "\n");
  publish_parameters();
  if (engine_->source())
    show_source(*engine_->source());
  std::map<std::int64_t, live::PageAlarm> before;  // a restart; a browser may acknowledge one already
  {
    const std::lock_guard lock(alarm_lock_);
    before = shown_alarms_;
  }
  for (const auto &[id, alarm] : before)
    publish(live::event_names::alarm, live::alarm_text(alarm));
}

// In the thread of the server.
live::CommandReply LiveRun::take_command(const std::string &json)
{
  const auto refuse = [](const std::string &why) {
    return live::CommandReply{400, nlohmann::json{{"error", why}}.dump()};
  };
  try {
    const live::PageCommand command = live::page_command(json);
    const auto &keys                = live::slider_keys();
    const bool has_key              = std::find(keys.begin(), keys.end(), command.key) != keys.end();
    using Kind                      = live::PageCommandKind;
    if ((command.kind == Kind::set && !has_key) ||
        (command.kind == Kind::reset && !command.key.empty() && !has_key))
      return refuse("unknown key \"" + visible(command.key, true) + "\"; K1 to K7 and damping can be set");
    if (command.kind == Kind::acknowledge)
      return acknowledge(command.id) ? live::CommandReply{} : refuse(fmt::format("unknown alarm {}", command.id));
    if (!commands_.push(command))
      return live::CommandReply{409, nlohmann::json{{"error", "too many commands wait"}}.dump()};
    return live::CommandReply{202, "{}"};
  } catch (const InputError &error) {
    return refuse(error.problems.front().message);
  }
}

void LiveRun::begin_advice()
{
  const bool begun = advice_.start([model = engine_->model(), tuning = engine_->tuning(), place = place_] {
    return live_advice(model, tuning, place, utc_now());
  });
  live::PageAdvice computing;
  computing.utc   = utc_now();
  computing.state = "computing";
  if (begun)
    publish(live::event_names::advice, live::advice_text(computing));
}

// An alarm that was seen stays seen when it changes or ends.
void LiveRun::show_alarm(live::PageAlarm alarm)
{
  {
    const std::lock_guard lock(alarm_lock_);
    live::PageAlarm &shown = shown_alarms_[alarm.id];
    alarm.acknowledged     = alarm.acknowledged || shown.acknowledged;
    shown                  = alarm;
    if (shown_alarms_.size() > 400)  // the page keeps 200
      shown_alarms_.erase(shown_alarms_.begin());
  }
  publish(live::event_names::alarm, live::alarm_text(alarm));
}

bool LiveRun::acknowledge(const std::int64_t id)
{
  live::PageAlarm alarm;
  {
    const std::lock_guard lock(alarm_lock_);
    const auto shown = shown_alarms_.find(id);
    if (shown == shown_alarms_.end())
      return false;
    alarm = shown->second;
  }
  alarm.acknowledged = true;
  show_alarm(alarm);
  return true;
}

void LiveRun::publish(const std::string &event, const std::string &json)
{
  if (page_)
    page_->publish(event, json);
  if (sources_ && (event == live::event_names::levels || event == live::event_names::alarm ||
                   event == live::event_names::modes))
    sources_->publish("{\"event\":\"" + event + "\",\"data\":" + json + "}");
}

void LiveRun::print(const std::string &text)
{
  if (command_.quiet)
    return;
  const std::lock_guard lock(console_);
  console::print(text);
  console::flush();
}

// From the engine and from the background.
void LiveRun::say(const std::string &kind, const std::string &text)
{
  const std::string shown = visible(text, true);
  std::int64_t times      = 0;
  {
    const std::lock_guard lock(console_);
    times = ++said_[kind];
  }
  const auto alarm = choice_named<AlarmingNote>(kind);
  const bool stops = alarm == AlarmingNote::recording;
  if (alarm) {
    const std::lock_guard lock(alarm_lock_);
    alarms_.raise(kind, utc_now(),
                  stops                         ? "recording"
                  : *alarm == AlarmingNote::gap ? "gap"
                                                : "source",
                  stops ? "alarm" : "warning", shown);
  }
  if (times == shown_of_a_kind + 1)
    print(fmt::format("{}: further ones are counted and not shown\n", kind));
  if (times > shown_of_a_kind)
    return;
  if (stops) {
    const std::lock_guard lock(console_);
    console::say("alarm: " + shown + "\n");
  } else
    print(kind + ": " + shown + "\n");
}

live::PageAccount LiveRun::page_account() const
{
  live::PageAccount account;
  account.utc    = utc_now();
  account.source = sources_ ? sources_->description() : "";
  const auto &of = engine_->source();
  if (of && !of->name.empty() && account.source.find(of->name) == std::string::npos)
    account.source += ", " + of->name;
  account.connected = of.has_value();
  account.queue     = of ? double(queue_.samples()) / of->rate : 0;
  if (recorder_) {
    account.recording = command_.live.record;
    account.recorded  = recorder_->seconds();
    account.trouble   = recorder_->trouble();
  }
  for (std::size_t c = 0; of && c < of->channels.size(); ++c) {
    const live::ChannelAccount &a = engine_->book()->channels()[c];
    account.channels.push_back({of->channels[c].name, a.offered, a.processed, a.missing, a.rejected, a.overrun});
  }
  return account;
}

std::string LiveRun::account_json() const
{
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  const auto &of              = engine_->source();
  for (std::size_t c = 0; of && c < of->channels.size(); ++c) {
    const live::ChannelAccount &a          = engine_->book()->channels()[c];
    json["channels"][of->channels[c].name] = {{"offered", a.offered},
                                              {"processed", a.processed},
                                              {"missing", a.missing},
                                              {"rejected", a.rejected},
                                              {"overrun", a.overrun}};
  }
  if (engine_->book()) {
    json["doubled"]       = engine_->book()->doubled();
    json["gaps"]          = engine_->book()->gaps();
    json["refused_lines"] = engine_->refused_lines();
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// OpenMetrics without its end, which the server adds.
std::string LiveRun::metrics() const
{
  MetricsInput input;
  input.source        = engine_->source() ? &*engine_->source() : nullptr;
  input.book          = engine_->book();
  input.comparison    = comparison_ ? &*comparison_ : nullptr;
  input.adopted       = model_.adopted;
  input.limit         = limit_;
  input.refused_lines = engine_->refused_lines();
  input.queued        = queue_.samples();
  input.states        = states_;
  if (arrival_)
    input.arrival_rate = arrival_->rate();
  const std::lock_guard lock(alarm_lock_);
  for (const auto &[cause, alarm] : alarms_.state().now)
    input.own_alarms.push_back(alarm);
  return metrics_text(input);
}

void LiveRun::summary()
{
  const auto &of = engine_->source();
  if (!of || !engine_->book())
    return;
  print(fmt::format("{:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "samples", "offered", "processed", "missing",
                    "rejected", "overrun"));
  for (std::size_t c = 0; c < of->channels.size(); ++c) {
    const live::ChannelAccount &a = engine_->book()->channels()[c];
    print(fmt::format("{:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", visible(of->channels[c].name, true),
                      a.offered, a.processed, a.missing, a.rejected, a.overrun));
  }
  print(fmt::format("{} gaps, {} samples doubled, {} lines refused\n", engine_->book()->gaps(),
                    engine_->book()->doubled(), engine_->refused_lines()));
}
}  // namespace mill
