#include "report/modes/named_modes.h"
#include "core/records/result_names.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/tables.h"
#include <cmath>

namespace mill::report {
std::string named_mode_table(const Run &run)
{
  std::string body;
  for (const Result &mode : run.results) {
    if (!is_of(mode.name, family::mode))
      continue;
    const NamedMode named = named_mode(mode);
    std::string others;
    for (const Check &check : mode.checks)
      others += (others.empty() ? "" : ", ") + check.name + " " + fixed(check.value, 1);
    body += "<tr><th scope=\"row\">" + escaped(named.name) + "</th><td class=\"num\"><b>" +
            frequency_text(mode.value, mode.error_estimate) + "</b></td><td>" + accuracy_cell(mode) + "</td><td>" +
            escaped(named.why) + "</td><td>" + (others.empty() ? "\u2013" : escaped(others)) + "</td></tr>\n";
  }
  if (body.empty())
    return "";
  return "<table><thead><tr><th>mode</th><th>frequency [Hz]</th><th>accuracy</th><th>why this name</th>"
         "<th>same name elsewhere [Hz]</th></tr></thead>\n<tbody>\n" +
         body + "</tbody></table>\n";
}
}  // namespace mill::report
