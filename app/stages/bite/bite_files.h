#pragma once
#include "app/stages/bite/bite_study.h"

namespace mill {
/// curves/bite-PASS.MODEL.csv along the arc for every model, curves/bite-PASS.roll.csv, curves/bite-PASS.field.csv
/// and fields/bite-PASS.vtu.
void write_bite(RunContext &run, const BiteStudy &study);
}  // namespace mill
