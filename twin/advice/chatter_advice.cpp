#include "twin/advice/chatter_advice.h"
#include "core/case/errors.h"
#include "core/numerics/require.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::twin {
namespace {
using bite::PassNumber;

constexpr double least_rise = 1e-5;  // relative change of a critical speed that is only its search

// One thing to do to mill or process.
struct ProcessStep {
  std::string name, parameter, means;
  std::string slope_key;  // of the exact slopes
  double factor = 1;
  bool of_speed = false;  // factor on the working speed
  std::string structure;  // key of a number of the structure; empty: none
  int number = -1;        // PassNumber; -1: none
};

std::string percent(const double part)
{
  return fmt::format("{:.3g} %", 100 * part);
}

class CriticalAdviser {
public:
  explicit CriticalAdviser(const CriticalQuestion &question) : asked_(question) {}

  CriticalAdvice advise()
  {
    advice_.now = critical_state(asked_.stand, asked_.bite, asked_.scheme, asked_.range, asked_.working_speed);
    if (advice_.now.no_bite)
      throw InputError(fmt::format("there is no steady bite at the working speed of {:.4g} m/s: {}; no advice can "
                                   "be given for a bite that does not exist",
                                   asked_.working_speed, advice_.now.why));
    advice_.reached = reaches(advice_.now, 1);
    if (advice_.now.found.verdict == dynamics::Verdict::crossing) {
      dynamics::SensitivityRequest request;
      request.scheme        = asked_.scheme;
      request.range         = asked_.range;
      request.working_speed = asked_.working_speed;
      request.change        = 0;
      request.threads       = asked_.threads;
      advice_.slopes        = chatter_sensitivities(asked_.stand, asked_.numbers, asked_.bite, request);
    }
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
  struct Rated {
    RatedAction action;
    CriticalState state;
    bool reaches = false;
  };
  const CriticalQuestion &asked_;
  CriticalAdvice advice_;

  bool reaches(const CriticalState &state, const double speed_factor) const
  {
    const bool stable_there = state.at_least || state.found.verdict == dynamics::Verdict::crossing;
    return stable_there && state.speed >= (1 + asked_.margin) * asked_.working_speed * speed_factor;
  }

  // Actions are sorted together with their states.
  CriticalAdvice sorted(std::vector<Rated> all)
  {
    std::stable_sort(all.begin(), all.end(), [](const Rated &a, const Rated &b) {
      if (a.action.against.empty() != b.action.against.empty())
        return a.action.against.empty();
      return a.action.gain > b.action.gain;
    });
    for (Rated &one : all) {
      advice_.actions.push_back(std::move(one.action));
      advice_.states.push_back(std::move(one.state));
      advice_.reaches.push_back(one.reaches);
    }
    return std::move(advice_);
  }

  std::vector<ProcessStep> all_steps() const
  {
    std::vector<ProcessStep> steps;
    const auto add = [&](const ProcessStep &like, const std::array<double, 2> &factors) {
      for (const double factor : factors)
        if (factor != 1) {
          ProcessStep step = like;
          step.factor      = factor;
          step.name        = fmt::format("{} x {:g}", like.name, factor);
          steps.push_back(step);
        }
    };
    const auto of_pass = [&](const char *name, const char *means, const PassNumber number,
                             const std::array<double, 2> &factors) {
      const double value = value_of(asked_.bite, number);
      if (!(value > 0))
        return;  // no tension, no oil
      ProcessStep step{name, name, means, bite::name_of(number).key};
      step.number = int(number);
      add(step, factors);
    };
    ProcessStep speed{"speed", "speed", "set point of the mill", ""};
    speed.of_speed = true;
    add(speed, asked_.speed);
    of_pass("entry thickness", "exit thickness of the stand before, whose reduction changes instead",
            PassNumber::entry_thickness, asked_.entry_thickness);
    of_pass("entry tension", "tension set point between this stand and the one before", PassNumber::entry_tension,
            asked_.entry_tension);
    of_pass("exit tension", "tension set point between this stand and the next one", PassNumber::exit_tension,
            asked_.exit_tension);
    const auto known = bite::numbers_of(asked_.bite);
    if (std::count(known.begin(), known.end(), PassNumber::viscosity) > 0)
      of_pass("oil viscosity", "other oil, its temperature, concentration of the emulsion", PassNumber::viscosity,
              asked_.viscosity);
    for (const dynamics::StructureNumber &number : asked_.numbers) {
      if (number.key == "stand.dampings" || number.unit == "Hz" || number.M_by.size() > 0 || !(number.value > 0))
        continue;
      ProcessStep step{number.name, number.key, "", number.key};
      step.structure       = number.key;
      const bool of_spring = number.K_by.size() > 0;
      step.means = of_spring ? "part of the stand that this spring stands for" : "dampers, liners, cylinders";
      add(step, of_spring ? asked_.stiffness : asked_.damping);
    }
    return steps;
  }

  double foretold(const ProcessStep &step) const
  {
    if (step.of_speed)
      return -std::log(step.factor);
    for (const ChatterSensitivity &input : advice_.slopes.inputs)
      if (input.key == step.slope_key)
        return input.critical_speed * std::log(step.factor);
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
    bite::RollBite bite = asked_.bite;
    StructureChanges structure;
    double speed_factor = 1, log_change = 0;
    for (const ProcessStep *step : steps) {
      action.name += (action.name.empty() ? "" : " and ") + step->name;
      action.means += (action.means.empty() ? "" : "; ") + step->means;
      action.parameters.push_back(step->parameter);
      log_change += foretold(*step);
      if (step->of_speed)
        speed_factor *= step->factor;
      if (!step->structure.empty())
        structure.emplace_back(step->structure, step->factor);
      if (step->number >= 0)
        bite = with_number_scaled(bite, PassNumber(step->number), step->factor);
    }
    action.first_order = std::expm1(log_change);
    if (const double initial = bite.strip.initial_thickness; bite.strip.entry_thickness > initial) {
      action.against.push_back("the strip would be thicker than before all rolling");
      action.kept_apart = true;
    }
    dynamics::ChatterStandModel stand = asked_.stand;
    if (!structure.empty())
      stand.structure = asked_.changed(structure);
    r.state = critical_state(stand, bite, asked_.scheme, asked_.range, asked_.working_speed * speed_factor);
    judge(r, speed_factor);
    return r;
  }

  void judge(Rated &r, const double speed_factor) const
  {
    RatedAction &action        = r.action;
    const CriticalState &state = r.state, &now = advice_.now;
    action.change = action.verified = action.gain = state.speed / speed_factor / now.speed - 1;
    r.reaches                                     = reaches(state, speed_factor);
    action.effects.push_back({"critical speed", state.speed, "m/s"});
    action.effects.push_back({"margin", state.speed / (asked_.working_speed * speed_factor) - 1, "1"});
    action.effects.push_back({"force", state.force / now.force - 1, "1"});
    action.effects.push_back({"torque", state.torque / now.torque - 1, "1"});
    action.effects.push_back({"friction", state.friction / now.friction - 1, "1"});
    action.effects.push_back({"production", state.output / now.output - 1, "1"});
    action.effects.push_back({"growth rate at the working speed", state.growth, "1/s"});
    if (state.at_least)
      action.remarks.push_back(
          fmt::format("nothing grows up to {:.4g} m/s: the rise is at least this", state.speed));
    limits(action, state, speed_factor);
    if (const double f = state.found.frequency; std::isfinite(f) && std::isfinite(now.found.frequency))
      action.modes = std::abs(f / now.found.frequency - 1) < 0.05
                         ? fmt::format("{:.1f} Hz stays the critical mode", f)
                         : fmt::format("another mode becomes critical: {:.1f} Hz in place of {:.1f} Hz", f,
                                       now.found.frequency);
  }

  void limits(RatedAction &action, const CriticalState &state, const double speed_factor) const
  {
    const CriticalState &now = advice_.now;
    if (state.no_bite) {
      action.against.push_back("no steady bite at the working speed: " + state.why);
      action.kept_apart = true;
      return;
    }
    if (const double speed = asked_.working_speed * speed_factor; speed < asked_.wanted_speed * (1 - 1e-12)) {
      action.against.push_back(
          fmt::format("rolls at {:.4g} m/s, at least {:.4g} m/s are wanted", speed, asked_.wanted_speed));
      action.kept_apart = true;
    }
    if (const double rise = state.force / now.force - 1; rise > asked_.force_rise)
      action.against.push_back(
          fmt::format("the force rises by {}, at most {} are allowed", percent(rise), percent(asked_.force_rise)));
    if (const double rise = state.torque / now.torque - 1; rise > asked_.torque_rise)  // NaN: any
      action.against.push_back(fmt::format("the torque rises by {}, at most {} are allowed", percent(rise),
                                           percent(asked_.torque_rise)));
    if (action.gain < -least_rise)
      action.against.push_back("lowers the critical speed");
    else if (!(action.gain > least_rise))
      action.against.push_back("does nothing to the critical speed");
  }

  // Change of the force by an action that helps and keeps every limit; 0 where it does not.
  double relieved(const Rated &single) const
  {
    return single.action.against.empty() ? std::min(0.0, single.state.force / advice_.now.force - 1) : 0;
  }

  // Two by two the best singles of different parameters, whatever they violate that a partner may mend.
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
      if (singles[i].action.gain > least_rise && !singles[i].action.kept_apart &&
          int(best.size()) < asked_.paired && std::none_of(best.begin(), best.end(), [&](const std::size_t j) {
            return steps[j].parameter == steps[i].parameter;
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
        if (!singles[i].action.against.empty() && steps[i].parameter != steps[*relief].parameter)
          pairs.emplace_back(i, *relief);
    return pairs;
  }
};
}  // namespace

CriticalState critical_state(const dynamics::ChatterStandModel &stand, const bite::RollBite &bite,
                             const bite::Linearisation scheme, const dynamics::SpeedRange &range,
                             const double working_speed)
{
  using dynamics::Verdict;
  CriticalState s;
  s.found    = dynamics::critical_speed(stand, bite, scheme, range);
  s.at_least = s.found.verdict == Verdict::stable;
  s.speed = s.found.verdict == Verdict::crossing ? s.found.speed : s.at_least ? s.found.highest_bite : range.from;
  try {
    const auto point = dynamics::working_point(bite, working_speed, scheme);
    s.force          = point.state.force;
    s.torque         = point.state.torque;
    s.friction       = point.state.friction;
    s.growth         = dynamics::growth_rate(chatter_matrix(stand, point.by));
    s.output         = point.state.exit_speed * bite.strip.exit_thickness * bite.strip.width;
  } catch (const InputError &error) {
    s.no_bite = true;
    s.why     = error.problems.front().message;
  } catch (const SolverError &error) {
    s.no_bite = true;
    s.why     = error.report.what;
  }
  return s;
}

CriticalAdvice critical_advice(const CriticalQuestion &question)
{
  require(question.working_speed > 0, "a working speed is above zero");
  return CriticalAdviser(question).advise();
}
}  // namespace mill::twin
