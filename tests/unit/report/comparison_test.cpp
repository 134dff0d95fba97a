#include "report/compare/certainty.h"
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

TEST(Comparison, SectionsBelowAListBelongToTheirItem)
{
  const std::string text =
      "[[roll]]\nname = \"A\"\n[roll.saddles]\nstiffness = \"1 kN/mm\"\n[[roll]]\nname = \"B\"\n"
      "[roll.saddles]\nstiffness = ";
  const auto changed = changed_inputs({text + "\"2000 kN/mm\"\n", text + "\"4000 kN/mm\"\n"});
  ASSERT_EQ(changed.size(), 1u) << "the second of two rolls, numbered from 0";
  EXPECT_EQ(changed[0].key, "roll.1.saddles.stiffness");
  EXPECT_EQ(changed[0].values, (std::vector<std::string>{"\"2000 kN/mm\"", "\"4000 kN/mm\""}));
}

TEST(Comparison, NamesOfSectionsHaveNoQuotes)
{
  const auto changed =
      changed_inputs({"[bearing.\"crb 1.5\"]\nbore = \"1 mm\"\n", "[bearing.\"crb 1.5\"]\nbore = \"2 mm\"\n"});
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].key, "bearing.crb 1.5.bore") << "as results name their inputs";
}

TEST(Comparison, RunsWithoutErrorsAndOtherInputsSaySo)
{
  const std::string page = comparison_page({run_with("a", {{"K1", 100}}, 0), run_with("b", {{"K1", 150}}, 0)},
                                           {"title = \"x\"\n", "title = \"x\"\n"});
  EXPECT_NE(page.find("certain: neither run states an error"), std::string::npos);
  EXPECT_EQ(page.find("certain: follows from"), std::string::npos) << "there is nothing that it could name";
}

TEST(Comparison, ResultsThatDifferLargestFirst)
{
  const std::vector<mill::report::Run> runs{
      run_with("a", {{"K1", 100}, {"K2", 100}, {"K3", 100}, {"K4", 1}, {"zero", 0}}),
      run_with("b", {{"K1", 101}, {"K2", 80}, {"K3", 100 * (1 + 1e-12)}, {"zero", 0}})};
  const auto changed = changed_results(runs, {"", ""});
  ASSERT_EQ(changed.size(), 2u) << "K3 differs by rounding, K4 stands in one run only";
  EXPECT_EQ(changed[0].results[0]->name, "K2");
  EXPECT_TRUE(near(changed[0].change, -0.2, within(1e-14, "one quotient and one difference of numbers near one")));
  EXPECT_EQ(changed[0].certainty, Certainty::beyond);
  EXPECT_TRUE(near(changed[1].change, 0.01, within(1e-13, "101/100 - 1 loses two digits by cancellation")));
  EXPECT_EQ(changed[1].certainty, Certainty::within) << "1 % with 1 % of either run and no input that differs";
}

namespace {
// Modes that follow K4, K3 and a chock; the run states what an estimate of the chock moves.
Run run_of_stand(const std::string &directory, const double f1, const double f2, const double error = 0.1)
{
  Run run = run_with(directory, {{"f1", f1}, {"f2", f2}}, error);
  for (Result &result : run.results)
    result.inputs = {"given.K4", "given.K3", "backup_roll.chock_mass_upper", "dynamics.model"};
  return run;
}

std::vector<ChangedResult> differences(const std::string &first, const std::string &other, const double f1 = 100.5)
{
  return changed_results({run_of_stand("a", 100, 200), run_of_stand("b", f1, 201)}, {first, other});
}
}  // namespace

TEST(Comparison, WhatFollowsFromOneGivenKeyIsCertain)
{
  const auto changed =
      differences("title = \"a\"\n[given]\nK4 = \"17 GN/m\"\n", "title = \"b\"\n[given]\nK4 = \"18 GN/m\"\n");
  ASSERT_EQ(changed.size(), 2u);
  for (const ChangedResult &one : changed) {
    EXPECT_EQ(one.certainty, Certainty::certain) << "0.5 % with 10 % of either run, which cancel";
    EXPECT_EQ(one.error, 0);
    EXPECT_EQ(one.behind, std::vector<std::string>{"given.K4"}) << "the title makes no result";
  }
}

TEST(Comparison, OneGivenKeyIsCertainWhateverItsTolerance)
{
  const auto changed = differences("[given]\nK4 = { value = \"17 GN/m\", error_estimate = 0.1 }\n",
                                   "[given]\nK4 = { value = \"18 GN/m\", error_estimate = 0.1 }\n");
  EXPECT_EQ(changed[0].certainty, Certainty::certain);
}

