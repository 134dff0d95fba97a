#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/cache_entry.h"
#include "tests/support/obstacles.h"
#include <atomic>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/file.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace mill;

namespace {
const std::string folder =
    (std::filesystem::temp_directory_path() / ("millstand-entry-" + std::to_string(getpid()))).string();
const std::string path = folder + "/entry", kind = "something 1", key = "0123";
const std::string bytes = std::string("some\nbytes \0 and more of them", 29);

// Without the fsync of write_atomically: hundreds of damaged entries in no time.
void overwrite(const std::string &text)
{
  std::ofstream(path, std::ios::binary) << text;
}

class CacheEntry : public testing::Test {
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
    write_cache_entry(path, kind, key, bytes);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
};
}  // namespace

TEST_F(CacheEntry, ReturnsEveryByte)
{
  EXPECT_EQ(read_cache_entry(path, kind, key), bytes);
  write_cache_entry(path, kind, key, "");
  EXPECT_EQ(read_cache_entry(path, kind, key), "");
}

// A killed process leaves the file that it was writing; no other process may touch the file that a living one is
// writing.
TEST_F(CacheEntry, WhatKilledWritersLeftIsRemoved)
{
  namespace fs            = std::filesystem;
  const std::string stale = path + ".0123456789abcdef.part", living = path + ".fedcba9876543210.part";
  const std::vector<std::string> others{folder + "/mine.part", folder + "/x.0123456789abcdeg.part", path,
                                        folder + "/.0123456789abcdef.part.bak"};
  std::ofstream(stale) << "half";
  std::ofstream(living) << "half";
  for (const std::string &other : others)
    std::ofstream(other) << "mine";
  fs::create_directory(folder + "/folder.0123456789abcdef.part");
  const int writer = ::open(living.c_str(), O_WRONLY);
  ASSERT_EQ(::flock(writer, LOCK_EX), 0);
  remove_stale_parts(folder);
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(living));
  for (const std::string &other : others)
    EXPECT_TRUE(fs::exists(other)) << other;
  EXPECT_TRUE(fs::exists(folder + "/folder.0123456789abcdef.part"));
  ::close(writer);
  remove_stale_parts(folder);
  EXPECT_FALSE(fs::exists(living));
}

// Writers and cleaners side by side: every write ends with its file.
TEST_F(CacheEntry, CleaningLeavesTheFilesOfALivingWriter)
{
  std::atomic<bool> done{false};
  std::thread cleaner([&] {
    while (!done)
      remove_stale_parts(folder);
  });
  for (int i = 0; i < 300; ++i)
    EXPECT_NO_THROW(write_cache_entry(path, kind, key, bytes)) << i;
  done = true;
  cleaner.join();
  EXPECT_EQ(read_cache_entry(path, kind, key), bytes);
}

TEST_F(CacheEntry, ANoteSaysWhyAnEntryIsNotUsed)
{
  std::string note;
  EXPECT_FALSE(read_cache_entry(folder + "/none", kind, key, &note));
  EXPECT_EQ(note, "") << "a missing entry needs no note";
  EXPECT_FALSE(read_cache_entry(path, "something 2", key, &note));
  EXPECT_EQ(note, path + " is not used: it is not a something 2");
  EXPECT_FALSE(read_cache_entry(path, kind, "0124", &note));
  EXPECT_EQ(note, path + " is not used: it belongs to other inputs");
  EXPECT_FALSE(read_cache_entry(path, kind, "012", &note)) << "not a beginning of the key either";
}

TEST_F(CacheEntry, NoTruncationAndNoFlippedBitIsTrusted)
{
  const std::string whole = read_text(path);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    overwrite(whole.substr(0, size));
    EXPECT_FALSE(read_cache_entry(path, kind, key)) << size << " bytes";
  }
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string broken = whole;
    broken[bit / 8] ^= char(1 << bit % 8);
    overwrite(broken);
    EXPECT_FALSE(read_cache_entry(path, kind, key)) << "bit " << bit;
  }
  overwrite(whole + "x");
  EXPECT_FALSE(read_cache_entry(path, kind, key)) << "something behind it";
}

// The checksum goes by words in several sums: no bit, no pair of high bits and no exchange of words is lost in
// them.
TEST_F(CacheEntry, NoChangeOfALongEntryIsTrusted)
{
  std::string long_bytes(331, '\0');
  std::mt19937 random(5);
  for (char &byte : long_bytes)
    byte = char(random());
  write_cache_entry(path, kind, key, long_bytes);
  const std::string whole = read_text(path);
  ASSERT_EQ(read_cache_entry(path, kind, key), long_bytes);
  const std::size_t head    = whole.size() - long_bytes.size();
  const auto expect_refused = [&](const std::string &broken, const std::string &what) {
    overwrite(broken);
    EXPECT_FALSE(read_cache_entry(path, kind, key)) << what;
  };
  for (std::size_t bit = 8 * head; bit < 8 * whole.size(); ++bit) {
    std::string broken = whole;
    broken[bit / 8] ^= char(1 << bit % 8);
    expect_refused(broken, "bit " + std::to_string(bit));
  }
  for (std::size_t word = 0; word + 5 <= long_bytes.size() / 8; ++word) {
    std::string flipped = whole, exchanged = whole;
    const std::size_t position = head + 8 * word, next = position + 32;
    flipped[position + 7] ^= char(0x80);
    flipped[next + 7] ^= char(0x80);
    expect_refused(flipped, "highest bits from word " + std::to_string(word));
    for (const std::size_t other : {position + 8, next})
      if (whole.substr(position, 8) != whole.substr(other, 8)) {
        exchanged = whole;
        exchanged.replace(position, 8, whole.substr(other, 8)).replace(other, 8, whole.substr(position, 8));
        expect_refused(exchanged, "exchange of word " + std::to_string(word));
      }
  }
}

// A pipe would be waited for and a device read for ever: CTest's time limit is part of this test.
TEST_F(CacheEntry, AFolderOrPipeInPlaceOfAnEntryIsIgnored)
{
  for (const std::string &obstacle : obstacles) {
    put_obstacle(path, obstacle);
    std::string note;
    EXPECT_FALSE(read_cache_entry(path, kind, key, &note)) << obstacle;
    EXPECT_EQ(note.rfind(path + " is not used: ", 0), 0u) << obstacle << ": " << note;
  }
}

TEST_F(CacheEntry, AnEntryReplacesAnythingButAFolder)
{
  for (const std::string &obstacle : obstacles) {
    put_obstacle(path, obstacle);
    if (obstacle == "a folder")
      EXPECT_THROW(write_cache_entry(path, kind, key, bytes), InputError);
    else {
      write_cache_entry(path, kind, key, bytes);
      EXPECT_EQ(read_cache_entry(path, kind, key), bytes) << obstacle;
    }
  }
}
