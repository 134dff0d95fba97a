#include "app/twin/live/live_run.h"
#include "app/process/console.h"
#include "app/twin/live/live_chatter.h"
#include "app/twin/live/live_detail.h"
#include "app/twin/live/live_stand.h"
#include "app/twin/stand/detail_parts.h"
#include "app/twin/stand/record_options.h"
#include "app/verbs/leading_model.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include "twin/live/engine/engine_loop.h"
#include "twin/live/steady_clock.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
namespace {
live::ClockReading clock_now()
{
  return {live::steady_now(), utc_now()};
}

bool six_masses(const CommandLine &command, const Case &the_case)
{
  return leading_model(the_case, command) == StandModelKind::six_mass;
}
}  // namespace

LiveRun::LiveRun(const CommandLine &command, const Case &the_case)
    : command_(command), the_case_(the_case), input_(live_input(command.live.input)),
      model_(live_model(the_case, six_masses(command, the_case)))
{
  const LiveOptions &options = command.live;
  replay_speed(options.speed);
  limit_ = own_limit(command, monitoring_of(command.target, command.sets));
  if (input_.kind != LiveInput::Kind::replay)
    arrival_.emplace();
  if (!options.keep.empty() && options.record.empty())
    throw InputError(
        "--keep sets how much of a recording is kept; name the folder of the recording with --record");
  if (!options.token_file.empty())
    token_ = web::token_of_file(options.token_file);
  engine_ = std::make_unique<live::Engine>(model_, hooks());
  if (model_.dynamics.contact == ContactSprings::curve)
    print("note: contacts on their curves are not followed here; the twin has their slopes\n");
  open_folder();
  if (!options.response.empty())
    response_.emplace(options.response, command.force_overwrite, input_.kind == LiveInput::Kind::replay);
  resume();
  open_page();
  sources_ = std::make_unique<LiveSources>(input_, options, rules(), skip_to_, queue_);
  print(fmt::format("twin:   {} ({})\nsource: {}\n", the_case.name, model_.source, sources_->description()));
  if (const auto warning = model_.detailed ? std::nullopt : warning_of_six_masses(the_case, "live"))
    console::say("warning: " + text_of(*warning) + "\n");
  if (const std::string notice = sources_->notice(); !notice.empty())
    console::say("warning: " + notice + "\n");
  console::flush();
}

bool LiveRun::leaves_old_response() const
{
  return response_ && response_->leaves_old_file();
}

LiveRun::~LiveRun()
{
  sources_.reset();   // the readers stop before what they give to
  recorder_.reset();  // finishes its file while the account is there
  background_.reset();
  page_.reset();
}

void LiveRun::open_folder()
{
  const std::string &folder = command_.live.record;
  if (folder.empty())
    return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    refuse_file(error.value(), "the folder " + folder + " cannot be made" + (error ? ": " + error.message() : "") +
                                   "; choose another with --record");
  record_lock_.emplace(folder);
  state_.emplace(folder);
  finished_ = live::finish_parts(folder, [&](const std::string &text) { print(text + "\n"); });
  live::RecorderSettings settings;
  settings.folder    = folder;
  settings.case_name = the_case_.name;
  settings.case_hash = model_.hash;
  if (!command_.live.keep.empty())
    settings.kept = live::kept_records(command_.live.keep);
  recorder_.emplace(
      settings, *background_, [this](const std::string &kind, const std::string &text) { say(kind, text); },
      [this] { return account_json(); });
}

live::SourceRules LiveRun::rules() const
{
  live::SourceRules rules;
  rules.places  = live::places_of(live::stepped(model_, {}));
  rules.reading = read_options(command_, monitoring_of(command_.target, command_.sets));
  rules.token   = input_.kind == LiveInput::Kind::tcp ? token_ : "";
  rules.next    = [this]() -> std::optional<std::int64_t> {
    const std::int64_t next = next_;
    return next < 0 ? std::nullopt : std::optional(next);
  };
  if (input_.kind == LiveInput::Kind::mqtt)
    rules.assumed = assumed_;
  return rules;
}

