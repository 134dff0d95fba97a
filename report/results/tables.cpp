#include "report/results/tables.h"
#include "core/base/si_unit.h"
#include "core/base/source_text.h"
#include "core/model/material.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_stand.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::report {
namespace {
// Shown in percent.
const ResultRow *const shares[]{&row::bearing::row_share, &row::motion::without_contact, &row::bite::elastic_share,
                                &row::modes::gap_share};

bool is_share(const Result &result)
{
  return is_in(result.unit, SiUnit::one) && is_made_by(shares, result.name);
}

// At most five digits; six above 1e5, as in published tables of stiffnesses.
std::string table_number(const double value, const double relative_error = not_given)
{
  return known_digits(value, relative_error, std::abs(value) >= 1e5 ? 6 : 5);
}

// An integer has no decimals.
std::string with_unit(const Shown &shown, const double relative_error = not_given)
{
  if (shown.unit.empty() && shown.value == std::round(shown.value) && std::abs(shown.value) < 1e6)
    return fixed(shown.value, 0);
  return table_number(shown.value, relative_error) + (shown.unit.empty() ? "" : "\u00a0" + escaped(shown.unit));
}

// In the unit in which the result itself is shown, so that the two can be compared at a glance.
std::string check_text(const Result &result, const Check &check)
{
  if (is_share(result))
    return escaped(check.name) + ": " + fixed(100 * check.value, 1) + "\u00a0% <span class=\"deviation\">(" +
           (result.value >= check.value ? "+" : "") + fixed(100 * (result.value - check.value), 1) +
           " points)</span>";
  const Shown quantity = engineering(result.value, result.unit);
  const double scale   = result.value != 0 ? quantity.value / result.value : 1;
  std::string text     = escaped(check.name) + ": ";
  text += std::isfinite(scale) ? with_unit({check.value * scale, quantity.unit})
                               : with_unit(engineering(check.value, result.unit));
  if (std::isfinite(result.value) && check.value != 0)
    text += " <span class=\"deviation\">(" + percent(result.value / check.value - 1) + ")</span>";
  return text;
}

// "976.2 kN" stays on one line; a longer state may wrap.
std::string unbroken(const std::string &text)
{
  return text.size() > 16 ? text : "<span class=\"together\">" + text + "</span>";
}

// What copying and the CSV of the page take: the numbers as stored, SI.
std::string data_of(const Result &result)
{
  const auto number = [](const double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; };
  return " data-name=\"" + escaped(result.name) + "\" data-value=\"" + number(result.value) + "\" data-unit=\"" +
         escaped(result.unit) + "\" data-at=\"" + escaped(result.at) + "\" data-error=\"" +
         number(result.error_estimate) + "\"";
}

std::string row_head(const Result &result)
{
  return "<th scope=\"row\"><code>" + escaped(result.name) + "</code><small>" + escaped(meaning_of(result.name)) +
         "</small></th>";
}

// A result that depends on estimates says so below its source.
std::string marked_estimated(const Result &result)
{
  if (result.estimated.empty())
    return "";
  return "<small>estimated: " + std::to_string(result.estimated.size()) +
         (result.estimated.size() == 1 ? " input" : " inputs") + "</small>";
}

std::string common_cells(const Result &result, const std::string &source)
{
  return "<td class=\"value\">" + value_cell(result) + "</td><td>" + escaped(source) + marked_estimated(result) +
         "</td><td>" + (result.at.empty() ? "\u2013" : unbroken(escaped(result.at))) + "</td><td>" +
         accuracy_cell(result) + "</td>";
}

std::string all_checks(const Result &result)
{
  if (result.checks.empty())
    return "\u2013";
  std::string cell;
  for (const Check &check : result.checks)
    cell += "<div>" + check_text(result, check) +
            (check.note.empty() ? "" : "<small>" + escaped(check.note) + "</small>") + "</div>";
  return cell;
}

// Lists of inputs that results share are long and few: each is printed once, below the table.
class InputLists {
public:
  /// A link to the list of these inputs; empty without inputs.
  std::string link(const std::vector<std::string> &inputs)
  {
    if (inputs.empty())
      return "";
    const auto match = std::find(lists_.begin(), lists_.end(), inputs);
    const auto index = std::size_t(match - lists_.begin());
    if (match == lists_.end())
      lists_.push_back(inputs);
    return "<small><a href=\"#inputs-" + std::to_string(index + 1) + "\">" + std::to_string(inputs.size()) +
           (inputs.size() == 1 ? " input" : " inputs") + ", list " + std::to_string(index + 1) + "</a></small>";
  }
  std::string html() const
  {
    std::string all;
    for (std::size_t i = 0; i < lists_.size(); ++i) {
      std::string keys;
      for (const std::string &input : lists_[i])
        keys += (keys.empty() ? "<code>" : ", <code>") + escaped(input) + "</code>";
      all += "<p id=\"inputs-" + std::to_string(i + 1) + "\"><b>" + std::to_string(i + 1) + ".</b> " + keys +
             "</p>\n";
    }
    return all.empty() ? ""
                       : "<details class=\"lists\"><summary>Lists of inputs</summary>\n" + all + "</details>\n";
  }

private:
  std::vector<std::vector<std::string>> lists_;
};

std::string group_head(const Group &group)
{
  return "<tr class=\"group\"><th colspan=\"6\">" + escaped(group.title) + "</th></tr>\n";
}

// What the short table compares a number with: its first check, and the published value.
std::string first_checks(const Result &result)
{
  if (result.checks.empty())
    return "\u2013";
  const Check *published = find_published(result.checks);
  std::string cell       = check_text(result, result.checks[0]);
  if (published && published != &result.checks[0])
    cell += "<br/>" + check_text(result, *published);
  return cell;
}

// Value of another origin and how many times as large this run's is.
std::string compared_cells(const Result &result, const Check *check)
{
  if (!check)
    return "<td class=\"num\">\u2013</td><td class=\"num\">\u2013</td>";
  return "<td class=\"num\">" + g_text(in_g(check->value, result.unit)) + "</td><td class=\"num\">" +
         fixed(result.value / check->value, 2) + "</td>";
}
}  // namespace

