#include "app/twin/advice/stand_advice.h"
#include "app/twin/advice/asked_choices.h"
#include "app/twin/advice/measured_levels.h"
#include "app/twin/advice/repeated_in_detail.h"
#include "app/twin/advice/speed_record.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "core/records/rows_of_response.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace mill {
namespace {
using twin::Attachment;
using twin::RatedAction;
using twin::VibratingStand;

constexpr double finest_step = 0.02;  // Hz, of the sums over the band
constexpr int drawn_points   = 4000;  // of the spectra before and after

const StandAdvice &asked_of(const Case &the_case)
{
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec))
    return four->advice;
  return std::get<Lumped>(the_case.spec).advice;
}

std::vector<twin::SpringChoice> spring_choices(const twin::AdvisedStand &advised, const StandAdvice &asked,
                                               const Case &the_case)
{
  std::vector<twin::SpringChoice> choices;
  if (!advised.chain)
    return choices;
  for (const dynamics::Spring &spring : advised.chain->springs) {
    const bool named = std::count(asked.springs.begin(), asked.springs.end(), spring.name) > 0;
    if (named && !(spring.stiffness > 0))
      throw InputError(place_of_key(the_case, "advice.springs"),
                       fmt::format("advice.springs names {}, which is zero here{}; leave it out", spring.name,
                                   spring.name == word_of(ChainNumber::K4)
                                       ? " (dynamics.force_meaning = \"measured\" holds it in the force)"
                                       : ""));
    if (named || (asked.springs.empty() && spring.stiffness > 0 && spring.name != word_of(ChainNumber::K4)))
      choices.push_back({spring.name, asked.stiffness[0], asked.stiffness[1], twin::means_of_spring(spring.name)});
  }
  return choices;
}

std::vector<twin::TunedChoice> tuned_choices(const VibratingStand &stand, const StandAdvice &asked,
                                             const int place, const Case &the_case)
{
  std::vector<twin::TunedChoice> choices;
  if (asked.tuned.empty() && asked.tuned_mass > 0)
    choices.push_back({place, not_given, asked.tuned_mass});
  for (std::size_t i = 0; i < asked.tuned.size(); ++i) {
    const TunedDamperProposal &one = asked.tuned[i];
    choices.push_back(
        {one.at.empty() ? place : place_in(stand, the_case, fmt::format("advice.tuned_damper.{}.at", i), one.at),
         one.mass, one.mass_ratio});
  }
  return choices;
}

Table spectrum_table(const twin::LevelAdvice &advice, const twin::ForceBand &force, const bool measured)
{
  const double low = force.frequency[0], high = force.frequency[force.frequency.size() - 1];
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(drawn_points, std::max(low, 1e-3 * high), high);
  Eigen::VectorXd root    = Eigen::VectorXd::Ones(f.size());
  const double step       = force.frequency.size() > 1 ? force.frequency[1] - force.frequency[0] : high - low;
  if (measured)
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      const auto k = std::clamp<Eigen::Index>(Eigen::Index((f[i] - low) / step), 0, force.square.size() - 1);
      root[i]      = std::sqrt(force.square[k] / step);
    }
  const char *unit = measured ? "m/s2/sqrt(Hz)" : "m/s2/N";
  const auto of    = [&](const VibratingStand &stand, const std::vector<Attachment> &joined) {
    return Eigen::VectorXd(twin::amplitude(stand, joined, advice.place, f).cwiseProduct(root));
  };
  Table table;
  table.add("frequency", "Hz", f).add("as it is", unit, of(advice.stand, {}));
  std::size_t drawn = 0;
  for (const RatedAction &action : advice.actions)
    if (action.against.empty() && action.process.empty() && drawn < 2 && (drawn == 0 || !action.pair)) {
      table.add(action.name, unit, of(action.stand, action.joined));
      ++drawn;
    }
  return table;
}

