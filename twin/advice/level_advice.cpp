#include "core/base/errors.h"
#include "core/base/require.h"
#include "core/model/assumed_error.h"
#include "twin/advice/advice.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill::twin {
namespace {
constexpr double nothing         = 1e-3;  // relative change below which an action is not worth its words
constexpr double notable_slope   = 0.05;  // of the level by a parameter, from which the result rests on it
constexpr const char *of_damping = "modal damping";
constexpr const char *critical_over_working = "critical over working speed";

// One thing to do, before anybody knows what it brings.
struct Part {
  std::string name;
  std::vector<std::string> parameters;
  std::string means;
  std::string spring;  // empty: none is changed
  double factor  = 1;  // on that spring
  double damping = 1;  // factor on the ratios of all modes
  std::vector<Attachment> dampers;
  std::optional<Attachment> tuned;  // starting values, or those found for it alone
  std::optional<ProcessAction> process;
};

// Two dampers between the same places are one parameter.
std::string damper_between(const Attachment &damper)
{
  return fmt::format("damper {} {}", std::min(damper.from, damper.to), std::max(damper.from, damper.to));
}

bool share_one(const Part &a, const Part &b)
{
  return std::any_of(a.parameters.begin(), a.parameters.end(), [&](const std::string &name) {
    return std::count(b.parameters.begin(), b.parameters.end(), name) > 0;
  });
}

// N/m: stiffness of the stand against the bite force.
double stand_stiffness(const VibratingStand &stand)
{
  return 1 / stand.force.cwiseQuotient(stand.frequency).squaredNorm();
}

std::string mode_words(const std::vector<dynamics::Pole> &before, std::vector<dynamics::Pole> after)
{
  std::string moved;
  double most = 0.002;  // what is worth a word: 0.2 % of a frequency
  std::vector<dynamics::Pole> kept;
  for (const dynamics::Pole &old : before) {
    if (after.empty())
      break;
    const auto near = std::min_element(after.begin(), after.end(), [&](const auto &a, const auto &b) {
      return std::abs(std::log(a.frequency / old.frequency)) < std::abs(std::log(b.frequency / old.frequency));
    });
    const double shift =
        std::abs(std::log(near->frequency / old.frequency)) + std::abs(near->damping - old.damping);
    if (shift > most) {
      most  = shift;
      moved = fmt::format("{:.1f} Hz ({:.2g} %) to {:.1f} Hz ({:.2g} %)", old.frequency, 100 * old.damping,
                          near->frequency, 100 * near->damping);
    }
    after.erase(near);
  }
  for (const dynamics::Pole &extra : after)
    if (extra.damping < 1)
      moved += fmt::format("{}one more at {:.1f} Hz ({:.2g} %)", moved.empty() ? "" : ", ", extra.frequency,
                           100 * extra.damping);
  return moved;
}

class LevelAdviser {
public:
  LevelAdviser(const AdvisedStand &advised, const LevelQuestion &question) : own_(advised), asked_(question)
  {
    const VibratingStand &stand = advised.stand;
    require(question.place >= 0 && question.place < int(stand.places.size()), "the place of the advice exists");
    if (!((stand.damping.array() > 0).all()))
      throw InputError("a mode of the stand has no damping, so that its vibration has no level; give "
                       "dynamics.modal_damping above zero");
    advice_.place = question.place;
    advice_.stand = stand;
    advice_.level = levels(stand, {}, question.force);
    if (!(advice_.level[question.place] > 0))
      throw InputError("the force does not move the place \"" + stand.places[std::size_t(question.place)] +
                       "\" in the band; choose another place or band");
    if (advised.chain)
      advice_.slopes = level_slopes(*advised.chain, stand.damping, stand.gap_damper, question.force);
    poles_ = poles(stand, {});
    if (question.pass) {
      require(bool(advised.open), "a pass needs the stand without its bite");
      rolled_.emplace(*question.pass, advised.open, question.force);
      advice_.pass = rolled_->now();
      if (advice_.pass->no_bite)
        rolled_.reset();
    }
  }

  LevelAdvice advise()
  {
    std::vector<Part> parts = all_parts();
    std::vector<RatedAction> singles;
    for (Part &part : parts)
      singles.push_back(rated({&part}));
    std::vector<RatedAction> all = singles;
    for (const auto &[a, b] : pairs(parts, singles)) {
      RatedAction pair = rated({&parts[a], &parts[b]});
      pair.apart       = (1 + singles[a].change) * (1 + singles[b].change) - 1;
      all.push_back(std::move(pair));
    }
    rank(all);
    for (std::size_t i = 0; i < above_the_line(all); ++i)
      all[i].spread = spread(all[i]);
    advice_.actions = std::move(all);
    return std::move(advice_);
  }

private:
  const AdvisedStand &own_;
  const LevelQuestion &asked_;
  LevelAdvice advice_;
  std::vector<dynamics::Pole> poles_;
  std::optional<RolledLevel> rolled_;

