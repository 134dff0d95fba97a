#include "core/memory.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace mill;

TEST(MemoryLeft, IsSomethingAndSaysWhatSetsTheEnd)
{
  const MemoryLeft left = memory_left();
  EXPECT_GT(left.bytes, 1e6);
  EXPECT_LT(left.bytes, double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)));
  EXPECT_FALSE(left.end.empty());
}

TEST(MemoryLeft, TheAddressSpaceIsWhatTheLimitLeaves)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer maps terabytes of address space";
#endif
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t allowed = rlim_t(pages * sysconf(_SC_PAGESIZE)) + 50000000;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit tight{allowed, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  const MemoryLeft left = memory_left();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_GT(left.bytes, 40e6) << "what the reading itself takes is small";
  EXPECT_LE(left.bytes, 50e6);
  EXPECT_EQ(left.end, "the " + megabytes(double(allowed)) + " of address space that are allowed (ulimit -v)");
}
