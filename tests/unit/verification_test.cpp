#include "core/errors.h"
#include "verify/manual.h"
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
  for (const Judged judged : {Judged::relative, Judged::absolute, Judged::at_least, Judged::at_most})
    EXPECT_FALSE(passes(check(std::nan(""), 1, 1, judged)));
  EXPECT_FALSE(passes(check(INFINITY, 1, 1, Judged::relative)));
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
  EXPECT_EQ(check_text(check(0.3, 2, 0, Judged::reported)).verdict, "-");
}

TEST(Printing, HidesTheDigitsOfRoundOff)
{
  // Results of two machines that differ by round-off print the same.
  for (const auto &[a, b] : {
           std::pair{check(3.1e-16,   1e-12, 0,     Judged::at_most),  check(7.7e-15,   1e-12, 0,     Judged::at_most) },
           {check(1 + 2e-13, 1,     1e-10, Judged::relative), check(1 - 5e-14, 1,     1e-10, Judged::relative)},
           {check(2e-17,     0,     1e-10, Judged::absolute), check(-1e-15,    0,     1e-10, Judged::absolute)}
  }) {
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
  EXPECT_EQ(summary_text({good}), "1 of 1 cases pass, 1 of 1 checks");
  EXPECT_EQ(summary_text({good, bad}), "1 of 2 cases pass, 2 of 3 checks; failed: bad");
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
    EXPECT_EQ(e.problems[0].message, "there is no verification case 'crown-pair'; did you mean 'crowned-pair'?");
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

TEST(Manual, NamesAreUniqueAndEveryTextIsThere)
{
  std::set<std::string> names;
  for (const Case &c : all_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_TRUE(std::regex_match(c.name, std::regex("[a-z0-9]+(-[a-z0-9]+)*"))) << c.name;
    EXPECT_TRUE(c.kind == "unit" || c.kind == "verification" || c.kind == "benchmark") << c.name << ": " << c.kind;
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
