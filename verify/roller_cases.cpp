#include "verify/verification.h"

namespace mill::verify {
std::vector<Case> roller_cases()
{
  return {};
}
}  // namespace mill::verify
