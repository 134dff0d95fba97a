#include "app/run/kept_part.h"
#include "app/run/run_context.h"
#include "core/model/case.h"
#include <atomic>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

// Stages side by side: what they say comes in the order in which they are taken.
namespace {
using namespace mill;

struct Folder {
  Case the_case;
  std::string path = testing::TempDir() + "side-by-side";
  Folder()
  {
    std::filesystem::remove_all(path);
    the_case.name = "side-by-side";
  }
  ~Folder()
  {
    std::filesystem::remove_all(path);
  }
};

Parameter number(const double value)
{
  Parameter p;
  p.value = value;
  return p;
}

// A stage that waits for another one to be done, where two threads are there to run them.
IndependentStage says(const std::string &name, std::atomic<int> &turn, const int turn_of_this, const bool wait)
{
  return [=, &turn](RunContext &run) {
    for (int i = 0; wait && turn < turn_of_this && i < 100; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    run.results.append({{name, number(turn_of_this)}});
    run.warn(warning_of_text("warning of " + name));
    run.warn(warning_of_text("warning of both"));
    run.assume(name);
    ++turn;
  };
}
}  // namespace

TEST(SideBySide, ResultsComeInTheOrderOfTheListWhateverEndsFirst)
{
  const Folder folder;
  const OutputDir out(folder.path, folder.the_case, true, "id");
  RunContext run{folder.the_case, out, folder.path};
  run.threads = 2;
  run.results.append({{"before", number(0)}});
  std::atomic<int> turn{0};
  run_side_by_side(run, {says("first", turn, 1, true), says("second", turn, 0, false)});
  ASSERT_EQ(run.results.values.size(), 3u);
  EXPECT_EQ(run.results.values[1].first, "first");
  EXPECT_EQ(run.results.values[2].first, "second");
  EXPECT_EQ(texts_of(run.results.warnings),
            (std::vector<std::string>{"warning of first", "warning of both", "warning of second"}));
  EXPECT_EQ(run.results.assumptions, (std::vector<std::string>{"first", "second"}));
}

TEST(SideBySide, ABranchSeesWhatWasThereBefore)
{
  const Folder folder;
  const OutputDir out(folder.path, folder.the_case, true, "id");
  RunContext run{folder.the_case, out, folder.path};
  run.results.append({{"before", number(3)}});
  run_side_by_side(run, {[](RunContext &part_run) {
                     ASSERT_NE(part_run.find("before"), nullptr);
                     EXPECT_EQ(part_run.find("before")->value, 3);
                     EXPECT_EQ(part_run.find("after"), nullptr);
                   }});
}

TEST(SideBySide, TheFirstFailureOfTheListIsThrownAfterTheResultsBeforeIt)
{
  const Folder folder;
  const OutputDir out(folder.path, folder.the_case, true, "id");
  for (const int threads : {1, 2}) {
    RunContext run{folder.the_case, out, folder.path};
    run.threads     = threads;
    const auto fail = [](const char *what) { return [what](RunContext &) { throw InputError(what); }; };
    std::atomic<int> turn{0};
    try {
      run_side_by_side(run, {says("good", turn, 0, false), fail("one"), fail("two")});
      FAIL();
    } catch (const InputError &e) {
      EXPECT_EQ(e.problems.front().message, "one");
    }
    EXPECT_NE(run.results.find("good"), nullptr);
  }
}

TEST(SideBySide, APartOfTwoStagesIsMadeOnce)
{
  const Folder folder;
  const OutputDir out(folder.path, folder.the_case, true, "id");
  RunContext run{folder.the_case, out, folder.path};
  run.threads = 2;
  run.fresh   = true;
  std::atomic<int> made{0};
  const auto part = [&](RunContext &part_run) {
    const int value = kept_part<int>(
        part_run, "part", folder.path + "/part.bin", "key",
        [&] {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          return ++made;
        },
        "nothing smaller");
    EXPECT_EQ(value, 1);
  };
  run_side_by_side(run, {part, part});
  EXPECT_EQ(made, 1);
  ASSERT_EQ(run.times.size(), 2u);
  EXPECT_NE(run.times[0].cached, run.times[1].cached);
}
