#include "app/twin/advice/repeated_in_detail.h"
#include "app/twin/advice/asked_choices.h"
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace mill {
namespace {
using twin::Attachment;
using twin::RatedAction;
using twin::VibratingStand;

// The detailed stand at the places of the chain: the rolls at mid-length and their chocks, since it has many more.
class SeenStand {
public:
  SeenStand(const DetailedStand &detailed, const VibratingStand &chain) : detailed_(detailed)
  {
    for (const std::string &name : chain.places) {
      rolls_.push_back(keep(detailed.as_it_is.place(name)));
      chocks_.push_back(keep(on_its_chock(detailed.as_it_is, name)));
    }
  }
  std::optional<VibratingStand> after(const twin::StandChange &change, const bool with_bite) const
  {
    const bool none = change.springs.empty() && change.damping == 1 && change.force == 1 && with_bite;
    auto stand      = none ? detailed_.as_it_is : detailed_.after(change, with_bite);
    if (!stand)
      return stand;
    VibratingStand seen = std::move(*stand);
    const auto all      = seen;
    seen.places.clear();
    seen.point.resize(Eigen::Index(kept_.size()), all.point.cols());
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      seen.places.push_back(all.places[std::size_t(kept_[i])]);
      seen.point.row(Eigen::Index(i)) = all.point.row(kept_[i]);
    }
    return seen;
  }
  /// Of a place of the chain; -1: the detailed stand has no such place.
  int place(const int of_chain, const bool on_chock) const
  {
    return (on_chock ? chocks_ : rolls_)[std::size_t(of_chain)];
  }
  /// Dampers of the chain; none where a place is missing.
  std::optional<std::vector<Attachment>> joined(std::vector<Attachment> dampers, const bool on_chocks) const
  {
    for (Attachment &one : dampers)
      for (int *end : {&one.from, &one.to})
        if (*end >= 0 && (*end = place(*end, on_chocks)) < 0)
          return std::nullopt;
    return dampers;
  }

private:
  const DetailedStand &detailed_;
  std::vector<int> kept_, rolls_, chocks_;

  int keep(const int place)
  {
    if (place < 0)
      return -1;
    kept_.push_back(place);
    return int(kept_.size()) - 1;
  }
};

// Dampers as they are; tuned ones with their mass, tuned again.
std::vector<Attachment> tuned_again(const VibratingStand &stand, const std::vector<Attachment> &joined,
                                    const int place, const twin::ForceBand &force, const double level)
{
  std::vector<Attachment> tuned;
  for (const Attachment &one : joined)
    if (!(one.mass > 0))
      tuned.push_back(one);
  for (const Attachment &one : joined)
    if (one.mass > 0) {
      const int mode    = twin::leading_mode(stand, place, one.to, force);
      const double mass = twin::effective_mass(stand, mode, one.to);
      const auto start  = twin::closed_tuning(stand, mode, one.to, one.mass / mass);
      tuned.push_back(twin::tune(stand, tuned, place, start, force, level).best);
    }
  return tuned;
}

class Repeater {
public:
  /// @returns nothing where the detailed stand has not the place
  static std::optional<Repeater> of(const AdvisedModel &model, const int place, const twin::ForceBand &force)
  {
    if (!model.detailed)
      return std::nullopt;
    Repeater repeater(model, place, force);
    return repeater.place_ < 0 ? std::nullopt : std::optional<Repeater>(std::move(repeater));
  }

  std::optional<twin::CriticalState> now() const
  {
    return rolled_ ? std::optional(rolled_->now()) : std::nullopt;
  }

  void repeat(RatedAction &action) const
  {
    if (!action.process.empty() && !(rolled_ && rolled_->settled())) {
      action.against.push_back(grows());
      return;
    }
    const auto stand = seen_->after(action.of_stand, true);
    if (!stand)
      return;
    if (action.joined.empty())
      repeat(action, *stand, "", false);
    else {
      repeat(action, *stand, ", dampers at mid-length", false);
      repeat(action, *stand, ", dampers on the chocks", true);
    }
    judge_nearer(action, nearer_chatter_);
  }

private:
  std::shared_ptr<const SeenStand> seen_;
  std::shared_ptr<const twin::RolledLevel> rolled_;
  const twin::ForceBand *force_;
  std::string name_;
  int place_             = -1;
  double level_          = 0;
  double nearer_chatter_ = 0;

  Repeater(const AdvisedModel &model, const int place, const twin::ForceBand &force)
      : seen_(std::make_shared<SeenStand>(*model.detailed, model.advised.stand)), force_(&force),
        name_(model.detailed->name), place_(seen_->place(place, false))
  {
    if (place_ < 0)
      return;
    level_ = twin::levels(*seen_->after({}, true), {}, force)[place_];
    if (!model.pass)
      return;
    nearer_chatter_ = model.pass->nearer_chatter;
    rolled_         = std::make_shared<twin::RolledLevel>(
        *model.pass, [seen = seen_](const twin::StandChange &change) { return seen->after(change, false); },
        force);
    if (rolled_->now().no_bite)
      rolled_.reset();
  }

  std::string grows() const
  {
    return "vibration grows at the working speed in the model of " + name_;
  }

  void repeat(RatedAction &action, const VibratingStand &stand, const char *where, const bool on_chocks) const
  {
    const auto there = seen_->joined(action.joined, on_chocks);
    if (!there)
      return;
    const auto joined = tuned_again(stand, *there, place_, *force_, level_);
    // What counts is the last: the critical speed is searched for that alone.
    const bool counts = action.joined.empty() || on_chocks;
    const auto rolled = rolled_ && (counts || !action.process.empty())
                            ? rolled_->after(action.of_stand, joined, action.process)
                            : std::nullopt;
    if (rolled && counts)
      action.nearer = rolled->nearer;
    const double level = action.process.empty()               ? twin::levels(stand, joined, *force_)[place_]
                         : rolled && rolled->level.size() > 0 ? rolled->level[place_]
                                                              : not_given;
    if (counts && std::isnan(level))
      action.against.push_back(grows());
    const double now = action.process.empty() ? level_ : rolled_->level()[place_];
    action.repeated.push_back({name_ + where, level / now - 1, "1"});
  }
};

// What counts is the last of the other models, where dampers sit as they can.
void count_what_is_verified(RatedAction &action)
{
  if (action.repeated.empty())
    return;
  action.verified = action.repeated.back().value;
  if (action.verified * action.change < 0 && std::max(std::abs(action.verified), std::abs(action.change)) > 1e-3)
    action.remarks.push_back("six masses and the detailed model do not agree whether it helps");
  judge_gain(action);
}

void mark_chain_only(RatedAction &action, const std::string &detailed)
{
  if (!detailed.empty() && action.repeated.empty() && action.joined.empty())
    action.remarks.push_back(action.of_stand.springs.empty() ? "not repeated in the " + detailed
                                                             : "not repeated in the " + detailed +
                                                                   ": its spring is several parts of the drawing");
  if (!action.chain_only)
    return;
  std::string &remark = action.remarks[*action.chain_only];
  if (!action.repeated.empty())
    remark = "six masses have no chocks: the decisive change is that in the model of " + detailed +
             ", dampers on the chocks";
  else
    remark += detailed.empty()
                  ? "; repeat it with the drawing of the stand (kind four-high) or with [model]"
                  : "; its spring is one of several parts, so that it is not repeated in the " + detailed;
}
}  // namespace

std::optional<twin::CriticalState> repeat_in_detail(std::vector<RatedAction> &actions, const AdvisedModel &model,
                                                    const int place, const twin::ForceBand &force)
{
  if (!model.advised.chain)
    return {};
  const auto repeater = Repeater::of(model, place, force);
  for (RatedAction &action : actions) {
    if (repeater)
      repeater->repeat(action);
    count_what_is_verified(action);
    mark_chain_only(action, model.detailed ? model.detailed->name : "");
  }
  twin::rank(actions);
  return repeater ? repeater->now() : std::nullopt;
}
}  // namespace mill
