#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/plot_layout.h"
#include "report/shapes/shape_sketch.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr const char *flexibility = "\u00b5m/MN";

// Half a shape, stored from mid-length outwards, is drawn as the whole roll.
Line mirrored(Line line)
{
  const Eigen::Index n = line.x.size(), skip = line.x[0] == 0 ? 1 : 0;
  if (line.x.minCoeff() < 0)
    return line;
  Eigen::VectorXd x(2 * n - skip), y(2 * n - skip);
  x << -line.x.reverse(), line.x.tail(n - skip);
  y << line.y.reverse(), line.y.tail(n - skip);
  line.x = x;
  line.y = y;
  return line;
}

double half_of(const Run &run, const std::string &length)
{
  const auto match = run.manifest.geometry.find(length);
  return match == run.manifest.geometry.end() ? std::nan("") : 0.5 * match->second;
}

void mark_both_sides(Plot &plot, const Run &run, const std::string &length, const std::string &label,
                     const bool support)
{
  const double half = half_of(run, length);
  if (std::isfinite(half))
    for (const double side : {-1.0, 1.0})
      plot.marks.push_back({side * half, label, support});
}

struct Roll {
  const Table &table;
  std::string title, symbol;  // "Backup roll", "f2"
  std::string barrel, span;   // keys of its lengths in run.json
  bool work;
};

bool has_elements(const Roll &roll)
{
  return values_of(roll.table, {roll.symbol + "_upper_fe", flexibility}).size() > 0 ||
         values_of(roll.table, {roll.symbol + "_lower_fe", flexibility}).size() > 0;
}

// At the bearing, straight between the samples; NaN when the case stored no span.
double at_bearing(const Run &run, const Roll &roll, const Line &line)
{
  const double seat = half_of(run, roll.span);
  for (Eigen::Index i = 1; i < line.x.size(); ++i)
    if (line.x[i - 1] <= seat && seat <= line.x[i])
      return line.y[i - 1] + (seat - line.x[i - 1]) / (line.x[i] - line.x[i - 1]) * (line.y[i] - line.y[i - 1]);
  return std::nan("");
}

Plot empty_plot(const Roll &roll, const std::string &title, const std::string &quantity)
{
  Plot plot;
  plot.title = title;
  plot.x     = {"distance from mid-length", "m"};
  plot.y     = {quantity + " " + roll.symbol, flexibility};
  return plot;
}

void add_lines(Plot &plot, const Roll &roll, const std::string &side, const Pen closed, const Pen elements)
{
  const bool both = has_elements(roll);
  add_line(plot, roll.table, {"x", "m"}, {roll.symbol + "_" + side, flexibility},
           side + " roll" + (both ? ", chain" : ""), closed);
  add_line(plot, roll.table, {"x", "m"}, {roll.symbol + "_" + side + "_fe", flexibility},
           side + " roll, finite elements", elements);
}

void finish(Plot &plot, const Run &run, const Roll &roll)
{
  for (Line &line : plot.lines) {
    line        = mirrored(line);
    plot.x.high = std::max(std::isfinite(plot.x.high) ? plot.x.high : 0.0,
                           1.06 * line.x.cwiseAbs().maxCoeff());  // supports may stand at the very end
    plot.x.low = -plot.x.high;
  }
  mark_both_sides(plot, run, roll.span, "bearing", true);
  mark_both_sides(plot, run, roll.barrel, "barrel end", false);
  if (roll.work)
    mark_both_sides(plot, run, "strip_width", "strip edge", false);
}

RollSketch sketch_of(const Run &run, const Roll &roll, const Plot &plot)
{
  const bool work = roll.work;
  RollSketch s;
  s.title       = roll.title + " and what holds it";
  s.half_barrel = half_of(run, roll.barrel);
  s.radius      = half_of(run, work ? "work_roll_diameter" : "backup_diameter");
  s.neck_radius = half_of(run, work ? "work_neck_diameter" : "backup_neck_diameter");
  s.half_total = work ? half_of(run, "work_total_length") : s.half_barrel + 2 * half_of(run, "backup_neck_length");
  s.half_contact      = std::min(half_of(run, "work_roll_length"), half_of(run, "backup_length"));
  s.half_seat         = half_of(run, roll.span);
  s.half_strip        = work ? half_of(run, "strip_width") : std::nan("");
  s.work              = work;
  s.width             = plot.width;
  const Layout layout = layout_of(plot);
  s.left              = layout.left;
  s.right             = layout.right;
  s.low               = layout.to_x.range.low;
  s.high              = layout.to_x.range.high;
  return s;
}

