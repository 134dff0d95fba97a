#pragma once
#include "app/cluster/cluster_chatter.h"
#include "reduce/stand/mode_name.h"

namespace mill {
/// Modes of the stack in one state of its gap, named by what they do to it.
struct NamedStackModes {
  cluster::GapStandModes modes;
  std::vector<reduce::ModeName> names;
};
/// @param K4  N/m, between the rolls at the strip; 0: open
NamedStackModes named_modes(const ClusterStand &stand, const cluster::PassState &state, double K4);

/// Has the mode results of its own: a name, and a share of the gap that is worth a row.
bool is_listed(const reduce::ModeName &name);

/// mode.* with K4 between the rolls at the strip, open.mode.* without, of the first pass.
void add_gap_modes(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass);
}  // namespace mill
