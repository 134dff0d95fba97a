#include "core/records/result_row.h"
#include "report/page/run.h"
#include "report/results/output_reference.h"
#include "tests/support/coarse_run.h"

// Every result of a run has a row, and docs/output.md lists the rows.
namespace {
void expect_all_explained(const std::string &folder)
{
  const mill::report::Run run = mill::report::read_run(folder);
  EXPECT_FALSE(run.results.empty()) << folder;
  for (const mill::report::Result &result : run.results) {
    const auto id = mill::result_id(result.name);
    ASSERT_TRUE(id) << result.name << " has no row in core/records/rows_of_*.h";
    if (*id->row->unit) {
      EXPECT_EQ(result.unit, id->row->unit) << result.name << " is made by " << id->row->name;
    }
  }
}

void expect_runs_explained(const std::vector<std::string> &cases, const std::string &more = "")
{
  for (const std::string &name : cases) {
    const std::string folder = scratch("output-" + name);
    const auto outcome =
        millstand("run cases/" + name + ".toml -q -o " + folder + " --cache " + shared_cache() + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_all_explained(folder);
  }
}
}  // namespace

TEST(OutputPage, ExplainsEveryResultOfAStand)
{
  expect_all_explained(coarse_run("run", "output-page", ""));
}

TEST(OutputPage, ExplainsEveryResultOfOtherKinds)
{
  expect_runs_explained({"two-cylinders", "published-1400", "crowned-roller-on-plane", "partial-slip", "oil-film",
                         "stack-two-high"});
  expect_runs_explained({"chatter-two-stands"}, " --set analysis.map_points=0");  // maps hold no result
}

TEST(OutputPageLong, ExplainsEveryResultOfMoreKinds)
{
  expect_runs_explained({"chatter-tandem", "z-mill", "bearing-266", "cold-fit", "six-high", "stack-four-high"});
}

TEST(OutputPage, IsThatOfTheRows)
{
  EXPECT_TRUE(mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/docs/output.md") ==
              mill::report::output_reference())
      << "docs/output.md is not what tests/bench/output-reference prints";
}
