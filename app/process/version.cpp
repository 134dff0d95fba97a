#include "app/process/version.h"

namespace mill {
std::string version()
{
  return MILLSTAND_VERSION;
}
}  // namespace mill
