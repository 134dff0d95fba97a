#include "twin/advice/chatter_advice.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "core/process/parallel.h"
#include "twin/advice/process_action.h"
#include "twin/chatter/critical_slopes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace mill::twin {
namespace {
constexpr double least_rise = 1e-5;  // relative change of a critical speed that is only its search

// One thing to do: to the process, or to a number of the structure.
struct ProcessStep {
  ProcessAction action;               // name, parameter, means and slope_key also of the structure
  std::optional<ChangeOf> structure;  // what slope_key names in the structure; nothing: a process action
  bool what_if = false;
};

// How a number of the structure is changed by an action; nothing for one that no action changes by itself.
std::optional<ChangeOf> change_of(const dynamics::NumberKind kind)
{
  switch (kind) {
  case dynamics::NumberKind::spring:
    return ChangeOf::spring;
  case dynamics::NumberKind::damper:
    return ChangeOf::damper;
  case dynamics::NumberKind::damping_ratio:
    return ChangeOf::damping_ratio;
  case dynamics::NumberKind::mass:
  case dynamics::NumberKind::all_dampers:
  case dynamics::NumberKind::frequency:
    break;
  }
  return std::nullopt;
}

class CriticalAdviser {
public:
  explicit CriticalAdviser(const CriticalQuestion &question) : asked_(question) {}

  CriticalAdvice advise()
  {
    advice_.now = critical_state(asked_.stand, asked_.bite, asked_.scheme, asked_.range, asked_.working_speed);
    if (advice_.now.no_bite)
      throw InputError(fmt::format("no steady bite exists at the working speed of {:.4g} m/s: {}; no advice can "
                                   "be given for a bite that does not exist",
                                   asked_.working_speed, advice_.now.why));
    advice_.reached = reaches(advice_.now, 1);
    if (advice_.now.search.verdict == dynamics::Verdict::crossing) {
      dynamics::SensitivityRequest request;
      request.scheme        = asked_.scheme;
      request.range         = asked_.range;
      request.working_speed = asked_.working_speed;
      request.change        = 0;
      request.threads       = asked_.threads;
      advice_.slopes        = chatter_sensitivities(asked_.stand, asked_.numbers, asked_.bite, request);
    }
    now_errors_ = errors_of(asked_, advice_.now);
    if (!now_errors_.empty())
      advice_.spread = spread_of({{1, &now_errors_}});  // (46.10)
    const std::vector<ProcessStep> steps = all_steps();
    std::vector<std::vector<const ProcessStep *>> sets;
    for (const ProcessStep &step : steps)
      sets.push_back({&step});
    std::vector<Rated> all = rated(sets);
    sets.clear();
    const auto two = pairs(steps, all);
    for (const auto &[a, b] : two)
      sets.push_back({&steps[a], &steps[b]});
    std::vector<Rated> more = rated(sets);
    for (std::size_t i = 0; i < more.size(); ++i) {
      more[i].action.apart = (1 + all[two[i].first].action.change) * (1 + all[two[i].second].action.change) - 1;
      all.push_back(std::move(more[i]));
    }
    return sorted(std::move(all));
  }

private:
  // By the key of a number: d ln v_crit of its error of one standard deviation.
  using Errors = std::map<std::string, double>;
  struct Rated {
    RatedAction action;
    CriticalState state;
    bool reaches = false;
    Errors errors;
  };
  const CriticalQuestion &asked_;
  CriticalAdvice advice_;
  Errors now_errors_;

  bool reaches(const CriticalState &state, const double speed_factor) const
  {
    const bool stable_there = state.at_least || state.search.verdict == dynamics::Verdict::crossing;
    return stable_there && state.speed >= (1 + asked_.margin) * asked_.working_speed * speed_factor;
  }

  // Actions are sorted together with their states.
  CriticalAdvice sorted(std::vector<Rated> all)
  {
    std::stable_sort(all.begin(), all.end(), [](const Rated &a, const Rated &b) {
      if (a.action.what_if != b.action.what_if)
        return b.action.what_if;
      if (a.action.against.empty() != b.action.against.empty())
        return a.action.against.empty();
      return a.action.gain > b.action.gain;
    });
    say_what_cannot_be_told_apart(all);
    for (Rated &one : all) {
      if (one.action.what_if) {
        advice_.what_ifs.push_back(std::move(one.action));
        continue;
      }
      advice_.actions.push_back(std::move(one.action));
      advice_.states.push_back(std::move(one.state));
      advice_.reaches.push_back(one.reaches);
    }
    return std::move(advice_);
  }

