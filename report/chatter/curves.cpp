#include "report/page/curves.h"
#include "report/chatter/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::report {
namespace {
using Eigen::VectorXd;

constexpr double half_page = 510, third_page = 333;  // px

void mark_speeds(Plot &plot, const ChatterCondition &condition)
{
  if (std::isfinite(condition.critical.speed))
    plot.marks.push_back({condition.critical.speed, "critical " + fixed(condition.critical.speed, 2)});
  if (std::isfinite(condition.speed))
    plot.marks.push_back({condition.speed, "working " + fixed(condition.speed, 2)});
}

// Zero is the line between dying away and growing.
void add_zero(Plot &plot, const double low, const double high)
{
  plot.lines.insert(plot.lines.begin(), {"", Eigen::Vector2d(low, high), Eigen::Vector2d(0, 0), Pen::pale});
}

struct Extent {
  double low, high;
};
Extent finite_extent(const VectorXd &values)
{
  Extent extent{not_given, not_given};
  for (const double v : values)
    if (std::isfinite(v)) {
      extent.low  = std::isfinite(extent.low) ? std::min(extent.low, v) : v;
      extent.high = std::isfinite(extent.high) ? std::max(extent.high, v) : v;
    }
  return extent;
}

// From a little more than half the speed that matters on, where that is in the table.
Extent extent_around_work(const Table &table, const Column &column, const ChatterCondition &condition)
{
  const VectorXd v     = values_of(table, {"speed", "m/s"});
  VectorXd values      = values_of(table, column);
  const double matters = std::isfinite(condition.critical.speed) ? condition.critical.speed : condition.speed;
  for (Eigen::Index i = 0; i < std::min(v.size(), values.size()); ++i)
    if (v[i] < 0.6 * matters && 0.6 * matters < v.maxCoeff())
      values[i] = not_given;
  return finite_extent(values);
}

// One column of the table over speed; no drawing without a finite value.
std::string over_speed(const Run &run, const ChatterCondition &condition, const Column &y, const Axis &axis,
                       const std::string &title, const double width, const bool zero = false)
{
  const Table *table = stored_curve(run, curve::chatter_speed, condition.slug);
  Plot plot;
  plot.title  = title;
  plot.width  = width;
  plot.height = width > 400 ? 300 : 270;
  plot.x      = {"roll speed", "m/s"};
  plot.y      = axis;
  if (!table || !add_line(plot, *table, {"speed", "m/s"}, y, "", Pen::dark))
    return "";
  const VectorXd v = plot.lines[0].x, values = plot.lines[0].y;
  if (!std::isfinite(finite_extent(values).low))
    return "";
  if (zero)
    add_zero(plot, v.minCoeff(), v.maxCoeff());
  mark_speeds(plot, condition);
  return svg_plot(plot);
}
}  // namespace

std::string chatter_growth(const Run &run, const ChatterCondition &condition, const double width)
{
  return over_speed(run, condition, {"growth_rate", "1/s"}, {"growth rate", "1/s"},
                    "Growth rate of the least stable mode", width, true);
}

std::string chatter_frequency(const Run &run, const ChatterCondition &condition)
{
  return over_speed(run, condition, {"frequency", "Hz"}, {"frequency", "Hz"}, "Frequency of the least stable mode",
                    half_page);
}

std::vector<std::string> chatter_bite(const Run &run, const ChatterCondition &condition)
{
  Axis force{"force", "kN"};
  if (const Table *table = stored_curve(run, curve::chatter_speed, condition.slug)) {
    const Column column{"force", "kN"};
    const double high = 2.5 * extent_around_work(*table, column, condition).high;
    if (finite_extent(values_of(*table, column)).high > high) {  // just above the slowest bite it is enormous
      force.low  = 0;
      force.high = high;
    }
  }
  std::vector<std::string> drawings{
      over_speed(run, condition, {"friction", "-"}, {"friction \u00b5", "-"}, "Friction", third_page),
      over_speed(run, condition, {"film_thickness", "\u00b5m"}, {"mean oil film", "\u00b5m"}, "Oil film",
                 third_page),
      over_speed(run, condition, {"force", "kN"}, force, "Rolling force", third_page)};
  drawings.erase(std::remove(drawings.begin(), drawings.end(), ""), drawings.end());
  return drawings;
}

std::string chatter_process_damping(const Run &run, const ChatterCondition &condition)
{
  const Table *table = stored_curve(run, curve::chatter_speed, condition.slug);
  Axis axis{"process damping", "MN s/m"};
  if (table) {  // it falls like 1/v and more, which would press everything of interest on one line
    const Extent extent = extent_around_work(*table, {"process_damping", axis.unit}, condition);
    const double room   = 0.05 * (extent.high - extent.low);
    axis.low            = extent.low - room;
    axis.high           = std::max(extent.high, 0.0) + room;
  }
  return over_speed(run, condition, {"process_damping", axis.unit}, axis, "Damping by strip and bite",
                    half_page - 110, true);
}

