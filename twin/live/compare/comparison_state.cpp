#include "twin/live/compare/comparison.h"
#include "twin/live/compare/stored_alarms.h"
#include "twin/live/compare/stored_object.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

// What of the comparison is stored, and read again.
namespace mill::live {
namespace {
using Json = nlohmann::json;

constexpr std::size_t most_bands     = 100000;
constexpr std::size_t kept_proposals = 50;  // the last ones
constexpr double most_change         = 20;  // of ln of a factor

Json sums_json(const twin::Cusum::State &s)
{
  return {{"taken", s.taken}, {"since_up", s.since_up}, {"since_down", s.since_down}, {"up", s.up},
          {"down", s.down},   {"sum_up", s.sum_up},     {"sum_down", s.sum_down},     {"alarm", s.alarm}};
}

twin::Cusum::State stored_sums(const StoredObject &stored)
{
  twin::Cusum::State s;
  s.taken      = stored.count("taken", 0, largest_number);
  s.since_up   = stored.count("since_up", 0, s.taken);
  s.since_down = stored.count("since_down", 0, s.taken);
  s.up         = stored.number("up", 0, any_size);
  s.down       = stored.number("down", 0, any_size);
  s.sum_up     = stored.number("sum_up", -any_size, any_size);
  s.sum_down   = stored.number("sum_down", -any_size, any_size);
  s.alarm      = stored.flag("alarm");
  return s;
}

Json since_json(const TrackedModes::Since &since)
{
  return {{"utc", since.utc}, {"block", since.block}};
}

TrackedModes::Since stored_since(const StoredObject &stored)
{
  return {stored.number_or_unknown("utc", earliest_time, latest_time), stored.count("block", 0, largest_number)};
}

Json modes_json(const TrackedModes &tracked)
{
  Json modes = Json::array();
  for (const TrackedModes::Mode &mode : tracked.modes) {
    const twin::ModeWatch::State &w = mode.watch;
    modes.push_back({{"sums", sums_json(w.sums)},
                     {"reference", int(w.reference_is)},
                     {"blocks", w.n},
                     {"mean", w.mean},
                     {"squares", w.squares},
                     {"weight", w.weight},
                     {"scatter", w.scatter},
                     {"up", since_json(mode.up)},
                     {"down", since_json(mode.down)}});
  }
  return {{"blocks", tracked.blocks}, {"modes", modes}};
}

TrackedModes stored_modes(const StoredObject &stored, const std::size_t modes)
{
  TrackedModes tracked;
  tracked.blocks = stored.count("blocks", 0, largest_number);
  for (const StoredObject &one : stored.list("modes", modes)) {
    TrackedModes::Mode mode;
    twin::ModeWatch::State &w = mode.watch;
    w.sums                    = stored_sums(one.object("sums"));
    w.reference_is            = twin::ModeWatch::Reference(one.count("reference", 0, 2));
    w.n                       = int(one.count("blocks", 0, 1000));
    w.mean                    = one.number("mean", -most_change, most_change);
    w.squares                 = one.number("squares", 0, any_size);
    w.weight                  = one.number("weight", 0, any_size);
    w.scatter                 = one.number("scatter", 1, any_size);
    if ((w.n > 0) != (w.weight > 0))
      one.refuse("has a reference without blocks");
    mode.up   = stored_since(one.object("up"));
    mode.down = stored_since(one.object("down"));
    tracked.modes.push_back(mode);
  }
  if (tracked.modes.size() != modes)
    stored.refuse("has another number of modes than the twin");
  return tracked;
}

Json onset_json(const StoredOnset &onset)
{
  Json all = Json::array();
  for (const StoredOnset::One &one : onset.all)
    all.push_back({{"channel", one.channel},
                   {"frequency", one.frequency},
                   {"baseline", one.baseline},
                   {"near", one.near},
                   {"sigma", one.growth.sigma},
                   {"law", one.growth.law},
                   {"duration", one.growth.duration},
                   {"turns", one.growth.frequency},
                   {"kept", one.growth.kept}});
  return {{"utc", onset.utc}, {"all", all}};
}

StoredOnset stored_onset(const StoredObject &stored)
{
  StoredOnset onset;
  onset.utc = stored.number_or_unknown("utc", earliest_time, latest_time);
  for (const StoredObject &one : stored.list("all", most_bands)) {
    StoredOnset::One band;
    band.channel          = one.text("channel");
    band.frequency        = one.number("frequency", 1e-9, any_size);
    band.baseline         = one.number_or_unknown("baseline", 0, any_size);
    band.near             = int(one.count("near", 0, 1000000000));
    band.growth.sigma     = one.number_or_unknown("sigma", -any_size, any_size);
    band.growth.law       = one.number_or_unknown("law", 0, any_size);
    band.growth.duration  = one.number("duration", 0, any_size);
    band.growth.frequency = one.number("turns", -any_size, any_size);
    band.growth.kept      = one.number("kept", 0, any_size);
    onset.all.push_back(band);
  }
  return onset;
}

Json drift_json(const ModeDrift &drift)
{
  return {{"mode", drift.mode},         {"sign", drift.shift.sign}, {"since", drift.shift.since},
          {"taken", drift.shift.taken}, {"sum", drift.shift.sum},   {"mean", drift.shift.mean},
          {"change", drift.change},     {"began", drift.since},     {"at", drift.time},
          {"from", drift.from}};
}

ModeDrift stored_drift(const StoredObject &stored, const std::size_t modes)
{
  ModeDrift drift;
  drift.mode   = std::size_t(stored.count("mode", 0, std::int64_t(modes) - 1));
  drift.shift  = {int(stored.count("sign", -1, 1)), stored.count("since", 0, largest_number),
                  stored.count("taken", 0, largest_number), stored.number("sum", 0, any_size),
                  stored.number("mean", -any_size, any_size)};
  drift.change = stored.number("change", -most_change, most_change);
  drift.since  = stored.number("began", earliest_time, latest_time);
  drift.time   = stored.number("at", earliest_time, latest_time);
  drift.from   = stored.count("from", 0, largest_number);
  return drift;
}

Json proposal_json(const Proposal &p)
{
  Json values = Json::array(), springs = Json::array();
  for (const twin::RecalibratedValue &value : p.recalibration.values)
    values.push_back({{"name", value.name},
                      {"prior_sd", value.prior_sd},
                      {"change", value.change},
                      {"sd", value.sd},
                      {"told", value.identified}});
  for (const Parameter &K : p.before.K)
    springs.push_back({{"value", K.value}});
  return {{"id", p.id},
          {"utc", p.utc},
          {"from", p.from},
          {"to", p.to},
          {"reason", p.reason},
          {"state", word_of(p.state)},
          {"file", p.file},
          {"seconds", p.recalibration.seconds},
          {"misfit_before", p.recalibration.misfit_before},
          {"misfit_after", p.recalibration.misfit_after},
          {"load", p.recalibration.load},
          {"damping", p.damping_before},
          {"values", values},
          {"springs", springs}};
}

// @param chain  the twin's, for what no proposal changes
Proposal stored_proposal(const StoredObject &stored, const LumpedModel &chain)
{
  Proposal p;
  p.id             = stored.count("id", 1, largest_number);
  p.utc            = stored.number("utc", earliest_time, latest_time);
  p.from           = stored.number("from", earliest_time, latest_time);
  p.to             = stored.number("to", earliest_time, latest_time);
  p.reason         = stored.text("reason");
  const auto state = choice_named<ProposalState>(stored.text("state"));
  if (!state)
    stored.refuse("has a proposal of an unknown state");
  p.state                       = *state;
  p.file                        = stored.text("file");
  p.recalibration.seconds       = stored.number("seconds", 0, any_size);
  p.recalibration.misfit_before = stored.number("misfit_before", 0, any_size);
  p.recalibration.misfit_after  = stored.number("misfit_after", 0, any_size);
  p.recalibration.load          = stored.number("load", -any_size, any_size);
  p.damping_before              = stored.number("damping", 1e-9, 1);
  for (const StoredObject &one : stored.list("values", 64))
    p.recalibration.values.push_back({one.text("name"), one.number("prior_sd", 0, any_size),
                                      one.number("change", -most_change, most_change),
                                      one.number("sd", 0, most_change), one.flag("told")});
  p.before           = chain;
  const auto springs = stored.list("springs", chain.K.size());
  if (springs.size() != chain.K.size())
    stored.refuse("has not the springs of a chain");
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const double value = springs[i].number_or_unknown("value", 0, any_size);
    if ((value > 0) != (chain.K[i].value > 0))
      stored.refuse("has other springs than the twin");
    p.before.K[i].value = value;
  }
  p.chain   = recalibrated(p.before, p.recalibration, p.recalibration.load);
  p.damping = recalibrated(p.damping_before, p.recalibration);
  return p;
}
}  // namespace

