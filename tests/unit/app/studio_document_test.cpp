#include "app/studio/document/document.h"
#include "app/studio/document/journal.h"
#include "app/studio/jobs/jobs.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "tests/support/program.h"
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

namespace studio = mill::studio;

namespace {
std::string case_file(const std::string &name)
{
  const std::string folder = scratch("studio-document-" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/stand.toml") << "title = \"x\"  # kept\n[steel]\nyoungs_modulus = \"210 GPa\"\n";
  return folder + "/stand.toml";
}

std::string none()
{
  return "";
}

studio::Edit edit(const std::string &id, const std::string &toml)
{
  return {id, "steel.youngs_modulus", toml};
}
}  // namespace

TEST(StudioDocument, EditsAreUndoneAndDoneAgain)
{
  const std::string path = case_file("undo");
  studio::Document document(path, none);
  const std::string first = document.state().text;
  document.set({edit("1", "\"206 GPa\""), {"2", "title", "\"y\""}});
  const auto changed = document.state();
  EXPECT_FALSE(changed.saved);
  EXPECT_EQ(changed.undo, 1u);
  EXPECT_NE(changed.text.find("title = \"y\"  # kept"), std::string::npos);
  document.undo();
  EXPECT_EQ(document.state().text, first);
  EXPECT_TRUE(document.state().saved);
  document.redo();
  EXPECT_EQ(document.state().text, changed.text);
  EXPECT_GT(document.state().revision, changed.revision);
}

TEST(StudioDocument, ANameWithoutAFileIsSaidToBeANewStand)
{
  const std::string path = case_file("new");
  EXPECT_EQ(studio::Document(path, none).notice(), "");
  std::filesystem::remove(path);
  std::filesystem::remove(studio::journal_path(path));
  const auto text = [] { return std::string("title = \"x\"\n"); };
  EXPECT_EQ(studio::Document(path, text).notice(),
            path + " does not exist yet: this is a new stand, which is written when it is saved.");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(StudioDocument, AnEditThatArrivesTwiceIsDoneOnce)
{
  studio::Document document(case_file("twice"), none);
  document.set({edit("a", "\"1 GPa\"")});
  document.set({edit("b", "\"2 GPa\"")});
  document.set({edit("a", "\"1 GPa\"")});
  EXPECT_NE(document.state().text.find("\"2 GPa\""), std::string::npos);
}

TEST(StudioDocument, SavingWritesTheTextAndRefusesAForeignChange)
{
  const std::string path = case_file("save");
  studio::Document document(path, none);
  document.set({edit("a", "\"1 GPa\"")});
  document.save();
  EXPECT_EQ(mill::read_text(path), document.state().text);
  EXPECT_TRUE(document.state().saved);
  std::ofstream(path, std::ios::app) << "# by another hand\n";
  document.set({edit("b", "\"2 GPa\"")});
  EXPECT_THROW(document.save(), mill::InputError);
  EXPECT_NE(mill::read_text(path).find("another hand"), std::string::npos);
}

TEST(StudioDocument, ASecondStudioOfOneCaseIsRefused)
{
  const std::string path = case_file("second");
  std::optional<studio::Document> first;
  first.emplace(path, none);
  EXPECT_THROW(studio::Document(path, none), mill::InputError);
  first.reset();
  EXPECT_NO_THROW(studio::Document(path, none));
}

TEST(StudioDocument, PinsAndRunsComeBackAfterAnEnd)
{
  const std::string path = case_file("pins");
  std::string pinned;
  {
    studio::Document document(path, none);
    document.set({edit("a", "\"1 GPa\"")});
    document.pin("hostile <script>\"'&\n");
    pinned = document.state().text;
    document.add_run({"run-1", pinned});
    document.set({edit("b", "\"2 GPa\"")});
  }
  studio::Document again(path, none);
  ASSERT_EQ(again.state().pins.size(), 1u);
  EXPECT_EQ(again.state().pins[0].text, pinned);
  EXPECT_EQ(again.state().runs[0].id, "run-1");
  EXPECT_NE(again.notice(), "");
  again.back_to("hostile <script>\"'&\n");
  EXPECT_EQ(again.state().text, pinned);
  EXPECT_THROW(again.back_to("another"), mill::InputError);
}

TEST(StudioDocument, ALineThatAKillHasCutIsTakenOff)
{
  const std::string path = case_file("cut");
  std::string text;
  {
    studio::Document document(path, none);
    document.set({edit("a", "\"1 GPa\"")});
    text = document.state().text;
  }
  std::ofstream(studio::journal_path(path), std::ios::app) << R"({"op":"set","edits":[{"id":"b)";
  studio::Document again(path, none);
  EXPECT_EQ(again.state().text, text);
  again.set({edit("c", "\"3 GPa\"")});
  EXPECT_NE(again.state().text.find("\"3 GPa\""), std::string::npos);
}

TEST(StudioDocument, AFileThatChangedOutsideIsTakenAndTheJournalKept)
{
  const std::string path = case_file("outside");
  {
    studio::Document document(path, none);
    document.set({edit("a", "\"1 GPa\"")});
  }
  std::ofstream(path) << "title = \"new\"\n";
  const studio::Document again(path, none);
  EXPECT_EQ(again.state().text, "title = \"new\"\n");
  EXPECT_NE(again.notice().find("outside"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(studio::journal_path(path) + ".old"));
}

// A change outside, twice: what was typed before the first is still there after the second, where nothing was
// lost.
TEST(StudioDocument, ARescuedCopyIsNeverReplaced)
{
  const std::string path = case_file("rescued");
  const auto old = studio::journal_path(path) + ".old", second = old + "-2";
  {
    studio::Document document(path, none);
    document.set({edit("a", "\"1 GPa\"")});
  }
  std::ofstream(path) << "title = \"new\"\n";
  {
    const studio::Document document(path, none);
    EXPECT_NE(document.notice().find(old), std::string::npos) << document.notice();
  }
  std::ofstream(path) << "title = \"newer\"\n";
  {
    studio::Document document(path, none);
    EXPECT_NE(document.notice().find("outside"), std::string::npos);
    EXPECT_EQ(document.notice().find("not saved"), std::string::npos) << document.notice();
    document.set({{"b", "title", "\"typed\""}});
  }
  EXPECT_NE(mill::read_text(old).find("1 GPa"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(second));
  std::ofstream(path) << "title = \"newest\"\n";
  const studio::Document document(path, none);
  EXPECT_NE(document.notice().find(second), std::string::npos) << document.notice();
  EXPECT_NE(mill::read_text(old).find("1 GPa"), std::string::npos);
  EXPECT_NE(mill::read_text(second).find("typed"), std::string::npos);
  EXPECT_EQ(std::filesystem::status(second).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write)
      << "a case that only its owner reads stays so";
}

TEST(StudioDocument, PinsAndRunsStayWhenTheFileChangesOutside)
{
  const std::string path = case_file("outside-pins");
  std::string pinned;
  {
    studio::Document document(path, none);
    document.pin("p");
    pinned = document.state().text;
    document.add_run({"run-1", pinned});
  }
  for (const char *title : {"title = \"new\"\n", "title = \"newer\"\n"}) {
    std::ofstream(path) << title;
    const auto state = studio::Document(path, none).state();
    EXPECT_EQ(state.text, title);
    ASSERT_EQ(state.pins.size(), 1u);
    EXPECT_EQ(state.pins[0].text, pinned);
    ASSERT_EQ(state.runs.size(), 1u);
    EXPECT_EQ(state.runs[0].id, "run-1");
  }
}

TEST(StudioDocument, AnEndBetweenTheFileAndTheJournalOfASaveLosesNothing)
{
  const std::string path = case_file("half-saved");
  std::string text;
  {
    studio::Document document(path, none);
    document.set({edit("a", "\"1 GPa\"")});
    text = document.state().text;
  }
  std::ofstream(path) << text;  // what save() does first
  const studio::Document again(path, none);
  EXPECT_TRUE(again.state().saved);
  EXPECT_EQ(again.state().undo, 1u);
  EXPECT_EQ(again.notice(), "");
  EXPECT_FALSE(std::filesystem::exists(studio::journal_path(path) + ".old"));
}

TEST(StudioDocument, ARefusedEditLeavesTheOthersOfItsBatch)
{
  const std::string path = case_file("batch");
  std::string text;
  {
    studio::Document document(path, none);
    const auto refused =
        document.set({{"1", "title", "\"good\""}, {"2", "", "\"x\""}, edit("3", "\"1 GPa\""), {"2", "", "1"}});
    ASSERT_EQ(refused.size(), 2u);
    EXPECT_EQ(refused[0].id, "2");
    EXPECT_NE(refused[0].message, "");
    text = document.state().text;
    EXPECT_EQ(document.state().undo, 1u);
    EXPECT_EQ(document.set({{"4", "", "1"}}).size(), 1u);
    EXPECT_EQ(document.state().text, text);
  }
  EXPECT_NE(text.find("\"good\""), std::string::npos);
  EXPECT_NE(text.find("\"1 GPa\""), std::string::npos);
  EXPECT_EQ(studio::Document(path, none).state().text, text) << "the journal is replayed";
}

TEST(StudioJobs, NothingIsPublishedOrStartedAfterTheEnd)
{
  std::atomic<int> published = 0;
  studio::Jobs jobs([&](const studio::JobState &) { ++published; });
  jobs.start("run-1", "/bin/sleep", {"60"});
  jobs.end();
  EXPECT_EQ(jobs.state().status, studio::JobStatus::cancelled);
  const int last = published;
  EXPECT_EQ(last, 2) << "its begin and its end";
  EXPECT_THROW(jobs.start("run-2", "/bin/true", {}), mill::InputError);
  EXPECT_EQ(published, last);
}

// A process that edits and is killed after each tenth edit: no edit that was answered is lost.
TEST(StudioDocument, NoAnsweredEditIsLostByAKill)
{
  const std::string path = case_file("kill");
  int done               = 0;
  for (int round = 0; round < 20; ++round) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      studio::Document document(path, none);
      for (int i = 0; i < 10; ++i) {
        const int n = done + i + 1;
        document.set({edit(std::to_string(n), "\"" + std::to_string(n) + " GPa\"")});
        (void)!write(ends[1], "x", 1);
      }
      pause();
      _exit(0);
    }
    close(ends[1]);
    char answered[10];
    for (int i = 0; i < 10; ++i)
      ASSERT_EQ(read(ends[0], &answered[i], 1), 1);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ends[0]);
    done += 10;
  }
  const studio::Document document(path, none);
  EXPECT_NE(document.state().text.find("\"200 GPa\""), std::string::npos) << document.state().text;
  EXPECT_EQ(document.state().undo, 200u);
}