std::string value_cell(const Result &result)
{
  if (!std::isfinite(result.value))
    return "\u2013<small>not a number</small>";
  if (is_share(result))
    return "<b>" + fixed(100 * result.value, 1) + "</b>\u00a0%";
  const Shown shown = engineering(result.value, result.unit);
  std::string cell  = shown.unit.empty() ? "<b>" + with_unit(shown, result.error_estimate) + "</b>"
                                         : "<b>" + table_number(shown.value, result.error_estimate) + "</b>\u00a0" +
                                              escaped(shown.unit);
  if (is_in(result.unit, SiUnit::stiffness))
    cell += "<small>" + known_digits(result.value, result.error_estimate, 5) + "\u00a0N/m</small>";
  return cell;
}

std::string accuracy_cell(const Result &result)
{
  if (std::isfinite(result.error_estimate))
    return accuracy(result.error_estimate);
  if (!result.error_lacks.empty()) {
    constexpr std::size_t most = 1;
    std::string lacks;
    for (std::size_t i = 0; i < std::min(most, result.error_lacks.size()); ++i)
      lacks += (i == 0 ? "" : ", ") + result.error_lacks[i];
    if (result.error_lacks.size() > most)
      lacks += " and " + std::to_string(result.error_lacks.size() - most) + " more";
    return "\u2013<small>not known of " + escaped(lacks) + "</small>";
  }
  if (const auto source = source_in(result.source).source; source && source != Source::computed)
    return std::string("\u2013<small>") + name_of(*source) + ", not computed here</small>";
  return "\u2013<small>no independent estimate</small>";
}

