#pragma once
#include "tests/manual/check/verification.h"

namespace mill::verify {
/// Comparisons with CalculiX on meshes of its own; each is skipped, and says so, where it is not installed.
std::vector<Case> peer_cases();
}  // namespace mill::verify
