#include "app/review/estimate_review.h"
#include "app/review/closed_form_modes.h"
#include "app/run/run_context.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/units.h"
#include "core/case/estimates.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace mill {
namespace {
constexpr double no_move = 1e-5;  // relative; smaller changes are not reported

bool is_mode(const std::string &name)
{
  return name.size() >= 2 && name[0] == 'f' && name[1] >= '1' && name[1] <= '9';
}

// Springs, masses, bearings, modes and mill modulus of the first pass; responses and later passes have a dot in
// their name.
bool is_ranked(const std::string &name)
{
  static const std::set<std::string> of_stand{"stand.modulus.kiss", "stand.modulus.tangent"};
  return name.find('.') == std::string::npos || of_stand.count(name);
}

template <class Which> double largest_move(const EstimateRecord &record, const Which &is_meant)
{
  double most = 0;
  for (const auto &[name, move] : record.moves)
    if (is_meant(name))
      most = std::max(most, move);
  return most;
}

double largest_mode_move(const EstimateRecord &record)
{
  return largest_move(record, is_mode);
}

std::string quantity_of(const Estimate &e, const double value)
{
  return fmt::format("{:.4g}", from_si(value, unit(e.unit)));
}

std::string sentence(const EstimateRecord &record)
{
  const Estimate &e = record.estimate;
  std::string moved;
  for (const auto &[name, move] : record.moves)
    if (is_mode(name) && move == largest_mode_move(record) && move > no_move && moved.empty())
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
// models the most it moves any mode of the chain, of other moduli the most it moves any spring.  NaN: nothing
// tells.
double move_of(const EstimateRecord &record, const std::string &name, const std::vector<std::string> &known)
{
  if (is_ranked(name) && holds(known, name))
    return largest_move(record, [&](const std::string &result) { return result == name; });
  const std::string stem = name.substr(0, name.find('.')), last = name.substr(name.rfind('.') + 1);
  if (stem != name && (is_mode(last) || is_word(last, ResultWord::frequency)))
    return largest_mode_move(record);
  if (stem == family::stand)
    return largest_move(record, [](const std::string &spring) { return spring[0] == 'K'; });
  if (!holds(known, stem))
    return not_given;
  return largest_move(record, [&](const std::string &name) { return name == stem; });
}

// What all estimates of the rolls may move together: those of one source add up, different ones by squares.
double moved_by_rolls(const std::vector<EstimateRecord> &records, const std::string &name, const KeyList &keys,
                      const std::vector<std::string> &known)
{
  std::map<std::string, double> by_source;
  for (const EstimateRecord &record : records)
    if (const Estimate &e = record.estimate; !is_of_frame(e) && holds(keys, e.key))
      by_source[e.source.empty() ? e.key : e.source] += move_of(record, name, known);
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
  std::vector<EstimateRecord> records;
  for (const Estimate &e : stand.estimates) {
    EstimateRecord record{e, {}};
    const auto value_text = [&](const double value) {
      FourHigh other = stand;
      set_estimated(other, e.key, value);
      return closed_form_stand(other, load);
    };
    try {
      const auto low = value_text(e.low), high = value_text(e.high);
      for (const ClosedFormResult &r : low)
        if (const ClosedFormResult *other = find(high, r.name); other && is_ranked(r.name)) {
          const double move = 0.5 * std::abs(std::log(other->parameter.value / r.parameter.value));
          if (move > no_move)
            record.moves.emplace_back(r.name, move);
        }
    } catch (const InputError &) {  // an end of the interval that the closed forms refuse
    } catch (const SolverError &) {
    }
    records.push_back(std::move(record));
  }
  std::stable_sort(records.begin(), records.end(), [](const EstimateRecord &a, const EstimateRecord &b) {
    return largest_mode_move(a) > largest_mode_move(b);
  });
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
  std::vector<std::string> known;  // names of the closed forms
  for (const ClosedFormResult &r : closed_form_stand(*stand, load))
    known.push_back(r.name);
  for (auto &[name, p] : run.results.values) {
    KeyList more;
    for (const Estimate &e : stand->estimates)
      if (holds(p.inputs, e.key)) {
        p.estimated.push_back(e.key);
        more = joined(std::move(more), e.from);
      }
    if (p.estimated.empty())
      continue;
    const double moved = moved_by_rolls(run.results.estimates, name, p.inputs, known);
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
