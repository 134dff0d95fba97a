#include "app/cluster/cluster_chatter.h"
#include "app/chatter/chatter_question.h"
#include "app/chatter/chatter_results.h"
#include "app/chatter/pass_studies.h"
#include "app/cluster/cluster_bite.h"
#include "app/stages/stability/stability_question.h"
#include "app/stages/stability/uncertain_numbers.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include "core/records/result_names.h"
#include "core/records/speed_verdict.h"
#include "dynamics/chatter/modal_inputs.h"
#include "reduce/stand/gap_modes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_damping  = 0.01;  // -, of critical, where no loss factor is given
constexpr double usual_distance = 5;     // m, of free strip
constexpr double unseen = 1e-6;  // -, of the gap's compliance: the bite moves a mode by less than any damping

// The modes of the open stand that the gap sees.
cluster::GapStandModes seen_modes(const cluster::GapStand &gap)
{
  const cluster::GapStandModes all = cluster::modes_of(gap, 0);
  const Eigen::VectorXd share      = reduce::gap_shares(all.frequency, all.shape, gap.b);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < share.size(); ++k)
    if (share[k] > unseen)
      kept.push_back(k);
  cluster::GapStandModes seen;
  const auto n   = Eigen::Index(kept.size());
  seen.frequency = Eigen::VectorXd(n);
  seen.damping   = Eigen::VectorXd(n);
  seen.shape     = Eigen::MatrixXd(all.shape.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    seen.frequency[i] = all.frequency[kept[std::size_t(i)]];
    seen.damping[i]   = all.damping[kept[std::size_t(i)]];
    seen.shape.col(i) = all.shape.col(kept[std::size_t(i)]);
  }
  return seen;
}

struct Points {
  std::vector<std::string> labels;
  Eigen::MatrixXd rows;  // (points, n)
};

// Every roll upwards, then along the rolling direction.  @param away  positive away from the strip, else upwards
Points points_of(const ClusterStand &stand, const cluster::Stack &stack, const bool away)
{
  const StripRolls rolls = strip_rolls(stand);
  Points points;
  points.rows      = Eigen::MatrixXd::Zero(2 * Eigen::Index(stack.rolls.size()), stack.size());
  Eigen::Index row = 0;
  for (const int direction : {1, 0})
    for (std::size_t i = 0; i < stack.rolls.size(); ++i) {
      const bool down = away && direction == 1 && !rolls.is_upper(stack, i);
      points.rows(row++, stack.per_roll() * Eigen::Index(i) + direction) = down ? -1 : 1;
      const std::string name = int(i) == rolls.upper && direction == 1 ? "upper work roll"
                               : int(i) == rolls.lower && direction == 1
                                   ? "lower work roll"
                                   : stack.rolls[i].name + (direction ? " y" : " x");
      points.labels.push_back(name);
    }
  return points;
}

Eigen::MatrixXd in_modes(const Eigen::MatrixXd &K, const Eigen::MatrixXd &shape)
{
  return shape.transpose() * K * shape;
}

// Damping of the modes as it follows springs: that of loss factors, or one ratio where the case gives none.
dynamics::DampingOfModes damping_that_follows(const cluster::GapStand &gap, const cluster::GapStandModes &modes)
{
  if (modes.damping.isZero(0))
    return {usual_damping, {}};
  return {0, in_modes(gap.loss, modes.shape)};
}

// A group of contacts and supports: its part of K and of the loss, N/m.
struct GroupParts {
  Eigen::MatrixXd K, loss;
};
GroupParts group_parts(const cluster::GapStand &gap, const StiffnessGroup &group)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(gap.K.rows(), gap.K.cols()), loss = K;
  for (const std::size_t i : group.contacts) {
    K += gap.contacts[i];
    loss += gap.contact_losses[i];
  }
  for (const std::size_t i : group.supports) {
    K += gap.supports[i];
    loss += gap.support_losses[i];
  }
  return {K, loss};
}

