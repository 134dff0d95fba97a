#include "tests/support/coarse_run.h"

// A whole run computed again: with components and responses, which the suite compares from the cache alone; its
// stiffnesses are compared afresh in schedule_test.
TEST(FreshRun, SaysWhatTheCacheSaidOnAnyNumberOfThreads)
{
  const std::string kept  = coarse_run("run", "kept-run", "--threads 2"),
                    fresh = coarse_run("run", "fresh-run", "--fresh --threads 1");
  EXPECT_EQ(difference_of_runs(kept, fresh), "");
  const auto run = nlohmann::json::parse(mill::read_text(fresh + "/run.json"));
  int computed   = 0;
  for (const auto &stage : run.at("timings")) {
    const auto name = stage.at("stage").get<std::string>();
    for (const char *heavy : {"condensation", "contact", "components", "bite, section"})
      if (name.rfind(heavy, 0) == 0) {
        EXPECT_FALSE(stage.at("cached").get<bool>()) << name;
        ++computed;
      }
  }
  EXPECT_GE(computed, 8);
}
