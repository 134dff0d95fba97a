#pragma once
#include "core/base/errors.h"
#include <string>

namespace mill {
/// What this process may still take, and what sets the end.
struct MemoryLeft {
  double bytes = 0;  ///< byte
  std::string end;   ///< "the memory of this machine", "the 600 MB of address space allowed (ulimit -v)"
};

/// The least of what the machine has free, what a container allows (cgroup v1 and v2), what is left of the limits
/// on address space and data (ulimit -v, -d) and of the one of set_memory_limit(). Infinite where the system says
/// nothing. Cost: some files of /proc.
MemoryLeft memory_left();

/// Work whose need is known beforehand does not begin where this process would then have more than so many bytes
/// in memory. It is for this process as a whole, as a limit of the system is; 0: none.
void set_memory_limit(double bytes);

/// A piece of work needs more memory than there is: known before it begins, or refused by the system.
class OutOfMemory : public SolverError {
public:
  using SolverError::SolverError;
};

/// What makes the need smaller, as a remedy that names `smaller` first: "a smaller contact.upper.samples".
std::string memory_remedy(const std::string &smaller);

/// "612 MB"
std::string megabytes(double bytes);
}  // namespace mill