dynamics::ModalChange change_of(const GroupParts &parts, const cluster::GapStandModes &modes)
{
  return {in_modes(parts.K, modes.shape), {}, in_modes(parts.loss, modes.shape)};
}

// The mode with the largest share in the compliance of the gap.
// @param w    (n) rad/s
// @param gap  (n) its opening in each mode
Eigen::Index leading_mode(const Eigen::VectorXd &w, const Eigen::VectorXd &gap)
{
  Eigen::Index leading = 0;
  gap.cwiseQuotient(w).cwiseAbs().maxCoeff(&leading);
  return leading;
}
}  // namespace

StripRolls strip_rolls(const ClusterStand &stand)
{
  StripRolls rolls;
  rolls.upper     = cluster::strip_roll(stand);
  const auto dash = stand.stack.strip.find('-');
  if (dash == std::string::npos)
    return rolls;
  const std::string name = stand.stack.strip.substr(dash + 1);
  for (std::size_t i = 0; i < stand.rolls.size(); ++i)
    if (stand.rolls[i].name == name)
      rolls.lower = int(i);
  return rolls;
}

bool StripRolls::is_upper(const cluster::Stack &stack, const std::size_t roll) const
{
  const auto y = [&](const int i) { return stack.rolls[std::size_t(i)].centre.y(); };
  return lower < 0 || y(int(roll)) > 0.5 * (y(upper) + y(lower));
}

KeyList keys_of_bite(const Case &the_case, const std::size_t p)
{
  KeyList keys           = cluster_keys(the_case, p, false);
  const auto begins_with = [](const std::string &key, const std::string &start) {
    return key.rfind(start, 0) == 0;
  };
  const KeyList read = joined(keys_in("response", "loss_factor support_loss_factor"),
                              keys_in(fmt::format("pass.{}", p), "speed entry_thickness exit_thickness entry_pull "
                                                                 "exit_pull entry_tension exit_tension"));
  for (const auto &[key, place] : the_case.places)
    if (begins_with(key, "strip.") || begins_with(key, "stand.") || begins_with(key, "analysis.") ||
        holds(read, key))
      keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

cluster::GapStand gap_stand_of(const ClusterStand &stand, const cluster::PassState &state)
{
  const StripRolls rolls = strip_rolls(stand);
  return cluster::gap_stand(state.stack, state.rest.u, rolls.upper, rolls.lower);
}

Eigen::VectorXd damping_of(const cluster::GapStandModes &modes)
{
  if (modes.damping.isZero(0))
    return Eigen::VectorXd::Constant(modes.damping.size(), usual_damping);
  return modes.damping;
}

std::vector<StiffnessGroup> stiffness_groups(const ClusterStand &stand)
{
  std::vector<StiffnessGroup> groups;
  const auto group = [&](const std::string &kind, const std::string &name) -> StiffnessGroup & {
    const std::string key = kind + "." + name;
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&](const StiffnessGroup &one) { return one.key == key; });
    if (known != groups.end())
      return *known;
    groups.push_back({key, kind + " " + name, {}, {}});
    return groups.back();
  };
  for (std::size_t i = 0; i < stand.contacts.size(); ++i) {
    const ClusterContact &c = stand.contacts[i];
    group("contact", c.like.empty() ? c.pair : c.like).contacts.push_back(i);
  }
  for (std::size_t i = 0; i < stand.supports.size(); ++i) {
    const ClusterSupport &s = stand.supports[i];
    group("support", s.like.empty() ? s.own_name() : s.like).supports.push_back(i);
  }
  return groups;
}

