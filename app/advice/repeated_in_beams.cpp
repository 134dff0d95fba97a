#include "app/advice/repeated_in_beams.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace mill {
namespace {
using twin::Attachment;
using twin::RatedAction;
using twin::VibratingStand;

// The chock that carries a roll's damper, by its name in the model of beams.
int on_its_chock(const VibratingStand &beam, const std::string &roll)
{
  for (const char *side : {"upper", "lower"})
    for (const auto &[body, chock] : {
             std::pair{" work roll",   " work-roll chock"},
             {" backup roll", " backup chock"   }
    })
      if (roll == std::string(side) + body)
        return beam.place(std::string(side) + chock);
  return beam.place(roll);
}

// Only the places that are asked for: a stand of beams has many.
struct SeenBeam {
  VibratingStand stand;
  std::vector<Attachment> joined;
  int place = 0;
};

// A damper of the chain at its places in the beams, or at the chocks of those rolls.  None where a place is
// missing.
std::optional<SeenBeam> in_beams(const VibratingStand &beam, const VibratingStand &chain, const int place,
                                 const std::vector<Attachment> &joined, const bool on_chocks)
{
  SeenBeam seen{beam, {}, 0};
  std::vector<int> kept;
  const auto keep = [&](const int of_chain, const bool chock) {
    if (of_chain < 0)
      return -1;
    const std::string &name = chain.places[std::size_t(of_chain)];
    const int there         = chock ? on_its_chock(beam, name) : beam.place(name);
    kept.push_back(there);
    return int(kept.size()) - 1;
  };
  seen.place = keep(place, false);
  for (Attachment one : joined) {
    one.from = keep(one.from, on_chocks);
    one.to   = keep(one.to, on_chocks);
    seen.joined.push_back(one);
  }
  if (std::count(kept.begin(), kept.end(), -1) > 0)
    return std::nullopt;
  seen.stand.places.clear();
  seen.stand.point.resize(Eigen::Index(kept.size()), beam.point.cols());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    seen.stand.places.push_back(beam.places[std::size_t(kept[i])]);
    seen.stand.point.row(Eigen::Index(i)) = beam.point.row(kept[i]);
  }
  return seen;
}

// Level of the place with the same dampers; a tuned one keeps its mass and is tuned anew.
double level_in_beams(const SeenBeam &seen, const twin::ForceBand &force, const double level)
{
  std::vector<Attachment> joined;
  for (const Attachment &one : seen.joined)
    if (!(one.mass > 0))
      joined.push_back(one);
  for (const Attachment &one : seen.joined)
    if (one.mass > 0) {
      const int mode    = twin::leading_mode(seen.stand, seen.place, one.to, force);
      const double mass = twin::effective_mass(seen.stand, mode, one.to);
      const auto start  = twin::closed_tuning(seen.stand, mode, one.to, one.mass / mass);
      joined.push_back(twin::tune(seen.stand, joined, seen.place, start, force, level).best);
    }
  return twin::levels(seen.stand, joined, force)[seen.place];
}

void repeat_one(RatedAction &action, const AdvisedModel &model, const int place, const twin::ForceBand &force,
                const double level)
{
  const auto beam = action.springs.empty() ? model.beam : model.beam_with(action.springs);
  if (!beam || action.damping != 1)
    return;
  const auto repeat = [&](const char *name, const bool on_chocks) {
    if (const auto seen = in_beams(*beam, model.advised.stand, place, action.joined, on_chocks))
      action.repeated.push_back({name, level_in_beams(*seen, force, level) / level - 1, "1"});
  };
  if (action.joined.empty())
    repeat("beams", false);
  else {
    repeat("beams, dampers at mid-length", false);
    repeat("beams, dampers on the chocks", true);
  }
}

// What counts is the last of the other models, where dampers sit as they can.
void count_what_is_verified(RatedAction &action)
{
  if (action.repeated.empty())
    return;
  action.verified = action.repeated.back().value;
  if (action.verified * action.change < 0 && std::max(std::abs(action.verified), std::abs(action.change)) > 1e-3)
    action.remarks.push_back("six masses and beams do not agree whether it helps");
  judge_gain(action);
}

void mark_chain_only(RatedAction &action, const bool beams)
{
  if (beams && action.repeated.empty() && action.joined.empty())
    action.remarks.push_back("not repeated in the beams: its spring is several parts of the drawing");
  const auto says = std::find_if(action.remarks.begin(), action.remarks.end(),
                                 [](const std::string &r) { return r.find("chain only") == 0; });
  if (says == action.remarks.end())
    return;
  if (!action.repeated.empty())
    *says = "six masses have no chocks: what counts is the change in the model of beams, dampers on the chocks";
  else
    *says += beams ? "; its spring is one of several parts, so that it is not repeated in the beams"
                   : "; repeat it with the drawing of the stand (kind four-high) or with [model]";
}
}  // namespace

void repeat_in_beams(std::vector<RatedAction> &actions, const AdvisedModel &model, const int place,
                     const twin::ForceBand &force)
{
  if (!model.advised.chain)
    return;
  double level = 0;
  if (model.beam)
    if (const auto seen = in_beams(*model.beam, model.advised.stand, place, {}, false))
      level = twin::levels(seen->stand, {}, force)[seen->place];
  for (RatedAction &action : actions) {
    if (level > 0)
      repeat_one(action, model, place, force, level);
    count_what_is_verified(action);
    mark_chain_only(action, model.beam.has_value());
  }
  twin::rank(actions);
}
}  // namespace mill
