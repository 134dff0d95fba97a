#include "report/chatter/figures.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/envelope.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace mill::report {
namespace {
using Eigen::VectorXd;

// A record as it is drawn: one axis, one or more series.
struct Chart {
  std::string title;
  Axis y;
  std::vector<Line> lines;  // over the same times
  double limit = 0;         // half the height around zero; 0: from the data
};

std::string drawn(const Chart &chart, const std::vector<Mark> &marks)
{
  Plot plot;
  plot.title  = chart.title;
  plot.width  = page_width;
  plot.height = marks.empty() ? 190 : 210;
  plot.x      = {"time", "s"};
  plot.y      = chart.y;
  if (chart.limit > 0) {
    plot.y.low  = -chart.limit;
    plot.y.high = chart.limit;
  }
  plot.lines = chart.lines;
  plot.marks = marks;
  return svg_plot(plot);
}

// Half of what a chart of one series may hold: some 15 points in a period of 2 s of chatter, and a page that can
// still be mailed.
constexpr Eigen::Index long_record = zoom_intervals / 2;

// The static drawing for paper, and for the screen the data of a chart that page.js puts in its place.
std::string zoomable(const Chart &chart, const std::string &group, const std::vector<Mark> &marks = {})
{
  VectorXd time    = chart.lines[0].x;
  const bool whole = time.size() <= 2 * zoom_intervals;
  std::vector<std::pair<std::string, VectorXd>> series;
  for (const Line &line : chart.lines)
    series.emplace_back(line.label.empty() ? chart.title : line.label,
                        whole ? line.y : interval_extremes(line.y, long_record));
  if (!whole)
    time = VectorXd::LinSpaced(2 * long_record, time[0], time[time.size() - 1]).eval();
  return "<div class=\"history\"><div class=\"static\">" + drawn(chart, marks) + "</div>" +
         zoom_chart(group, chart.y.quantity + " [" + chart.y.unit + "]", chart.limit, time, series, chart.title) +
         "</div>\n";
}

const Table *history_table(const Run &run, const ChatterCondition &condition, const std::string &what)
{
  return run.table("response/chatter-" + condition.slug + "-" + what);
}

bool usable(const VectorXd &time, const VectorXd &value)
{
  return time.size() > 2 && value.size() == time.size() && time.allFinite() && value.allFinite() &&
         time[time.size() - 1] > time[0];
}

// Column of a record in the unit of the page; empty when it is not there or not finite.
Line line_of(const Table &table, const char *column, const char *unit, const std::string &label, const Pen pen)
{
  Line line{label, values_of(table, {"time", "s"}), values_of(table, {column, unit}), pen};
  if (!usable(line.x, line.y))
    line.x = line.y = VectorXd();
  return line;
}

const ChatterHistoryInfo *info_of(const ChatterCondition &condition, const std::string &what)
{
  const std::string file = "response/chatter-" + condition.slug + "-" + what;
  for (const ChatterHistoryInfo &info : condition.histories)
    if (info.file == file)
      return &info;
  return nullptr;
}

std::string rate(const double growth)
{
  const bool none = std::abs(growth) < 1e-4;  // what is left of zero after the search
  return none ? "0 1/s" : (growth > 0 ? "+" : "") + significant(growth, 3) + " 1/s";
}

// Without a critical speed the only record is that at the working speed.
std::string title_of(const std::string &what, const ChatterCondition &condition)
{
  const ChatterHistoryInfo *info = info_of(condition, what);
  const auto place               = choice_named<HistorySpeed>(what);
  const bool working             = place == HistorySpeed::at && info && !std::isfinite(condition.critical.speed);
  std::string title              = place == HistorySpeed::below   ? "Below the critical speed"
                                   : place == HistorySpeed::above ? "Above the critical speed"
                                   : working                      ? "At the working speed"
                                                                  : "At the critical speed";
  if (!info)
    return title;
  if (std::isfinite(info->speed))
    title += ", " + fixed(info->speed, 2) + " m/s";
  if (std::isfinite(info->growth))
    title += ": eigenvalue " + rate(info->growth);
  if (std::isfinite(info->measured))
    title += ", record " + rate(info->measured);
  return title;
}

// Largest swing when the modes that a push excites besides the critical one have died away.
double after_the_start(const Line &gap)
{
  const Eigen::Index n = gap.y.size();
  return gap.y.tail(n - n / 5).cwiseAbs().maxCoeff();
}

// What the eigenvalue says about the amplitude, through the largest swing of the second half.
Line envelope_of(const Line &gap, const double growth)
{
  const Eigen::Index half = gap.y.size() / 2;
  Eigen::Index peak;
  const double size     = gap.y.tail(gap.y.size() - half).cwiseAbs().maxCoeff(&peak);
  const double position = gap.x[half + peak];
  return {"amplitude by the eigenvalue", gap.x, size * (growth * (gap.x.array() - position)).exp().matrix(),
          Pen::warm};
}
}  // namespace

