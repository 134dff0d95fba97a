#pragma once
#include "app/stages/bite/bite_study.h"

namespace mill {
/// K4 over reduction, tension, friction and speed, curves/bite-k4-*.csv, and finite elements against slab theories
/// over the aspect of the bite, curves/bite-aspect.csv.
void write_bite_curves(RunContext &run, const BiteStudy &study);
}  // namespace mill
