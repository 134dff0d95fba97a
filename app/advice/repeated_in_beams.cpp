#include "app/advice/repeated_in_beams.h"
#include <algorithm>
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

// The same dampers in the beams; a tuned one keeps its mass and is tuned anew.
double change_in_beams(SeenBeam seen, const twin::ForceBand &force)
{
  const double level = twin::levels(seen.stand, {}, force)[seen.place];
  std::vector<Attachment> joined;
  for (const Attachment &one : seen.joined)
    if (!(one.mass > 0))
      joined.push_back(one);
  for (const Attachment &one : seen.joined)
    if (one.mass > 0) {
      const int mode    = twin::leading_mode(seen.stand, seen.place, one.to, force);
      const double mass = twin::effective_mass(seen.stand, mode, one.to);
      joined.push_back(twin::tune(seen.stand, joined, seen.place,
                                  twin::closed_tuning(seen.stand, mode, one.to, one.mass / mass), force, level)
                           .best);
    }
  return twin::levels(seen.stand, joined, force)[seen.place] / level - 1;
}

}  // namespace

void repeat_in_beams(std::vector<RatedAction> &actions, const AdvisedModel &model, const int place,
                     const twin::ForceBand &force)
{
  const std::string chain_only = "chain only";
  for (RatedAction &action : actions) {
    if (action.joined.empty() || !model.advised.chain)
      continue;
    const bool springs = (action.stand.frequency - model.advised.stand.frequency).cwiseAbs().maxCoeff() > 0;
    if (model.beam && !springs)
      for (const bool on_chocks : {false, true})
        if (const auto seen = in_beams(*model.beam, model.advised.stand, place, action.joined, on_chocks))
          action.repeated.push_back({on_chocks ? "beams, damper on the chocks" : "beams, damper at mid-length",
                                     change_in_beams(*seen, force), "1"});
    const auto says = std::find_if(action.remarks.begin(), action.remarks.end(),
                                   [&](const std::string &r) { return r.find(chain_only) == 0; });
    if (says == action.remarks.end())
      continue;
    if (!action.repeated.empty())
      *says = "six masses have no chocks: the change in the model of beams stands beside it";
    else
      *says += springs && model.beam
                   ? "; with a changed spring it is not repeated in the beams"
                   : "; repeat it with the drawing of the stand (kind four-high) or with [model]";
  }
}
}  // namespace mill
