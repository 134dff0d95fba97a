#include "app/twin/live/live_comparison.h"
#include "app/twin/live/live_chatter.h"
#include "app/twin/live/live_clock.h"
#include "app/twin/live/live_detail.h"
#include "app/twin/live/live_input.h"
#include "app/twin/live/live_stand.h"
#include "app/twin/stand/detail_parts.h"
#include "app/twin/stand/record_options.h"
#include "core/base/visible_text.h"
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
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

LiveComparison::LiveComparison(const CommandLine &command, const Case &the_case, const std::optional<double> limit,
                               LiveConsole &console)
    : command_(command), the_case_(the_case), limit_(limit), console_(console)
{
}

LiveComparison::~LiveComparison() = default;

void LiveComparison::set_learned(std::unique_ptr<nlohmann::json> state)
{
  learned_ = std::move(state);
}

// At another force, with the sliders: their factors hold at every load.
LumpedModel LiveComparison::tuned_chain_at(const double load) const
{
  live::TwinModel tuned = model_;
  tuned.chain           = live::tuned_chain(model_, tuning_);
  return chain_at_load(the_case_, tuned, load);
}

live::ComparisonSetup LiveComparison::setup(const live::LiveSource &source) const
{
  live::ComparisonSetup setup;
  setup.rate     = source.rate;
  setup.channels = source.channels;
  setup.places   = source.places;
  setup.modes    = modes_at_load(the_case_, model_, tuning_);
  setup.chain    = live::tuned_chain(model_, tuning_);
  setup.dynamics = live::tuned_dynamics(model_, tuning_);
  setup.limit    = limit_;
  setup.unknowns = fitted_springs(model_);
  // a record that is played faster than real time waits for every result, so that it gives the same twice
  setup.wait     = std::isinf(replay_speed(command_.live.speed));
  setup.chain_at = [this](const double load) { return tuned_chain_at(load); };
  if (model_.detailed) {
    setup.mode_names = model_.detailed->mode_names;
    setup.detailed   = [this](const LumpedModel &chain) {
      return fitted_detail(model_, chain, live::tuned_dynamics(model_, tuning_).modal_damping);
    };
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
      console_.print("note: " + visible(note, true) + "\n");
    setup.chatter = std::move(chatter->setup);
  }
  setup.bands = watched_bands(monitoring_of(command_.target, command_.sets));
  return setup;
}

void LiveComparison::begin(const live::LiveSource &source, const live::TwinModel &model,
                           const live::Tuning &tuning)
{
  model_                     = model;
  tuning_                    = tuning;
  critical_of_               = model_.adopted;
  live::ComparisonSetup next = setup(source);
  if (comparison_)  // another source, or the same one again: of the same mill
    learned_ = std::make_unique<nlohmann::json>(comparison_->state());
  comparison_.emplace(std::move(next));
  if (const std::string note = assumed_errors_note(model_); !note.empty())
    console_.print("note: " + note + "\n");
  for (const std::string &note : comparison_->notes())
    console_.print("note: " + visible(note, true) + "\n");
  const std::string trouble = learned_ ? comparison_->resume(*learned_) : "";
  lost_                     = !trouble.empty();
  if (lost_)
    console_.print(visible(trouble, true) + "\n");
  learned_.reset();
}

live::ComparisonNews LiveComparison::take(const live::LiveBlock &block)
{
  return comparison_ ? comparison_->take(block) : live::ComparisonNews{};
}

void LiveComparison::changed_model(const live::TwinModel &model, const live::Tuning &tuning)
{
  model_  = model;
  tuning_ = tuning;
  if (!comparison_)
    return;
  comparison_->set_twin(live::tuned_chain(model, tuning), live::tuned_dynamics(model, tuning),
                        modes_at_load(the_case_, model, tuning));
  if (model.adopted == critical_of_)
    return;
  if (auto chatter = live_chatter(the_case_, model))
    comparison_->set_chatter(std::move(chatter->setup.model));
  critical_of_ = model.adopted;
}

std::optional<live::TwinModel> LiveComparison::adopt(const std::int64_t id)
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
    model_.source = (model_.detailed ? "model " + name_of_model(model_) : "six masses") + " of " + model_.adopted;
    return model_;
  } catch (const std::exception &error) {  // what cannot be written is not adopted
    console_.say("refused", error.what());
    return {};
  }
}
}  // namespace mill
