#include "report/frequency/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mill::report {
namespace {
Pen pen_of(const std::string &group)
{
  static const std::map<std::string, Pen> pens{{"work roll", Pen::dark},
                                               {"backup roll", Pen::dashed},
                                               {"work-roll bearing", Pen::pale},
                                               {"backup-roll bearing", Pen::pale_dashed},
                                               {"drive", Pen::warm}};
  const auto match = pens.find(group);
  return match == pens.end() ? Pen::pale : match->second;
}

// Named modes close below each other share the space of their names.
std::vector<CampbellMode> ascending(std::vector<CampbellMode> modes)
{
  std::stable_sort(modes.begin(), modes.end(),
                   [](const CampbellMode &a, const CampbellMode &b) { return a.frequency < b.frequency; });
  return modes;
}

// As high as a mode or a line reaches: where no line goes there is nothing to read.
double top_of(const CampbellData &data)
{
  double mode = 0, lowest = std::numeric_limits<double>::infinity(), line = 0;
  for (const CampbellMode &m : data.modes) {
    mode   = std::max(mode, m.frequency);
    lowest = std::min(lowest, m.frequency);
  }
  for (const CampbellLine &l : data.lines)
    line = std::max(line, l.per_length * data.speeds[1]);
  return std::min(mode, std::max(1.1 * line, 2 * lowest));
}

std::string distance_text(const double distance)
{
  if (std::isnan(distance))
    return "\u2013";
  return distance == 0 ? "inside" : fixed(100 * std::abs(distance), 0) + (distance < 0 ? " % below" : " % above");
}
}  // namespace

std::string campbell_drawing(const CampbellData &data)
{
  if (!data.stored || data.modes.empty() || !(data.speeds[1] > data.speeds[0]))
    return "";
  const double top = top_of(data);
  Plot plot;
  plot.width  = 1040;
  plot.height = 620;
  plot.title  = "Modes over the rolling speed with the orders of what turns";
  plot.x      = {"speed of the rolls' surface", "m/s", Scale::linear, data.speeds[0], data.speeds[1]};
  plot.y      = {"frequency", "Hz", Scale::linear, 0, 1.05 * top};
  std::map<std::string, bool> listed;
  for (const CampbellLine &line : data.lines) {
    // Cut where it leaves the drawing.
    const double end = std::min(data.speeds[1], plot.y.high / line.per_length);
    if (!(end > data.speeds[0]))
      continue;
    plot.lines.push_back({listed[line.group] ? "" : line.group, Eigen::Vector2d(data.speeds[0], end),
                          line.per_length * Eigen::Vector2d(data.speeds[0], end), pen_of(line.group)});
    listed[line.group] = true;
  }
  bool first = true;
  for (const CampbellMode &mode : ascending(data.modes)) {
    if (mode.frequency > plot.y.high)
      break;
    plot.lines.push_back({first ? "modes" : "", Eigen::Vector2d(data.speeds[0], data.speeds[1]),
                          Eigen::Vector2d::Constant(mode.frequency), Pen::chained});
    first = false;
  }
  for (const CampbellMode &mode : data.modes)
    if (mode.frequency < plot.y.high)
      plot.points.push_back({data.speeds[0], mode.frequency, mode.name + ", " + fixed(mode.frequency, 0) + " Hz"});
  Line meets{"crossings", {}, {}, Pen::warm, true, false};
  meets.x.resize(Eigen::Index(data.crossings.size()));
  meets.y.resize(meets.x.size());
  for (std::size_t i = 0; i < data.crossings.size(); ++i) {
    meets.x[Eigen::Index(i)] = data.crossings[i].speed;
    meets.y[Eigen::Index(i)] = data.modes[std::size_t(data.crossings[i].mode)].frequency;
  }
  if (meets.x.size() > 0)
    plot.lines.push_back(std::move(meets));
  if (std::isfinite(data.working[0])) {
    plot.marks.push_back({data.working[0], data.working[1] > data.working[0] ? "working from" : "working speed"});
    if (data.working[1] > data.working[0])
      plot.marks.push_back({data.working[1], "to"});
  }
  return svg_plot(plot);
}

std::string crossing_table(const CampbellData &data, const std::size_t most)
{
  std::vector<CampbellCrossing> all = data.crossings;
  std::stable_sort(all.begin(), all.end(), [](const CampbellCrossing &a, const CampbellCrossing &b) {
    const double near_a = std::isnan(a.distance) ? a.speed : std::abs(a.distance),
                 near_b = std::isnan(b.distance) ? b.speed : std::abs(b.distance);
    return near_a < near_b;
  });
  all.resize(std::min(all.size(), most));
  if (all.empty())
    return "";
  std::string rows;
  for (const CampbellCrossing &c : all) {
    const CampbellMode &mode = data.modes[std::size_t(c.mode)];
    const CampbellLine &line = data.lines[std::size_t(c.line)];
    rows += "<tr><th scope=\"row\">" + escaped(mode.name) + "</th><td class=\"num\">" +
            frequency_text(mode.frequency, mode.error_estimate) + "</td><td>" + escaped(line.name) +
            "</td><td class=\"num\">" + significant(line.per_turn, 5) + "</td><td class=\"num\"><b>" +
            known_digits(c.speed, mode.error_estimate) + "</b></td><td class=\"num\">" +
            accuracy(mode.error_estimate) + "</td><td>" + distance_text(c.distance) + "</td></tr>\n";
  }
  return "<table><thead><tr><th>mode</th><th>frequency [Hz]</th><th>what turns</th><th>per turn [-]</th>"
         "<th>speed [m/s]</th><th>accuracy</th><th>working range</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}
}  // namespace mill::report
