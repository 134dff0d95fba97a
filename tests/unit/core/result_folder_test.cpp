// A result folder holds one whole run, at whatever moment the program that writes it stops.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/result_folder.h"
#include "core/records/run_identity.h"
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <sys/stat.h>
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
  std::map<std::string, std::string> texts{{"mine.txt", "mine"}, {"notes/a.txt", "mine"}};
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
  // A process publishes and is killed at the rename with this number, before or after it.
  void kill_while_publishing(const int kill, const bool after)
  {
    set_up_earlier_run();
    const pid_t child = ::fork();
    if (child == 0) {
      int renames = 0;
      publish([&](const char *from, const char *to) {
        const bool last = renames++ == kill;
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
    ASSERT_TRUE(WIFSIGNALED(status)) << kill;
  }
  // The entries that a user sees: those that are not hidden.
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

TEST_F(ResultFolder, TheNewRunReplacesTheEarlierOneAndForeignFilesStay)
{
  set_up_earlier_run();
  int renames = 0;
  publish([&](const char *from, const char *to) {
    ++renames;
    return ::rename(from, to);
  });
  EXPECT_EQ(shown(), later);
  EXPECT_EQ(hidden(), "");
  EXPECT_EQ(renames, 1 + 9 + 7 + 1) << "the switch, nine names are moved away, seven into place, the end";
}

// A process that is killed at any of the renames; the first of them is the switch.
TEST_F(ResultFolder, AKillAtAnyRenameLeavesOneRunAndTheNextCommandCompletesIt)
{
  for (int kill = 0; kill < 18; ++kill)
    for (const bool after : {false, true}) {
      kill_while_publishing(kill, after);
      EXPECT_LE(runs_shown().size(), 1u) << "files of two runs are visible after rename " << kill;
      const bool switched = kill > 0 || after;
      {
        const FolderLock alone(folder.string());
        finish_publishing(folder.string());
        remove_leftovers(folder.string());
      }
      EXPECT_EQ(shown(), switched ? later : earlier) << kill;
      EXPECT_EQ(hidden(), "") << kill;
    }
}

// Another kind of folder, of three files: those of a run that are next to them are files of the user there.
TEST_F(ResultFolder, FilesOfAnAnalysisAreReplacedTogetherAndOthersStay)
{
  const std::vector<std::string> names{"analysis.json", "spectrum.csv", "report.html"};
  const std::vector<std::string> first{"analysis.json", "spectrum.csv", "report.html", "results.json"};
  for (int kill = 0; kill < 7; ++kill) {  // the switch, three names away, two into place, the end
    fs::remove_all(folder);
    write(folder, first, "earlier");
    const pid_t child = ::fork();
    if (child == 0) {
      int renames = 0;
      const FolderLock alone(folder.string());
      const Staging staging(folder.string());
      write(staging.path(), {"analysis.json", "report.html"}, "later");
      publish_results(
          staging.path(), folder.string(),
          [&](const char *from, const char *to) {
            if (renames++ == kill)
              ::raise(SIGKILL);
            return ::rename(from, to);
          },
          names);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << kill;
    {
      const WholeRun complete(folder.string());
    }
    std::map<std::string, std::string> wanted{{"results.json", "earlier"}};
    for (const char *name : {"analysis.json", "report.html"})
      wanted[name] = kill == 0 ? "earlier" : "later";
    if (kill == 0)
      wanted["spectrum.csv"] = "earlier";
    EXPECT_EQ(shown(), wanted) << kill;
  }
}

// A journal is text from a disk: names that lead out of the folder are not followed.
TEST_F(ResultFolder, NamesOfAJournalThatLeadElsewhereAreLeftAlone)
{
  set_up_earlier_run();
  const fs::path outside = folder.string() + "-outside.txt";
  write_atomically(outside.string(), "outside");
  fs::create_directories(folder / ".publishing");
  write_atomically((folder / ".publishing/.names").string(),
                   "../" + outside.filename().string() + "\nresults.json\n");
  write_atomically((folder / ".publishing/.replaced").string(),
                   "results.json\n../" + outside.filename().string() + "\n" + outside.string() + "\n..\n");
  write_atomically((folder / ".publishing/results.json").string(), "later");
  {
    const WholeRun complete(folder.string());
  }
  EXPECT_EQ(read_text(outside.string()), "outside");
  EXPECT_EQ(shown().at("results.json"), "later");
  EXPECT_EQ(shown().at("mine.txt"), "mine");
  fs::remove(outside);
}

// The same, and the next program only reads.
TEST_F(ResultFolder, AReaderAfterAKillAtAnyRenameSeesOneWholeRun)
{
  for (int kill = 0; kill < 18; ++kill)
    for (const bool after : {false, true}) {
      kill_while_publishing(kill, after);
      const bool switched = kill > 0 || after;
      const WholeRun run(folder.string());
      EXPECT_EQ(shown(), switched ? later : earlier) << kill;
    }
}

TEST_F(ResultFolder, AFileOfAnInterruptedRunIsReadFromTheCompletedRun)
{
  for (int kill = 1; kill < 18; ++kill) {
    kill_while_publishing(kill, false);
    EXPECT_EQ(read_toml_text((folder / "resolved.toml").string()), "later") << kill;
  }
}

TEST_F(ResultFolder, AReaderThatMayNotWriteRefusesAnIncompleteRun)
{
  kill_while_publishing(12, false);
  ::chmod(folder.c_str(), 0555);
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t another = 65534;
    if (::geteuid() == 0 && ::setuid(another) != 0)  // root may write everywhere
      ::_exit(2);
    const std::string error   = refusal([&] { const WholeRun run(folder.string()); });
    const std::string refused = "a run was interrupted while it replaced the results in " + folder.string() +
                                ", and the replacement cannot be completed (";
    ::_exit(error.find(refused) != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  fs::permissions(folder, fs::perms::owner_all);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: not refused in these words, 2: no other user";
}

TEST_F(ResultFolder, ASymbolicLinkToAFolderIsFollowed)
{
  set_up_earlier_run();
  const fs::path target = folder, link = folder.string() + "-link";
  fs::remove(link);
  fs::create_directory_symlink(target, link);
  folder = link;
  publish();
  EXPECT_TRUE(fs::is_symlink(link));
  folder = target;
  fs::remove(link);
  EXPECT_EQ(shown(), later);
  EXPECT_EQ(hidden(), "");
}

// As before, but the system refuses the rename: the program continues and reports it.
TEST_F(ResultFolder, ARefusedRenameIsReportedAndLosesNothing)
{
  for (int refused = 0; refused < 18; ++refused) {
    set_up_earlier_run();
    int renames              = 0;
    const std::string error  = refusal([&] {
      publish([&](const char *from, const char *to) {
        if (renames++ == refused)
          return errno = EIO, -1;
        return ::rename(from, to);
      });
    });
    const std::string remedy = refused == 0 ? "; the earlier results are unchanged, choose another folder with -o"
                                            : "; the new results are complete in " + folder.string() +
                                                  "/.publishing, `millstand report " + folder.string() +
                                                  "` moves them into place";
    EXPECT_NE(error.find("cannot be written: Input/output error" + remedy), std::string::npos) << error;
    EXPECT_LE(runs_shown().size(), 1u) << refused;
    finish_publishing(folder.string());
    EXPECT_EQ(shown(), refused == 0 ? earlier : later) << refused;
    EXPECT_EQ(hidden(), "") << refused;
  }
}

TEST_F(ResultFolder, AnInterruptedRenameIsRepeated)
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

TEST_F(ResultFolder, AFolderThatIsNotAJournalIsRefused)
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
