#pragma once
#include "app/stages/bite/fit_stage.h"

namespace mill {
/// bite.fit.*: values, intervals, correlation, residuals, the direction that is known worst.
void add_fit_results(RunContext &run, const StripFit &fit);
/// Fitted values, their model, and the numbers that the data cannot distinguish.
void note_fit(RunContext &run, const StripFit &fit);
/// Confidence region of friction and flow stress, and the lines on which single values are met.
void write_fit(RunContext &run, const StripFit &fit);
}  // namespace mill
