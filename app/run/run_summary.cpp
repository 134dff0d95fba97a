#include "app/run/run_summary.h"
#include "core/base/error_list.h"
#include "core/base/short_number.h"
#include "core/base/si_unit.h"
#include "core/base/visible_text.h"
#include "core/case/fields.h"
#include "core/records/named_mode.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include "core/records/rows_of_stand.h"
#include "report/results/names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace mill {
namespace {
constexpr std::size_t most_lines = 25, most_modes = 8, most_limits = 6, most_values = 10, most_speeds = 3;

std::string one_line(const std::string &text)
{
  return shortened(visible(text, true));
}

// " +- 64 %"; empty where no error is stated.
std::string accuracy(const Parameter &p)
{
  return std::isnan(p.error_estimate) ? "" : " +- " + percent_text(p.error_estimate);
}

std::string value_line(const std::string &name, const Parameter &p)
{
  return fmt::format("  {:<34} {:>16}{}", name, engineering(p), accuracy(p));
}

void add_modulus_line(const Results &results, std::vector<std::string> &lines)
{
  const Parameter *strip = results.find("stand.modulus.tangent"), *touching = results.find("stand.modulus.kiss");
  if (!strip && !touching)
    return;
  const auto stiffness = [](const Parameter &p) {
    return fmt::format(" {} MN/mm{}", number_within(p.value / 1e9, p.error_estimate, 3), accuracy(p));
  };
  std::string text = "mill modulus:";
  if (strip)
    text += stiffness(*strip) + " with strip";
  if (touching)
    text += (strip ? "," : "") + stiffness(*touching) + " with touching work rolls";
  lines.push_back(text);
}

// The answer of a run first; passes with the same sentence share a line.
void add_speed_lines(const Results &results, std::vector<std::string> &lines)
{
  std::vector<std::pair<std::string, std::string>> sentences;  // with the passes that they are of
  std::vector<SpeedVerdict> verdicts = results.speeds;
  worst_first(verdicts);
  for (const SpeedVerdict &verdict : verdicts) {
    const std::string sentence = sentence_of(verdict);
    const auto same =
        std::find_if(sentences.begin(), sentences.end(), [&](const auto &one) { return one.first == sentence; });
    if (same == sentences.end())
      sentences.emplace_back(sentence, verdict.pass);
    else
      same->second += ", " + verdict.pass;
  }
  const std::size_t shown = std::min(sentences.size(), most_speeds);
  for (std::size_t i = 0; i < shown; ++i)
    lines.push_back(
        one_line(sentences.size() == 1 ? sentences[i].first : sentences[i].second + ": " + sentences[i].first));
  if (sentences.size() > shown)
    lines.push_back(fmt::format("and critical speeds of {} more passes on the page", sentences.size() - shown));
}

// A mode by its name on the page, "gap mode, first kind (third octave)", with its frequency in the open stand
// after it; gap modes first, because a mill asks for these.
void add_mode_lines(const Results &results, std::vector<std::string> &lines)
{
  std::vector<std::pair<std::string, const Parameter *>> modes;  // key and frequency
  for (const auto &[name, p] : results.values)
    if (const auto id = result_id(name); id && id->is_of(row::modes::frequency) && id->place("open").empty())
      modes.emplace_back(id->place("mode"), &p);
  const auto rank = [](const auto &mode) {
    return is_word(mode.first, ResultWord::gap_first_kind)    ? 0
           : is_word(mode.first, ResultWord::gap_second_kind) ? 1
           : gap_kind_of(mode.first)                          ? 2
                                                              : 3;
  };
  std::stable_sort(modes.begin(), modes.end(), [&](const auto &a, const auto &b) { return rank(a) < rank(b); });
  for (std::size_t i = 0; i < std::min(modes.size(), most_modes); ++i) {
    const Parameter *open = results.find(row::modes::frequency.of(family::open, modes[i].first));
    const Parameter &p    = *modes[i].second;
    lines.push_back(fmt::format("  {:<54} {:>9}{}{}", named_mode_of(p.method).name, engineering(p), accuracy(p),
                                open ? ", open stand " + engineering(*open) : ""));
  }
  if (modes.size() > most_modes)
    lines.push_back(fmt::format("  and {} more named mode{}", modes.size() - most_modes,
                                modes.size() - most_modes > 1 ? "s" : ""));
}

// What the rolls of a stack do to the strip.
void add_stack_lines(const Results &results, std::vector<std::string> &lines)
{
  for (const char *name : {"stack.crown", "stack.edge_drop", "stack.opening", "stack.modulus.mid"})
    if (const Parameter *p = results.find(name))
      lines.push_back(value_line(name, *p));
}

// Results without modes: the first values.
void add_first_values(const Results &results, std::vector<std::string> &lines)
{
  std::size_t n = 0;
  for (const auto &[name, p] : results.values)
    if (!report::is_of_one_model(name) && std::count(name.begin(), name.end(), '.') < 3 && n++ < most_values)
      lines.push_back(value_line(visible(name, true), p));
}
}  // namespace

std::string engineering(const Parameter &p)
{
  struct Unit {
    const char *si, *shown;
    double size;  // of the unit shown, in SI
    int digits;
  };
  // Without a stated error four digits: more would look like accuracy.  A number without unit may be a count.
  const auto digits = [&](const int most) {
    return std::isnan(p.error_estimate) && !is_in(p.unit, SiUnit::one) ? 4 : most;
  };
  static const Unit units[]{
      {"N/m", "kN/mm", 1e6, 5}, {"N/m2", "N/mm per mm", 1e6, 6}, {"m", "mm", 1e-3, 5}, {"Pa", "MPa", 1e6, 5},
      {"N", "kN", 1e3, 6},
  };
  for (const Unit &unit : units)
    if (p.unit == unit.si)
      return number_within(p.value / unit.size, p.error_estimate, digits(unit.digits)) + " " + unit.shown;
  if (constexpr double hour = 3600; is_in(p.unit, SiUnit::second) && p.value >= hour)
    return number_within(p.value / hour, p.error_estimate, digits(6)) + " h";
  return number_within(p.value, p.error_estimate, digits(6)) + after_number(p.unit);
}

std::string run_summary(const Results &results, const std::string &name, const std::string &limits,
                        const std::string &page)
{
  const std::size_t n_warnings = results.warnings.size();
  std::vector<std::string> lines{fmt::format(
      "{}: finished with {}{}", visible(name, true),
      n_warnings == 0   ? "no warnings"
      : n_warnings == 1 ? "1 warning"
                        : fmt::format("{} warnings", n_warnings),
      results.estimates.empty() ? "" : fmt::format(", {} values estimated", results.estimates.size()))};
  add_speed_lines(results, lines);
  add_modulus_line(results, lines);
  add_stack_lines(results, lines);
  add_mode_lines(results, lines);
  if (lines.size() == 1)
    add_first_values(results, lines);
  std::size_t n_limits = 0;
  for (const std::string &line : split(limits, "\n"))
    if (!line.empty() && n_limits++ < most_limits)
      lines.push_back(one_line(line));
  const std::size_t room = most_lines - lines.size() - 2, shown = std::min(room, n_warnings);
  for (std::size_t i = 0; i < shown; ++i)
    lines.push_back(one_line("warning: " + text_of(results.warnings[i])));
  if (shown < n_warnings)
    lines.push_back(fmt::format("and {} more warnings on the page", n_warnings - shown));
  std::string text;
  for (const std::string &line : lines)
    text += line + "\n";
  return text + "report: " + page + "\n";
}
}  // namespace mill
