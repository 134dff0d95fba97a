#include "report/modes/names.h"
#include "core/records/result_names.h"
#include "report/page/number.h"
#include "report/page/tables.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
NamedMode named_mode(const Result &mode)
{
  // "computed: NAME: DECIDED; method of the frequency"
  const std::string start = "computed: ";
  const std::string text  = mode.source.rfind(start, 0) == 0 ? mode.source.substr(start.size()) : mode.source;
  const auto colon = text.find(": "), end = text.rfind("; ");
  NamedMode named{text.substr(0, colon), "", ""};
  if (colon != std::string::npos)
    named.why = text.substr(colon + 2, end == std::string::npos ? end : end - colon - 2);
  if (end != std::string::npos)
    named.model = text.substr(end + 2);
  return named;
}

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
    body += "<tr><th scope=\"row\">" + escaped(named.name) + "</th><td class=\"num\"><b>" + fixed(mode.value, 1) +
            "</b></td><td>" + accuracy_cell(mode) + "</td><td>" + escaped(named.why) + "</td><td>" +
            (others.empty() ? "\u2013" : escaped(others)) + "</td></tr>\n";
  }
  if (body.empty())
    return "";
  return "<table><thead><tr><th>mode</th><th>frequency [Hz]</th><th>accuracy</th><th>why this name</th>"
         "<th>same name elsewhere [Hz]</th></tr></thead>\n<tbody>\n" +
         body + "</tbody></table>\n";
}
}  // namespace mill::report