std::string chatter_histories(const Run &run, const ChatterCondition &condition)
{
  std::vector<Chart> charts;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const char *what : {"below", "at", "above"}) {
    const Table *table = history_table(run, condition, what);
    const Line gap     = table ? line_of(*table, "gap", "\u00b5m", "gap", Pen::dark) : Line{};
    if (gap.x.size() == 0)
      continue;
    const ChatterHistoryInfo *info = info_of(condition, what);
    charts.push_back({title_of(what, condition), {"gap", "\u00b5m"}, {gap}});
    charts.back().limit = 1.25 * after_the_start(gap);
    if (info && std::isfinite(info->growth) && std::abs(info->growth) * (gap.x[gap.x.size() - 1] - gap.x[0]) < 5)
      charts.back().lines.push_back(envelope_of(gap, info->growth));
    smallest = std::min(smallest, charts.back().limit);
    largest  = std::max(largest, charts.back().limit);
  }
  std::string drawings;
  for (Chart &chart : charts) {
    if (largest < 8 * smallest)  // one scale, so that decay and growth are seen against each other
      chart.limit = largest;
    drawings += zoomable(chart, "chatter-" + condition.slug);
  }
  return drawings.empty() ? "" : "<div class=\"histories\">\n" + drawings + "</div>\n";
}

namespace {
// First sample of the last `periods` periods.
Eigen::Index last_periods(const VectorXd &time, const double frequency, const double periods)
{
  const double from = time[time.size() - 1] - periods / frequency;
  return std::lower_bound(time.begin(), time.end(), from) - time.begin();
}

Line tail_of(const Line &line, const Eigen::Index first)
{
  Line tail = line;
  tail.x    = line.x.tail(line.x.size() - first);
  tail.y    = line.y.tail(line.y.size() - first);
  return tail;
}
}  // namespace

std::string chatter_periods(const Run &run, const ChatterCondition &condition)
{
  const Table *table = history_table(run, condition, "at");
  const double frequency =
      std::isfinite(condition.critical.frequency) ? condition.critical.frequency : condition.phases.frequency;
  if (!table || !(frequency > 0))
    return "";
  Plot plot;
  plot.title  = "Eight periods, each quantity over its own amplitude";
  plot.width  = page_width;
  plot.height = 270;
  plot.x      = {"time", "ms"};
  plot.y      = {"deviation over its amplitude", "-", Scale::linear, -1.15, 1.15};
  struct Channel {
    const char *column, *unit, *label;
    Pen pen;
  };
  for (const Channel &channel :
       {Channel{"gap", "\u00b5m", "gap", Pen::dark}, Channel{"force", "kN", "force", Pen::warm},
        Channel{"entry_tension", "MPa", "back tension", Pen::dashed},
        Channel{"exit_tension", "MPa", "front tension", Pen::dotted},
        Channel{"friction", "-", "friction", Pen::chained}}) {
    Line line = line_of(*table, channel.column, channel.unit, channel.label, channel.pen);
    if (line.x.size() == 0)
      continue;
    line              = tail_of(line, last_periods(line.x, frequency, 8));
    const double size = line.y.size() > 4 ? line.y.cwiseAbs().maxCoeff() : 0;
    if (!(size > 0))
      continue;
    line.x = 1e3 * (line.x.array() - line.x[0]);
    line.y /= size;
    plot.lines.push_back(line);
  }
  return plot.lines.size() < 2 ? "" : svg_plot(plot);
}