std::string whole_shape(const Run &run, const Roll &roll)
{
  Plot plot = empty_plot(roll, roll.title, "displacement per load");
  add_lines(plot, roll, "upper", Pen::dark, Pen::dark_dashed);
  add_lines(plot, roll, "lower", Pen::warm, Pen::warm_dashed);
  finish(plot, run, roll);
  return "<div class=\"stacked\">" + svg_plot(plot) + roll_sketch(sketch_of(run, roll, plot)) + "</div>\n";
}

// What the roll itself gives, without the ground under its bearings; empty without a span to count from.
std::string own_shape(const Run &run, const Roll &roll)
{
  Plot plot = empty_plot(roll, roll.title + ", without its bearings' motion", "bending part of");
  add_lines(plot, roll, "upper", Pen::dark, Pen::dark_dashed);
  add_lines(plot, roll, "lower", Pen::warm, Pen::warm_dashed);
  for (Line &line : plot.lines) {
    const double seat = at_bearing(run, roll, line);
    if (!std::isfinite(seat))
      return "";
    line.y.array() -= seat;
  }
  if (plot.lines.empty())
    return "";
  finish(plot, run, roll);
  return svg_plot(plot);
}

// Largest difference of the two shapes over the bending at mid-length; NaN without finite elements.
double difference(const Run &run, const Roll &roll)
{
  double largest = std::nan("");
  for (const char *side : {"upper", "lower"}) {
    Plot plot;
    add_lines(plot, roll, side, Pen::dark, Pen::dark);
    if (plot.lines.size() != 2)
      continue;
    Line &closed = plot.lines[0], &elements = plot.lines[1];
    closed.y.array() -= at_bearing(run, roll, closed);
    elements.y.array() -= at_bearing(run, roll, elements);
    // Beyond the bearing the neck's end moves freely and nothing hangs on it.
    const double seat = half_of(run, roll.span);
    for (Eigen::Index i = 0; i < closed.y.size(); ++i)
      if (const double off = std::abs((elements.y[i] - closed.y[i]) / closed.y[0]);
          closed.x[i] <= seat && !(off <= largest))
        largest = off;
  }
  return largest;
}

std::string how_far_apart(const Run &run, const std::vector<Roll> &rolls)
{
  std::string text;
  for (const Roll &roll : rolls)
    if (const double off = difference(run, roll); std::isfinite(off))
      text += (text.empty() ? "" : ", ") + roll.symbol + " " + significant(100 * off, 2) + "\u00a0%";
  return text.empty() ? ""
                      : " Between the bearings the shapes by finite elements are at most this far from the closed "
                        "forms, in parts of the bending at mid-length: " +
                            text + ".";
}

}  // namespace

void shape_section(Page &page, const Run &run)
{
  const Table *work   = stored_curve(run, curve::shape_work_roll),
              *backup = stored_curve(run, curve::shape_backup_roll);
  if (!work && !backup && run.manifest.kind != KindOfCase::four_high)
    return;
  page.section("shapes", "Roll shapes and equivalent masses", Depth::expert);
  std::vector<Roll> rolls;
  if (backup)
    rolls.push_back({*backup, "Backup roll", "f2", "backup_length", "backup_bearing_span", false});
  if (work)
    rolls.push_back({*work, "Work roll", "f1", "work_roll_length", "work_bearing_span", true});
  std::vector<std::string> drawings, own;
  bool elements = false;
  for (const Roll &roll : rolls) {
    elements = elements || has_elements(roll);
    drawings.push_back(whole_shape(run, roll));
    if (const std::string drawing = own_shape(run, roll); !drawing.empty())
      own.push_back(drawing);
  }
  if (!drawings.empty())
    page.figure(
        drawings,
        "How far each cross-section moves from the ground up when the bite pushes with one "
        "meganewton. Each mass is weighted with the square of this displacement over that of its reference point, "
        "from which the equivalent masses M2 to M5 follow. The backup roll "
        "bends between its bearings (triangles); the work roll lies on the backup roll and is "
        "pressed by the strip, so its necks move least. Below each diagram the roll to scale along the "
        "same axis, with what holds it and what loads it." +
            std::string(
                elements ? " Solid lines are the shapes of the chain (each roll under its own even load, or as a "
                           "stepped beam where backup_roll.bending_model says so), dashed lines the "
                           "rolls of the whole stand by finite elements."
                         : ""));
  if (elements && !own.empty())
    page.figure(own,
                "The same shapes counted from the roll's own bearings, so that only its bending, its shear and "
                "the contact are left: <b>where solid and dashed lines part, the roll of the chain is not that of "
                "the stand</b>: "
                "a beam deflects too little at the step from barrel to neck, and the contact loads a barrel "
                "unevenly." +
                    how_far_apart(run, rolls));
  if (!backup)
    page.absent("The backup roll's shape is", curve_path(curve::shape_backup_roll) + ".csv");
  if (!work)
    page.absent("The work roll's shape is", curve_path(curve::shape_work_roll) + ".csv");
}
}  // namespace mill::report
