#include "tests/support/near.h"
#include "tests/support/studio_edits.h"
#include <csignal>
#include <fstream>
#include <thread>

// The long form of the studio: five hundred edits against the command line, a thousand with a kill at each tenth,
// a run against the command line, and how long answers take.
namespace {
using nlohmann::json;

double percentile(std::vector<double> seconds, const double share)
{
  std::sort(seconds.begin(), seconds.end());
  return seconds.at(std::size_t(share * double(seconds.size() - 1)));
}
}  // namespace

TEST(StudioEdits, FiveHundredEditsAreJudgedAsByTheCommandLine)
{
  const JudgedEdits judged = judge_random_edits(new_stand("five-hundred"), 500, 5);
  EXPECT_EQ(judged.differ, std::vector<std::string>());
  EXPECT_GT(judged.wrong, 50);
  EXPECT_LT(judged.wrong, 450);
}

TEST(StudioEdits, AThousandEditsWithAKillAtEachTenthLoseNone)
{
  const std::string folder = new_stand("thousand");
  std::unique_ptr<StudioProgram> studio;
  json last;
  for (int i = 0; i < 1000; ++i) {
    if (i % 10 == 0) {
      if (studio)
        studio->program().end(SIGKILL);
      studio = std::make_unique<StudioProgram>(folder);
      ASSERT_TRUE(last.is_null() || studio->get("/document")["values"] == last) << i;
    }
    last = studio->edit(std::to_string(i), i % 2 ? "strip.width" : "work_roll.barrel_length",
                        fmt::format("{} mm", 1000 + i % 300))["values"];
  }
  EXPECT_EQ(studio->get("/document")["values"], last);
  EXPECT_EQ(studio->get("/document")["undo"], 1000);
}

TEST(StudioEdits, AnswersAreQuickAndMemoryIsSmall)
{
  StudioProgram studio(new_stand("quick-answers"));
  std::vector<double> check, quick;
  for (int i = 0; i < 60; ++i) {
    double begin = steady_seconds();
    studio.edit(std::to_string(i), "work_roll.barrel_diameter", fmt::format("{} mm", 400 + i));
    check.push_back(steady_seconds() - begin);
    begin = steady_seconds();
    ASSERT_FALSE(studio.post("/quick", json::object()).contains("error"));
    quick.push_back(steady_seconds() - begin);
  }
  RecordProperty("check_p95_ms", fmt::format("{:.0f}", 1e3 * percentile(check, 0.95)));
  RecordProperty("quick_p95_ms", fmt::format("{:.0f}", 1e3 * percentile(quick, 0.95)));
  EXPECT_LT(percentile(check, 0.95), 0.05);
  EXPECT_LT(percentile(quick, 0.95), 0.3);
  std::ifstream status(fmt::format("/proc/{}/status", studio.program().process()));
  long peak = 0;
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0)
      peak = std::atol(line.c_str() + 6);
  EXPECT_GT(peak, 0);
  EXPECT_LT(peak, 300 * 1024) << "kB";
}

TEST(StudioEdits, ARunOfThePageIsThatOfTheSavedFile)
{
  const std::string folder = new_stand("run-as-file");
  StudioProgram studio(folder, "127.0.0.1:0", {"--cache", folder + "/cache"});
  studio.edit("1", "bite.method", "slab");
  studio.post("/save", json::object());
  ASSERT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-1");
  json job;
  for (const double end = steady_seconds() + 300;
       steady_seconds() < end && (job.is_null() || job["status"] == "running");
       std::this_thread::sleep_for(std::chrono::milliseconds(200)))
    job = studio.get("/document")["job"];
  ASSERT_EQ(job["status"], "done") << job.dump();
  const Outcome run = millstand("run stand.toml -q -o out --cache cache", folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(std::ifstream(folder + "/runs/run-1/results.json")),
            json::parse(std::ifstream(folder + "/out/results.json")));
}
