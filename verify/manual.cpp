#include "verify/manual.h"
#include "core/errors.h"
#include "core/fields.h"
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace mill::verify {
namespace {
// Below this the deviation of a check that passes is round-off, which differs from machine to machine.
constexpr double round_off = 1e-9;

// Seven digits, as a decimal fraction where that is readable.
std::string number(const double value)
{
  const double size = std::abs(value);
  if (!(size >= 1e-3 && size < 1e9))
    return fmt::format("{:.6g}", value);
  const int before = std::max(0, int(std::floor(std::log10(size))) + 1);
  std::string text = fmt::format("{:.{}f}", value, std::max(0, 7 - before));
  if (text.find('.') != std::string::npos)
    text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text;
}

std::string share(const double value)
{
  return std::abs(value) >= 1e-5 ? fmt::format("{:.2g} %", 100 * value) : fmt::format("{:.1g}", value);
}

double relative_deviation(const Check &c)
{
  return (c.result - c.reference) / std::abs(c.reference);
}

std::string deviation(const Check &c)
{
  if (!std::isfinite(c.result))
    return "-";
  switch (c.judged) {
  case Judged::at_least:
  case Judged::at_most:
    return "-";
  case Judged::absolute: {
    const double d    = c.result - c.reference;
    const bool hidden = passes(c) && std::abs(d) < round_off * std::max(1., std::abs(c.reference));
    return hidden ? "< 1e-9" : fmt::format("{:+.2g}", d);
  }
  case Judged::relative:
  case Judged::reported:
    break;
  }
  if (c.reference == 0)
    return "-";
  const double d = relative_deviation(c);
  return passes(c) && std::abs(d) < round_off ? "< 1e-9" : (d > 0 ? "+" : "") + share(d);
}

std::string tolerance(const Check &c)
{
  switch (c.judged) {
  case Judged::relative:
    return share(c.tolerance);
  case Judged::absolute:
    return c.tolerance == 0 ? "exact" : fmt::format("{} {}", number(c.tolerance), c.unit == "-" ? "" : c.unit);
  case Judged::at_least:
    return "at least";
  case Judged::at_most:
    return "at most";
  case Judged::reported:
    return "reported";
  }
  return "";
}

std::string result(const Check &c)
{
  // A residual that is as small as it should be: only its order is a result.
  if (c.judged == Judged::at_most && std::abs(c.reference) <= round_off && passes(c))
    return "below " + number(c.reference);
  if (c.judged == Judged::absolute && c.reference == 0 && passes(c) && std::abs(c.result) < round_off)
    return "0";
  return number(c.result);
}

std::string trimmed(std::string text)
{
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

std::size_t n_passed(const std::vector<Check> &checks)
{
  return std::size_t(std::count_if(checks.begin(), checks.end(), [](const Check &c) { return passes(c); }));
}

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
    text += trimmed(line) + "\n";
  }
  return text;
}

std::string verdict_text(const Verdict verdict)
{
  switch (verdict) {
  case Verdict::pass:
    return "pass";
  case Verdict::fail:
    return "FAIL";
  case Verdict::known_deviation:
    return "known deviation";
  case Verdict::reported:
    return "-";
  }
  return "";
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

CheckText check_text(const Check &c)
{
  return {c.quantity,
          result(c),
          c.unit,
          number(c.reference),
          deviation(c),
          trimmed(tolerance(c)),
          verdict_text(verdict(c))};
}

std::string table_cell(std::string text)
{
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

bool passes(const Outcome &outcome)
{
  return outcome.error.empty() && !outcome.checks.empty() && n_passed(outcome.checks) == outcome.checks.size();
}

Outcome run(const Case &page)
{
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome{page, {}, 0, ""};
  try {
    outcome.checks = page.run();
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
      throw InputError("there is no verification case '" + name + "'" + suggestion(name, known));
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
  if (!o.error.empty())
    text += "  stopped: " + o.error + "\n";
  else if (o.checks.empty())
    text += "  the case checks nothing: FAIL\n";
  return text + "  tolerance: " + o.page.tolerance_reason + "\n  source: " + o.page.source +
         fmt::format("\n  time: {:.2f} s\n", o.seconds);
}

std::string summary_text(const std::vector<Outcome> &outcomes)
{
  std::size_t good = 0, n_checks = 0, good_checks = 0;
  std::string failed;
  for (const Outcome &o : outcomes) {
    good += passes(o);
    n_checks += o.checks.size();
    good_checks += n_passed(o.checks);
    if (!passes(o))
      failed += (failed.empty() ? "; failed: " : ", ") + o.page.name;
  }
  return fmt::format("{} of {} cases pass, {} of {} checks{}", good, outcomes.size(), good_checks, n_checks,
                     failed);
}

std::string manual_page(const std::vector<Outcome> &outcomes)
{
  std::string text =
      "# Verification manual\n\n"
      "Problems with a known answer, run by `millstand verify` and by the tests; this page is written by\n"
      "`millstand verify --markdown docs/verification.md`. Kinds: *unit* is a closed form or kernel in "
      "isolation,\n"
      "*verification* the whole numerical chain against an exact reference, *benchmark* a comparison with "
      "published or\n"
      "peer numbers. A deviation below 1e-9 is round-off and not shown.\n\n" +
      summary_text(outcomes) + ".\n\n| case | kind | verdict |\n|---|---|---|\n";
  for (const Outcome &o : outcomes)
    text += fmt::format("| [{0}](#{0}) | {1} | {2} |\n", o.page.name, o.page.kind, passes(o) ? "pass" : "FAIL");
  for (const Outcome &o : outcomes) {
    text += fmt::format("\n## {}\n\n{}\n\n", o.page.name, o.page.problem);
    if (!o.error.empty())
      text += "Stopped: " + o.error + "\n\n";
    text += "| quantity | result | unit | reference | deviation | tolerance | verdict |\n"
            "|---|---:|---|---:|---:|---:|---|\n";
    for (const Check &c : o.checks) {
      text += "|";
      for (const std::string &entry : cells(check_text(c)))
        text += " " + table_cell(entry) + " |";
      text += "\n";
    }
    text += "\nTolerance: " + o.page.tolerance_reason + "\n\nSource: " + o.page.source + "\n";
  }
  return text;
}
}  // namespace mill::verify
