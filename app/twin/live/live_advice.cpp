#include "app/twin/live/live_advice.h"
#include "core/base/errors.h"
#include "twin/advice/advice.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double up_to             = 1000;  // Hz, of the force
constexpr double noticed           = 1e-3;  // -, change of a level
constexpr std::size_t most_helping = 8, most_refused = 4;

live::AdviceRow row_of(const twin::RatedAction &action)
{
  live::AdviceRow row{action.name, action.change, action.first_order, action.means, {}, "chain only", {}};
  for (const twin::SideEffect &effect : action.effects)
    if (std::abs(effect.value) > noticed)
      row.side_effects +=
          fmt::format("{}{} {:+.1f} %", row.side_effects.empty() ? "" : "; ", effect.name, 100 * effect.value);
  for (const std::string &sentence : action.against)
    row.against += (row.against.empty() ? "" : "; ") + sentence;
  return row;
}

// Those that help, then what violates a limit although it would help.
void add_rows(live::PageAdvice &advice, const std::vector<twin::RatedAction> &actions)
{
  const std::size_t helping = twin::above_the_line(actions);
  std::size_t refused       = 0;
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (i < std::min(helping, most_helping) ||
        (i >= helping && actions[i].change < -noticed && refused++ < most_refused))
      advice.rows.push_back(row_of(actions[i]));
}
}  // namespace

namespace {
// The six masses behind a detailed stand, with its springs as they now are: bearings are in series with the roll.
std::optional<dynamics::MillModel> six_masses_of(const live::TwinModel &model, const live::Tuning &tuning)
{
  if (!model.detailed)
    return live::tuned(model, tuning);
  if (!model.six_masses)
    return {};
  LumpedModel chain       = *model.six_masses;
  const LumpedModel there = live::tuned_chain(model, tuning);
  for (std::size_t j = 0; j < chain.K.size(); ++j)
    if (model.detailed->stiffness[j] > 0 && chain.K[j].value > 0)
      chain.K[j].value = 1 / (1 / chain.K[j].value - 1 / model.detailed->stiffness[j] + 1 / there.K[j].value);
  return dynamics::mill_model(chain, live::tuned_dynamics(model, tuning));
}
}  // namespace

live::PageAdvice live_advice(const live::TwinModel &model, const live::Tuning &tuning, const std::string &place,
                             const double utc)
{
  live::PageAdvice advice;
  advice.utc = utc;
  try {
    const auto six_masses = six_masses_of(model, tuning);
    if (!six_masses) {
      advice.state = "failed";
      advice.text  = "advice while the mill runs is by six masses, which a case of matrices does not have; "
                     "millstand advise CASE of the drawing";
      return advice;
    }
    const dynamics::MillModel &chain = *six_masses;
    const Eigen::VectorXd damping =
        Eigen::VectorXd::Constant(chain.M.size(), live::tuned_dynamics(model, tuning).modal_damping);
    twin::LevelQuestion question = twin::usual_question({twin::vibrating_stand(chain, damping), chain}, 0, up_to);
    const auto places            = live::places_of(live::stepped_stand(chain));
    const auto found             = std::find(places.begin(), places.end(), place);
    if (found != places.end())
      question.place = int(found - places.begin());
    for (std::size_t j = 0; j < model.chain.K.size(); ++j)
      if (std::isfinite(model.chain.K[j].error_estimate))
        question.spring_error["K" + std::to_string(j + 1)] = model.chain.K[j].error_estimate;
    add_rows(advice, twin::ranked_actions(chain, damping, question).actions);
    advice.goal = fmt::format("rms of the {} under a white force to {:g} Hz",
                              chain.labels[std::size_t(question.place)], up_to);
    advice.text =
        "changes, no levels, since the force is taken as white; by six masses, which overrate dampers on "
        "chocks: millstand advise CASE repeats them in a detailed model; nothing is sent to the mill";
  } catch (const InputError &error) {
    advice.state = "failed";
    advice.text  = error.problems.front().message;
  } catch (const SolverError &error) {
    advice.state = "failed";
    advice.text  = error.what();
  }
  return advice;
}
}  // namespace mill
