#pragma once
#include "app/chatter/chatter_study.h"
#include "app/cluster/cluster_results.h"
#include "dynamics/cluster/gap_stand.h"

// A pass of a cluster as the verbs chatter, advise and export have it: M, C, K and the row of the gap, as a
// four-high has them.  theory.md 38.11
namespace mill {
/// Which rolls the strip runs between, and on which side of it a roll lies.
struct StripRolls {
  int upper = 0, lower = -1;  ///< -1: the stack is the upper half
  bool is_upper(const cluster::Stack &stack, std::size_t roll) const;
};
StripRolls strip_rolls(const ClusterStand &stand);

/// Keys that the bite of pass p and its stack follow.
KeyList keys_of_bite(const Case &the_case, std::size_t p);

/// The stack of a pass as the strip sees it.
cluster::GapStand gap_stand_of(const ClusterStand &stand, const cluster::PassState &state);

/// Ratio of critical of every mode: half of its loss factor; 1 % where the case gives no loss factor at all.
Eigen::VectorXd damping_of(const cluster::GapStandModes &modes);

/// Contacts and supports whose stiffness is one number: one of them with its mirror images.
struct StiffnessGroup {
  std::string key, name;  ///< "contact.W-R", "contact W-R"
  std::vector<std::size_t> contacts, supports;
};
std::vector<StiffnessGroup> stiffness_groups(const ClusterStand &stand);

/// In the modes that the gap sees (share of its compliance above 1e-12; the others have no part in chatter).
/// Points: every roll upwards, then along the rolling direction, positive away from the strip; the rolls at the
/// strip are "upper work roll" and "lower work roll".
dynamics::StandStructure structure_of(const ClusterStand &stand, const cluster::Stack &stack,
                                      const cluster::GapStand &gap);

/// Stiffness of every group, and the damping.  Keys contact.PAIR, support.NAME, response.loss_factor.
std::vector<dynamics::StructureNumber> cluster_numbers(const ClusterStand &stand, const cluster::Stack &stack,
                                                       const cluster::GapStand &gap);

/// The pass as a working condition, with what the case does not say, one sentence each.
struct ClusterChatter {
  ChatterQuestion question;
  cluster::GapStand gap;
  cluster::Stack stack;
  std::vector<std::string> assumed;
};
/// @throws InputError  keys that are missing, named with the place of the pass; what the bite refuses
ClusterChatter chatter_question(const Case &the_case, const ClusterStand &stand, std::size_t pass,
                                const ClusterForce &force, const cluster::PassState &state);

/// Verb chatter: every pass that says enough.
/// @throws InputError  none does: which keys the first one lacks
void solve_cluster_chatter(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes);

/// A run: critical speed with its interval and the verdict of every pass, as a four-high has them; the verdict of
/// a pass that does not say enough names the keys.
void add_critical_speeds(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes);

/// The stand of one pass in its modes, for export.
DrivenStand driven_cluster(RunContext &run, const std::string &pass);
}  // namespace mill