Table detuning_table(const twin::LevelAdvice &advice)
{
  Table table;
  for (std::size_t i = 0; i < advice.tuned.size(); ++i) {
    if (i == 0)
      table.add("detuning", "%", 100 * advice.tuned[i].detuning);
    table.add(advice.tuned_names[i], "%", 100 * advice.tuned[i].detuned_change);
  }
  return table;
}

Parameter ratio(const double value, const std::string &method, const std::vector<std::string> &lacks)
{
  Parameter p;
  p.value       = value;
  p.unit        = "1";
  p.method      = method;
  p.error_lacks = lacks;
  return p;
}

// -, of a level under a force whose spectrum is one of a record: half of that of its mean square.
double scatter_of_level(const twin::LevelAdvice &advice, const twin::ForceBand &force, const double duration)
{
  const Eigen::VectorXd square =
      twin::amplitude(advice.stand, {}, advice.place, force.frequency).cwiseAbs2().cwiseProduct(force.square);
  const double step = force.frequency.size() > 1 ? force.frequency[1] - force.frequency[0] : 1;
  return 0.5 * square.norm() / square.sum() / std::sqrt(step * duration);
}

void add_level(twin::AdviceRecord &record, const twin::LevelAdvice &advice, const MeasuredLevels &measured)
{
  std::string name = advice.stand.places[std::size_t(advice.place)];
  std::replace(name.begin(), name.end(), ' ', '_');
  Parameter level;
  level.value          = advice.level[advice.place];
  level.unit           = "m/s2";
  level.method         = record.stand + ", force of " + std::to_string(measured.files.size()) + " records";
  level.error_estimate = scatter_of_level(advice, measured.force, measured.duration);
  if (const auto measured_level = measured.level.find(name); measured_level != measured.level.end()) {
    level.checks.push_back({"rms of the same records in this band", measured_level->second,
                            "what the model does not hold, and a force that is not the only one"});
    const double decibel = 20 * std::log10(level.value / measured_level->second);
    if (std::abs(decibel) > 3)
      record.notes.emplace_back(
          NoteId::level_off_record, "",
          fmt::format("the model gives {:+.1f} dB of the measured level of {}", decibel, name),
          "calibrate the stand before the advice is trusted", "",
          std::vector<std::string>{"advice.level." + name});
  }
  record.results.add(row::advice::level.of(name), level);
}

void add_results(twin::AdviceRecord &record, const twin::LevelAdvice &advice)
{
  const std::vector<std::string> lacks{"errors of springs and damping of the stand"};
  if (!advice.actions.empty() && advice.actions.front().against.empty()) {
    const RatedAction &best = advice.actions.front();
    Parameter change        = ratio(best.verified, best.name, {});
    if (best.repeated.empty() && std::isfinite(best.spread))
      change.error_estimate = std::abs(best.spread / best.change);
    else
      change.error_lacks = lacks;
    change.checks.push_back({"linear estimate", best.first_order, "not the answer: second order is left out"});
    if (!best.repeated.empty())
      change.checks.push_back({"six masses", best.change, "which have no chocks"});
    record.results.add(row::advice::best_change.of(), change);
  }
  for (std::size_t i = 0; i < advice.tuned.size(); ++i) {
    const twin::TunedDamper &t = advice.tuned[i];
    const std::string number   = advice.tuned.size() > 1 ? std::to_string(i + 1) : "";
    Parameter mass      = ratio(t.best.mass, "mass ratio times the effective mass of the leading mode", lacks);
    mass.unit           = "kg";
    Parameter frequency = ratio(t.best.frequency, "least level over frequency and damping", lacks);
    frequency.unit      = "Hz";
    frequency.checks.push_back({"closed form for one mode under white force", t.start.frequency, "(46.7)"});
    Parameter damping = ratio(t.best.ratio, "least level over frequency and damping", lacks);
    damping.checks.push_back({"closed form for one mode under white force", t.start.ratio, "(46.7)"});
    Parameter change = ratio(t.change, advice.tuned_names[i], lacks);
    for (const RatedAction &action : advice.actions)
      if (action.name == advice.tuned_names[i] && std::isfinite(action.spread)) {
        change.error_estimate = std::abs(action.spread / action.change);
        change.error_lacks.clear();
      }
    change.checks.push_back({"5 % too low", t.detuned_by(-0.05), ""});
    change.checks.push_back({"5 % too high", t.detuned_by(0.05), ""});
    record.results.add(row::advice::tuned_mass.of(number), mass);
    record.results.add(row::advice::tuned_frequency.of(number), frequency);
    record.results.add(row::advice::tuned_damping.of(number), damping);
    record.results.add(row::advice::tuned_change.of(number), change);
    record.tuned.push_back({advice.tuned_names[i], advice.stand.places[std::size_t(t.best.to)],
                            advice.stand.frequency[t.mode] / (2 * M_PI), t});
    if (!t.inside)
      record.notes.emplace_back(NoteId::tuning_at_edge, advice.tuned_names[i],
                                "the least level lies at the edge of what was searched");
  }
}

