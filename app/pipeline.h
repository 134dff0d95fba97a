#pragma once
#include "app/run_context.h"

namespace mill {
struct FourHigh;
struct Lumped;

/// How far a run goes; each goal needs the ones above it, but chatter and simulate, which stand beside each other.
enum class Goal { stiffness, masses, modes, chatter, simulate };

/// The stages of a case in order, up to the goal.  Results, curves and the lumped model are in the run's
/// folder afterwards.
/// @param force_file  replaces the force record of every pass (simulate --force); empty: none
void run_stages(RunContext &run, Goal goal, const std::string &force_file = "");

/// Those of kind "four-high" and of kind "lumped".
void run_four_high(RunContext &run, FourHigh stand, Goal goal, const std::string &force_file);
void run_lumped(RunContext &run, Lumped lumped, Goal goal, const std::string &force_file);
}  // namespace mill