  std::vector<ProcessStep> all_steps() const
  {
    std::vector<ProcessStep> steps;
    for (ProcessAction &action : process_actions(asked_.bite, asked_.process))
      steps.push_back({std::move(action), std::nullopt});
    for (const dynamics::StructureNumber &number : asked_.numbers) {
      const auto what = change_of(number.kind);
      if (!what || !(number.value > 0))
        continue;
      const bool of_spring = *what == ChangeOf::spring;
      for (const double factor : of_spring ? asked_.stiffness : asked_.damping)
        if (factor != 1)
          steps.push_back(
              {{fmt::format("{} x {:g}", number.name, factor), number.key,
                of_spring ? "part of the stand that this spring stands for" : "dampers, liners, cylinders",
                number.key, factor},
               what,
               *what == ChangeOf::damping_ratio});
    }
    for (const StructureAction &action : asked_.actions)
      steps.push_back(
          {{action.name, action.parameter, action.means, action.key, action.factor}, action.what, action.what_if});
    return steps;
  }

  // N/N, rolling force over the present one; 1 where no bite is solved, which the search then states.
  double force_ratio(const ChangedPass &pass) const
  {
    try {
      return dynamics::working_point(pass.bite, asked_.working_speed * pass.speed_factor, asked_.scheme)
                 .state.force /
             advice_.now.force;
    } catch (const InputError &) {
    } catch (const SolverError &) {
    }
    return 1;
  }

