// Whole files: written at once or not at all, read back byte by byte.
#include "core/errors.h"
#include "core/files.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
class Files : public testing::Test {
protected:
  fs::path folder = fs::path(testing::TempDir()) / "millstand_files_test";
  void SetUp() override
  {
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  void TearDown() override
  {
    fs::permissions(folder, fs::perms::owner_all);
    fs::remove_all(folder);
  }
  std::size_t n_entries() const
  {
    return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
};

std::string message(const std::string &path)
{
  try {
    write_atomically(path, "x");
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}
}  // namespace

TEST_F(Files, BytesComeBack)
{
  std::string bytes;
  for (int i = 0; i < 70000; ++i)
    bytes += char(i % 256);
  write_atomically((folder / "a").string(), bytes);
  EXPECT_EQ(read_text((folder / "a").string()), bytes);
}

TEST_F(Files, AnOldFileIsReplacedAndNothingElseIsLeft)
{
  const std::string path = (folder / "a").string();
  write_atomically(path, "old, and longer");
  write_atomically(path, "new");
  EXPECT_EQ(read_text(path), "new");
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(Files, AFailedWriteLeavesNothingBehind)
{
  const std::string path = (folder / "a").string();
  fs::create_directory(path);  // a rename onto a folder fails after the text has been written
  EXPECT_EQ(message(path), path + ": error: cannot be written: Is a directory");
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(Files, AMissingFolderIsNamedWithTheReason)
{
  const std::string path = (folder / "none" / "a").string();
  EXPECT_EQ(message(path), path + ": error: cannot be written: No such file or directory");
}

TEST_F(Files, AReadOnlyFolderIsNamedWithTheReason)
{
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  const std::string path = (folder / "a").string();
  const bool superuser   = ::geteuid() == 0;  // may write everywhere; be nobody for a moment
  if (superuser) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string said = message(path);
  if (superuser) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_EQ(said, path + ": error: cannot be written: Permission denied");
}

TEST_F(Files, WhatCannotBeReadSaysWhy)
{
  const std::string path = (folder / "none").string();
  try {
    read_text(path);
    FAIL() << "a missing file was read";
  } catch (const InputError &error) {
    EXPECT_EQ(error.what(), path + ": error: cannot be read: No such file or directory");
  }
  try {
    read_text(folder.string());
    FAIL() << "a folder was read";
  } catch (const InputError &error) {
    EXPECT_EQ(error.what(), folder.string() + ": error: cannot be read: it is a folder");
  }
}

TEST(Hash, IsFnv1a)
{
  // test vectors of the authors, http://www.isthe.com/chongo/src/fnv/test_fnv.c, 64-bit FNV-1a
  EXPECT_EQ(hash_of(""), "cbf29ce484222325");
  EXPECT_EQ(hash_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash_of("foobar"), "85944171f73967e8");
}