dynamics::StandStructure structure_of(const ClusterStand &stand, const cluster::Stack &stack,
                                      const cluster::GapStand &gap)
{
  const cluster::GapStandModes modes = seen_modes(gap);
  const Points points                = points_of(stand, stack, true);
  const Eigen::VectorXd w            = 2 * M_PI * modes.frequency;
  dynamics::StandStructure s;
  s.name   = "roll stack";
  s.M      = Eigen::MatrixXd::Identity(w.size(), w.size());
  s.C      = (2 * damping_of(modes).cwiseProduct(w)).asDiagonal();
  s.K      = w.cwiseAbs2().asDiagonal();
  s.b      = modes.shape.transpose() * gap.b;
  s.labels = points.labels;
  s.point  = points.rows * modes.shape;
  return s;
}

std::vector<dynamics::StructureNumber> cluster_numbers(const ClusterStand &stand, const cluster::Stack &stack,
                                                       const cluster::GapStand &gap)
{
  const cluster::GapStandModes modes = seen_modes(gap);
  const Eigen::MatrixXd C            = structure_of(stand, stack, gap).C;
  std::vector<dynamics::StructureNumber> numbers;
  for (const StiffnessGroup &group : stiffness_groups(stand)) {
    const GroupParts parts             = group_parts(gap, group);
    const dynamics::ModalChange change = change_of(parts, modes);
    dynamics::StructureNumber n;
    n.kind   = dynamics::NumberKind::spring;
    n.key    = group.key;
    n.name   = "stiffness of " + group.name;
    n.unit   = "N/m";
    n.value  = parts.K.cwiseAbs().maxCoeff();
    n.K_by   = change.dK;
    n.C_by   = dynamics::damping_by(modes.frequency, damping_that_follows(gap, modes), change);
    n.scaled = [=](const double factor) {
      return structure_of(stand, stack, cluster::scaled(gap, group.contacts, group.supports, factor));
    };
    if (n.value > 0 && n.K_by.cwiseAbs().maxCoeff() > 0)
      numbers.push_back(n);
  }
  dynamics::StructureNumber damping;
  damping.kind   = dynamics::NumberKind::damping_ratio;
  damping.key    = "response.loss_factor";
  damping.name   = "damping of the stack";
  damping.unit   = "1";
  damping.value  = 2 * damping_of(modes).maxCoeff();
  damping.C_by   = C;
  damping.scaled = [=](const double factor) {
    dynamics::StandStructure s = structure_of(stand, stack, gap);
    s.C *= factor;
    return s;
  };
  numbers.push_back(damping);
  return numbers;
}

ClusterChatter chatter_question(const Case &the_case, const ClusterStand &stand, const std::size_t p,
                                const ClusterForce &force, const cluster::PassState &state)
{
  const ClusterPass &pass = stand.schedule[p];
  if (const std::string missing = missing_of_chatter(stand, p); !missing.empty())
    throw InputError(pass.place, fmt::format("pass \"{}\": its critical speed needs {}", pass.name, missing));
  const auto rolled = rolled_bite(stand, pass, force);
  ClusterChatter asked;
  asked.gap           = gap_stand_of(stand, state);
  asked.stack         = state.stack;
  ChatterQuestion &q  = asked.question;
  q.bite              = rolled->bite;
  q.condition         = condition_of(pass, q.bite.strip);
  q.label             = pass.name;
  q.analysis          = stand.analysis;
  q.scheme            = stand.analysis.linearisation;
  const auto distance = [&](const double given, const char *key) {
    if (!std::isnan(given))
      return given;
    asked.assumed.push_back(
        fmt::format("stand.{} is not given: {:g} m of free strip are assumed", key, usual_distance));
    return usual_distance;
  };
  q.stand = {structure_of(stand, state.stack, asked.gap), distance(stand.span.entry_distance, "entry_distance"),
             distance(stand.span.exit_distance, "exit_distance"), q.bite.strip.youngs_modulus};
  if (seen_modes(asked.gap).damping.isZero(0))
    asked.assumed.push_back(fmt::format("response.loss_factor is not given: every mode of the stack has {:g} % of "
                                        "critical damping in the search of the critical speed",
                                        100 * usual_damping));
  asked.assumed.push_back(fmt::format("pass \"{}\": the critical speed is that of a bite with the flow stress {}",
                                      pass.name, rolled->stress));
  q.structure  = fmt::format("roll stack under {:.5g} kN, {} modes that open the gap", 1e-3 * force.value,
                             q.stand.structure.n());
  q.structures = {{"roll stack", q.stand, {}}};
  q.numbers    = cluster_numbers(stand, state.stack, asked.gap);
  q.structures.front().numbers = q.numbers;
  q.inputs                     = keys_of_bite(the_case, p);
  return asked;
}