namespace {
constexpr std::array<Pen, 5> shades{Pen::shade1, Pen::shade2, Pen::shade3, Pen::shade4, Pen::shade5};

struct Branch {
  VectorXd growth, frequency;  // (n) 1/s, Hz
};

std::vector<Branch> branches_of(const Table &table)
{
  std::vector<Branch> all;
  for (int i = 1;; ++i) {
    const std::string mode = "mode" + std::to_string(i);
    Branch branch{values_of(table, {mode + "_growth", "1/s"}), values_of(table, {mode + "_frequency", "Hz"})};
    if (branch.growth.size() == 0 || branch.frequency.size() != branch.growth.size())
      return all;
    all.push_back(branch);
  }
}

// The window shows every mode that comes near the axis, and not the one that is damped a hundred times as much.
void choose_window(Plot &plot, const std::vector<Branch> &branches)
{
  double top = -std::numeric_limits<double>::infinity(), reach = 0;
  for (const Branch &branch : branches)
    if (const Extent extent = finite_extent(branch.growth); extent.high > top) {
      top   = extent.high;
      reach = extent.high - extent.low;
    }
  reach            = std::max({reach, std::abs(top), 1.0});
  plot.x.low       = top - 2 * reach;
  plot.x.high      = std::max(top, 0.0) + 0.08 * reach;
  double frequency = 0;
  for (const Branch &branch : branches)
    for (Eigen::Index i = 0; i < branch.growth.size(); ++i)
      if (branch.growth[i] >= plot.x.low && std::isfinite(branch.frequency[i]))
        frequency = std::max(frequency, branch.frequency[i]);
  plot.y.low  = 0;
  plot.y.high = frequency > 0 ? 1.1 * frequency : not_given;
}
}  // namespace

std::string chatter_locus(const Run &run, const ChatterCondition &condition)
{
  const Table *table = stored_curve(run, curve::chatter_locus, condition.slug);
  if (!table)
    return "";
  const VectorXd v                   = values_of(*table, {"speed", "m/s"});
  const std::vector<Branch> branches = branches_of(*table);
  const Extent speeds                = finite_extent(v);
  if (branches.empty() || v.size() < 2 || !(speeds.low < speeds.high))
    return "";
  Plot plot;
  plot.title  = "Modes in the plane of growth rate and frequency";
  plot.width  = half_page + 110;
  plot.height = 430;
  plot.x      = {"growth rate", "1/s"};
  plot.y      = {"frequency", "Hz"};
  choose_window(plot, branches);
  for (const Branch &branch : branches)
    plot.lines.push_back({"", branch.growth, branch.frequency, Pen::pale});
  const double step = (speeds.high - speeds.low) / double(shades.size());
  for (std::size_t s = 0; s < shades.size(); ++s) {
    const double low = speeds.low + double(s) * step, high = low + step;
    std::vector<double> x, y;
    for (const Branch &branch : branches)
      for (Eigen::Index i = 0; i < v.size(); ++i)
        if ((v[i] >= low || s == 0) && (v[i] < high || s + 1 == shades.size()) &&
            std::isfinite(branch.growth[i]) && branch.growth[i] >= plot.x.low) {
          x.push_back(branch.growth[i]);
          y.push_back(branch.frequency[i]);
        }
    Line dots{fixed(low, 1) + " \u2013 " + fixed(high, 1) + " m/s",
              Eigen::Map<VectorXd>(x.data(), Eigen::Index(x.size())),
              Eigen::Map<VectorXd>(y.data(), Eigen::Index(y.size())), shades[s], true};
    dots.joined = false;
    plot.lines.push_back(dots);
  }
  plot.lines.push_back({"", Eigen::Vector2d(0, 0), Eigen::Vector2d(0, plot.y.high), Pen::warm_dashed});
  if (std::isfinite(condition.critical.speed) && std::isfinite(condition.critical.frequency))
    plot.points.push_back(
        {0, condition.critical.frequency,
         fixed(condition.critical.speed, 2) + " m/s, " + fixed(condition.critical.frequency, 1) + " Hz"});
  return svg_plot(plot);
}

namespace {
std::string tandem_growth(const Run &run, const ChatterTandem &tandem, const CurveKind &kind,
                          const std::string &title)
{
  const Table *table = stored_curve(run, kind, tandem_item);
  if (!table)
    return "";
  Plot plot;
  plot.title  = title;
  plot.width  = half_page;
  plot.height = 320;
  plot.x      = {"roll speed of the last stand", "m/s"};
  plot.y      = {"growth rate", "1/s"};
  const Column speed{"speed", "m/s"};
  if (!add_line(plot, *table, speed, {"growth_rate", "1/s"}, "all, with the delay", Pen::dark) ||
      !std::isfinite(finite_extent(plot.lines[0].y).low))
    return "";
  add_line(plot, *table, speed, {"growth_without_delay", "1/s"}, "tension alone", Pen::warm_dashed);
  add_line(plot, *table, speed, {"growth_alone", "1/s"}, "single stands", Pen::dotted);
  add_zero(plot, plot.lines[0].x.minCoeff(), plot.lines[0].x.maxCoeff());
  if (std::isfinite(tandem.critical_speed))
    plot.marks.push_back({tandem.critical_speed, "critical " + fixed(tandem.critical_speed, 2)});
  return svg_plot(plot);
}
}  // namespace

std::string chatter_tandem_growth(const Run &run, const ChatterTandem &tandem)
{
  return tandem_growth(run, tandem, curve::chatter_speed, "Growth rate of all stands together");
}

std::string chatter_tandem_lobes(const Run &run, const ChatterTandem &tandem)
{
  return tandem_growth(run, tandem, curve::chatter_lobes, "The same in finer steps");
}
}  // namespace mill::report
