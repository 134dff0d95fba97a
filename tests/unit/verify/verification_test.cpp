#include "core/base/errors.h"
#include "core/case/fields.h"
#include "tests/manual/groups.h"
#include "tests/manual/manual.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

using namespace mill;
using namespace mill::verify;

namespace {
Check check(const double result, const double reference, const double tolerance, const Judged judged)
{
  return {"force", "N", result, reference, tolerance, judged};
}

Case page(const std::string &name, const std::vector<Check> &checks)
{
  return {name, "unit", "A spring. It is linear.", "Hooke", "exact arithmetic", [checks] { return checks; }};
}

// Asked is 100 within 1 %; recorded is 105.
Check deviating(const double result)
{
  return known_deviation(check(result, 100, 0.01, Judged::relative),
                         {105, 0.5, "the spring is bent", "a new spring"});
}

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

std::string file(const std::string &name)
{
  std::ifstream in(std::string(MILLSTAND_SOURCE_DIR) + "/" + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}
}  // namespace

TEST(Judging, EachKindHasItsBound)
{
  EXPECT_TRUE(passes(check(-99, -100, 0.01, Judged::relative)));
  EXPECT_FALSE(passes(check(-98.9, -100, 0.01, Judged::relative)));
  EXPECT_TRUE(passes(check(0.5, 0, 0.5, Judged::absolute)));
  EXPECT_FALSE(passes(check(0.6, 0, 0.5, Judged::absolute)));
  EXPECT_TRUE(passes(check(2.5, 2.5, 0, Judged::at_least)));
  EXPECT_FALSE(passes(check(2.4, 2.5, 0, Judged::at_least)));
  EXPECT_TRUE(passes(check(1e-13, 1e-12, 0, Judged::at_most)));
  EXPECT_FALSE(passes(check(2e-12, 1e-12, 0, Judged::at_most)));
  EXPECT_TRUE(passes(check(1e9, 1, 0, Judged::reported)));
}

TEST(Judging, WhatIsNotANumberFails)
{
  for (const Judged judged :
       {Judged::relative, Judged::absolute, Judged::at_least, Judged::at_most, Judged::reported})
    EXPECT_EQ(verdict(check(std::nan(""), 1, 1, judged)), Verdict::fail);
  EXPECT_EQ(verdict(deviating(std::nan(""))), Verdict::fail);
  EXPECT_FALSE(passes(check(INFINITY, 1, 1, Judged::relative)));
}

TEST(Judging, AKnownDeviationFailsWhenItMovesAndWhenItIsGone)
{
  EXPECT_EQ(verdict(deviating(105.3)), Verdict::known_deviation);
  EXPECT_EQ(verdict(deviating(106)), Verdict::fail);
  EXPECT_EQ(verdict(deviating(100)), Verdict::fail);
  // Also when the spread reaches into the asked tolerance.
  EXPECT_EQ(verdict(known_deviation(check(100.9, 100, 0.01, Judged::relative), {105, 5, "", ""})), Verdict::fail);
  EXPECT_EQ(verdict_text(run(page("bent", {deviating(105)}))), "known deviation");
  EXPECT_TRUE(passes(run(page("bent", {deviating(105)}))));
}

TEST(Judging, ACaseThatOnlyReportsIsNotCounted)
{
  const Outcome reports = run(page("reports", {check(2, 1, 0, Judged::reported)}));
  EXPECT_EQ(verdict_text(reports), "reported");
  EXPECT_EQ(summary_text({reports, run(page("judges", {check(1, 1, 0, Judged::absolute)}))}),
            "1 of 1 cases pass, 1 of 1 judged checks; 1 value compared with a reference, not judged");
}

TEST(Judging, ASkippedCaseNeitherPassesNorFails)
{
  Case needs            = page("peer", {});
  needs.run             = []() -> std::vector<Check> { throw Skipped("needs a peer"); };
  const Outcome skipped = run(needs);
  EXPECT_EQ(verdict_text(skipped), "skipped");
  EXPECT_FALSE(passes(skipped));
  EXPECT_TRUE(contains(outcome_text(skipped), "skipped: needs a peer")) << outcome_text(skipped);
  EXPECT_EQ(summary_text({run(page("good", {check(1, 1, 0, Judged::absolute)})), skipped}),
            "1 of 1 cases pass, 1 of 1 judged checks; skipped: peer (needs a peer)");
}

TEST(Judging, AWrittenResultMayChangeWithinTheTolerance)
{
  EXPECT_DOUBLE_EQ(allowed_change(check(-99, -100, 0.01, Judged::relative)), 1);
  EXPECT_DOUBLE_EQ(allowed_change(check(0.1, 0, 0.5, Judged::absolute)), 0.5);
  EXPECT_DOUBLE_EQ(allowed_change(deviating(105)), 0.5);
  EXPECT_DOUBLE_EQ(allowed_change(check(3e-14, 1e-12, 0, Judged::at_most)), 1e-13);
  EXPECT_DOUBLE_EQ(allowed_change(check(200, 100, 0, Judged::reported)), 2);
}

TEST(Judging, ACaseThatStopsOrChecksNothingFails)
{
  Case stops = page("stops", {});
  stops.run  = []() -> std::vector<Check> { throw SolverError({"no active set", "60 iterations", "", "", ""}); };
  EXPECT_FALSE(passes(run(stops)));
  EXPECT_EQ(run(stops).error, "no active set (60 iterations)");
  EXPECT_TRUE(contains(outcome_text(run(stops)), "stopped: no active set (60 iterations)"));
  EXPECT_FALSE(passes(run(page("nothing", {}))));
  EXPECT_TRUE(contains(outcome_text(run(page("nothing", {}))), "FAIL"));
  EXPECT_TRUE(passes(run(page("good", {check(1, 1, 0, Judged::absolute)}))));
}

TEST(Printing, ShowsDeviationToleranceAndVerdict)
{
  const CheckText t = check_text(check(101, 100, 0.005, Judged::relative));
  EXPECT_EQ(t.result, "101");
  EXPECT_EQ(t.reference, "100");
  EXPECT_EQ(t.deviation, "+1 %");
  EXPECT_EQ(t.tolerance, "0.5 %");
  EXPECT_EQ(t.verdict, "FAIL");
  EXPECT_EQ(check_text(check(2953.4694, 2953.469, 1e-3, Judged::absolute)).deviation, "+0.0004");
  EXPECT_EQ(check_text(check(2953.4694, 2953.469, 1e-3, Judged::absolute)).tolerance, "0.001 N");
  EXPECT_EQ(check_text(check(4615384.6, 4615384.6, 1e-3, Judged::relative)).result, "4615385");
  EXPECT_EQ(check_text(check(0.3, 2, 0, Judged::at_least)).tolerance, "at least");
  EXPECT_EQ(check_text(check(0.3, 2, 0, Judged::reported)).verdict, "reported");
  EXPECT_EQ(check_text(deviating(105)).verdict, "known deviation");
  EXPECT_EQ(check_text(deviating(105)).deviation, "+5 %");
}

TEST(Printing, AKnownDeviationHasCauseAndRemedy)
{
  const std::string text = known_text({run(page("bent", {deviating(105)}))});
  EXPECT_EQ(text, "  known deviation, bent: force: 105 N, asked 100 (+5 %)\n    cause: the spring is bent\n"
                  "    remedy: a new spring\n");
  EXPECT_TRUE(contains(outcome_text(run(page("bent", {deviating(105)}))), "    cause: the spring is bent\n"));
  EXPECT_TRUE(
      contains(known_text({run(page("bent", {deviating(110)}))}), "FAIL: recorded was 105 with a spread of 0.5"));
  EXPECT_TRUE(
      contains(known_text({run(page("bent", {deviating(100)}))}), "FAIL: the asked reference is reached now"));
}

TEST(Printing, HidesTheDigitsOfRoundOff)
{
  // Results of two machines that differ by round-off print the same.
  for (const auto &[a, b] :
       {std::pair{check(3.1e-16, 1e-12, 0, Judged::at_most), check(7.7e-15, 1e-12, 0, Judged::at_most)},
        {check(1 + 2e-13, 1, 1e-10, Judged::relative), check(1 - 5e-14, 1, 1e-10, Judged::relative)},
        {check(2e-17, 0, 1e-10, Judged::absolute), check(-1e-15, 0, 1e-10, Judged::absolute)}}) {
    EXPECT_EQ(check_text(a).result, check_text(b).result);
    EXPECT_EQ(check_text(a).deviation, check_text(b).deviation);
  }
  // But what is too large is shown.
  EXPECT_EQ(check_text(check(1 + 2e-10, 1, 1e-10, Judged::relative)).deviation, "+2e-10");
  EXPECT_EQ(check_text(check(3e-11, 1e-12, 0, Judged::at_most)).result, "3e-11");
}

TEST(Printing, TableIsAlignedAndComplete)
{
  const std::string text = outcome_text(
      run(page("spring", {check(1, 1, 0.1, Judged::relative), check(12345, 12345, 0.1, Judged::relative)})));
  std::set<std::size_t> verdicts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto column = line.find("pass"); column != std::string::npos)
      verdicts.insert(column);
  EXPECT_EQ(verdicts.size(), 1u) << text;
  for (const char *part :
       {"spring (unit): A spring. It is linear.", "tolerance: exact arithmetic", "source: Hooke", "time: "})
    EXPECT_TRUE(contains(text, part)) << text;
}