void solve_cluster_chatter(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes)
{
  study_passes(run, passes.size(), [&](const std::size_t i) {
    const ClusterPassRun &pass = passes[i];
    const ClusterChatter asked = chatter_question(run.the_case, stand, pass.p, pass.force, pass.state);
    for (const std::string &sentence : asked.assumed)
      run.assume(sentence);
    return study_chatter(run, asked.question);
  });
}

namespace {
// Roll at the strip and what carries it, in each stack: the names of the modes need no more.
void keep_stack_motions(dynamics::StandStructure &structure, const ClusterStand &stand, const ClusterPassRun &pass,
                        const cluster::GapStandModes &modes)
{
  const StripRolls rolls = strip_rolls(stand);
  structure.labels.clear();
  structure.point            = Eigen::MatrixXd::Zero(rolls.lower < 0 ? 2 : 4, modes.shape.cols());
  const Eigen::VectorXd mass = cluster::masses(pass.state.stack);
  for (const bool upper : {true, false}) {
    Eigen::VectorXd of_stack = Eigen::VectorXd::Zero(mass.size());
    for (std::size_t i = 0; i < pass.state.stack.rolls.size(); ++i)
      if (const int row = pass.state.stack.per_roll() * int(i); rolls.is_upper(pass.state.stack, i) == upper)
        of_stack.segment(row, pass.state.stack.per_roll()) = mass.segment(row, pass.state.stack.per_roll());
    structure.stack_mass[upper ? 0 : 1] = modes.shape.transpose() * of_stack.asDiagonal() * modes.shape;
  }
  for (const bool upper : {true, false}) {
    if (!upper && rolls.lower < 0)
      continue;
    const std::string side = upper ? "upper" : "lower";
    const auto row         = Eigen::Index(structure.labels.size());
    for (Eigen::Index k = 0; k < modes.shape.cols(); ++k) {
      const cluster::StripMotion motion =
          cluster::strip_motion(pass.state.stack, pass.state.rest.contact_loads, upper ? rolls.upper : rolls.lower,
                                upper ? 1 : -1, modes.shape.col(k));
      structure.point(row, k)     = motion.work_roll;
      structure.point(row + 1, k) = motion.carrier;
    }
    structure.labels.insert(structure.labels.end(), {side + " work roll", side + " backup roll"});
  }
}

// Contacts and supports that are one number are off together.
StabilityQuestion stability_question(const RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                                     const ClusterChatter &asked)
{
  const ChatterQuestion &from            = asked.question;
  const cluster::GapStandModes modes     = seen_modes(asked.gap);
  const dynamics::DampingOfModes damping = damping_that_follows(asked.gap, modes);
  StabilityQuestion q;
  q.pass          = pass.pass->name;
  q.speed         = pass.pass->speed;
  q.K4            = strip_spring(stand, *pass.pass, pass.force);
  q.model         = from.structure;
  q.leading.stand = from.stand;
  keep_stack_motions(q.leading.stand.structure, stand, pass, modes);
  q.leading.modal_damping = damping.ratio;
  q.leading.loss          = damping.loss;
  q.leading.bite          = from.bite;
  q.leading.scheme        = from.scheme;
  q.leading.range         = speed_range(stand.analysis);
  UncertainNumbers uncertain;
  for (const StiffnessGroup &group : stiffness_groups(stand)) {
    const auto same = [&](const dynamics::StructureNumber &number) { return number.key == group.key; };
    if (std::none_of(from.numbers.begin(), from.numbers.end(), same))
      continue;  // it moves nothing
    dynamics::UncertainNumber one{group.key, usual_error::spring_or_mass};
    one.structure = change_of(group_parts(asked.gap, group), modes);
    uncertain.numbers.push_back(std::move(one));
  }
  uncertain.assumed = fmt::format("{:g} % for contacts and supports", 100 * usual_error::spring_or_mass);
  add_pass_numbers(uncertain, fitted_errors(run), from.bite, stand.span, not_given);
  q.uncertain = std::move(uncertain.numbers);
  q.assumed   = std::move(uncertain.assumed);
  q.inputs    = from.inputs;
  return q;
}
}  // namespace