void add_slopes(twin::AdviceRecord &record, const twin::LevelAdvice &advice)
{
  const auto &names = advice.slopes.names;
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), 0);
  const auto slope = [&](const std::size_t p) { return advice.slopes.slope(advice.place, Eigen::Index(p)); };
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto a, const auto b) { return std::abs(slope(a)) > std::abs(slope(b)); });
  for (const std::size_t p : order)
    record.slopes.emplace_back(names[p], slope(p));
}

std::string level_answer(const twin::LevelAdvice &advice)
{
  if (advice.actions.empty())
    return "Nothing was allowed to be tried.";
  const RatedAction &best = advice.actions.front();
  if (!best.against.empty())
    return "No action that was tried lowers the level and keeps the limits.";
  if (best.repeated.empty())
    return fmt::format("Best: {}, {:+.1f} % (first order {:+.1f} %).", best.name, 100 * best.change,
                       100 * best.first_order);
  return fmt::format("Best: {}, {:+.1f} % in the model of {} (six masses {:+.1f} %, first order {:+.1f} %).",
                     best.name, 100 * best.verified, best.repeated.back().name, 100 * best.change,
                     100 * best.first_order);
}
// The pass of the level: its critical speed, or why it has none.
void add_pass_notes(twin::AdviceRecord &record, const twin::LevelAdvice &advice,
                    const std::optional<twin::CriticalState> &detailed, const AdvisedModel &model)
{
  if (!advice.pass) {
    record.notes.emplace_back(NoteId::pass_not_judged, "",
                              "force, torque, tensions and critical speed do not follow from a stand alone",
                              "process actions are judged where the case has a pass with its speed and a strip "
                              "with friction and flow stress, "
                              "or in a case of kind chatter");
    return;
  }
  const twin::CriticalState &now = *advice.pass;
  const double speed             = model.pass->working_speed;
  if (now.no_bite) {
    record.notes.push_back(
        Warning{WarningId::no_steady_bite, "",
                fmt::format("no steady bite exists at the working speed of {:.4g} m/s ({})", speed, now.why),
                "process actions and the critical speed are not judged"});
    return;
  }
  const auto critical_speed = [&](const std::string &name, const twin::CriticalState &state) {
    record.notes.push_back("critical speed as it is, " + name + ": " +
                           sentence(state.search, model.pass->model.range));
  };
  critical_speed(model.advised.chain ? "six masses" : model.source, now);
  if (detailed)
    critical_speed(model.detailed->name, *detailed);
  if (now.growth >= 0)
    record.notes.push_back(
        Warning{WarningId::chatters, "",
                fmt::format("vibration grows without excitation at the working speed of {:.4g} m/s", speed),
                "it has no level that a process action could lower", "raise the critical speed first"});
  else
    record.notes.push_back(
        "process actions: the disturbance behind the present force stays, the bite responds to it again, contacts "
        "follow the rolling force; first order is a slope by differences");
  if (std::isnan(model.pass->process.torque_rise))
    record.notes.push_back(no_torque_limit());
  if (now.search.verdict == dynamics::Verdict::crossing) {
    Parameter critical;
    critical.value       = now.speed;
    critical.unit        = "m/s";
    critical.method      = "search over the speed";
    critical.error_lacks = {"errors of stand, friction law and flow stress"};
    record.results.add(row::advice::critical_speed.of(), critical);
  }
}
}  // namespace

