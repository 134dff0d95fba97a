#pragma once
#include "core/records/schedule_record.h"
#include "report/page/run.h"
#include <string>

// Forces of a pass schedule, what was fitted to them and what other theories say; empty when there is nothing to
// show.
namespace mill::report {
/// curves/schedule.json as this run stored it.
struct ScheduleData : ScheduleRecord {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong
};
/// Never throws.
ScheduleData read_schedule(const std::string &run_directory);

std::string fit_table(const ScheduleData &data);        ///< passes, flow stress on both arcs, flattening
std::string factor_table(const ScheduleData &data);     ///< friction factors of equal force, power, torque
std::string hardening_table(const ScheduleData &data);  ///< one law for all passes and the forces it gives back
std::string dynamic_table(const ScheduleData &data);    ///< dynamic force by one constant
std::string theory_table(const ScheduleData &data);     ///< the fitted stress by every theory
std::string force_drawing(const ScheduleData &data);    ///< bars of every pass
}  // namespace mill::report
