#include "report/curves.h"
#include "report/sections.h"

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

void mark_both_sides(Plot &plot, const Run &run, const std::string &length, const std::string &label,
                     const bool support)
{
  const auto found = run.manifest.geometry.find(length);
  if (found == run.manifest.geometry.end())
    return;
  for (const double side : {-0.5, 0.5})
    plot.marks.push_back({side * found->second, label, support});
}

std::string shape(const Run &run, const Table &table, const std::string &title, const std::string &symbol,
                  const std::string &roll)
{
  Plot plot;
  plot.title = title;
  plot.x     = {"distance from mid-length", "m"};
  plot.y     = {"displacement per load " + symbol, flexibility};
  add_line(plot, table, {"x", "m"}, {symbol + "_upper", flexibility}, "upper roll", Pen::dark);
  add_line(plot, table, {"x", "m"}, {symbol + "_lower", flexibility}, "lower roll", Pen::warm);
  for (Line &line : plot.lines) {
    line        = mirrored(line);
    plot.x.high = 1.06 * line.x.cwiseAbs().maxCoeff();  // supports may stand at the very end
    plot.x.low  = -plot.x.high;
  }
  mark_both_sides(plot, run, roll + "_bearing_span", "bearing", true);
  mark_both_sides(plot, run, roll + "_length", "barrel end", false);
  if (roll == "work_roll")
    mark_both_sides(plot, run, "strip_width", "strip edge", false);
  return svg_plot(plot);
}
}  // namespace

void shape_section(Page &page, const Run &run)
{
  const Table *work = run.table("curves/shape-work-roll"), *backup = run.table("curves/shape-backup-roll");
  if (!work && !backup && run.manifest.kind != "four-high")
    return;
  page.section("shapes", "Roll shapes and equivalent masses");
  std::vector<std::string> drawings;
  if (backup)
    drawings.push_back(shape(run, *backup, "Backup roll", "f2", "backup"));
  if (work)
    drawings.push_back(shape(run, *work, "Work roll", "f1", "work_roll"));
  if (!drawings.empty())
    page.figure(drawings,
                "How far each cross-section moves from the ground up when the bite pushes with one "
                "meganewton. A mass counts with the square of this displacement over that of its reference "
                "point, which is where the equivalent masses M2 to M5 come from. The backup roll "
                "bends between its bearings (triangles); the work roll lies on the backup roll and is "
                "pressed by the strip, so its necks move least.");
  if (!backup)
    page.absent("The backup roll's shape is", "curves/shape-backup-roll.csv");
  if (!work)
    page.absent("The work roll's shape is", "curves/shape-work-roll.csv");
}
}  // namespace mill::report