TEST(Printing, SummaryCountsAndNamesWhatFailed)
{
  const auto good = run(page("good", {check(1, 1, 0, Judged::absolute)}));
  const auto bad  = run(page("bad", {check(1, 1, 0, Judged::absolute), check(2, 1, 0, Judged::absolute)}));
  const auto rest = run(page("rest", {deviating(105), check(2, 1, 0, Judged::reported)}));
  EXPECT_EQ(summary_text({good}), "1 of 1 cases pass, 1 of 1 judged checks");
  EXPECT_EQ(summary_text({good, bad}), "1 of 2 cases pass, 2 of 3 judged checks; failed: bad");
  EXPECT_EQ(summary_text({good, rest}), "2 of 2 cases pass, 1 of 1 judged checks; 1 known deviation; "
                                        "1 value compared with a reference, not judged");
}

TEST(Selecting, TakesNamesInTheirOrderAndNamesTheNearest)
{
  const std::vector<Case> all{page("love-patch", {}), page("crowned-pair", {})};
  EXPECT_EQ(select(all, {}).size(), 2u);
  EXPECT_EQ(select(all, {"crowned-pair", "love-patch"})[0].name, "crowned-pair");
  try {
    select(all, {"crown-pair"});
    FAIL() << "an unknown name was taken";
  } catch (const InputError &e) {
    ASSERT_EQ(e.problems.size(), 1u);
    EXPECT_EQ(e.problems[0].message,
              "no verification case has the name 'crown-pair'; did you mean 'crowned-pair'?");
  }
  EXPECT_TRUE(contains(list_text(all), "love-patch    unit          A spring.\n"));
}

