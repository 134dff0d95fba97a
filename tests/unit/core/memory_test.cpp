#include "core/process/memory.h"
#include "tests/support/address_space.h"
#include <cmath>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;

TEST(MemoryLeft, MemoryLeftIsPositiveAndNamesItsLimit)
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
  const rlim_t allowed  = mapped_address_space() + 50000000;
  const MemoryLeft left = [&] {
    const AddressSpaceLimit tight(allowed);
    EXPECT_TRUE(tight.set);
    return memory_left();
  }();
  EXPECT_GT(left.bytes, 40e6) << "what the reading itself takes is small";
  EXPECT_LE(left.bytes, 50e6);
  EXPECT_EQ(left.end, "the " + megabytes(double(allowed)) + " of address space that are allowed (ulimit -v)");
}

TEST(MemoryLeft, TheLimitOfTheUserIsForTheWholeProcess)
{
  const auto left_below = [](const double limit) {
    set_memory_limit(limit);
    const MemoryLeft left = memory_left();
    set_memory_limit(0);
    return left;
  };
  EXPECT_EQ(left_below(1e6).bytes, 0) << "a process with its libraries has more than that";
  EXPECT_EQ(left_below(1e6).end, "the 1 MB that --memory allows");
  const double some = left_below(300e6).bytes;
  EXPECT_GT(some, 0);
  EXPECT_LT(some, 300e6) << "less what this process has already";
  EXPECT_NE(memory_left().end, "the 300 MB that --memory allows");
}
