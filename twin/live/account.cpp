#include "twin/live/account.h"

namespace mill::live {
bool balanced(const ChannelAccount &a)
{
  return a.offered == a.processed + a.missing + a.rejected + a.overrun;
}
}  // namespace mill::live
