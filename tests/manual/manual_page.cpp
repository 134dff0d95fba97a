#include "tests/manual/manual.h"
#include <algorithm>
#include <fmt/format.h>

// docs/verification.md: what the verdicts mean, all known deviations, a table of the cases, then case by case.
namespace mill::verify {
namespace {
const char *const head =
    "# Verification manual\n\n"
    "Problems with a known answer, run by `millstand verify` and by the tests; this page is written by\n"
    "`millstand verify --markdown docs/verification.md`. A deviation below 1e-9 is round-off and not shown.\n\n"
    "| verdict of a check | meaning |\n|---|---|\n"
    "| pass | judged: the result is within the tolerance of the reference, or on the right side of a bound |\n"
    "| FAIL | judged: it is not, or it is not a number; also a known deviation that moved or is gone |\n"
    "| known deviation | the asked reference is not reached; the deviation is the one that was recorded, with its "
    "cause and what would end it. The check fails as soon as the result moves or the reference is reached |\n"
    "| reported | printed next to the reference for the reader, not judged; fails only when it is not a number "
    "|\n\n"
    "\"N of N checks\" is the number of judged checks; known deviations and reported values are counted "
    "separately. A case "
    "passes when\nno check fails; one that judges nothing is marked *reported* and not counted. *At "
    "least* and *at most*\nin the column of the tolerance say that the reference is a bound. Cases of the family "
    "*peer* were run with another\nprogram; they say which and when, and are repeated by `millstand verify peer`, "
    "which skips them and returns 4 where\nthat program is not installed. Tests over many seeded cases are under "
    "[campaigns](campaigns.md).\n\n";

std::string kind_table()
{
  std::string text = "| kind of a case | its reference |\n|---|---|\n";
  for (const Kind &k : kinds())
    text += fmt::format("| {} | {} |\n", k.name, k.meaning);
  return text + "\n";
}

std::string known_table(const std::vector<Outcome> &outcomes)
{
  std::string text;
  for (const Outcome &o : outcomes)
    for (const KnownText &k : known_deviations(o.checks))
      text += fmt::format("| [{0}](#{0}) | {1} | {2} {3} | {4} | {5} | {6} | {7} | {8} |\n", o.page.name,
                          table_cell(k.check.quantity), k.check.result, k.check.unit, k.check.reference,
                          k.check.deviation, k.check.tolerance, table_cell(k.cause), table_cell(k.remedy));
  if (text.empty())
    return "No known deviation.\n\n";
  return "### Known deviations\n\n"
         "| case | quantity | result | asked reference | deviation | tolerance | cause | remedy |\n"
         "|---|---|---:|---:|---:|---:|---|---|\n" +
         text + "\n";
}

std::string case_table(const std::vector<Outcome> &outcomes)
{
  std::string text =
      "### Cases\n\n| case | kind | judged | known | reported | verdict |\n|---|---|---:|---:|---:|---|\n";
  for (const Outcome &o : outcomes) {
    const Tally t = tally(o.checks);
    text += fmt::format("| [{0}](#{0}) | {1} | {2} | {3} | {4} | {5} |\n", o.page.name, o.page.kind, t.judged(),
                        t.known, t.reported, verdict_text(o));
  }
  return text;
}

std::string check_table(const std::vector<Check> &checks)
{
  std::string text = "| quantity | result | unit | reference | deviation | tolerance | verdict |\n"
                     "|---|---:|---|---:|---:|---:|---|\n";
  for (const Check &c : checks) {
    const CheckText t = check_text(c);
    text += "|";
    for (const std::string &cell :
         {t.quantity, t.result, t.unit, t.reference, t.deviation, t.tolerance, t.verdict})
      text += " " + table_cell(cell) + " |";
    text += "\n";
  }
  return text + "\n";
}

std::string section(const Outcome &o)
{
  std::string text = fmt::format("\n## {}\n\n{}\n\n", o.page.name, o.page.problem);
  if (!o.error.empty())
    text += "Stopped: " + o.error + "\n\n";
  if (!o.skipped.empty())
    text += "Skipped: " + o.skipped + "\n\n";
  text += check_table(o.checks);
  for (const KnownText &k : known_deviations(o.checks))
    text += fmt::format("Known deviation, {}: {} Remedy: {}\n\n", k.check.quantity, k.cause, k.remedy);
  if (!o.ran_with.empty())
    text += "With: " + o.ran_with + "\n\n";
  return text + "Tolerance: " + o.page.tolerance_reason + "\n\nSource: " + o.page.source + "\n";
}
}  // namespace

std::string manual_page(const std::vector<Outcome> &outcomes)
{
  std::string text =
      head + kind_table() + summary_text(outcomes) + ".\n\n" + known_table(outcomes) + case_table(outcomes);
  for (const Outcome &o : outcomes)
    text += section(o);
  return text;
}
}  // namespace mill::verify
