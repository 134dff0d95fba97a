#include "tests/manual/manual.h"
#include "core/base/errors.h"
#include "core/case/fields.h"
#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>

namespace mill::verify {
namespace {
// Width on the screen: characters, not bytes.
std::size_t width(const std::string &utf8)
{
  return std::size_t(std::count_if(utf8.begin(), utf8.end(), [](const char c) { return (c & 0xC0) != 0x80; }));
}

using Row = std::array<std::string, 7>;

Row cells(const CheckText &t)
{
  return {t.quantity, t.result, t.unit, t.reference, t.deviation, t.tolerance, t.verdict};
}

const Row heads{"quantity", "result", "unit", "reference", "deviation", "tolerance", "verdict"};

std::string without_trailing_blanks(std::string text)
{
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

std::string aligned(const std::vector<Row> &rows)
{
  Row::size_type column = 0;
  std::vector<std::size_t> widths(heads.size(), 0);
  for (const Row &row : rows)
    for (column = 0; column < row.size(); ++column)
      widths[column] = std::max(widths[column], width(row[column]));
  std::string text;
  for (const Row &row : rows) {
    std::string line = " ";
    for (column = 0; column < row.size(); ++column) {
      const std::string space(widths[column] - width(row[column]), ' ');
      const bool figure = column == 1 || (column >= 3 && column <= 5);  // right-aligned
      line += " " + (figure ? space + row[column] : row[column] + space) + " ";
    }
    text += without_trailing_blanks(line) + "\n";
  }
  return text;
}

// A known deviation below a table; `of` names its case, or is empty there.
std::string known_lines(const std::string &owner, const KnownText &k)
{
  std::string text = fmt::format("  known deviation, {}{}: {} {}, asked {} ({})\n    cause: {}\n    remedy: {}\n",
                                 owner, k.check.quantity, k.check.result, k.check.unit, k.check.reference,
                                 k.check.deviation, k.cause, k.remedy);
  return k.moved.empty() ? text : text + "    FAIL: " + k.moved + "\n";
}

std::string first_sentence(const std::string &text)
{
  const auto end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

std::string message_of(const std::exception &e)
{
  if (const auto *solver = dynamic_cast<const SolverError *>(&e))
    return solver->report.what + " (" + solver->report.where + ")";
  return e.what();
}
}  // namespace

bool passes(const Outcome &outcome)
{
  return outcome.error.empty() && outcome.skipped.empty() && !outcome.checks.empty() &&
         tally(outcome.checks).failed == 0;
}

std::string verdict_text(const Outcome &outcome)
{
  if (!outcome.skipped.empty())
    return "skipped";
  if (!passes(outcome))
    return "FAIL";
  const Tally t = tally(outcome.checks);
  if (t.known > 0)
    return "known deviation";
  return t.judged() > 0 ? "pass" : "reported";
}

Outcome run(const Case &page)
{
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome{page, {}, 0, "", "", ""};
  try {
    outcome.checks = page.run();
    if (page.ran_with)
      outcome.ran_with = page.ran_with();
  } catch (const Skipped &e) {
    outcome.skipped = e.what();
  } catch (const std::exception &e) {
    outcome.error = message_of(e);
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::vector<Case> select(const std::vector<Case> &all, const std::vector<std::string> &names)
{
  if (names.empty())
    return all;
  std::vector<std::string> known;
  for (const Case &c : all) {
    known.push_back(c.name);
    for (const std::string &family : split(c.family, " "))
      if (!family.empty() && std::find(known.begin(), known.end(), family) == known.end())
        known.push_back(family);
  }
  std::vector<Case> selected;
  for (const std::string &name : names) {
    const auto before = selected.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(selected), [&](const Case &c) {
      const auto families = split(c.family, " ");
      return c.name == name || std::find(families.begin(), families.end(), name) != families.end();
    });
    if (selected.size() == before)
      throw InputError("no verification case has the name '" + name + "'" + suggestion(name, known));
  }
  return selected;
}

std::string list_text(const std::vector<Case> &cases)
{
  std::size_t longest = 0;
  for (const Case &c : cases)
    longest = std::max(longest, c.name.size());
  std::string text;
  for (const Case &c : cases)
    text += fmt::format("{:<{}}  {:<12}  {}\n", c.name, longest, c.kind, first_sentence(c.problem));
  return text;
}

std::string outcome_text(const Outcome &o)
{
  std::vector<Row> rows{heads};
  for (const Check &c : o.checks)
    rows.push_back(cells(check_text(c)));
  std::string text = o.page.name + " (" + o.page.kind + "): " + o.page.problem + "\n";
  if (!o.checks.empty())
    text += aligned(rows);
  for (const KnownText &k : known_deviations(o.checks))
    text += known_lines("", k);
  if (!o.skipped.empty())
    text += "  skipped: " + o.skipped + "\n";
  else if (!o.error.empty())
    text += "  stopped: " + o.error + "\n";
  else if (o.checks.empty())
    text += "  the case checks nothing: FAIL\n";
  if (!o.ran_with.empty())
    text += "  with: " + o.ran_with + "\n";
  return text + "  tolerance: " + o.page.tolerance_reason + "\n  source: " + o.page.source +
         fmt::format("\n  time: {:.2f} s\n", o.seconds);
}

std::string summary_text(const std::vector<Outcome> &outcomes)
{
  Tally sum;
  std::vector<std::string> failed, skipped, needs;
  std::size_t good = 0;
  for (const Outcome &o : outcomes) {
    const Tally t = tally(o.checks);
    sum           = {sum.passed + t.passed, sum.failed + t.failed, sum.known + t.known, sum.reported + t.reported};
    if (!o.skipped.empty()) {
      skipped.push_back(o.page.name);
      if (std::find(needs.begin(), needs.end(), o.skipped) == needs.end())
        needs.push_back(o.skipped);
    } else if (!passes(o))
      failed.push_back(o.page.name);
    else
      good += t.judged() + t.known > 0;
  }
  std::string text = fmt::format("{} of {} cases pass, {} of {} judged checks", good, good + failed.size(),
                                 sum.passed, sum.judged());
  if (sum.known > 0)
    text += fmt::format("; {} known deviation{}", sum.known, sum.known == 1 ? "" : "s");
  if (sum.reported > 0)
    text += fmt::format("; {} value{} compared with a reference, not judged", sum.reported,
                        sum.reported == 1 ? "" : "s");
  if (!skipped.empty())
    text += fmt::format("; skipped: {} ({})", fmt::join(skipped, ", "), fmt::join(needs, "; "));
  return text + (failed.empty() ? "" : fmt::format("; failed: {}", fmt::join(failed, ", ")));
}

std::string known_text(const std::vector<Outcome> &outcomes)
{
  std::string text;
  for (const Outcome &o : outcomes)
    for (const KnownText &k : known_deviations(o.checks))
      text += known_lines(o.page.name + ": ", k);
  return text;
}
}  // namespace mill::verify
