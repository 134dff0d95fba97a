#include "report/compare/comparison.h"
#include "report/front/html.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill::report;

namespace {
Run run_with(const std::string &directory, const std::vector<std::pair<std::string, double>> &values,
             const double error = 0.01)
{
  Run run;
  run.directory = directory;
  run.case_name = "stand";
  run.status    = "ok";
  for (const auto &[name, value] : values) {
    Result r{};
    r.name           = name;
    r.value          = value;
    r.unit           = "N/m";
    r.error_estimate = error;
    run.results.push_back(r);
  }
  return run;
}
}  // namespace

TEST(Comparison, InputsThatDiffer)
{
  const auto changed =
      changed_inputs({"kind = \"lumped\"\n[work_roll]\ncrown = \"0 um\"  # default\n[[pass]]\nname = \"a # 1\"\n",
                      "kind = \"lumped\"\n[work_roll]\ncrown = \"0 um\"\n[[pass]]\nname = \"a # 2\"\n"
                      "[[pass]]\nname = \"b\"\n"});
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_EQ(changed[0].key, "pass.0.name");
  EXPECT_EQ(changed[0].values, (std::vector<std::string>{"\"a # 1\"", "\"a # 2\""}));
  EXPECT_EQ(changed[1].key, "pass.1.name");
  EXPECT_EQ(changed[1].values[0], "");
}

TEST(Comparison, ResultsThatDifferLargestFirst)
{
  const std::vector<mill::report::Run> runs{
      run_with("a", {{"K1", 100}, {"K2", 100}, {"K3", 100}, {"K4", 1}, {"zero", 0}}),
      run_with("b", {{"K1", 101}, {"K2", 80}, {"K3", 100 * (1 + 1e-12)}, {"zero", 0}})};
  const auto changed = changed_results(runs);
  ASSERT_EQ(changed.size(), 2u) << "K3 differs by rounding, K4 stands in one run only";
  EXPECT_EQ(changed[0].results[0]->name, "K2");
  EXPECT_TRUE(near(changed[0].change, -0.2, within(1e-14, "one quotient and one difference of numbers near one")));
  EXPECT_TRUE(changed[0].beyond);
  EXPECT_TRUE(near(changed[1].change, 0.01, within(1e-13, "101/100 - 1 loses two digits by cancellation")));
  EXPECT_FALSE(changed[1].beyond) << "1 % with 1 % of either run";
}

TEST(Comparison, ThePageSaysHowMuchDiffers)
{
  const std::string page = comparison_page(
      {run_with("out/a", {{"K1", 100}, {"K2", 100}}), run_with("out/b/", {{"K1", 100}, {"K2", 150}})},
      {"a = 1\n", "a = 2\n"});
  EXPECT_NE(page.find("1 input differs; 1 result differs, 1 by more than the accuracy of both runs."),
            std::string::npos);
  EXPECT_NE(page.find("<th>a</th><th>b</th>"), std::string::npos);
  EXPECT_NE(page.find("+50.0\u00a0%"), std::string::npos);
  EXPECT_EQ(page.find(">nan<"), std::string::npos);
}

TEST(Comparison, OnlyItsOwnPageIsRecognised)
{
  const std::string page = comparison_page({run_with("a", {{"K1", 1}}), run_with("b", {{"K1", 2}})}, {"", ""});
  EXPECT_TRUE(is_comparison_page(page));
  EXPECT_FALSE(is_comparison_page(html_page(run_with("a", {{"K1", 1}})))) << "the report of a run";
  EXPECT_FALSE(is_comparison_page("")) << "an empty file may be somebody's";
  EXPECT_FALSE(is_comparison_page("<!DOCTYPE html>\n<title>prices</title><style></style>" + page)) << "embedded";
}