  std::vector<Part> all_parts()
  {
    std::vector<Part> parts;
    for (const SpringChoice &spring : asked_.springs)
      for (const double factor : {spring.softer, spring.stiffer})
        if (factor != 1) {
          parts.push_back({fmt::format("{} x {:g}", spring.name, factor), {spring.name}, spring.means});
          parts.back().spring = spring.name;
          parts.back().factor = factor;
        }
    for (const double factor : asked_.damping)
      if (factor != 1) {
        parts.push_back(
            {fmt::format("{} x {:g}", of_damping, factor), {of_damping}, "joints, liners and bearings"});
        parts.back().damping = factor;
      }
    for (const DamperChoice &damper : asked_.dampers) {
      parts.push_back({damper.name, {}, "dampers between the chocks"});
      parts.back().dampers = damper.joined;
      for (const Attachment &one : damper.joined)
        parts.back().parameters.push_back(damper_between(one));
    }
    for (const TunedChoice &tuned : asked_.tuned)
      parts.push_back(tuned_part(tuned));
    if (rolled_ && rolled_->settled())
      for (const ProcessAction &action : process_actions(asked_.pass->model.bite, asked_.pass->process)) {
        parts.push_back({action.name, {action.parameter}, action.means});
        parts.back().process = action;
      }
    return parts;
  }

  Part tuned_part(const TunedChoice &choice)
  {
    const int mode    = leading_mode(own_.stand, asked_.place, choice.place_index, asked_.force);
    const double mass = effective_mass(own_.stand, mode, choice.place_index);
    const double mu   = std::isnan(choice.mass) ? choice.mass_ratio : choice.mass / mass;
    TunedDamper tuned = tune(own_.stand, {}, asked_.place, closed_tuning(own_.stand, mode, choice.place_index, mu),
                             asked_.force, advice_.level[asked_.place]);
    tuned.mode        = mode;
    tuned.effective_mass = mass;
    Part part;
    part.name       = fmt::format("tuned damper {:.4g} kg, {}", tuned.best.mass,
                                  own_.stand.places[std::size_t(choice.place_index)]);
    part.parameters = {part.name};
    part.means      = "a mass on a spring and a damper";
    part.tuned      = tuned.best;
    advice_.tuned_names.push_back(part.name);
    advice_.tuned.push_back(std::move(tuned));
    return part;
  }

