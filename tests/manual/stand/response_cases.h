#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

namespace mill::verify {
/// Frequency response of six masses and of component modes, theory.md 31.
std::vector<Case> response_cases();
}  // namespace mill::verify
