#include "app/twin/live/live_run.h"
#include "app/process/console.h"
#include "app/process/cut_signal.h"
#include "app/twin/live/live_clock.h"
#include "app/twin/live/live_input.h"
#include "app/twin/live/live_metrics.h"
#include "app/twin/live/live_stand.h"
#include "app/twin/live/sample_account.h"
#include "app/twin/stand/detail_parts.h"
#include "app/twin/stand/record_options.h"
#include "app/verbs/leading_model.h"
#include "core/base/errors.h"
#include "core/base/visible_text.h"
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include "twin/live/compare/stored_object.h"
#include "twin/live/engine/engine_loop.h"
#include "twin/live/steady_clock.h"
#include "twin/web/server/listen_address.h"
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
constexpr std::int64_t no_number = std::numeric_limits<std::int64_t>::min();
}

// Read and checked before anything is opened.
struct LiveRun::Start {
  LiveInput input;
  live::TwinModel model;
  std::optional<double> limit;
  std::string token;  // empty: the page makes one

  Start(const CommandLine &command, const Case &the_case)
      : input(live_input(command.live.input)),
        model(live_model(the_case, leading_model(the_case, command) == StandModelKind::six_mass))
  {
    const LiveOptions &options = command.live;
    replay_speed(options.speed);
    limit = own_limit(command, monitoring_of(command.target, command.sets));
    if (!options.keep.empty() && options.record.empty())
      throw InputError(
          "--keep sets how much of a recording is kept; name the folder of the recording with --record");
    if (!options.token_file.empty())
      token = web::token_of_file(options.token_file);
  }
};

LiveRun::LiveRun(const CommandLine &command, const Case &the_case)
    : LiveRun(command, the_case, Start(command, the_case))
{
}

LiveRun::LiveRun(const CommandLine &command, const Case &the_case, const Start &start)
    : command_(command), limit_(start.limit), sources_(start.input), engine_(start.model, hooks()),
      alarms_([this](const std::string &event, const std::string &json) { publish(event, json); }),
      console_(command.quiet, alarms_), comparison_(command, the_case, limit_, console_),
      page_(the_case, limit_, engine_, alarms_)
{
  const LiveOptions &options = command.live;
  if (start.model.dynamics.contact == ContactSprings::curve)
    console_.print("note: contacts on their curves are not followed here; the twin has their slopes\n");
  if (!options.record.empty())
    recording_.emplace(options, the_case.name, start.model.hash, console_,
                       [this] { return account_json(engine_); });
  if (!options.response.empty())
    response_.emplace(options.response, command.force_overwrite, start.input.kind == LiveInput::Kind::replay);
  resume(start.input.target);
  page_.open(command, start.token, console_);
  alarms_.show_all();
  sources_.open(command, start.token, engine_);
  console_.print(
      fmt::format("twin:   {} ({})\nsource: {}\n", the_case.name, engine_.model().source, sources_.description()));
  if (const auto warning = start.model.detailed ? std::nullopt : warning_of_six_masses(the_case, "live"))
    console::say("warning: " + text_of(*warning) + "\n");
  if (const std::string notice = sources_.notice(); !notice.empty())
    console::say("warning: " + notice + "\n");
  console::flush();
}

bool LiveRun::leaves_old_response() const
{
  return response_ && response_->leaves_old_file();
}

live::EngineHooks LiveRun::hooks()
{
  live::EngineHooks hooks;
  hooks.sources   = {[this](const live::LiveSource &source) { begin(source); }};
  hooks.observers = {[this](const live::LiveBlock &block) { take(block); }};
  hooks.rows      = [this](const std::int64_t first, const Eigen::MatrixXd &rows) {
    if (recording_)
      recording_->recorder().add(first, rows);
    report_arrival(sources_.arrived(first + rows.rows(), rows.rows(), engine_.source()->rate));
  };
  hooks.motion = [this](const std::int64_t first, const double step, const Eigen::MatrixXd &motion) {
    page_.motion(first, step, motion);
  };
  hooks.reported = [this](const std::string &kind, const std::string &text) { console_.say(kind, text); };
  hooks.adopt    = [this](const std::int64_t proposal) {
    auto model = comparison_.adopt(proposal);
    if (model)
      last_second_ = 0;  // stored at once, so that a kill does not undo it
    return model;
  };
  hooks.models = {[this](const live::TwinModel &model, const live::Tuning &tuning) {
    comparison_.changed_model(model, tuning);
    page_.twin_changed();
  }};
  hooks.others = [this](const live::PageCommand &command) { page_.apply(command); };
  hooks.now    = utc_now;
  return hooks;
}

void LiveRun::begin(const live::LiveSource &source)
{
  console_.begin(source);
  comparison_.begin(source, engine_.model(), engine_.tuning());
  if (comparison_.lost())
    alarms_.forget_comparison();
  page_.begin(source);
  if (recording_)
    recording_->recorder().begin(source);
  if (response_)
    response_->begin(source);
  sources_.begin(source, engine_.start_known());
}

void LiveRun::take(const live::LiveBlock &block)
{
  if (response_ && response_->problem().empty()) {
    response_->take(block);
    if (const std::string &problem = response_->problem(); !problem.empty())
      console_.say("response", problem);
  }
  page_.take(block);
  console_.take(block);
  live::ComparisonNews news = comparison_.take(block);
  console_.take(news);
  for (const live::PageAlarm &alarm : news.alarms)
    alarms_.show(alarm);
  news.alarms.clear();
  news.spectra.clear();  // the page shows one place, and also those without a sensor
  live::publish(news, [this](const std::string &event, const std::string &json) { publish(event, json); });
}