namespace {
struct CycleChannel {
  const char *title;
  Axis y;
  std::vector<std::pair<const char *, const char *>> columns;  // column, label
};
const std::vector<CycleChannel> &cycle_channels()
{
  static const std::vector<CycleChannel> channels{
      {"Gap", {"gap", "\u00b5m"}, {{"gap", ""}}},
      {"Rolling force", {"force", "kN"}, {{"force", ""}}},
      {"Tensions", {"tension", "MPa"}, {{"entry_tension", "back tension"}, {"exit_tension", "front tension"}}},
  };
  return channels;
}

std::vector<Chart> cycle_charts(const Run &run, const ChatterCondition &condition)
{
  const Table *table = history_table(run, condition, "limit-cycle");
  std::vector<Chart> charts;
  if (!table)
    return charts;
  for (const CycleChannel &channel : cycle_channels()) {
    Chart chart{channel.title, channel.y, {}};
    for (const auto &[column, label] : channel.columns)
      if (const Line line =
              line_of(*table, column, channel.y.unit.c_str(), label, chart.lines.empty() ? Pen::dark : Pen::warm);
          line.x.size() > 0)
        chart.lines.push_back(line);
    if (!chart.lines.empty())
      charts.push_back(chart);
  }
  return charts;
}

// The first of every kind; what follows repeats it in every period.
std::vector<Mark> first_events(const LimitCycleInfo &cycle)
{
  std::map<std::string, double> first;
  for (const ChatterEventInfo &event : cycle.events)
    if (std::isfinite(event.time) && !event.what.empty())
      if (const auto [entry, is_new] = first.emplace(event.what, event.time); !is_new)
        entry->second = std::min(entry->second, event.time);
  std::vector<Mark> marks;
  for (const auto &[what, time] : first)
    marks.push_back({time, what});
  return marks;
}
}  // namespace

std::string chatter_limit_cycle(const Run &run, const ChatterCondition &condition)
{
  std::string drawings;
  const std::vector<Mark> marks = first_events(condition.limit_cycle);
  for (const Chart &chart : cycle_charts(run, condition))
    drawings += zoomable(chart, "cycle-" + condition.slug, drawings.empty() ? marks : std::vector<Mark>{});
  return drawings.empty() ? "" : "<div class=\"histories\">\n" + drawings + "</div>\n";
}

std::vector<std::string> chatter_cycle_periods(const Run &run, const ChatterCondition &condition)
{
  std::vector<std::string> drawings;
  const double frequency = condition.limit_cycle.frequency;
  if (!(frequency > 0))
    return drawings;
  for (const Chart &chart : cycle_charts(run, condition)) {
    Plot plot;
    plot.title  = chart.title + ", last three periods";
    plot.width  = 333;
    plot.height = 260;
    plot.x      = {"time", "ms"};
    plot.y      = chart.y;
    for (const Line &line : chart.lines) {
      Line tail = tail_of(line, last_periods(line.x, frequency, 3));
      if (tail.x.size() < 4)
        continue;
      tail.x = 1e3 * (tail.x.array() - tail.x[0]);
      plot.lines.push_back(tail);
    }
    if (!plot.lines.empty())
      drawings.push_back(svg_plot(plot));
  }
  return drawings;
}
}  // namespace mill::report