TEST(Page, HasNoTimesAndEscapesBars)
{
  Check bars         = check(1, 1, 0.1, Judged::relative);
  bars.quantity      = "|z| up to 18";
  const Outcome fast = run(page("spring", {bars}));
  Outcome slow       = fast;
  slow.seconds       = 100;
  EXPECT_EQ(manual_page({fast}), manual_page({slow}));
  EXPECT_TRUE(contains(manual_page({fast}), "| \\|z\\| up to 18 | 1 | N | 1 | < 1e-9 | 10 % | pass |"));
}

TEST(Page, ExplainsTheVerdictsAndListsTheKnownDeviations)
{
  const std::string text = manual_page({run(page("bent", {deviating(105)}))});
  for (const char *part :
       {"\n| pass | ", "\n| FAIL | ", "\n| known deviation | ", "\n| reported | ", "\n| regression | ",
        "| [bent](#bent) | force | 105 N | 100 | +5 % | 1 % | the spring is bent | a new spring |\n",
        "| [bent](#bent) | unit | 0 | 1 | 0 | known deviation |\n"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
}

TEST(Page, CellsAreReadAsTheyAreWritten)
{
  EXPECT_EQ(cells_of_line("| " + table_cell("|z| up to 18") + " | 1 | N |"),
            (std::vector<std::string>{table_cell("|z| up to 18"), "1", "N"}));
  EXPECT_TRUE(cells_of_line("no table").empty());
}

TEST(Manual, TheSuiteRunsEveryGroup)
{
  std::vector<std::string> known, with_long_form, long_form;
  for (const Group &group : groups()) {
    known.push_back(group.name);
    std::size_t usual = 0;
    for (const Case &c : cases_of(group))
      if (c.long_form)
        long_form.push_back(c.name);
      else
        ++usual;
    if (usual < cases_of(group).size())
      with_long_form.push_back(group.name);
    EXPECT_GT(usual, 0u) << group.name << " has no case for the usual form of the suite";
  }
  EXPECT_EQ(split(MANUAL_GROUPS, ","), known) << "tests/manual.cmake lists the groups that CTest runs";
  EXPECT_EQ(split(LONG_GROUPS, ","), with_long_form) << "and those with cases of the long form";
  EXPECT_EQ(long_form.size(), names_of_long_form().size()) << "a name of the long form is not a case";
}

TEST(Manual, NamesAreUniqueAndEveryTextIsThere)
{
  std::set<std::string> names;
  std::set<std::string> known;
  for (const verify::Kind &kind : kinds())
    known.insert(kind.name);
  for (const Case &c : all_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_TRUE(std::regex_match(c.name, std::regex("[a-z0-9]+(-[a-z0-9]+)*"))) << c.name;
    EXPECT_TRUE(known.count(c.kind)) << c.name << ": " << c.kind;
    EXPECT_FALSE(c.problem.empty() || c.source.empty() || c.tolerance_reason.empty()) << c.name;
    EXPECT_TRUE(bool(c.run)) << c.name;
  }
}

TEST(Manual, PageListsExactlyTheCases)
{
  const std::string text = file("docs/verification.md");
  std::vector<std::string> on_page, known;
  const std::regex head("\n## ([^\n]+)\n");
  for (std::sregex_iterator it(text.begin(), text.end(), head), end; it != end; ++it)
    on_page.push_back((*it)[1]);
  for (const Case &c : all_cases()) {
    known.push_back(c.name);
    for (const std::string &part : {c.problem, c.tolerance_reason, c.source})
      EXPECT_TRUE(contains(text, part)) << c.name << ": the page does not say: " << part;
  }
  EXPECT_EQ(on_page, known) << "write the page again: millstand verify --markdown docs/verification.md";
}