std::string short_source(const std::string &source)
{
  return source.substr(0, source.find(','));
}

std::string short_table(const std::vector<Group> &groups)
{
  std::string table = "<table class=\"results\"><thead><tr><th>name</th><th>value</th><th>source</th><th>at</th>"
                      "<th>accuracy</th><th>compared with (this run deviates by)</th></tr></thead>\n";
  for (const Group &group : groups) {
    table += "<tbody>" + group_head(group);
    for (const Result *result : group.results)
      table += "<tr>" + row_head(*result) + common_cells(*result, short_source(result->source)) + "<td>" +
               first_checks(*result) + "</td></tr>\n";
    table += "</tbody>\n";
  }
  return table + "</table>\n";
}

std::string full_table(const Run &run)
{
  std::string table =
      "<table class=\"results full\"><thead><tr><th>name</th><th>value</th><th>source</th><th>at</th>"
      "<th>accuracy</th><th>checks (this run deviates by)</th></tr></thead>\n<tbody>\n";
  InputLists lists;
  const auto row = [&](const Result &result) {
    return "<tr" + data_of(result) + ">" + row_head(result) + common_cells(result, result.source) + "<td>" +
           all_checks(result) + lists.link(result.inputs) + "</td></tr>\n";
  };
  if (run.manifest.kind == KindOfCase::bearing || run.manifest.kind == KindOfCase::bite)
    for (const Group &group : short_groups(run)) {
      table += group_head(group);
      for (const Result *result : group.results)
        table += row(*result);
    }
  else
    for (const Result &result : run.results)
      if (run.manifest.kind == KindOfCase::chatter ? !is_slope_by_one_input(result.name)
                                                   : !is_of_one_model(result.name))
        table += row(result);
  return table + "</tbody></table>\n" + lists.html();
}

const Result *pass_value(const Run &run, const PassInfo &pass, const std::string &quantity)
{
  const Result *by_name = run.find(pass.name + "." + quantity);
  return by_name ? by_name : run.find(pass.slug + "." + quantity);
}

double in_g(const double value, const std::string &unit)
{
  return is_in(unit, SiUnit::acceleration) ? value / standard_gravity : value;
}

std::string g_text(const double value)
{
  return std::abs(value) < 0.1 ? significant(value, 2) : fixed(value, 2);
}

std::string peak_table(const Run &run)
{
  std::string rows;
  for (const PassInfo &pass : run.manifest.passes)
    for (const std::string roll : {"upper", "lower"}) {
      const Result *peak = pass_value(run, pass, "peak_g." + roll + "_work_roll");
      const Result *rms  = pass_value(run, pass, "rms_g." + roll + "_work_roll");
      if (!peak)
        continue;
      rows += "<tr><th scope=\"row\">" + escaped(pass.name) +
              (pass.synthetic ? " <small>synthetic force</small>" : "") + "</th><td>" + roll +
              "</td><td class=\"num\"><b>" + g_text(in_g(peak->value, peak->unit)) +
              "</b></td><td class=\"num\">" + (rms ? significant(in_g(rms->value, rms->unit), 3) : "\u2013") +
              "</td>" + compared_cells(*peak, find_published(peak->checks)) +
              compared_cells(*peak, find_check(peak->checks, CheckId::measured)) + "</tr>\n";
    }
  if (rows.empty())
    return "";
  return "<table class=\"peaks\"><thead><tr><th rowspan=\"2\">pass</th><th rowspan=\"2\">work roll</th>"
         "<th colspan=\"2\">this run</th><th colspan=\"2\">published model</th><th "
         "colspan=\"2\">measured</th></tr>"
         "<tr><th>peak [g]</th><th>rms [g]</th><th>peak [g]</th><th>run / model</th><th>peak [g]</th>"
         "<th>run / measured</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}
}  // namespace mill::report
