#pragma once
#include "app/kinds/pipeline.h"
#include "app/run/driven_stand.h"
#include "app/stack/stack_stage.h"
#include "core/model/pass.h"
#include "dynamics/chatter/stand_structure.h"
#include "reduce/bite/bite.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stack/moving_stack.h"
#include "reduce/stand/stand_comparison.h"
#include <memory>
#include <optional>
#include <string>
#include <vector>

// A solved stack in motion: its modes with their names, in both states of the gap.  theory.md 51.6
namespace mill {
/// A pass of a stack: the state under its force, and small motion about it.
struct MovingPass {
  Pass pass;
  double force = 0;    ///< N, under which the stack is solved
  ForceRecord record;  ///< empty: the pass has none
  Stack stack;
  std::shared_ptr<reduce::BeamStack> engine;
  reduce::StackState state;
  reduce::MovingStack moving, lumped;
  reduce::StandWithModes open;                    ///< without the strip between the work rolls
  std::optional<reduce::StandWithModes> rolling;  ///< with it; nothing: the strip has no slope
  reduce::StandWithModes lumped_open;             ///< one mass for each roll

  /// What the force of the settings drives.
  const reduce::StandWithModes &driven(const DynamicsSettings &settings) const
  {
    return driven_state(settings) == GapState::rolling && rolling ? *rolling : open;
  }
};

inline constexpr int frequencies_listed = 8;  ///< stack.f1..

/// Passes of the case; without one a pass without name under the force of [strip].
/// @param wanted  name of the only one that is asked for; empty: all
/// @throws InputError  no such pass; SolverError  no equilibrium
std::vector<MovingPass> moving_passes(const StackInput &input, const Stack &stack, int threads,
                                      const std::string &wanted = "");

/// One of them.  @param elements_per_width  of the beams
MovingPass moving_pass(const StackInput &input, const Stack &stack, const Pass &pass, int elements_per_width,
                       int threads = 1);

/// stack.f1.., mode.* and open.mode.*, curves/modes-stack*.csv, curves of their shapes, matrices of the model.
/// @param coarse  the same on a coarser mesh, for the errors
void add_stack_modes(RunContext &run, const StackInput &input, const MovingPass &fine, const MovingPass &coarse);

/// Response of every pass that has a force.
void simulate_stack(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes);

/// Critical speed of every pass, or what its search lacks.
void add_stack_speeds(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes);

/// Keys without which the critical speed of pass p is not searched.
std::vector<std::string> missing_for_speed(const Case &the_case, const StackInput &input, std::size_t p);

/// What a critical speed needs in addition to the stack; what the case does not say is assumed, and said.
struct StackSpeedInputs {
  bite::RollBite bite;
  double entry_distance = 0, exit_distance = 0;  ///< m, of free strip
};
StackSpeedInputs stack_speed_inputs(RunContext &run, const StackInput &input, const MovingPass &pass);

/// What a pass drives, for export.
DrivenStand driven_stack(const StackInput &input, const Stack &stack, const std::string &pass, int threads = 1);

/// A stand in its modes as chatter has it, open.
dynamics::StandStructure structure_of(const StackInput &input, const reduce::StandWithModes &stand);
}  // namespace mill
