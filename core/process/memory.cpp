#include "core/process/memory.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <sys/resource.h>

namespace mill {
namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kB      = 1024;
std::atomic<double> limit_of_user{0};  // byte; 0: none

// "name  number" in a file of the kernel; a file of one number has the name "".
double entry(const char *path, const std::string &name)
{
  std::ifstream file(path);
  std::string word;
  double number = unknown;
  if (name.empty())
    return file >> number ? number : unknown;  // "max": no limit
  while (file >> word)
    if (word == name)
      return file >> number ? number : unknown;
  return unknown;
}

// A page of a file that can be read again is treated as free.
double left_in_container()
{
  const double v2 = entry("/sys/fs/cgroup/memory.max", "") - entry("/sys/fs/cgroup/memory.current", "") +
                    entry("/sys/fs/cgroup/memory.stat", "inactive_file");
  if (std::isfinite(v2))
    return v2;
  const char *stat = "/sys/fs/cgroup/memory/memory.stat";
  return entry("/sys/fs/cgroup/memory/memory.limit_in_bytes", "") -
         entry("/sys/fs/cgroup/memory/memory.usage_in_bytes", "") + entry(stat, "total_inactive_file");
}

double allowed(const int resource)
{
  rlimit limit{};
  const bool limited = getrlimit(__rlimit_resource_t(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? double(limit.rlim_cur) : unknown;
}
}  // namespace

MemoryLeft memory_left()
{
  MemoryLeft left{std::numeric_limits<double>::infinity(), "the memory of this machine"};
  const auto end = [&](const double bytes, const std::string &what) {
    if (bytes < left.bytes)  // false where unknown
      left = {std::max(0.0, bytes), what};
  };
  constexpr double usable = 0.9;  // the rest is for what else runs here
  end(usable * kB * entry("/proc/meminfo", "MemAvailable:"), left.end);
  end(left_in_container(), "the memory of this container");
  const double space = allowed(RLIMIT_AS), data = allowed(RLIMIT_DATA);
  end(space - kB * entry("/proc/self/status", "VmSize:"),
      fmt::format("the {} of address space that are allowed (ulimit -v)", megabytes(space)));
  end(data - kB * entry("/proc/self/status", "VmData:"),
      fmt::format("the {} of data that are allowed (ulimit -d)", megabytes(data)));
  if (const double limit = limit_of_user; limit > 0)
    end(limit - kB * entry("/proc/self/status", "VmRSS:"),
        fmt::format("the {} that --memory allows", megabytes(limit)));
  return left;
}

void set_memory_limit(const double bytes)
{
  limit_of_user = bytes;
}

std::string memory_remedy(const std::string &smaller)
{
  return smaller + ", fewer threads (--threads), or a higher limit";
}

std::string megabytes(const double bytes)
{
  return fmt::format("{:.0f} MB", bytes / 1e6);
}
}  // namespace mill