/// A state as it was stored, read to its end before any of it is used.
struct Comparison::Stored {
  std::vector<std::pair<std::string, double>> levels;  ///< m/s2, rms while the mill was calm, by place
  StoredOnset onset;
  TrackedModes modes;
  AlarmBook::State book;
  std::vector<Proposal> proposals;
  std::optional<ModeDrift> waiting;
};

nlohmann::json Comparison::state() const
{
  Json levels_of = Json::array(), list = Json::array();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    levels_of.push_back({{"place", pairs[i].name}, {"rms", baseline[i]}});
  const auto &all = offered.all();
  for (std::size_t i = all.size() - std::min(all.size(), kept_proposals); i < all.size(); ++i)
    list.push_back(proposal_json(all[i]));
  Json now{{"levels", levels_of},
           {"onset", onset_json(onset.stored())},
           {"drift", modes_json(modes.tracked())},
           {"book", book_json(book.state())},
           {"proposals", list}};
  // the data of a re-calibration that runs are gone after a restart: it waits for new ones
  if (const auto &open = answered ? answered : waiting)
    now["waiting"] = drift_json(*open);
  return now;
}

Comparison::Stored Comparison::read_state(const nlohmann::json &json) const
{
  const StoredObject state(json, "the comparison");
  const auto n_modes = std::size_t(setup_.modes.frequency.cols());
  Stored stored;
  for (const StoredObject &one : state.list("levels", most_bands))
    stored.levels.emplace_back(one.text("place"), one.number_or_unknown("rms", 0, any_size));
  stored.onset = stored_onset(state.object("onset"));
  stored.modes = stored_modes(state.object("drift"), n_modes);
  stored.book  = stored_book(state.object("book"));
  for (const StoredObject &one : state.list("proposals", kept_proposals)) {
    stored.proposals.push_back(stored_proposal(one, setup_.chain));
    const std::size_t n = stored.proposals.size();
    if (n > 1 && stored.proposals[n - 1].id <= stored.proposals[n - 2].id)
      state.refuse("has proposals out of order");
  }
  if (state.has("waiting"))
    stored.waiting = stored_drift(state.object("waiting"), n_modes);
  return stored;
}

std::string Comparison::resume(const nlohmann::json &state)
{
  Stored stored;
  try {
    stored = read_state(state);
  } catch (const DamagedState &damage) {
    return fmt::format("what was learned of the mill cannot be used: {}; drift, baselines, alarms and proposals "
                       "start without it",
                       damage.what());
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (const auto &[place, rms] : stored.levels)
      if (place == pairs[i].name)
        baseline[i] = rms;
  onset.resume(stored.onset);
  modes.resume(stored.modes);
  book.resume(stored.book);
  offered.resume(std::move(stored.proposals));
  waiting = stored.waiting;
  for (const auto &[cause, alarm] : stored.book.now) {
    const bool known = cause.rfind("drift ", 0) == 0 || cause == recalibration_cause ||
                       (chatter && cause == ChatterWatch::cause) || onset.knows(cause);
    if (!known)
      book.end(cause);  // its band is not watched any more, so nothing would ever end it
  }
  return "";
}
}  // namespace mill::live
