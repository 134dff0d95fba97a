#include "app/trace/trace_text.h"
#include "core/base/si_unit.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
std::string listed(const std::vector<std::string> &words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string value_text(const Parameter &p)
{
  if (!std::isfinite(p.value))
    return "no value";
  return fmt::format("{:.5g} {}", p.value, is_in(p.unit, SiUnit::one) ? "" : p.unit);
}

constexpr double smallest = 0.005;  // percent per percent, of what is shown with two digits

std::string slope_text(const double slope, const std::string &per)
{
  if (!std::isfinite(slope))
    return "no answer";
  if (is_relative(per))
    return std::abs(slope) < smallest ? "below 0.005" : fmt::format("{:+.2f} % per %", slope);
  const std::string number = std::abs(slope) < 100 ? fmt::format("{:+.2g}", slope) : fmt::format("{:+.0f}", slope);
  return std::abs(slope) < 1e-6 ? "0" : number + " % per " + per;
}

// A kink shows as two slopes; what bends by less than a fifth over the step is one.
bool has_kink(const TraceLine &line, const std::string &per)
{
  const double least = is_relative(per) ? 0.05 : 1e-6;
  return std::abs(line.slope_up - line.slope_down) >
         least + 0.2 * std::max(std::abs(line.slope_up), std::abs(line.slope_down));
}

std::string elasticity_text(const Trace &trace, const TraceLine &line)
{
  if (!line.moves)
    return "finite elements only";
  if (!line.words.empty()) {
    std::vector<std::string> words;
    for (const auto &[word, percent] : line.words)
      words.push_back(std::isfinite(percent) ? fmt::format("{}: {:+.3g} %", word, percent)
                                             : word + ": no percentage");
    return listed(words);
  }
  if (trace.per.empty())
    return "-";
  if (std::isnan(line.slope))
    return "";  // missing_slopes() says why
  if (has_kink(line, trace.per))
    return is_relative(trace.per)
               ? fmt::format("{:+.2f} up, {:+.2f} down", line.slope_up, line.slope_down)
               : fmt::format("{:+.2g} up, {:+.2g} down per {}", line.slope_up, line.slope_down, trace.per);
  return slope_text(line.slope, trace.per);
}

const std::string &short_name(const ClosedFormResult &r)
{
  return r.symbol.empty() ? r.name : r.symbol;
}

std::string relation_text(const Trace &trace, const TraceLine &line)
{
  std::vector<std::string> from;
  for (const std::string &part : line.through)
    from.push_back(short_name(*find(trace.base, part)));
  if (line.direct && !from.empty())
    from.insert(from.begin(), trace.key.row.key);
  return line.result.relation + (from.empty() ? "" : ", from " + listed(from));
}

// The results of the table and all that they are made of.
std::vector<std::string> involved(const Trace &trace)
{
  std::vector<std::string> names;
  for (const TraceLine &line : trace.lines)
    names.push_back(line.result.name);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const ClosedFormResult *result = find(trace.base, names[i]))
      for (const std::string &part : result->from)
        if (std::find(names.begin(), names.end(), part) == names.end())
          names.push_back(part);
  return names;
}

// What stands in for finite elements, one line for each closed form.
std::string stand_in_notes(const Trace &trace)
{
  const auto names_here = involved(trace);
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const ClosedFormResult &r : trace.base) {
    if (r.stands_for.empty() || std::find(names_here.begin(), names_here.end(), r.name) == names_here.end())
      continue;
    const std::string method = r.parameter.method + ", for " + r.stands_for;
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&](const auto &g) { return g.first == method; });
    const std::string name = short_name(r);
    if (known == groups.end())
      groups.push_back({method, {name}});
    else if (std::find(known->second.begin(), known->second.end(), name) == known->second.end())
      known->second.push_back(name);
  }
  std::string text;
  for (const auto &[method, names] : groups)
    text += fmt::format("  {}: {}\n", listed(names), method);
  return text.empty() ? "" : "Closed forms that stand in for finite elements:\n" + text;
}

