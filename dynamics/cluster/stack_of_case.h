#pragma once
#include "core/model/cluster.h"
#include "dynamics/cluster/equilibrium.h"
#include "dynamics/cluster/modes.h"
#include <map>

// From the case file to a stack.  theory.md 38.1
namespace mill::cluster {
/// Laws of contacts that finite elements have computed, by pair.
using ComputedLaws = std::map<std::string, ContactLaw>;

/// Every `like` written out: mirror images about the vertical.
ClusterStand written_out(ClusterStand stand);

/// Unloaded axes of all rolls: given, or found from contacts.
/// @throws InputError  rolls that cannot be placed, contacts that do not close (by how much), rolls that overlap:
/// all of
///                     them, each at its place
std::vector<Eigen::Vector2d> placed_rolls(const ClusterStand &stand);

/// The stack under one pass.
/// @param force     N, rolling force
/// @param computed  laws of contacts with law = "computed"; Johnson's closed form for the others
Stack stack_of(const ClusterStand &stand, const ClusterPass &pass, double force,
               const ComputedLaws &computed = {});

/// Index of the roll at the strip, of the upper one.
int strip_roll(const ClusterStand &stand);

/// A motion of the stack in which one roll moves most.
struct FreeMotion {
  int roll     = 0;      ///< in Stack::rolls
  bool along_y = false;  ///< moves more along y than along x
};
/// Motions that nothing holds at all, on the unloaded geometry.  What only the curvature of the contacts holds or
/// drives away is free.
std::vector<FreeMotion> free_motions(const Stack &stack);

std::vector<NamedShape> named_shapes(const ClusterStand &stand, const Stack &stack);

/// The state and modes of one pass.
struct PassState {
  Stack stack;  ///< anchors set
  Equilibrium rest;
  std::vector<Mode> modes;
  std::vector<int> identity;  ///< of every [[mode]]: which of modes
};
/// @throws SolverError  no equilibrium
PassState pass_state(const ClusterStand &stand, const ClusterPass &pass, double force,
                     const ComputedLaws &computed = {});
}  // namespace mill::cluster
