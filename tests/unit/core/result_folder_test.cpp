// A result folder holds one whole run, whenever the program that writes it stops.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/result_folder.h"
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
const std::vector<std::string> old_files{"results.json",     "report.html",       "run.json",
                                         "resolved.toml",    "lumped_model.toml", "millstand.log",
                                         "curves/modes.csv", "response/pass.csv", "fields/roll.vtu"};
// Another verb: one file more, and no response.
const std::vector<std::string> new_files{"results.json",       "report.html",    "run.json",
                                         "resolved.toml",      "millstand.log",  "curves/modes.csv",
                                         "curves/bearing.csv", "fields/roll.vtu"};

std::map<std::string, std::string> expected(const std::string &run, const std::vector<std::string> &files)
{
  std::map<std::string, std::string> texts{
      {"mine.txt",    "mine"},
      {"notes/a.txt", "mine"}
  };
  for (const std::string &file : files)
    texts[file] = run;
  return texts;
}

class ResultFolder : public testing::Test {
protected:
  // In memory where the system has such a folder: on a disk every fsync costs milliseconds.
  fs::path folder = fs::path(fs::is_directory("/dev/shm") ? "/dev/shm" : testing::TempDir()) /
                    ("millstand_result_folder_" + std::to_string(::getpid()));
  const std::map<std::string, std::string> earlier = expected("earlier", old_files),
                                           later   = expected("later", new_files);
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  void write(const fs::path &in, const std::vector<std::string> &files, const std::string &text)
  {
    for (const std::string &file : files) {
      fs::create_directories((in / file).parent_path());
      write_atomically((in / file).string(), text);
    }
  }
  void set_up_earlier_run()
  {
    fs::remove_all(folder);
    write(folder, old_files, "earlier");
    write(folder, {"mine.txt", "notes/a.txt"}, "mine");
  }
  void publish(const Rename &rename = {})
  {
    const FolderLock alone(folder.string());
    const Staging staging(folder.string());
    write(staging.path(), new_files, "later");
    fs::create_directory(staging.path() + "/response");
    publish_results(staging.path(), folder.string(), rename);
  }
  // What a user sees: entries that are not hidden.
  std::map<std::string, std::string> shown() const
  {
    std::map<std::string, std::string> texts;
    for (const auto &top : fs::directory_iterator(folder)) {
      if (top.path().filename().string()[0] == '.')
        continue;
      if (top.is_regular_file())
        texts[top.path().filename().string()] = read_text(top.path().string());
      else
        for (const auto &file : fs::directory_iterator(top))
          texts[fs::relative(file.path(), folder).string()] = read_text(file.path().string());
    }
    return texts;
  }
  std::set<std::string> runs_shown() const
  {
    std::set<std::string> runs;
    for (const auto &[name, text] : shown())
      if (text != "mine")
        runs.insert(text);
    return runs;
  }
  std::string hidden() const
  {
    std::string names;
    for (const auto &top : fs::directory_iterator(folder))
      if (top.path().filename().string()[0] == '.')
        names += top.path().filename().string() + " ";
    return names;
  }
};

std::string refusal(const std::function<void()> &action)
{
  try {
    action();
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}
}  // namespace

TEST_F(ResultFolder, TheNewRunTakesThePlaceOfTheEarlierOneAndForeignFilesStay)
{
  set_up_earlier_run();
  int renames = 0;
  publish([&](const char *from, const char *to) {
    ++renames;
    return ::rename(from, to);
  });
  EXPECT_EQ(shown(), later);
  EXPECT_EQ(hidden(), "");
  EXPECT_EQ(renames, 1 + 9 + 7 + 1) << "the switch, nine names leave, seven come, the end";
}

// A process that is killed at any rename: the first is the switch.
TEST_F(ResultFolder, AKillAtAnyRenameLeavesOneRunAndTheNextCommandFindsItWhole)
{
  for (int at = 0; at < 18; ++at)
    for (const bool after : {false, true}) {
      set_up_earlier_run();
      const pid_t child = ::fork();
      if (child == 0) {
        int renames = 0;
        publish([&](const char *from, const char *to) {
          const bool last = renames++ == at;
          if (last && !after)
            ::raise(SIGKILL);
          const int result = ::rename(from, to);
          if (last)
            ::raise(SIGKILL);
          return result;
        });
        ::_exit(0);
      }
      int status = 0;
      ::waitpid(child, &status, 0);
      ASSERT_TRUE(WIFSIGNALED(status)) << at;
      EXPECT_LE(runs_shown().size(), 1u) << "files of two runs side by side after rename " << at;
      const bool switched = at > 0 || after;
      {
        const FolderLock alone(folder.string());
        finish_publishing(folder.string());
        remove_leftovers(folder.string());
      }
      EXPECT_EQ(shown(), switched ? later : earlier) << at;
      EXPECT_EQ(hidden(), "") << at;
    }
}

// As before, but the system refuses: the program goes on and says so.
TEST_F(ResultFolder, ARefusedRenameIsSaidAndLosesNothing)
{
  for (int at = 0; at < 18; ++at) {
    set_up_earlier_run();
    int renames              = 0;
    const std::string error  = refusal([&] {
      publish([&](const char *from, const char *to) {
        if (renames++ == at)
          return errno = EIO, -1;
        return ::rename(from, to);
      });
    });
    const std::string remedy = at == 0 ? "; the earlier results are as they were, choose another folder with -o"
                                       : "; the new results are complete in " + folder.string() +
                                             "/.publishing, `millstand report " + folder.string() +
                                             "` puts them in their places";
    EXPECT_NE(error.find("cannot be written: Input/output error" + remedy), std::string::npos) << error;
    EXPECT_LE(runs_shown().size(), 1u) << at;
    EXPECT_EQ(refusal([&] { require_published(folder.string()); }).empty(), at == 0);
    finish_publishing(folder.string());
    EXPECT_EQ(shown(), at == 0 ? earlier : later) << at;
    EXPECT_EQ(hidden(), "") << at;
  }
}

TEST_F(ResultFolder, AnInterruptedRenameIsMadeAgain)
{
  set_up_earlier_run();
  int calls = 0;
  publish([&](const char *from, const char *to) {
    if (calls++ % 2 == 0)
      return errno = EINTR, -1;
    return ::rename(from, to);
  });
  EXPECT_EQ(shown(), later);
}

TEST_F(ResultFolder, AFolderThatIsNoJournalIsRefused)
{
  set_up_earlier_run();
  fs::create_directory(folder / ".publishing");
  const std::string path = (folder / ".publishing").string();
  EXPECT_EQ(refusal([&] { finish_publishing(folder.string()); }),
            path + ": error: is not the journal of a run: it has no readable list .names; move it out of the way");
  EXPECT_EQ(runs_shown(), std::set<std::string>{"earlier"});
}

TEST_F(ResultFolder, AStagingFolderOfALivingRunStaysWhateverItsProcessNumber)
{
  set_up_earlier_run();
  const fs::path killed = folder / ".run-0123456789abcdef", by_number = folder / ".run-1";
  write(killed, {"curves/modes.csv", ".lock"}, "half a run");
  write(by_number, {"curves/modes.csv"}, "half a run of version 0.1.0");  // process 1 lives everywhere
  const Staging alive(folder.string());
  {
    const FolderLock alone(folder.string());
    ASSERT_TRUE(alone.held());
    remove_leftovers(folder.string());
  }
  EXPECT_TRUE(fs::exists(alive.path()));
  EXPECT_FALSE(fs::exists(killed));
  EXPECT_FALSE(fs::exists(by_number));
}