  double foretold(const ProcessStep &step) const
  {
    const auto &[name, parameter, means, slope_key, factor, number] = step.action;
    if (slope_key.empty())  // the speed
      return -std::log(factor);
    for (const ChatterSensitivity &input : advice_.slopes.inputs)
      if (input.key == slope_key)
        return input.critical_speed * std::log(factor);
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::vector<Rated> rated(const std::vector<std::vector<const ProcessStep *>> &sets) const
  {
    std::vector<Rated> all(sets.size());
    share_tasks(long(sets.size()), asked_.threads,
                [&](const long i) { all[std::size_t(i)] = rated(sets[std::size_t(i)]); });
    return all;
  }

  Rated rated(const std::vector<const ProcessStep *> &steps) const
  {
    Rated r;
    RatedAction &action = r.action;
    action.pair         = steps.size() > 1;
    std::vector<ProcessAction> process;
    StructureChanges structure;
    double log_change = 0;
    for (const ProcessStep *step : steps) {
      action.name += (action.name.empty() ? "" : " and ") + step->action.name;
      action.means += (action.means.empty() ? "" : "; ") + step->action.means;
      action.parameters.push_back(step->action.parameter);
      action.what_if = action.what_if || step->what_if;
      log_change += foretold(*step);
      if (step->structure)
        structure.push_back({step->action.slope_key, step->action.factor, *step->structure});
      else
        process.push_back(step->action);
    }
    action.first_order     = std::expm1(log_change);
    const ChangedPass pass = changed_pass(asked_.bite, process);
    if (asked_.follows_force && !process.empty())
      structure.push_back({"", force_ratio(pass), ChangeOf::rolling_force});
    ChatterModel model{asked_.stand, pass.bite, asked_.scheme, asked_.range, asked_.numbers};
    if (!structure.empty()) {
      NumberedStructure changed = asked_.changed(structure);
      model.stand.structure     = std::move(changed.structure);
      model.numbers             = std::move(changed.numbers);
    }
    r.state = critical_state(model.stand, pass.bite, model.scheme, model.range,
                             asked_.working_speed * pass.speed_factor);
    judge(r, pass);
    r.errors = errors_of(model, r.state);
    if (!r.errors.empty() && !now_errors_.empty())
      action.spread = (1 + action.change) * spread_of({{1, &r.errors}, {-1, &now_errors_}});  // (46.11)
    return r;
  }

  void judge(Rated &r, const ChangedPass &pass) const
  {
    RatedAction &action        = r.action;
    const CriticalState &state = r.state, &now = advice_.now;
    const double speed = asked_.working_speed * pass.speed_factor;
    action.change = action.verified = action.gain = state.speed / pass.speed_factor / now.speed - 1;
    r.reaches                                     = reaches(state, pass.speed_factor);
    action.effects.push_back({"critical speed", state.speed, "m/s"});
    action.effects.push_back({"margin", state.speed / speed - 1, "1"});
    action.effects.push_back({"force", state.force / now.force - 1, "1"});
    action.effects.push_back({"torque", state.torque / now.torque - 1, "1"});
    action.effects.push_back({"friction", state.friction / now.friction - 1, "1"});
    action.effects.push_back({"production", state.output / now.output - 1, "1"});
    action.effects.push_back({"growth rate at the working speed", state.growth, "1/s"});
    if (state.at_least)
      action.remarks.push_back(
          fmt::format("nothing grows up to {:.4g} m/s: the rise is at least this", state.speed));
    Violations violated = violations(pass, now, state, asked_.working_speed, asked_.process);
    action.against      = std::move(violated.against);
    action.kept_apart   = violated.kept_apart;
    if (!state.no_bite && !(action.gain > least_rise))
      action.against.push_back(action.gain < -least_rise ? "lowers the critical speed"
                                                         : "does nothing to the critical speed");
    if (const double f = state.search.frequency; std::isfinite(f) && std::isfinite(now.search.frequency))
      action.modes = std::abs(f / now.search.frequency - 1) < 0.05
                         ? fmt::format("{:.1f} Hz stays the critical mode", f)
                         : fmt::format("another mode becomes critical: {:.1f} Hz in place of {:.1f} Hz", f,
                                       now.search.frequency);
  }

  // Empty where no slope exists.
  Errors errors_of(const ChatterModel &model, const CriticalState &state) const
  {
    Errors errors;
    const auto point = critical_point(state.search);
    if (!point)
      return errors;
    try {
      for (const CriticalSlope &slope : critical_slopes(model, model.bite, *point))
        if (const InputDoubt *doubt = doubt_of(asked_.doubts, slope.key))
          errors[slope.key] = slope.slope * doubt->sd;
    } catch (const SolverError &) {  // two roots in one
      errors.clear();
    }
    return errors;
  }

  // sd of a sum of critical speeds, which one error moves together.
  static double spread_of(const std::vector<std::pair<double, const Errors *>> &parts)
  {
    Errors sum;
    for (const auto &[factor, errors] : parts)
      for (const auto &[key, error] : *errors)
        sum[key] += factor * error;
    double variance = 0;
    for (const auto &[key, error] : sum)
      variance += error * error;
    return std::sqrt(variance);
  }

  // An action compared with the next better one, where the errors of mill and bite may turn their order.  (46.12)
  void say_what_cannot_be_told_apart(std::vector<Rated> &ranked) const
  {
    for (std::size_t i = 1; i < ranked.size() && ranked[i].action.against.empty() && !ranked[i].action.what_if;
         ++i) {
      const Rated &better = ranked[i - 1];
      Rated &one          = ranked[i];
      if (better.errors.empty() || one.errors.empty() || now_errors_.empty())
        continue;
      const double a = 1 + better.action.change, b = 1 + one.action.change;
      const double apart = a - b, sd = spread_of({{a, &better.errors}, {-b, &one.errors}, {b - a, &now_errors_}});
      if (apart < sd)
        one.action.remarks.push_back(fmt::format("not distinguishable from {}: {:.2g} % apart, with a standard "
                                                 "deviation of {:.2g} % by what is not known of mill and bite",
                                                 better.action.name, 100 * apart, 100 * sd));
    }
  }

  // Change of the force by an action that helps and keeps every limit; 0 where it does not.
  double relieved(const Rated &single) const
  {
    return single.action.against.empty() && !single.action.what_if
               ? std::min(0.0, single.state.force / advice_.now.force - 1)
               : 0;
  }

  // Pairs of the best single actions of different parameters; a partner may mend what one of them violates.
  std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<ProcessStep> &steps,
                                                         const std::vector<Rated> &singles) const
  {
    std::vector<std::size_t> order(steps.size()), best;
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      return singles[a].action.gain > singles[b].action.gain;
    });
    for (const std::size_t i : order)
      if (singles[i].action.gain > least_rise && !singles[i].action.kept_apart && !singles[i].action.what_if &&
          int(best.size()) < asked_.paired && std::none_of(best.begin(), best.end(), [&](const std::size_t j) {
            return steps[j].action.parameter == steps[i].action.parameter;
          }))
        best.push_back(i);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < best.size(); ++i)
      for (std::size_t j = i + 1; j < best.size(); ++j)
        pairs.emplace_back(best[i], best[j]);
    // Of those that violate a limit each with the action that helps and takes most of the force away.
    const auto relief =
        std::min_element(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
          return relieved(singles[a]) < relieved(singles[b]);
        });
    if (relief != order.end() && relieved(singles[*relief]) < 0 &&
        std::count(best.begin(), best.end(), *relief) == 0)
      for (const std::size_t i : best)
        if (!singles[i].action.against.empty() && steps[i].action.parameter != steps[*relief].action.parameter)
          pairs.emplace_back(i, *relief);
    return pairs;
  }
};
}  // namespace

CriticalAdvice critical_advice(const CriticalQuestion &question)
{
  require(question.working_speed > 0, "a working speed is above zero");
  return CriticalAdviser(question).advise();
}
}  // namespace mill::twin
