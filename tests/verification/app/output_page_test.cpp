#include "report/results/output_reference.h"
#include "tests/support/coarse_run.h"

// docs/output.md explains every result of a run.
namespace {
std::set<std::string> rows_of_page()
{
  std::set<std::string> rows;
  std::istringstream page(mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/docs/output.md"));
  for (std::string line; std::getline(page, line);)
    if (line.rfind("| `", 0) == 0)
      rows.insert(line.substr(3, line.find('`', 3) - 3));
  return rows;
}

void expect_all_explained(const std::string &folder)
{
  const std::set<std::string> rows = rows_of_page();
  const mill::report::Run run      = mill::report::read_run(folder);
  EXPECT_FALSE(run.results.empty()) << folder;
  for (const mill::report::Result &result : run.results)
    EXPECT_TRUE(rows.count(mill::report::row_of_output(run, result.name)))
        << result.name << " has no row in docs/output.md; tests/bench/output-reference prints the page";
}
}  // namespace

TEST(OutputPage, ExplainsEveryResultOfAStand)
{
  expect_all_explained(coarse_run("run", "output-page", ""));
}

TEST(OutputPage, ExplainsEveryResultOfOtherKinds)
{
  for (const char *name : {"two-cylinders", "published-1400", "crowned-roller-on-plane"}) {
    const std::string folder = scratch(std::string("output-") + name);
    const auto outcome =
        millstand(std::string("run cases/") + name + ".toml -q -o " + folder + " --cache " + shared_cache());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_all_explained(folder);
  }
}

TEST(OutputPage, ListsEveryWarning)
{
  const std::string page = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/docs/output.md");
  const std::string part = mill::report::warning_reference();
  ASSERT_GE(page.size(), part.size());
  EXPECT_EQ(page.substr(page.size() - part.size()), part) << "docs/output.md ends with the rows of the warnings";
}

TEST(OutputPage, EveryRowHasAMeaning)
{
  std::istringstream page(mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/docs/output.md"));
  for (std::string line; std::getline(page, line);)
    if (line.rfind("| `", 0) == 0)
      EXPECT_EQ(line.find("` |  |"), std::string::npos) << line;
}
