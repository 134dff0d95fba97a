#pragma once
#include "app/stages/bearing/bearing_results.h"

namespace mill {
/// Ratings, equivalent load, static safety and life of a solved bearing as bearing.NAME.C, C0, P, S0, L10, L10r,
/// L10mr (revolutions), with a speed also the time of life, speed of the cage and centrifugal force; the estimated
/// rollers of a designation.  theory.md 5.8, 5.9
void add_rating_results(RunContext &run, const BearingStudy &study, const KeysOfRow &inputs);
}  // namespace mill
