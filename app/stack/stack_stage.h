#pragma once
#include "app/run/driven_stand.h"
#include "app/run/run_context.h"
#include "app/stack/stack_kernels.h"
#include "core/model/stack_input.h"
#include "core/records/result_row.h"
#include "reduce/stack/beam_stack.h"
#include <functional>
#include <memory>
#include <string>
#include <vector>

// Stage of kind "stack": equilibrium on two meshes and what is read from it.
namespace mill {
struct Case;

/// A result before its error is known from a second mesh.
struct StackNumber {
  ResultName name;
  double value = 0;  ///< SI
  std::string unit, method;
  std::vector<Check> checks;
  Source source = Source::computed;
};
using StackNumbers = std::vector<StackNumber>;

/// The solved stack.
struct SolvedStack {
  Stack stack;  ///< with the rolling force, where the gap was given
  std::unique_ptr<reduce::StackEngine> engine;
  reduce::StackState state;
};
using MakeStackEngine = std::function<std::unique_ptr<reduce::StackEngine>(const Stack &)>;
reduce::BeamStackSettings beam_settings(const StackInput &input, int elements_per_width, int threads);
MakeStackEngine beams_of(const StackInput &input, int elements_per_width, int threads = 1);
MakeStackEngine condensed_of(const StackKernels &kernels, int stations_per_width, int threads = 1);

/// The engine of the case's [engine] on its finer mesh.
MakeStackEngine leading_engine(RunContext &run, const StackInput &input, const Stack &stack);

/// With the rolling force, or with that at which the unloaded gap is the given one.
/// @throws SolverError  no equilibrium
SolvedStack solve_stack(const StackInput &input, const Stack &stack, const MakeStackEngine &make);
/// The same stack under other settings, from a state that is solved where its engine can.
/// @throws SolverError  no equilibrium; `solved` has no engine then
void solve_from(SolvedStack &solved, const StackInput &input, const Stack &stack, const MakeStackEngine &make);

/// The stack with `strip.offset` at the centre of the solved line load, which is what statics takes.
Stack loaded_where_solved(const SolvedStack &solved);

/// S, the gap of the unloaded work rolls; NaN without an exit thickness.
double unloaded_gap(const SolvedStack &solved);
/// Flatness in I-units over the elements of the strip; empty without thicknesses.
Eigen::VectorXd flatness(const SolvedStack &solved);

/// Every result but the influences.
/// @param method  how they were computed
StackNumbers stack_numbers(const StackInput &input, const SolvedStack &solved, const char *method);

/// Derivatives of the gap by force, bending, crowns, eccentrics and shifts.
/// @param make  engine of the state, for the differences over a shift
StackNumbers stack_influences(const StackInput &input, const SolvedStack &solved, const MakeStackEngine &make);

/// What a trace follows: the beams on their coarser mesh, which takes some 10 ms.
StackNumbers traced_stack(const StackInput &input, const Stack &stack);

/// Keys of the case behind every result of the state and of its modes.
std::vector<std::string> keys_of_stack(const Case &the_case);
/// All of them: behind responses and critical speeds.
std::vector<std::string> all_keys_of_stack(const Case &the_case);

/// All of a run: the state with Goal::simulate, modes and critical speeds; with Goal::modes or Goal::chatter no
/// more than the modes, or the chatter, of beams.
void run_stack(RunContext &run, const StackInput &input, const Stack &drawn, Goal goal);
}  // namespace mill
