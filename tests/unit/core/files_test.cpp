// Whole files: written at once or not at all, read back byte by byte.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/save_in_place.h"
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <sys/stat.h>
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

template <class Action> std::string refusal(const Action &action)
{
  try {
    action();
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

std::string message(const std::string &path)
{
  return refusal([&] { write_atomically(path, "x"); });
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

TEST_F(Files, ANameOfTheGreatestLengthIsWritten)
{
  std::string umlauts;
  for (int i = 0; i < 127; ++i)
    umlauts += "\xc3\xa4";
  for (const std::string &name : {std::string(255, 'a'), std::string(234, 'a'), "x" + umlauts}) {
    const std::string path = (folder / name).string();
    EXPECT_EQ(message(path), "") << name.size();
    EXPECT_EQ(read_text(path), "x") << name.size();
    fs::remove(path);
  }
  EXPECT_EQ(n_entries(), 0u) << "nothing is left aside";
  const std::string too_long = (folder / std::string(256, 'a')).string();
  const std::string why = ": error: cannot be written: File name too long", refused = message(too_long);
  ASSERT_GT(refused.size(), why.size());
  EXPECT_EQ(refused.substr(refused.size() - why.size()), why) << "the name itself is shortened";
  EXPECT_EQ(n_entries(), 0u);
}

TEST_F(Files, AMissingFolderIsNamedWithTheReason)
{
  const std::string path = (folder / "none" / "a").string();
  EXPECT_EQ(message(path), path + ": error: cannot be written: No such file or directory");
}

// The name asked for is wrong: the user's mistake.  Disk, permission and limits are the system's refusal.
TEST(FileErrors, FileErrorsBelongToTheUserOrToTheSystem)
{
  for (const int error : {ENOENT, ENOTDIR, EISDIR, ENAMETOOLONG, ELOOP, EEXIST})
    EXPECT_FALSE(is_refused_by_system(error)) << error;
  for (const int error : {ENOSPC, EDQUOT, EIO, EROFS, EACCES, EPERM, EMFILE, ENFILE, ENOMEM, EFBIG, EBUSY})
    EXPECT_TRUE(is_refused_by_system(error)) << error;
  EXPECT_THROW(refuse_file(ENOSPC, "disk"), SystemError);
  try {
    refuse_file(ENOENT, "name");
  } catch (const SystemError &) {
    ADD_FAILURE() << "a wrong name is the user's mistake";
  } catch (const InputError &error) {
    EXPECT_EQ(std::string(error.what()), "error: name");
  }
}

TEST_F(Files, AReadOnlyFolderIsNamedWithTheReason)
{
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  const std::string path = (folder / "a").string();
  const bool superuser   = ::geteuid() == 0;  // may write everywhere; become another user for a moment
  if (superuser) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string refusal_text = message(path);
  EXPECT_THROW(write_atomically(path, "x"), SystemError) << "a missing permission is not an input error";
  if (superuser) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_EQ(refusal_text, path + ": error: cannot be written: Permission denied");
}

TEST_F(Files, AFileThatCannotBeReadIsRefusedWithTheReason)
{
  const std::string none = (folder / "none").string();
  EXPECT_EQ(refusal([&] { read_text(none); }), none + ": error: cannot be read: No such file or directory");
  EXPECT_EQ(refusal([&] { read_text(folder.string()); }),
            folder.string() + ": error: cannot be read: it is a folder");
  EXPECT_FALSE(text_if_readable(none));
  EXPECT_FALSE(text_if_readable(folder.string()));
}

// Opening a pipe without a writer, or reading a device without end, would wait for ever.
TEST_F(Files, PipesAndDevicesAreNeitherReadNorReplaced)
{
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal([&] { read_text(pipe); }),
            pipe + ": error: cannot be read: it is a named pipe; name a regular file");
  EXPECT_EQ(message(pipe), pipe + ": error: cannot be written: it is a named pipe; name a regular file");
  EXPECT_EQ(refusal([] { read_text("/dev/zero"); }),
            "/dev/zero: error: cannot be read: it is a device; name a regular file");
  EXPECT_EQ(message("/dev/null"), "/dev/null: error: cannot be written: it is a device; name a regular file");
  EXPECT_EQ(n_entries(), 1u);
}

TEST_F(Files, ALinkIsReplacedAndNotFollowed)
{
  const std::string theirs = (folder / "theirs").string(), link = (folder / "link").string();
  write_atomically(theirs, "theirs");
  fs::create_symlink(theirs, link);
  write_atomically(link, "ours");
  EXPECT_EQ(read_text(theirs), "theirs");
  EXPECT_EQ(read_text(link), "ours");
  EXPECT_FALSE(fs::is_symlink(link));
}

TEST_F(Files, NamesAsideAreRandomAndInTheSameFolder)
{
  const std::string a = name_aside("x/y.msh", ".msh"), b = name_aside("x/y.msh", ".msh");
  EXPECT_TRUE(std::regex_match(a, std::regex("x/y\\.msh\\.[0-9a-f]{16}\\.msh"))) << a;
  EXPECT_NE(a, b);
}

TEST(Hash, IsFnv1a)
{
  // test vectors of the authors, http://www.isthe.com/chongo/src/fnv/test_fnv.c, 64-bit FNV-1a
  EXPECT_EQ(hash_of(""), "cbf29ce484222325");
  EXPECT_EQ(hash_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash_of("foobar"), "85944171f73967e8");
}

TEST_F(Files, AUsersFileIsSavedBehindItsLinkAndKeepsItsMode)
{
  fs::create_directory(folder / "real");
  const fs::path file = folder / "real" / "case.toml", link = folder / "case.toml";
  write_atomically(file.string(), "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);  // 0600: of one user alone
  fs::create_symlink("real/case.toml", link);
  save_in_place(link.string(), "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_text(file.string()), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(n_entries(), 2u) << "the link and the folder";
  save_in_place((folder / "first").string(), "x");
  EXPECT_EQ(read_text((folder / "first").string()), "x") << "a file that is new";
}