live::EngineHooks LiveRun::hooks()
{
  live::EngineHooks hooks;
  hooks.sources.push_back([this](const live::LiveSource &source) {
    lines_.begin(source);
    feed_.begin(source);
    spectrum_.begin(source);
    place_ = spectrum_.place();
    begin_comparison(source);
    show_source(source);
    if (engine_)
      publish_parameters();
    if (recorder_)
      recorder_->begin(source);
    if (response_)
      response_->begin(source);
    if (arrival_)
      arrival_->begin(source.rate);
  });
  hooks.rows = [this](const std::int64_t first, const Eigen::MatrixXd &rows) {
    if (recorder_)
      recorder_->add(first, rows);
    if (arrival_)
      tell_arrival(arrival_->arrived(first + rows.rows(), rows.rows(), clock_now(),
                                     double(queue_.samples()) / engine_->source()->rate));
  };
  hooks.observers.push_back([this](const live::LiveBlock &block) {
    if (response_)
      response_->take(block);
    if (page_) {
      feed_.take(block);
      if (const auto spectrum = spectrum_.take(block, live::steady_now()))
        publish(live::event_names::spectrum, live::spectrum_text(*spectrum));
    }
    if (const std::string line = lines_.take(block); !line.empty())
      print(line);
    if (comparison_) {
      live::ComparisonNews news = comparison_->take(block);
      for (const live::PageAlarm &alarm : news.alarms) {
        if (!alarm.over && printed_[alarm.id] != alarm.level)
          print(fmt::format("{}: {}\n", alarm.level, visible(alarm.text, true)));
        if (alarm.over)
          printed_.erase(alarm.id);
        else
          printed_[alarm.id] = alarm.level;
        show_alarm(alarm);
      }
      news.alarms.clear();
      news.spectra.clear();  // the page shows one place, and also those without a sensor
      for (const live::PageProposal &proposal : news.proposals)
        print(fmt::format("proposal {} ({}): {}\n", proposal.id, proposal.state, visible(proposal.text, true)));
      live::publish(news, [this](const std::string &event, const std::string &json) { publish(event, json); });
    }
  });
  hooks.motion = [this](const std::int64_t first, const double step, const Eigen::MatrixXd &motion) {
    if (page_)
      publish(live::event_names::motion, live::motion_text(feed_.motion(first, step, motion)));
  };
  hooks.said   = [this](const std::string &kind, const std::string &text) { say(kind, text); };
  hooks.adopt  = [this](const std::int64_t proposal) { return adopt(proposal); };
  hooks.models = {
      [this](const live::TwinModel &model, const live::Tuning &tuning) { changed_model(model, tuning); }};
  hooks.others = [this](const live::PageCommand &command) {
    if (command.kind == live::PageCommandKind::advice)
      return begin_advice();
    if (command.kind == live::PageCommandKind::place) {
      spectrum_.choose(command.place);
      place_ = spectrum_.place();
    }
    publish_parameters();
  };
  hooks.now = utc_now;
  return hooks;
}

namespace {
// Springs that a re-calibration may move; K4 is not one of them where the force is measured.
std::vector<twin::Unknown> fitted_springs(const live::TwinModel &model)
{
  if (model.detailed)
    return live::unknowns_of(model.chain);
  const auto springs = live::tuned(model, {}).springs;
  std::vector<twin::Unknown> fitted;
  for (twin::Unknown &unknown : live::unknowns_of(model.chain))
    if (std::none_of(springs.begin(), springs.end(), [&](const dynamics::Spring &spring) {
          return spring.name == unknown.name && spring.stiffness == 0;
        }))
      fitted.push_back(std::move(unknown));
  return fitted;
}
}  // namespace

void LiveRun::begin_comparison(const live::LiveSource &source)
{
  model_       = engine_->model();
  critical_of_ = model_.adopted;
  live::ComparisonSetup setup;
  setup.rate     = source.rate;
  setup.channels = source.channels;
  setup.places   = source.places;
  setup.modes    = modes_at_load(the_case_, model_, engine_->tuning());
  setup.chain    = live::tuned_chain(model_, engine_->tuning());
  setup.dynamics = live::tuned_dynamics(model_, engine_->tuning());
  setup.limit    = limit_;
  setup.unknowns = fitted_springs(model_);
  // a record that is played faster than real time waits for every result, so that it gives the same twice
  setup.wait     = std::isinf(replay_speed(command_.live.speed));
  setup.chain_at = [this](const double load) { return chain_at_load(the_case_, model_, load); };
  if (model_.detailed) {
    setup.mode_names   = model_.detailed->mode_names;
    setup.detailed     = [this](const LumpedModel &chain) { return fitted_detail(model_, chain); };
    setup.adopted_case = [this](const live::Proposal &proposal, const std::string &folder) {
      return adopted_detail(model_, proposal, the_case_, folder);
    };
  }
  if (auto chatter = live_chatter(the_case_, model_)) {
    const auto is_speed = [](const live::LiveChannel &c) {
      const auto known = choice_named<twin::KnownChannel>(c.name);
      return known == twin::KnownChannel::speed || known == twin::KnownChannel::exit_speed;
    };
    const bool used = std::any_of(source.channels.begin(), source.channels.end(), is_speed);
    for (const std::string &note : used ? chatter->notes : std::vector<std::string>{})
      print("note: " + visible(note, true) + "\n");
    setup.chatter = std::move(chatter->setup);
  }
  setup.bands = watched_bands(monitoring_of(command_.target, command_.sets));
  if (comparison_)  // another source, or the same one again: of the same mill
    learned_ = std::make_unique<nlohmann::json>(comparison_->state());
  comparison_.emplace(std::move(setup));
  if (const std::string note = assumed_errors_note(model_); !note.empty())
    print("note: " + note + "\n");
  for (const std::string &note : comparison_->notes())
    print("note: " + visible(note, true) + "\n");
  if (learned_)
    if (const std::string trouble = comparison_->resume(*learned_); !trouble.empty())
      print(visible(trouble, true) + "\n");
  learned_.reset();
}

