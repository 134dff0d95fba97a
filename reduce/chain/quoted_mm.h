#pragma once
#include "core/base/short_number.h"

namespace mill::reduce {
/// A length as a case file gives it, "120 mm" with its quotes.
inline std::string quoted_mm(const double metres)
{
  return "\"" + short_number(1000 * metres, 6) + " mm\"";
}
}  // namespace mill::reduce
