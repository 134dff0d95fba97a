#pragma once
#include "core/records/schedule_record.h"
#include "reduce/bite/slab/slab_bite.h"
#include <array>
#include <string>
#include <vector>

// The passes of a schedule together: fits of one unknown on both arcs, one hardening law, one constant of the
// dynamic force.  theory.md 39
namespace mill::bite {
/// One pass as the case has it.
struct ScheduledPass {
  std::string name;
  RollBite bite;  ///< with the laws of the case; a flow stress that is not given has k = 0
  double load                    = not_given;               ///< N, given force
  double published               = not_given;               ///< N
  std::array<double, 2> measured = {not_given, not_given};  ///< N, range
  double dynamic                 = not_given;               ///< N, printed amplitude
  bool in_common_fit             = true;
};

/// True where the case says a flow stress.
bool has_flow_stress(const Strip &strip);

/// The pass with one mean stress: that of its law at the exit thickness, as (39.4) takes it.
/// @throws InputError  a law that gives none there
RollBite with_exit_stress(RollBite bite);

/// The force that the fits of a pass meet: its load, else the published one, else the middle of what was measured;
/// nan: none.
double force_to_fit(const ScheduledPass &pass);

/// All of it by Bland and Ford, or by Hu and Ehmann where the friction is one of factors.  What a pass refuses
/// stands in its record, and the others go on.
/// @throws InputError  no pass
/// Cost: some 1 ms for each pass.
ScheduleRecord schedule_of(const std::vector<ScheduledPass> &passes);
}  // namespace mill::bite