TEST(Comparison, SeveralValuesWithErrorsOfTheirOwnLeaveTheErrorsOfBothRuns)
{
  const auto changed =
      differences("[given]\nK3 = \"60 GN/m\"\nK4 = { value = \"17 GN/m\", error_estimate = 0.1 }\n",
                  "[given]\nK3 = \"61 GN/m\"\nK4 = { value = \"18 GN/m\", error_estimate = 0.1 }\n");
  EXPECT_EQ(changed[0].certainty, Certainty::within);
  EXPECT_TRUE(near(changed[0].error, std::hypot(0.1, 0.1 * 1.005),
                   within(1e-14, "two relative errors of 10 %, the second of a value 0.5 % larger")));
  EXPECT_EQ(differences("[given]\nK3 = \"60 GN/m\"\nK4 = \"17 GN/m\"\n",
                        "[given]\nK3 = \"61 GN/m\"\nK4 = \"18 GN/m\"\n")[0]
                .certainty,
            Certainty::certain)
      << "without errors of their own";
}

TEST(Comparison, AnotherModelLeavesTheErrorsOfBothRuns)
{
  const std::string six = "[dynamics]\nmodel = \"six-mass\"\n", beam = "[dynamics]\nmodel = \"beam\"\n";
  EXPECT_EQ(differences(six, beam)[0].certainty, Certainty::within);
  EXPECT_EQ(differences(six, beam, 150)[0].certainty, Certainty::beyond) << "50 % with 18 %";
  EXPECT_EQ(differences("[given]\nK4 = \"17 GN/m\"\n", "[given]\n")[0].certainty, Certainty::within)
      << "one run computes it";
}

TEST(Comparison, AnEstimateThatIsReplacedLeavesItsInterval)
{
  mill::report::Run first       = run_of_stand("a", 100, 200);
  first.estimates               = {{"backup_roll.chock_mass_upper", 1e4, 5e3, 2e4, "kg", "rule", {{"f1", 0.03}}}};
  const mill::report::Run other = run_of_stand("b", 102, 201);
  const std::vector<mill::report::Run> runs{first, other};  // the results point into it
  const auto result =
      changed_results(runs, {"# backup_roll.chock_mass_upper = \"10000 kg\" is estimated, 5000 kg .. 20000 kg\n",
                             "[backup_roll]\nchock_mass_upper = \"12000 kg\"\n"});
  EXPECT_EQ(result[0].results[0]->name, "f1");
  EXPECT_EQ(result[0].certainty, Certainty::within);
  EXPECT_TRUE(near(result[0].error, 0.03, within(1e-15, "what the run states")));
  EXPECT_TRUE(near(result[1].error, std::hypot(0.1, 0.1 * 1.005),
                   within(1e-14, "the estimate does not state what it moves f2 by")));
}

TEST(Comparison, EstimatesThatFollowBothTimesAreNoInput)
{
  EXPECT_TRUE(changed_inputs({"# backup_roll.chock_mass_upper = \"10000 kg\" is estimated\n",
                              "# backup_roll.chock_mass_upper = \"11000 kg\" is estimated\n"})
                  .empty());
}

TEST(Comparison, WordsChooseModelsUnlessTheyNameAPart)
{
  EXPECT_TRUE(chooses_model("bite.theory", "\"karman\""));
  EXPECT_TRUE(chooses_model("bite.elements_along", "48"));
  EXPECT_FALSE(chooses_model("bearing.work.arrangement", "\"back-to-back\""));
  EXPECT_FALSE(chooses_model("work_roll.barrel_diameter", "\"585 mm\""));
  EXPECT_FALSE(chooses_model("strip.friction", "0.03"));
}

TEST(Comparison, ThePageSaysHowMuchDiffers)
{
  const std::string page = comparison_page(
      {run_with("out/a", {{"K1", 100}, {"K2", 100}}), run_with("out/b/", {{"K1", 100}, {"K2", 150}})},
      {"a = 1\n", "a = 2\n"});
  EXPECT_NE(page.find("1 input differs; 1 result differs: 1 with certainty."), std::string::npos);
  EXPECT_NE(page.find("certain: follows from <code>a</code>"), std::string::npos);
  EXPECT_EQ(page.find("within the accuracy"), std::string::npos);
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