  // The best singles that help, of different parameters, two by two.
  std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<Part> &parts,
                                                         const std::vector<RatedAction> &singles) const
  {
    std::vector<std::size_t> order(parts.size()), best;
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto a, const auto b) { return singles[a].gain > singles[b].gain; });
    for (const std::size_t i : order)
      if (singles[i].gain > nothing && !singles[i].kept_apart && int(best.size()) < asked_.paired &&
          std::none_of(best.begin(), best.end(), [&](const auto j) { return share_one(parts[j], parts[i]); }))
        best.push_back(i);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < best.size(); ++i)
      for (std::size_t j = i + 1; j < best.size(); ++j)
        pairs.emplace_back(best[i], best[j]);
    return pairs;
  }

  VibratingStand changed(const std::vector<const Part *> &parts) const
  {
    Eigen::VectorXd damping = own_.stand.damping;
    bool springs            = false;
    for (const Part *part : parts) {
      damping *= part->damping;
      springs = springs || !part->spring.empty();
    }
    if (!springs) {
      VibratingStand stand = own_.stand;
      stand.damping        = damping;
      return stand;
    }
    dynamics::MillModel model = *own_.chain;
    for (const Part *part : parts)
      model = with_spring_scaled(std::move(model), part->spring, part->factor);
    return vibrating_stand(model, damping, own_.stand.gap_damper);
  }

  // ln of the change that the slopes foretell.
  double foretold(const Part &part, const std::vector<Attachment> &joined) const
  {
    const auto slope = [&](const std::string &name) {
      return own_.chain ? advice_.slopes.of(asked_.place, name) : std::numeric_limits<double>::quiet_NaN();
    };
    double sum = joined.empty() ? 0 : first_order(own_.stand, {}, joined, asked_.force)[asked_.place];
    if (!part.spring.empty())
      sum += slope(part.spring) * std::log(part.factor);
    if (part.damping != 1)
      sum += slope("zeta") * std::log(part.damping);
    if (part.process) {
      const Eigen::VectorXd slopes = rolled_->slope(*part.process);
      sum += slopes.size() > 0 ? slopes[asked_.place] * std::log(part.process->factor)
                               : std::numeric_limits<double>::quiet_NaN();
    }
    return sum;
  }

  RatedAction rated(const std::vector<const Part *> &parts)
  {
    RatedAction action;
    action.pair       = parts.size() > 1;
    action.stand      = changed(parts);
    double log_change = 0;
    for (const Part *part : parts) {
      action.name += (action.name.empty() ? "" : " and ") + part->name;
      action.means += (action.means.empty() || part->means.empty() ? "" : "; ") + part->means;
      action.parameters.insert(action.parameters.end(), part->parameters.begin(), part->parameters.end());
      std::vector<Attachment> dampers = part->dampers;
      if (part->tuned)
        dampers.push_back(*part->tuned);
      log_change += foretold(*part, dampers);
      action.joined.insert(action.joined.end(), part->dampers.begin(), part->dampers.end());
      if (!part->spring.empty())
        action.of_stand.springs.emplace_back(part->spring, part->factor);
      action.of_stand.damping *= part->damping;
      if (part->process)
        action.process.push_back(*part->process);
    }
    action.first_order = std::expm1(log_change);
    for (const Part *part : parts)  // in a pair tuned again, since the other action moves the mode
      if (part->tuned)
        action.joined.push_back(action.pair ? tune(action.stand, action.joined, asked_.place, *part->tuned,
                                                   asked_.force, advice_.level[asked_.place])
                                                  .best
                                            : *part->tuned);
    judge(action);
    return action;
  }

  void judge(RatedAction &action) const
  {
    const auto rolled =
        rolled_ ? rolled_->after(action.of_stand, action.joined, action.process) : std::optional<RolledState>();
    const Eigen::VectorXd after = level_after(action, rolled),
                          now   = action.process.empty() ? advice_.level : rolled_->level();
    action.change               = after[asked_.place] / now[asked_.place] - 1;
    action.verified             = action.change;
    const auto rolls            = std::min<Eigen::Index>(6, after.size());
    for (Eigen::Index i = 0; i < rolls; ++i) {
      if (i == asked_.place || !(now[i] > 0))
        continue;
      const double rise = after[i] / now[i] - 1;
      action.effects.push_back({own_.stand.places[std::size_t(i)] + ", level", rise, "1"});
      if (rise > asked_.rise_elsewhere && i > 0 && i < 5)
        action.against.push_back(fmt::format("the level of the {} rises by {:.3g} %, at most {:.3g} % are allowed",
                                             own_.stand.places[std::size_t(i)], 100 * rise,
                                             100 * asked_.rise_elsewhere));
    }
    const double softer = 1 - stand_stiffness(action.stand) / stand_stiffness(own_.stand);
    action.effects.push_back({"stiffness of the stand", -softer, "1"});
    if (softer > asked_.softening)
      action.against.push_back(fmt::format("the stand gets softer by {:.3g} %, at most {:.3g} % are allowed",
                                           100 * softer, 100 * asked_.softening));
    if (rolled)
      judge_pass(action, *rolled);
    judge_gain(action);
    action.modes = mode_words(poles_, poles(action.stand, action.joined));
    remark(action);
  }

  // (m) m/s2; NaN where vibration grows.
  Eigen::VectorXd level_after(const RatedAction &action, const std::optional<RolledState> &rolled) const
  {
    if (action.process.empty())
      return levels(action.stand, action.joined, asked_.force);
    return rolled && rolled->level.size() > 0
               ? rolled->level
               : Eigen::VectorXd::Constant(advice_.level.size(), std::numeric_limits<double>::quiet_NaN());
  }

  // Every action of one advice has these effects, in this order.
  void judge_pass(RatedAction &action, const RolledState &rolled) const
  {
    const CriticalState &now = rolled_->now(), &after = rolled.critical;
    action.nearer = rolled.nearer;
    action.effects.push_back({critical_over_working, rolled.nearer, "1"});
    action.effects.push_back({"force", after.force / now.force - 1, "1"});
    action.effects.push_back({"torque", after.torque / now.torque - 1, "1"});
    action.effects.push_back({"production", after.output / now.output - 1, "1"});
    if (!action.process.empty()) {
      const auto &against = rolled.violated.against;
      action.against.insert(action.against.end(), against.begin(), against.end());
      action.kept_apart = rolled.violated.kept_apart;
      if (rolled.level.size() == 0 && !after.no_bite)
        action.against.push_back("vibration grows at the working speed");
    }
    judge_nearer(action, asked_.pass->nearer_chatter);
  }

  // sd of the change by errors of springs and damping, each moved by one of its own, (46.9).  What is joined keeps
  // its numbers: a tuned damper is then out of tune.
  double spread(const RatedAction &action) const
  {
    if (!own_.chain || !action.process.empty())
      return std::numeric_limits<double>::quiet_NaN();
    const Eigen::VectorXd &all = asked_.force.frequency;
    const Eigen::Index every =
        std::max<Eigen::Index>(1, Eigen::Index(resolving_step(own_.stand, all[all.size() - 1]) *
                                               double(all.size()) / all[all.size() - 1]));
    ForceBand sparse;
    sparse.frequency = Eigen::VectorXd(all(Eigen::seq(every / 2, Eigen::last, every)));
    sparse.square    = Eigen::VectorXd(asked_.force.square(Eigen::seq(every / 2, Eigen::last, every)));
    const auto level = [&](dynamics::MillModel model, const double damping, const bool after) {
      if (after)
        for (const auto &[name, factor] : action.of_stand.springs)
          model = with_spring_scaled(std::move(model), name, factor);
      const VibratingStand stand = vibrating_stand(
          model, damping * (after ? action.of_stand.damping : 1) * own_.stand.damping, own_.stand.gap_damper);
      return levels(stand, after ? action.joined : std::vector<Attachment>(), sparse)[asked_.place];
    };
    const auto change = [&](const dynamics::MillModel &model, const double damping) {
      return level(model, damping, true) / level(model, damping, false) - 1;
    };
    const double as_it_is = change(*own_.chain, 1);
    double variance       = std::pow(change(*own_.chain, std::exp(asked_.damping_error)) - as_it_is, 2);
    for (const dynamics::Spring &spring : own_.chain->springs) {
      if (!(spring.stiffness > 0))
        continue;
      const auto known   = asked_.spring_error.find(spring.name);
      const double error = known == asked_.spring_error.end() ? assumed_spring_error : known->second;
      variance += std::pow(change(with_spring_scaled(*own_.chain, spring.name, 1 + error), 1) - as_it_is, 2);
    }
    return std::sqrt(variance);
  }

  void remark(RatedAction &action) const
  {
    if (!action.joined.empty() && own_.chain) {
      action.chain_only = action.remarks.size();
      action.remarks.push_back("chain only: a damper sits on chocks, which the six masses do not have");
    }
    for (const UnidentifiedParameter &one : asked_.unidentified) {
      const bool changed = std::count(action.parameters.begin(), action.parameters.end(), one.name) > 0;
      const double slope = own_.chain ? advice_.slopes.of(asked_.place, one.name) : 0;
      if (changed || std::abs(slope) > notable_slope)
        action.remarks.push_back("rests on " + one.name + ", " + one.why);
    }
  }
};
}  // namespace

