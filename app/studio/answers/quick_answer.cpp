#include "app/studio/answers/quick_answer.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stand/mode_results.h"
#include "app/trace/closed_form_speed.h"
#include "core/base/visible_text.h"
#include "core/model/four_high.h"
#include "core/records/named_mode.h"
#include "reduce/stand/stand_errors.h"
#include "report/results/names.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace mill::studio {
namespace {
using nlohmann::ordered_json;

void add_modes(QuickAnswer &answer, const ClosedFormStand &closed, const GapState state)
{
  if (state == GapState::rolling && !knows_strip(closed.model))
    return;
  const DynamicsSettings settings = in_state(closed.stand->dynamics, state);
  const ChainModes chain          = chain_modes(closed.model, settings);
  const auto named                = chain_with_modes(closed.model, settings);
  for (Eigen::Index i = 0; i < chain.modes.frequency.size(); ++i) {
    const auto &name = named.names.at(std::size_t(i));
    QuickMode mode{name.name, name.key, chain.modes.frequency[i], name.gap_share, state == GapState::open, {}};
    const Eigen::VectorXd shape = chain.modes.shape.col(i);
    Eigen::Index largest        = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    for (const double x : shape)
      mode.shape.push_back(x / shape[largest]);
    answer.modes.push_back(std::move(mode));
  }
  if (answer.moves.empty())
    for (const reduce::ModalSensitivity &input : reduce::modal_sensitivities(named, closed.model))
      for (Eigen::Index i = 0; i < named.modes.frequency.size(); ++i) {
        const auto &name = named.names[std::size_t(i)];
        if (!gap_kind_of(name.key))
          continue;
        const double w2 = std::pow(2 * M_PI * named.modes.frequency[i], 2);  // theory.md (22.9a), 24.5
        answer.moves.push_back({input.name, name.key, (input.dK(i, i) - w2 * input.dM(i, i)) / (2 * w2)});
      }
}

ordered_json number(const double value)
{
  return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

ordered_json speed_json(const SpeedVerdict &v)
{
  ordered_json out{{"pass", v.pass},
                   {"finding", id_of(v.finding)},
                   {"sentence", visible(sentence_of(v), true)},
                   {"speed", number(v.speed)},
                   {"critical", number(v.critical)},
                   {"low", number(v.low)},
                   {"high", number(v.high)},
                   {"frequency", number(v.frequency)},
                   {"mode", v.mode},
                   {"growth", number(v.growth)},
                   {"missing", v.missing},
                   {"inputs", ordered_json::array()}};
  for (const SpeedInput &input : v.inputs)
    out["inputs"].push_back({{"name", input.name}, {"error", input.error}, {"slope", number(input.slope)}});
  return out;
}
}  // namespace

QuickAnswer quick_answer(const Case &the_case, ClosedFormMemory &memory, const bool with_speeds)
{
  memory.with_responses = false;
  memory.with_inputs    = false;
  memory.stands.clear();
  QuickAnswer answer;
  answer.results = closed_form_chain(the_case, memory);
  if (!memory.stands.empty()) {
    add_modes(answer, memory.stands.front(), GapState::rolling);
    add_modes(answer, memory.stands.front(), GapState::open);
  }
  std::stable_sort(answer.moves.begin(), answer.moves.end(),
                   [](const QuickMove &a, const QuickMove &b) { return std::abs(a.slope) > std::abs(b.slope); });
  if (with_speeds)
    answer.speeds = closed_form_speeds(the_case, memory);
  return answer;
}

ordered_json quick_json(const QuickAnswer &answer)
{
  ordered_json out{{"results", ordered_json::array()},
                   {"modes", ordered_json::array()},
                   {"moves", ordered_json::array()},
                   {"speeds", ordered_json::array()}};
  for (const ClosedFormResult &r : answer.results)
    out["results"].push_back({{"name", r.name},
                              {"value", number(r.parameter.value)},
                              {"unit", r.parameter.unit},
                              {"method", r.parameter.method},
                              {"meaning", report::meaning_of(r.name)}});
  for (const QuickMode &mode : answer.modes)
    out["modes"].push_back({{"name", mode.name},
                            {"key", mode.key},
                            {"frequency", mode.frequency},
                            {"gap_share", number(mode.gap_share)},
                            {"open", mode.open},
                            {"shape", mode.shape}});
  for (const QuickMove &move : answer.moves)
    out["moves"].push_back({{"input", move.input}, {"mode", move.mode}, {"slope", move.slope}});
  for (const SpeedVerdict &v : answer.speeds)
    out["speeds"].push_back(speed_json(v));
  return out;
}
}  // namespace mill::studio
