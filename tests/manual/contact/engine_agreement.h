#pragma once
#include "tests/manual/check/verification.h"

namespace mill::verify {
/// Checks of the case of that name: hexahedra condensed onto the patch against the Fourier series.
std::vector<Check> engine_agreement();
}  // namespace mill::verify
