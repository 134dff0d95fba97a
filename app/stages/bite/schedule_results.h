#pragma once
#include "app/stages/bite/schedule_forces.h"

namespace mill {
/// The numbers of a schedule as results, with what was fitted to what.
void add_schedule_results(RunContext &run, const ScheduleQuestion &question, const ScheduleRecord &record);
}  // namespace mill