// Why the elasticity of some results is left empty.
std::string missing_slopes(const Trace &trace)
{
  std::vector<std::string> names;
  for (const TraceLine &line : trace.lines)
    if (line.moves && line.words.empty() && !trace.per.empty() && std::isnan(line.slope))
      names.push_back(line.result.name);
  return names.empty() ? ""
                       : "No elasticity, because the result has no value for this key or for the changed key: " +
                             listed(names) + ".\n";
}

std::string run_notes(const Trace &trace)
{
  if (trace.lines.empty())
    return "";
  if (trace.run_folder.empty())
    return "No run is stored to compare with.\n";
  std::vector<std::string> far;
  int near = 0;
  for (const TraceLine &line : trace.lines)
    for (const auto &[name, value] : trace.run)
      if (name == line.result.name && value != 0) {
        const double off = 100 * (line.result.parameter.value / value - 1);
        if (!std::isfinite(off))
          far.push_back(name + " has no value here");
        else if (std::abs(off) < 0.05)
          ++near;
        else
          far.push_back(fmt::format("{} {:+.1f} %", name, off));
      }
  std::string text = fmt::format("Values above against the last run ({}{}): ", trace.run_folder,
                                 trace.same_inputs ? "" : ", with other inputs");
  text += far.empty() ? "" : listed(far);
  if (near > 0)
    text += fmt::format("{}{} within 0.05 %", far.empty() ? "" : "; ", far.empty() ? "all" : "the others");
  return text + (far.empty() && near == 0 ? "it has no value of these" : "") + "\n";
}
}  // namespace

std::string trace_text(const Trace &trace, const bool notes)
{
  std::string text      = fmt::format("{}  ({})\n", trace.key.name + " = " + trace.key.shown, trace.key.origin);
  std::size_t wide_name = 0, wide_slope = 0;
  bool record = false, moves = false;
  for (const TraceLine &line : trace.lines) {
    wide_name  = std::max(wide_name, line.result.name.size());
    wide_slope = std::max(wide_slope, elasticity_text(trace, line).size());
    moves      = moves || line.moves;
    record     = record || (line.moves && line.result.file == "dynamics/response/response");
  }
  std::vector<std::pair<std::string, std::string>> relations;  // each with its results, in the order of the first
  for (const TraceLine &line : trace.lines) {
    const std::string relation = relation_text(trace, line);
    auto known =
        std::find_if(relations.begin(), relations.end(), [&](const auto &r) { return r.first == relation; });
    if (known == relations.end())
      known = relations.insert(relations.end(), {relation, ""});
    known->second += fmt::format("       {:<{}}  {:>15}  {:>{}}  {}{}\n", line.result.name, wide_name,
                                 value_text(line.result.parameter), elasticity_text(trace, line), wide_slope,
                                 line.result.file, line.result.equation.empty() ? "" : " " + line.result.equation);
  }
  for (const auto &[relation, results] : relations)
    text += "  -> " + relation + "\n" + results;
  if (trace.lines.empty() && !trace.only_in_a_run.empty())
    text += "  -> only in a run: " + listed(trace.only_in_a_run) + "\n";
  else if (trace.lines.empty())
    text += "  reaches no result of this case: " + trace.key.row.meaning + "\n";
  if (!notes)
    return text;
  if (!trace.reason.empty())
    text += "No elasticity: " + trace.reason + ".\n";
  if (!trace.steps.empty() && moves)
    text += fmt::format("Elasticities are differences between {}.\n", trace.steps);
  text += missing_slopes(trace);
  if (record && !trace.per.empty())
    text +=
        "Slopes of peak_g and rms_g belong to one record and scatter with it; under white force they do not.\n";
  if (trace.from_run)
    text += "Springs are those of the last run; closed forms give their change.\n";
  return text + stand_in_notes(trace) + run_notes(trace);
}
}  // namespace mill