void add_critical_speeds(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes)
{
  for (const ClusterPassRun &pass : passes) {
    const std::string missing = missing_of_chatter(stand, pass.p);
    search_critical_speed(run, pass.pass->name, pass.pass->speed,
                          missing.empty() ? std::vector<std::string>{} : split(missing, ", "), [&] {
                            const ClusterChatter asked =
                                chatter_question(run.the_case, stand, pass.p, pass.force, pass.state);
                            for (const std::string &sentence : asked.assumed)
                              run.assume(sentence);
                            return stability_question(run, stand, pass, asked);
                          });
  }
}

DrivenStand driven_cluster(RunContext &run, const std::string &wanted)
{
  const ClusterStand &stand = *std::get<ClusterCase>(run.the_case.spec).stand;
  const auto pass           = std::find_if(stand.schedule.begin(), stand.schedule.end(),
                                           [&](const ClusterPass &one) { return wanted.empty() || one.name == wanted; });
  if (pass == stand.schedule.end())
    throw InputError("--pass \"" + wanted + "\": the case has no pass of this name");
  const ClusterForce force           = cluster_force(stand, *pass);
  const cluster::PassState state     = cluster::pass_state(stand, *pass, force.value, computed_laws(run, stand));
  const StripRolls rolls             = strip_rolls(stand);
  const cluster::GapStand gap        = gap_stand_of(stand, state);
  const cluster::GapStandModes modes = seen_modes(gap);  // the force moves no other
  const Points points                = points_of(stand, state.stack, false);
  const Eigen::Index leading         = leading_mode(2 * M_PI * modes.frequency, modes.shape.transpose() * gap.b);
  dynamics::ModalModel modal;
  modal.labels    = points.labels;
  modal.frequency = modes.frequency;
  modal.point     = points.rows * modes.shape;
  modal.force     = modes.shape.transpose() * gap.b;
  modal.damping   = damping_of(modes)[leading];
  // What the supports above the strip take up; of a stack of one half that of the half.
  Eigen::VectorXd row = Eigen::VectorXd::Zero(gap.M.size());
  for (std::size_t i = 0; i < gap.supports.size(); ++i)
    if (rolls.is_upper(state.stack, std::size_t(state.stack.supports[i].roll)))
      row += gap.supports[i].row(state.stack.per_roll() * state.stack.supports[i].roll + 1).transpose() /
             (rolls.lower < 0 ? 2 : 1);
  modal.load_cell = modes.shape.transpose() * row;
  DrivenStand driven;
  driven.modes                  = modal;
  driven.dynamics.force_meaning = ForceMeaning::measured;
  driven.dynamics.modal_damping = modal.damping;
  driven.pass                   = *pass;
  driven.load                   = force.value;
  const double other            = (damping_of(modes).array() / modal.damping - 1).abs().maxCoeff();
  if (other > 1e-9)
    driven.warnings.push_back(
        {WarningId::one_damping_ratio, "",
         fmt::format("the exported stand has one damping ratio for all modes, {:.3g} % of critical",
                     100 * modal.damping),
         fmt::format("that of the mode at {:.5g} Hz, which has the largest share in the compliance of the gap",
                     modes.frequency[leading])});
  return driven;
}
}  // namespace mill
