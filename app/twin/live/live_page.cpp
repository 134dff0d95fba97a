#include "app/twin/live/live_page.h"
#include "app/process/console.h"
#include "app/run/run_setup.h"
#include "app/twin/live/live_advice.h"
#include "app/twin/live/live_clock.h"
#include "app/twin/live/live_input.h"
#include "app/twin/live/live_stand.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/base/visible_text.h"
#include "core/model/case.h"
#include "twin/live/steady_clock.h"
#include "twin/web/server/listen_address.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace mill {
namespace {
// With the recording, or in the cache folder: a page that is open finds a program that was started again.  Empty
// where neither can be had.
std::string token_keeper(const CommandLine &command, const int port)
{
  if (!command.live.record.empty())
    return command.live.record + "/page.token";
  const std::string folder = cache_folder(command, "");
  if (folder.empty() || port == 0)
    return "";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string keeper = fmt::format("{}/live-{}.token", folder, port);
  return error || access(folder.c_str(), W_OK) != 0 ? "" : keeper;
}

live::PageSettings page_settings(const CommandLine &command, const std::string &token)
{
  const LiveOptions &options = command.live;
  live::PageSettings settings;
  if (!options.listen.empty()) {
    const auto listen = web::address_and_port("--listen", options.listen, "127.0.0.1:8460");
    settings.address  = listen.address;
    settings.port     = listen.port;
  }
  settings.token       = token;
  settings.token_given = !token.empty();
  if (!options.host.empty())
    settings.hosts.push_back(options.host);
  if (token.empty())
    settings.token_keeper = token_keeper(command, settings.port);
  return settings;
}
}  // namespace

LivePage::LivePage(const Case &the_case, const std::optional<double> limit, const live::Engine &engine,
                   LiveAlarms &alarms)
    : the_case_(the_case), limit_(limit), engine_(engine), alarms_(alarms)
{
}

void LivePage::open(const CommandLine &command, const std::string &token, LiveConsole &console)
{
  if (command.live.listen == word_of(ListenWord::none))
    return;
  server_.emplace(
      page_settings(command, token), live::stand_text(stand()),
      [this](const std::string &json) { return take_command(json); },
      [this] {
        const std::lock_guard lock(metrics_lock_);
        return metrics_;
      });
  console.print("page:   " + server_->url() + "\n");
  if (!server_->notice().empty())
    console::say("warning: " + server_->notice() + "\n");
  show_stand();
  publish_parameters();
}

void LivePage::publish(const std::string &event, const std::string &json)
{
  if (server_)
    server_->publish(event, json);
}

std::int64_t LivePage::forgotten() const
{
  return server_ ? server_->statistics().forgotten : 0;
}

void LivePage::set_metrics(std::string text)
{
  const std::lock_guard lock(metrics_lock_);
  metrics_ = std::move(text);
}

void LivePage::begin(const live::LiveSource &source)
{
  feed_.begin(source);
  spectrum_.begin(source);
  place_ = spectrum_.place();
  show_stand();
  publish_parameters();
}

void LivePage::take(const live::LiveBlock &block)
{
  if (!server_)
    return;
  feed_.take(block);
  if (const auto spectrum = spectrum_.take(block, live::steady_now()))
    publish(live::event_names::spectrum, live::spectrum_text(*spectrum));
}

void LivePage::motion(const std::int64_t first, const double step, const Eigen::MatrixXd &motion)
{
  if (server_)
    publish(live::event_names::motion, live::motion_text(feed_.motion(first, step, motion)));
}

void LivePage::tick(const double now)
{
  if (server_)
    if (const auto numbers = feed_.numbers(now))
      publish(live::event_names::numbers, live::numbers_text(*numbers));
  if (const auto advice = advice_.finished())
    publish(live::event_names::advice, live::advice_text(*advice));
}

void LivePage::twin_changed()
{
  spectrum_.twin_changed();
  if (engine_.model().adopted != adopted_)
    show_stand();  // before the event that lets the page read it again
  publish_parameters();
}

void LivePage::apply(const live::PageCommand &command)
{
  if (command.kind == live::PageCommandKind::advice)
    return begin_advice();
  if (command.kind == live::PageCommandKind::place) {
    spectrum_.choose(command.place);
    place_ = spectrum_.place();
  }
  publish_parameters();
}

// In the thread of the server.
live::CommandReply LivePage::take_command(const std::string &json)
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
      return alarms_.acknowledge(command.id) ? live::CommandReply{}
                                             : refuse(fmt::format("unknown alarm {}", command.id));
    if (!commands_.push(command))
      return live::CommandReply{409, nlohmann::json{{"error", "too many commands wait"}}.dump()};
    return live::CommandReply{202, "{}"};
  } catch (const InputError &error) {
    return refuse(error.problems.front().message);
  }
}

live::PageStand LivePage::stand() const
{
  live::PageStand stand = page_stand(the_case_, engine_.model());
  stand.amplitude_limit = limit_.value_or(live::unknown);
  return stand;
}

// What the source measures is known when it has begun.
void LivePage::show_stand()
{
  if (!server_)
    return;
  adopted_              = engine_.model().adopted;
  live::PageStand shown = stand();
  if (const auto &source = engine_.source()) {
    shown.rate = source->rate;
    for (live::StandPlace &place : shown.places)
      place.measured =
          std::any_of(source->channels.begin(), source->channels.end(), [&](const live::LiveChannel &c) {
            return c.name == place.place && is_in(c.unit, SiUnit::acceleration);
          });
  }
  server_->set_stand(live::stand_text(shown));
}

void LivePage::publish_parameters()
{
  const std::string &adopted = engine_.model().adopted;
  const std::string origin   = adopted.empty() ? "the case" : adopted;
  publish(live::event_names::parameters,
          live::parameters_text(page_parameters(engine_.model(), engine_.tuning(), origin, place_)));
}

void LivePage::begin_advice()
{
  const bool begun = advice_.start([model = engine_.model(), tuning = engine_.tuning(), place = place_] {
    return live_advice(model, tuning, place, utc_now());
  });
  live::PageAdvice computing;
  computing.utc   = utc_now();
  computing.state = "computing";
  if (begun)
    publish(live::event_names::advice, live::advice_text(computing));
}
}  // namespace mill