void judge_gain(RatedAction &action)
{
  const std::string little = fmt::format("changes this level by less than {:g} %", 100 * nothing),
                    more   = "raises the level";
  auto &against            = action.against;
  against.erase(std::remove_if(against.begin(), against.end(),
                               [&](const std::string &reason) { return reason == little || reason == more; }),
                against.end());
  if (std::isnan(action.verified)) {
    action.gain = -std::numeric_limits<double>::infinity();
    return;
  }
  action.gain = -action.verified;
  if (std::abs(action.gain) <= nothing)
    against.push_back(little);
  else if (action.gain < 0)
    against.push_back(more);
}

void judge_nearer(RatedAction &action, const double allowed)
{
  const std::string nearer = "brings the critical speed nearer by ";
  auto &against            = action.against;
  against.erase(std::remove_if(against.begin(), against.end(),
                               [&](const std::string &reason) { return reason.find(nearer) == 0; }),
                against.end());
  for (SideEffect &effect : action.effects)
    if (effect.name == critical_over_working)
      effect.value = action.nearer;
  if (-action.nearer > allowed)
    against.push_back(
        fmt::format("{}{:.3g} %, at most {:.3g} % are allowed", nearer, -100 * action.nearer, 100 * allowed));
}

void rank(std::vector<RatedAction> &actions)
{
  std::stable_sort(actions.begin(), actions.end(), [](const RatedAction &a, const RatedAction &b) {
    if (a.against.empty() != b.against.empty())
      return a.against.empty();
    return a.gain > b.gain;
  });
}

std::size_t above_the_line(const std::vector<RatedAction> &ranked)
{
  return std::size_t(
      std::count_if(ranked.begin(), ranked.end(), [](const RatedAction &a) { return a.against.empty(); }));
}

LevelAdvice level_advice(const AdvisedStand &advised, const LevelQuestion &question)
{
  return LevelAdviser(advised, question).advise();
}

LevelAdvice ranked_actions(const dynamics::MillModel &model, const Eigen::VectorXd &damping,
                           const LevelQuestion &question, const double gap_damper)
{
  return level_advice({vibrating_stand(model, damping, gap_damper), model}, question);
}
}  // namespace mill::twin
