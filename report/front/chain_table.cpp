// The chain in numbers, on the first screen: springs, bearings and masses with their errors and where they come
// from.
#include "report/front/chain_table.h"
#include "core/base/source_text.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include <cmath>
#include <utility>
#include <vector>

namespace mill::report {
namespace {
struct ChainColumn {
  const char *title;
  std::vector<std::pair<std::string, const Result *>> rows;
};

std::string origin_of(const Result &result)
{
  if (!result.estimated.empty())
    return result.estimated.size() == result.inputs.size() ? "estimated" : "partly estimated";
  return name_of(source_in(result.source).source.value_or(Source::computed));
}

std::string row_of(const std::string &name, const Result &result)
{
  const Shown value       = engineering(result.value, result.unit);
  const std::string error = std::isfinite(result.error_estimate) && result.error_estimate > 0
                                ? accuracy(result.error_estimate)
                                : "\u2013";
  std::string title       = meaning_of(result.name) + "; " + result.source;
  if (!result.error_lacks.empty())
    title +=
        "; its error is not known of " + result.error_lacks.front() +
        (result.error_lacks.size() > 1 ? " and " + std::to_string(result.error_lacks.size() - 1) + " more" : "");
  return "<tr title=\"" + escaped(title) + "\"><th scope=\"row\">" + escaped(name) + "</th><td class=\"num\"><b>" +
         known_digits(value.value, result.error_estimate) + "</b></td><td>" + escaped(value.unit) +
         "</td><td class=\"num\">" + error + "</td><td>" + origin_of(result) + "</td></tr>\n";
}

std::string table_of(const ChainColumn &column)
{
  std::string rows;
  for (const auto &[name, result] : column.rows)
    rows += row_of(name, *result);
  return rows.empty()
             ? ""
             : std::string("<table><thead><tr><th colspan=\"3\">") + column.title +
                   "</th><th>error</th><th>from</th></tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

ChainColumn column(const Run &run, const char *title, const char *family, const int n)
{
  ChainColumn all{title, {}};
  for (int i = 1; i <= n; ++i) {
    const std::string name = family + std::to_string(i);
    if (const Result *result = chain_value(run, name); result && std::isfinite(result->value))
      all.rows.emplace_back(name, result);
  }
  return all;
}
}  // namespace

std::string chain_table(const Run &run)
{
  std::string tables;
  std::size_t count = 0;
  for (const ChainColumn &one : {column(run, "springs", "K", 7), column(run, "equivalent masses", "M", 6),
                                 column(run, "bearings, radial", "Kzc", 4)}) {
    tables += table_of(one);
    count += one.rows.size();
  }
  return count < 2 ? "" : "<div class=\"chain\">\n" + tables + "</div>\n";  // one number has its card
}
}  // namespace mill::report
