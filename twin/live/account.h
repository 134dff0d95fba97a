#pragma once
#include <cstdint>

namespace mill::live {
/// Where the samples of one channel went.  Every sample that a source offered is in exactly one of the other four.
struct ChannelAccount {
  std::int64_t offered   = 0;  ///< counted from the numbers of the samples, not from the blocks that arrived
  std::int64_t processed = 0;
  std::int64_t missing   = 0;  ///< null, not a number, or never sent
  std::int64_t rejected  = 0;  ///< in a line or block that was refused
  std::int64_t overrun   = 0;  ///< dropped since the queue was full
};

/// offered = processed + missing + rejected + overrun.
bool balanced(const ChannelAccount &account);
}  // namespace mill::live
