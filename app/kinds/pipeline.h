#pragma once
#include "app/run/driven_stand.h"
#include "app/run/run_context.h"
#include <string>
#include <vector>

namespace mill {
struct FourHigh;
struct Lumped;
struct LumpedModel;
struct Pass;

/// Those of kind "four-high" and of kind "lumped", from the stages that are needed for it.
/// @param pass  its name; empty: the first
/// @throws InputError  no pass of this name
DrivenStand driven_four_high(RunContext &run, FourHigh stand, const std::string &pass);
DrivenStand driven_lumped(RunContext &run, const Lumped &lumped, const std::string &pass);

/// The stages of a case in order, up to the goal.  Results, curves and the lumped model are in the run's
/// folder afterwards.
/// @param force_file  replaces the force record of every pass (simulate --force); empty: none
void run_stages(RunContext &run, Goal goal, const std::string &force_file = "");

/// Those of kind "four-high" and of kind "lumped".
void run_four_high(RunContext &run, FourHigh stand, Goal goal, const std::string &force_file);
void run_lumped(RunContext &run, Lumped lumped, Goal goal, const std::string &force_file);

/// M1..M6, K1..K7, C of a chain as results.  @param pass  "pass 2" of a later pass; empty: the first
void add_chain_results(RunContext &run, const LumpedModel &model, const std::string &pass);
/// Place of a pass by its name; the first where none is named.  @throws InputError  no pass has this name
std::size_t place_of_pass(const std::vector<Pass> &passes, const std::string &wanted);
}  // namespace mill
