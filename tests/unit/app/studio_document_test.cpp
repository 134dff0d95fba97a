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
