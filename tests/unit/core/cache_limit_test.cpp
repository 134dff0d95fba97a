#include "core/base/errors.h"
#include "core/records/cache_entry.h"
#include "core/records/cache_limit.h"
#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>

namespace {
using namespace mill;
namespace fs = std::filesystem;

TEST(CacheLimit, SizesAreReadWithTheirUnit)
{
  EXPECT_EQ(bytes_of_size("--cache-limit", "20GB"), 20e9);
  EXPECT_EQ(bytes_of_size("--cache-limit", "1.5 MB"), 1.5e6);
  for (const char *wrong : {"", "20", "GB", "-1GB", "0GB", "20 apples"})
    EXPECT_THROW(bytes_of_size("--cache-limit", wrong), InputError) << wrong;
}

TEST(CacheLimit, WhatWasNotUsedForLongestGoesFirst)
{
  const fs::path folder = fs::path(testing::TempDir()) / "cache-limit";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 4; ++i) {
    const std::string path = (folder / ("roll-" + std::to_string(i) + ".bin")).string();
    write_cache_entry(path, "roll", "key", std::string(1000, 'x'));
    fs::last_write_time(path, now - std::chrono::hours(10 - i));
  }
  // Reading the oldest one makes it the youngest.
  ASSERT_TRUE(read_cache_entry((folder / "roll-0.bin").string(), "roll", "key"));
  const double size = double(fs::file_size(folder / "roll-0.bin"));
  EXPECT_EQ(keep_cache_below(folder.string(), 10 * size), 0);
  EXPECT_EQ(keep_cache_below(folder.string(), 2 * size), 2 * size);
  EXPECT_TRUE(fs::exists(folder / "roll-0.bin"));
  EXPECT_FALSE(fs::exists(folder / "roll-1.bin"));
  EXPECT_FALSE(fs::exists(folder / "roll-2.bin"));
  EXPECT_TRUE(fs::exists(folder / "roll-3.bin"));
  fs::remove_all(folder);
}
}  // namespace
