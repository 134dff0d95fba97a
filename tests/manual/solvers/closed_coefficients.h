#pragma once
#include "reduce/bite/linear/linear_coefficients.h"

namespace mill::bite {
/// The sequential linearisation written out by hand, at a steady state under a film: an independent check of
/// linear_coefficients, never used by it.  Integrals by 48 Gauss points on each side.  theory.md (8.29)-(8.33)
LinearCoefficients closed_coefficients(const RollBite &bite, const BiteState &state);
}  // namespace mill::bite
