#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
std::string cell(const std::string &html)
{
  return "<td class=\"num\">" + html + "</td>";
}

std::string row_head(const std::string &name)
{
  return "<tr><th scope=\"row\">" + escaped(name) + "</th>";
}

std::string named_row(const std::string &name, const std::string &cells)
{
  return row_head(name) + cells + "</tr>\n";
}

std::string table_of(const std::string &head, const std::string &rows)
{
  return rows.empty() ? ""
                      : "<table><thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string deviation_note(const double value, const double reference)
{
  if (!std::isfinite(value) || !std::isfinite(reference) || reference == 0)
    return "";
  return " <span class=\"deviation\">(" + percent(value / reference - 1) + ")</span>";
}
}  // namespace mill::report
