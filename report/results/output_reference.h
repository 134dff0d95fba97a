#pragma once
#include "report/page/run.h"
#include <string>
#include <vector>

// docs/output.md: what each result of a run is.
namespace mill::report {
/// The row of docs/output.md that describes a result: names of passes, bearings, rolls and modes are replaced by
/// words in capitals and numbers by N: "bite.pass 1.force" -> "bite.PASS.force".
std::string row_of_output(const Run &run, const std::string &result);

/// The part of the page that lists what a run may warn of.
std::string warning_reference();

/// The page: for each row the meaning, the unit, the method of the first run that has it and the equation that its
/// source cites, grouped by the first part of the name.
/// @param runs  finished runs that together have every kind of result
std::string output_reference(const std::vector<Run> &runs);
}  // namespace mill::report