void LiveRun::publish(const std::string &event, const std::string &json)
{
  page_.publish(event, json);
  if (event == live::event_names::levels || event == live::event_names::alarm || event == live::event_names::modes)
    sources_.publish("{\"event\":\"" + event + "\",\"data\":" + json + "}");
}

int LiveRun::until_the_end()
{
  const CutSignal cut;
  live::LoopHooks loop;
  loop.stop = [&] { return cut.asked() != 0; };
  loop.tick = [this](const double now) { tick(now); };
  live::run_engine(engine_, sources_.queue(), page_.commands(), loop);
  sources_.rethrow();
  if (response_)
    response_->finish();
  if (recording_) {
    store_state();
    recording_->recorder().finish();
  }
  if (const std::string table = account_table(engine_); !table.empty())
    console_.print(table);
  return cut.asked() ? 128 + cut.asked() : 0;
}

void LiveRun::tick(const double now)
{
  if (engine_.book() && engine_.book()->begun())
    sources_.set_next(engine_.book()->next());
  if (recording_)
    recording_->recorder().tick(now);
  page_.tick(now);
  alarms_.publish_acknowledged();
  const bool has_state = has_state_ || sources_.next();
  if (now - last_second_ < 1 && has_state == has_state_)
    return;
  has_state_   = has_state;
  last_second_ = now;
  each_second();
}

// A wrong rate stays an alarm until it is right; a jump is reported once.
void LiveRun::report_arrival(const LiveSources::News &news)
{
  using Kind = live::ArrivalWatch::News::Kind;
  if (!news)
    return;
  if (news->kind == Kind::right_again)
    alarms_.end("rate");
  console_.say(news->kind == Kind::wrong_rate ? "rate" : news->kind == Kind::jump ? "clock" : "note", news->text);
}

void LiveRun::each_second()
{
  report_arrival(sources_.look());
  if (recording_ && engine_.source()) {
    recording_->recorder().save();  // what the state has seen is recorded
    store_state();
  }
  publish(live::event_names::account, live::account_text(page_account()));
  page_.set_metrics(metrics());
  alarms_.publish_changes();
}

live::PageAccount LiveRun::page_account()
{
  live::PageAccount account;
  account.utc        = utc_now();
  account.source     = sources_.description();
  const auto &source = engine_.source();
  if (source && !source->name.empty() && account.source.find(source->name) == std::string::npos)
    account.source += ", " + source->name;
  account.connected = source && sources_.connected();
  account.load      = load_.since_last_call(live::steady_now());
  account.queue     = source ? double(sources_.queue().samples()) / source->rate : 0;
  if (recording_) {
    account.recording = command_.live.record;
    account.recorded  = recording_->recorder().seconds();
    account.trouble   = recording_->recorder().trouble();
  }
  account.forgotten = page_.forgotten();
  account.channels  = account_rows(engine_);
  return account;
}

// OpenMetrics without its end, which the server adds.
std::string LiveRun::metrics()
{
  MetricsInput input;
  input.source        = engine_.source() ? &*engine_.source() : nullptr;
  input.book          = engine_.book();
  input.comparison    = comparison_.comparison();
  input.adopted       = engine_.model().adopted;
  input.limit         = limit_;
  input.refused_lines = engine_.refused_lines();
  input.queued        = sources_.queue().samples();
  input.states        = recording_ ? recording_->states() : 0;
  input.arrival_rate  = sources_.arrival_rate();
  input.own_alarms    = alarms_.open();
  return metrics_text(input);
}

void LiveRun::store_state()
{
  using Json       = nlohmann::json;
  Json state       = engine_.state();
  const auto until = recording_->recorder().next();
  Json run{{"recorded", until == no_number ? Json() : Json(until)}};
  alarms_.store(run);
  state["run"] = std::move(run);
  if (const live::Comparison *comparison = comparison_.comparison())
    state["comparison"] = comparison->state();
  recording_->store(state);
}

// The state that an earlier program of the same case left with its recording.
void LiveRun::resume(const std::string &file)
{
  if (!recording_ || command_.fresh)
    return;
  const auto stored = recording_->stored();
  recording_->resume(engine_, stored ? take_over(*stored) : 0, file);
}

// Number up to which rows are recorded; 0: not known.
std::int64_t LiveRun::take_over(const nlohmann::json &stored)
{
  // before the engine, which begins the source and with it the comparison
  if (const auto learned = stored.find("comparison"); learned != stored.end())
    comparison_.set_learned(std::make_unique<nlohmann::json>(*learned));
  if (const std::string message = engine_.resume(stored); !message.empty())
    console_.print(visible(message, false) + "\n");
  if (!engine_.source() && engine_.model().adopted.empty()) {
    comparison_.set_learned(nullptr);  // of another case, or of another version
    return 0;
  }
  std::int64_t until = 0;
  try {
    const live::StoredObject run = live::StoredObject(stored, "it").object("run");
    if (const double recorded =
            run.number_or_unknown("recorded", -double(live::largest_number), double(live::largest_number));
        recorded == recorded)
      until = std::int64_t(recorded);
    alarms_.resume(run);
    if (comparison_.lost() || !stored.contains("comparison"))
      alarms_.forget_comparison();
  } catch (const live::DamagedState &damage) {
    console_.print(visible(fmt::format("alarms of the stored state cannot be used: {}", damage.what()), true) +
                   "\n");
  }
  return until;
}
}  // namespace mill
