#include "app/review/estimate_review.h"
#include "app/review/closed_form_modes.h"
#include "app/run/run_context.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/units.h"
#include "core/case/estimates.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/rows_of_contact.h"
#include "core/records/rows_of_response.h"
#include "core/records/rows_of_stand.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace mill {
namespace {
constexpr double no_move = 1e-5;  // relative; smaller changes are not reported

bool is_mode(const ResultId &id)
{
  return id.is_of(row::modes::vertical) && id.place("open").empty();
}

// Springs, masses, bearings, modes and mill modulus of the first pass, not those of a later one.
bool is_ranked(const ResultId &id)
{
  return is_mode(id) || id.is_of(row::modes::horizontal) ||
         ((id.is_of(row::chain::all) || id.is_of(row::stand::modulus_kiss) ||
           id.is_of(row::stand::modulus_tangent)) &&
          id.place("pass").empty());
}

// Springs of the chain and their bearings.
constexpr const ResultRow *spring_rows[]{&row::chain::K1,         &row::chain::K2,   &row::chain::K3,
                                         &row::chain::K4,         &row::chain::K5,   &row::chain::K6,
                                         &row::chain::K7,         &row::chain::K_ZW, &row::chain::K_Zy,
                                         &row::chain::K_Zy_lower, &row::chain::Kzc,  &row::chain::Kzc_across};

// Results of other models and of responses that follow the frequencies of the chain.
constexpr const ResultRow *rows_of_modes[]{&row::modes::of_model,           &row::modes::of_housing,
                                           &row::modes::frequency,          &row::response::frf_frequency,
                                           &row::nonlinear::bend,           &row::chatter::frequency,
                                           &row::chatter::variant_frequency};

// The spring of the closed forms that a result of finite elements is of, "K3" of "K3.tangent"; "": of none.
std::string closed_form_of(const ResultId &id)
{
  if (id.is_of(row::roll_contact::all) && id.place("pass").empty())
    return id.place("roll_contact");
  if (id.is_of(row::bearing::all))
    return id.place("bearing_spring");
  return id.is_of(row::bite_spring::all) ? word_of(ChainNumber::K4) : "";
}

// The largest move of the results that is_meant(id) names.
template <class Which> double largest_move(const EstimateRecord &record, const Which &is_meant)
{
  double most = 0;
  for (const auto &[name, move] : record.moves)
    if (const auto id = result_id(name); id && is_meant(*id))
      most = std::max(most, move);
  return most;
}

// What one estimate moves, with the largest moves that many results share.
struct EstimateEffect {
  const EstimateRecord &record;
  double of_modes, of_springs;
  explicit EstimateEffect(const EstimateRecord &r)
      : record(r), of_modes(largest_move(r, is_mode)),
        of_springs(largest_move(r, [](const ResultId &id) { return id.is_of(spring_rows); }))
  {
  }
  double of(const std::string &result) const
  {
    const auto move = std::find_if(record.moves.begin(), record.moves.end(),
                                   [&](const auto &one) { return one.first == result; });
    return move == record.moves.end() ? 0 : move->second;
  }
};

std::string quantity_of(const Estimate &e, const double value)
{
  return fmt::format("{:.4g}", from_si(value, unit(e.unit)));
}

std::string sentence(const EstimateRecord &record)
{
  const Estimate &e = record.estimate;
  const double most = largest_move(record, is_mode);
  std::string moved;
  for (const auto &[name, move] : record.moves)
    if (const auto id = result_id(name); id && is_mode(*id) && move == most && move > no_move && moved.empty())
      moved = fmt::format("; its interval moves {} by {:.2g} %", name, 100 * move);
  return fmt::format("{} is estimated: {} {} ({} .. {}), {}{}", e.key, quantity_of(e, e.value), e.unit,
                     quantity_of(e, e.low), quantity_of(e, e.high), e.rule, moved);
}

double load_of_first(const FourHigh &stand)
{
  const Pass &pass = stand.passes.front();
  return std::isnan(pass.load) ? force_of(pass).force.mean() : pass.load;
}

bool is_of_frame(const Estimate &e)
{
  return e.key.rfind("frame.", 0) == 0;
}

// What one estimate moves in a result: by the closed form of that name, "K3" of "K3.tangent"; of modes of other
// models the most it moves any mode of the chain, of other moduli the most it moves any spring.  NaN: no closed
// form says it.
double move_of(const EstimateEffect &effect, const ResultId &id, const std::string &name,
               const std::set<std::string> &known)
{
  if (is_ranked(id) && known.count(name))
    return effect.of(name);
  if (id.is_of(rows_of_modes) || (id.is_of(row::modes::vertical) && !is_mode(id)))
    return effect.of_modes;
  if (id.is_of(row::stand::all))
    return effect.of_springs;
  const std::string closed = closed_form_of(id);
  return known.count(closed) ? effect.of(closed) : not_given;
}

// What all estimates of the rolls may move together: those of one source add up, different ones by squares.
double moved_by_rolls(const std::vector<EstimateEffect> &effects, const std::string &name, const KeyList &keys,
                      const std::set<std::string> &known)
{
  const auto id = result_id(name);
  std::map<std::string, double> by_source;
  for (const EstimateEffect &effect : effects)
    if (const Estimate &e = effect.record.estimate; !is_of_frame(e) && holds(keys, e.key))
      by_source[e.source.empty() ? e.key : e.source] += id ? move_of(effect, *id, name, known) : not_given;
  double squares = 0;
  for (const auto &entry : by_source)
    squares += entry.second * entry.second;
  return std::sqrt(squares);
}

// An estimated stiffness of the frame as the run has it, on the measured modulus.
void close_records(std::vector<EstimateRecord> &records, const Results &results)
{
  for (EstimateRecord &record : records)
    if (const Parameter *closed = results.find(record.estimate.key); closed && is_of_frame(record.estimate)) {
      Estimate &e         = record.estimate;
      const double factor = closed->value / e.value;
      for (double *value : {&e.value, &e.low, &e.high})
        *value *= factor;
    }
}
}  // namespace

