#pragma once
#include "app/stages/bearing/bearing_study.h"

namespace mill {
/// Curves of one bearing, curves/bearing-NAME*.csv: over the load, rows, rollers, law of one roller, tilt of one
/// roller, pressure of the heaviest one, one pitch of the cage, 5 x 5 tangent, published values.
void write_bearing(RunContext &run, const BearingStudy &study);
/// Only the curve over the load, as far as it went.
void write_load_curve(RunContext &run, const BearingStudy &study);
}  // namespace mill