std::optional<live::TwinModel> LiveRun::adopt(const std::int64_t id)
{
  if (!comparison_)
    return {};
  const std::string folder = command_.live.record.empty() ? "." : command_.live.record;
  try {
    const auto proposal = comparison_->adopt(id, utc_now(), folder, the_case_);
    if (!proposal)
      return {};
    model_.chain                  = proposal->chain;
    model_.dynamics.modal_damping = proposal->damping;
    model_.adopted                = fs::path(proposal->file).filename().string();
    origin_                       = model_.adopted;
    model_.source = (model_.detailed ? "model " + name_of_model(model_) : "six masses") + " of " + model_.adopted;
    last_second_  = 0;  // stored at once, so that a kill does not undo it
    return model_;
  } catch (const std::exception &error) {  // what cannot be written is not adopted
    say("refused", error.what());
    return {};
  }
}

void LiveRun::changed_model(const live::TwinModel &model, const live::Tuning &tuning)
{
  if (comparison_)
    comparison_->set_twin(live::tuned_chain(model, tuning), live::tuned_dynamics(model, tuning),
                          modes_at_load(the_case_, model, tuning));
  if (comparison_ && model.adopted != critical_of_) {
    if (auto chatter = live_chatter(the_case_, model))
      comparison_->set_chatter(std::move(chatter->setup.model));
    critical_of_ = model.adopted;
  }
  spectrum_.twin_changed();
  publish_parameters();
}

void LiveRun::publish_parameters()
{
  publish(live::event_names::parameters,
          live::parameters_text(page_parameters(engine_->model(), engine_->tuning(), origin_, place_)));
}

int LiveRun::until_the_end()
{
  const CutSignal cut;
  live::LoopHooks loop;
  loop.stop = [&] { return cut.asked() != 0; };
  loop.tick = [this](const double now) { tick(now); };
  live::run_engine(*engine_, queue_, commands_, loop);
  sources_->rethrow();
  if (response_)
    response_->finish();
  if (state_)
    store_state();
  if (recorder_)
    recorder_->finish();
  summary();
  return cut.asked() ? 128 + cut.asked() : 0;
}

void LiveRun::tick(const double now)
{
  if (engine_->book() && engine_->book()->begun())
    next_ = engine_->book()->next();
  if (recorder_)
    recorder_->tick(now);
  if (page_)
    if (const auto numbers = feed_.numbers(now))
      publish(live::event_names::numbers, live::numbers_text(*numbers));
  if (const auto advice = advice_.finished())
    publish(live::event_names::advice, live::advice_text(*advice));
  const bool first_state = !has_state_ && next_ >= 0;
  if (now - last_second_ < 1 && !first_state)
    return;
  has_state_   = has_state_ || next_ >= 0;
  last_second_ = now;
  each_second();
}

// A wrong rate stays an alarm until it is right; a jump is reported once.
void LiveRun::tell_arrival(const std::optional<live::ArrivalWatch::News> &news)
{
  using Kind = live::ArrivalWatch::News::Kind;
  if (!news)
    return;
  if (news->kind == Kind::right_again) {
    const std::lock_guard lock(alarm_lock_);
    alarms_.end("rate");
  }
  say(news->kind == Kind::wrong_rate ? "rate" : news->kind == Kind::jump ? "clock" : "note", news->text);
}

void LiveRun::each_second()
{
  if (arrival_)
    tell_arrival(arrival_->look(clock_now()));
  if (state_ && engine_->source()) {
    recorder_->tick(std::numeric_limits<double>::infinity());  // what the state has seen is recorded
    store_state();
  }
  publish(live::event_names::account, live::account_text(page_account()));
  {
    const std::lock_guard lock(metrics_lock_);
    metrics_text_ = metrics();
  }
  std::vector<live::PageAlarm> news;
  {
    const std::lock_guard lock(alarm_lock_);
    news = alarms_.news();
  }
  for (const live::PageAlarm &alarm : news)
    show_alarm(alarm);
}
}  // namespace mill
