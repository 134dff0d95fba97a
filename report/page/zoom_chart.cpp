#include "core/base/short_number.h"
#include "report/page/embedded.h"
#include "report/page/sections.h"
#include "report/plot/envelope.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
// Six digits: the screen shows no more, and the report stays small enough to be mailed.
std::string json_number(const double value)
{
  return std::isfinite(value) ? short_number(value, 6) : "null";
}

// A script element ends at the first "</", also inside a string.
std::string json_text(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  return out + '"';
}
}  // namespace

std::string zoom_chart(const std::string &group, const std::string &y_axis, const double limit,
                       const Eigen::VectorXd &time,
                       const std::vector<std::pair<std::string, Eigen::VectorXd>> &series,
                       const std::string &title)
{
  if (!*embedded::dygraphs_js || time.size() < 2 || series.empty())
    return "";
  const Eigen::Index drawn = std::min<Eigen::Index>(time.size(), 2 * zoom_intervals);
  const double step        = (time[time.size() - 1] - time[0]) / double(drawn - 1);
  std::string labels, values;
  for (const auto &[label, all] : series) {
    const Eigen::VectorXd kept = interval_extremes(all, zoom_intervals);
    labels += (labels.empty() ? "" : ",") + json_text(label);
    values += values.empty() ? "[" : ",[";
    for (Eigen::Index i = 0; i < kept.size(); ++i)
      values += (i ? "," : "") + json_number(kept[i]);
    values += "]";
  }
  return "<div class=\"zoom\" data-group=\"" + escaped(group) + "\" data-axis=\"" + escaped(y_axis) +
         "\"><script type=\"application/json\">{\"start\":" + json_number(time[0]) +
         ",\"step\":" + json_number(step) +
         (limit > 0 ? ",\"range\":[" + json_number(-limit) + "," + json_number(limit) + "]" : "") +
         (title.empty() ? "" : ",\"title\":" + json_text(title)) + ",\"labels\":[" + labels + "],\"series\":[" +
         values + "]}</script></div>\n";
}
}  // namespace mill::report
