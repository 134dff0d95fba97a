#include "app/cluster/cluster_modes.h"
#include "app/cluster/cluster_bite.h"
#include "core/model/case.h"
#include "core/records/named_mode.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "reduce/stand/gap_modes.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
// A stack moves with its roll at the strip and with the rolls above or below it.
reduce::StackMotion stack_motion(const cluster::PassState &state, const std::vector<double> &kinetic,
                                 const StripRolls &rolls, const bool upper, const Eigen::VectorXd &shape)
{
  reduce::StackMotion motion;
  motion.side = rolls.lower < 0 ? "" : upper ? "upper" : "lower";
  for (std::size_t i = 0; i < kinetic.size(); ++i)
    if (rolls.is_upper(state.stack, i) == upper)
      motion.kinetic += kinetic[i];
  const cluster::StripMotion strip = cluster::strip_motion(
      state.stack, state.rest.contact_loads, upper ? rolls.upper : rolls.lower, upper ? 1 : -1, shape);
  motion.work_roll   = strip.work_roll;
  motion.backup_roll = strip.carrier;
  return motion;
}

reduce::GapMotion gap_motion(const cluster::PassState &state, const cluster::GapStand &gap,
                             const StripRolls &rolls, const double frequency, const double share,
                             const Eigen::VectorXd &shape)
{
  static const char *const direction[] = {"horizontal", "vertical", "turning"};
  static const char *const key[]       = {"x", "y", "turn"};
  const cluster::Stack &stack          = state.stack;
  reduce::GapMotion motion;
  motion.frequency = frequency;
  motion.gap_share = share;
  std::vector<double> kinetic(stack.rolls.size());
  for (std::size_t i = 0; i < stack.rolls.size(); ++i)
    for (int k = 0; k < stack.per_roll(); ++k) {
      const Eigen::Index unknown = stack.per_roll() * Eigen::Index(i) + k;
      const double part          = gap.M[unknown] * shape[unknown] * shape[unknown];  // of a mass-normalised mode
      const std::string &roll    = stack.rolls[i].name;
      motion.parts.push_back({"roll " + roll, fmt::format("roll {}, {}", roll, direction[k]),
                              fmt::format("roll_{}_{}", roll, key[k]), part});
      kinetic[i] += part;
    }
  motion.stacks.push_back(stack_motion(state, kinetic, rolls, true, shape));
  if (rolls.lower >= 0)
    motion.stacks.push_back(stack_motion(state, kinetic, rolls, false, shape));
  return motion;
}

void add_state(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass, const std::string &state,
               const double K4, const KeyList &keys)
{
  const NamedStackModes named = named_modes(stand, pass.state, K4);
  for (std::size_t k = 0; k < named.names.size(); ++k) {
    const reduce::ModeName &name = named.names[k];
    if (!is_listed(name))
      continue;
    Parameter f;
    f.value = named.modes.frequency[Eigen::Index(k)];
    f.unit  = "Hz";
    f.method =
        mode_method({name.name, name.decided,
                     fmt::format("roll stack {} (38.29)",
                                 K4 > 0 ? fmt::format("with K4 = {:.5g} kN/mm between the work rolls", 1e-6 * K4)
                                        : std::string("without the spring of the strip"))});
    f.at            = {"{}", {{pass.force.value, "kN", ".5g"}}};
    f.inputs        = keys;
    f.error_lacks   = {"stiffness of the supports"};
    Parameter share = f;
    share.value     = name.gap_share;
    share.unit      = "1";
    share.method    = name.name + ": share in the static compliance of the gap (22.23)";
    run.results.add(row::modes::frequency.of(state, name.key), f);
    run.results.add(row::modes::gap_share.of(state, name.key), share);
  }
}
}  // namespace

bool is_listed(const reduce::ModeName &name)
{
  return !name.key.empty() && name.gap_share >= reduce::least_share_listed;
}

NamedStackModes named_modes(const ClusterStand &stand, const cluster::PassState &state, const double K4)
{
  const cluster::GapStand gap = gap_stand_of(stand, state);
  const StripRolls rolls      = strip_rolls(stand);
  NamedStackModes named{cluster::modes_of(gap, K4), {}};
  const Eigen::VectorXd share = reduce::gap_shares(named.modes.frequency, named.modes.shape, gap.b);
  std::vector<reduce::GapMotion> motions;
  for (Eigen::Index k = 0; k < share.size(); ++k)
    motions.push_back(gap_motion(state, gap, rolls, named.modes.frequency[k], share[k], named.modes.shape.col(k)));
  named.names = reduce::gap_mode_names(motions);
  return named;
}

void add_gap_modes(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass)
{
  add_state(run, stand, pass, family::open, 0, pass.keys);
  const double K4 = strip_spring(stand, *pass.pass, pass.force);
  if (K4 > 0)
    add_state(run, stand, pass, "", K4, keys_of_bite(run.the_case, pass.p));
  else
    run.assume(fmt::format("pass \"{}\": the modes of the rolling state (mode.*) need K4: give {}, or "
                           "stack.strip_stiffness; those of the open gap are open.mode.*",
                           pass.pass->name, missing_of_bite(stand, pass.p)));
}
}  // namespace mill
