#pragma once
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

/// Bytes of address space that this process has mapped.
inline rlim_t mapped_address_space()
{
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return rlim_t(pages * sysconf(_SC_PAGESIZE));
}

/// The limit of `ulimit -v`, in bytes, while this lives; children take it over.
class AddressSpaceLimit {
public:
  explicit AddressSpaceLimit(const rlim_t bytes)
  {
    getrlimit(RLIMIT_AS, &before);
    const rlimit tight{bytes, before.rlim_max};
    set = setrlimit(RLIMIT_AS, &tight) == 0;
  }
  ~AddressSpaceLimit()
  {
    setrlimit(RLIMIT_AS, &before);
  }
  AddressSpaceLimit(const AddressSpaceLimit &) = delete;
  bool set                                     = false;  ///< false: the system refused

private:
  rlimit before{};
};