std::vector<EstimateRecord> ranked_estimates(const FourHigh &stand, const double load)
{
  std::vector<std::pair<double, EstimateRecord>> by_effect;  // the largest move of a mode
  for (const Estimate &e : stand.estimates) {
    EstimateRecord record{e, {}};
    const auto results_with = [&](const double value) {
      FourHigh other = stand;
      set_estimated(other, e.key, value);
      return closed_form_stand(other, load);
    };
    try {
      const auto low = results_with(e.low), high = results_with(e.high);
      for (const ClosedFormResult &r : low)
        if (const ClosedFormResult *other = find(high, r.name)) {
          const double move = 0.5 * std::abs(std::log(other->parameter.value / r.parameter.value));
          if (const auto id = move > no_move ? result_id(r.name) : std::nullopt; id && is_ranked(*id))
            record.moves.emplace_back(r.name, move);
        }
    } catch (const InputError &) {  // an end of the interval that the closed forms refuse
    } catch (const SolverError &) {
    }
    const double of_modes = largest_move(record, is_mode);
    by_effect.emplace_back(of_modes, std::move(record));
  }
  std::stable_sort(by_effect.begin(), by_effect.end(),
                   [](const auto &a, const auto &b) { return a.first > b.first; });
  std::vector<EstimateRecord> records;
  for (auto &entry : by_effect)
    records.push_back(std::move(entry.second));
  return records;
}

void mark_estimates(RunContext &run)
{
  const auto *stand = std::get_if<FourHigh>(&run.the_case.spec);
  if (!stand || stand->estimates.empty())
    return;
  const double load     = load_of_first(*stand);
  run.results.estimates = ranked_estimates(*stand, load);
  close_records(run.results.estimates, run.results);
  std::vector<EstimateEffect> effects;
  for (const EstimateRecord &record : run.results.estimates)
    effects.emplace_back(record);
  std::set<std::string> known;  // names of the closed forms
  for (const ClosedFormResult &r : closed_form_stand(*stand, load))
    known.insert(r.name);
  for (auto &[name, p] : run.results.values) {
    KeyList more;
    for (const Estimate &e : stand->estimates)
      if (holds(p.inputs, e.key)) {
        p.estimated.push_back(e.key);
        more = joined(std::move(more), e.from);
      }
    if (p.estimated.empty())
      continue;
    const double moved = moved_by_rolls(effects, name, p.inputs, known);
    if (std::isnan(moved))
      for (const std::string &key : p.estimated)
        if (key.rfind("frame.", 0) != 0 && !holds(p.error_lacks, key))
          p.error_lacks.push_back(key);
    p.error_estimate += moved;
    p.inputs = joined(std::move(p.inputs), more);
  }
  for (const EstimateRecord &record : run.results.estimates)
    run.assume(sentence(record));
}
}  // namespace mill