twin::AdviceRecord stand_advice(const Case &the_case, const std::string &measured,
                                const twin::ReadOptions &reading, const RolledAdvice &rolled,
                                const Components &components)
{
  const StandAdvice &asked      = asked_of(the_case);
  const AdvisedModel model      = advised_model(the_case, asked, rolled, components);
  const VibratingStand &advised = model.advised.stand;
  twin::LevelQuestion question;
  question.place    = place_in(advised, the_case, "advice.place", asked.place);
  const double low  = std::isnan(asked.band[0]) ? 0 : asked.band[0];
  const double high = std::isnan(asked.band[1]) ? model.limit : asked.band[1];
  const double step = std::min(std::max(finest_step, high / 1e5), twin::resolving_step(advised, high));
  twin::AdviceRecord record;
  record.case_name = the_case.name;
  record.stand     = model.source;
  record.goal      = RatedGoal::level;
  record.notes     = model.notes;
  MeasuredLevels records;
  if (measured.empty()) {
    question.force = twin::white_force(low, high, step);
    record.notes.emplace_back(NoteId::force_not_measured, "", "the force was not measured",
                              "a white one is taken, and changes are given, no levels");
  } else {
    records        = measured_levels(measured, reading, low, high, step);
    question.force = records.force;
    record.notes.insert(record.notes.end(), records.notes.begin(), records.notes.end());
  }
  if (twin::resolving_step(advised, high) <= high / 200000)
    record.notes.emplace_back(NoteId::band_not_resolved, "",
                              "a mode is damped so little that the sums over the band may miss part of its peak");
  if (high > model.limit)
    record.notes.emplace_back(
        NoteId::band_above_model, "",
        fmt::format("the modes of the stand are right up to {:g} Hz, the band goes to {:g} Hz", model.limit, high),
        "", "", std::vector<std::string>{}, "advice.band");
  question.springs         = spring_choices(model.advised, asked, the_case);
  question.damping         = model.advised.chain ? asked.modal_damping : std::array<double, 2>{1, 1};
  question.dampers         = damper_choices(advised, asked, the_case);
  question.tuned           = tuned_choices(advised, asked, question.place, the_case);
  question.rise_elsewhere  = asked.rise_elsewhere;
  question.softening       = asked.softening;
  question.unidentified    = model.unidentified;
  question.spring_error    = model.spring_error;
  question.pass            = model.pass;
  twin::LevelAdvice advice = twin::level_advice(model.advised, question);
  const bool as_white      = measured.empty() && model.detailed;  // the sums need no finer steps
  const auto white = as_white ? twin::white_force(low, high, twin::resolving_step(model.detailed->as_it_is, high))
                              : twin::ForceBand();
  const auto detailed = repeat_in_detail(advice.actions, model, question.place, as_white ? white : question.force);
  record.question     = fmt::format("lowest rms acceleration of the {} from {:g} to {:g} Hz",
                                    advised.places[std::size_t(question.place)], low,
                                measured.empty() ? high : std::min(high, question.force.frequency.maxCoeff()));
  record.answer       = level_answer(advice);
  if (!measured.empty())
    add_level(record, advice, records);
  add_results(record, advice);
  add_pass_notes(record, advice, detailed, model);
  for (auto &value : record.results.values) {
    value.second.at     = record.stand;
    value.second.inputs = {"advice.place", "advice.band", "dynamics.modal_damping"};
  }
  add_slopes(record, advice);
  record.tables["spectrum"] = spectrum_table(advice, question.force, !measured.empty());
  if (!advice.tuned.empty())
    record.tables["detuning"] = detuning_table(advice);
  record.actions = std::move(advice.actions);
  return record;
}
}  // namespace mill
