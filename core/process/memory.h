#pragma once
#include <string>

namespace mill {
/// What this process may still take, and what sets the end.
struct MemoryLeft {
  double bytes = 0;  ///< byte
  std::string end;   ///< "the memory of this machine", "the 600 MB of address space allowed (ulimit -v)"
};

/// The least of what the machine has free, what a container allows (cgroup v1 and v2) and what is left of the
/// limits on address space and data (ulimit -v, -d). Infinite where the system says nothing. Cost: some files of
/// /proc.
MemoryLeft memory_left();

/// "612 MB"
std::string megabytes(double bytes);
}  // namespace mill
