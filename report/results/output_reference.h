#pragma once
#include <string>

// docs/output.md: what each result of a run is.
namespace mill::report {
/// The part of the page that lists what a run may warn of.
std::string warning_reference();

/// The page: name, meaning, unit and equation of every row of core/records/result_row.h, group by group.
std::string output_reference();
}  // namespace mill::report
