#pragma once
#include "app/run/run_context.h"
#include "core/model/two_cylinders.h"

namespace mill {
/// Writes curves/contact-line-width.csv: pressure and, under a tangential load, shear over the width; and adds
/// contact.line.stick_half_width, .tangential_*.
void solve_over_width(RunContext &run, const TwoCylinders &pair);
}  // namespace mill
