#include "report/stack/section.h"
#include "core/records/stack_names.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/plot/svg_plot.h"
#include <set>

namespace mill::report {
namespace {
constexpr Pen stack_pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::chained, Pen::pale};

Plot over_width(const char *title, const char *quantity, const char *unit)
{
  Plot plot;
  plot.title = title;
  plot.x     = {"z, drive side positive", "mm"};
  plot.y     = {quantity, unit};
  return plot;
}

std::string strip_drawing(const Table &table, const Column &column, const char *title)
{
  Plot plot = over_width(title, column.name == "flatness_I" ? "flatness" : "strip", column.unit.c_str());
  if (!add_line(plot, table, {"z", "mm"}, column, "", Pen::dark))
    return "";
  return svg_plot(plot);
}

// Names of the results "FAMILY.NAME.*" in their order.
std::vector<std::string> names_of(const Run &run, const std::string &family)
{
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Result &result : run.results)
    if (const auto parts = parts_of(result.name); parts[0] == family && seen.insert(parts[1]).second)
      names.push_back(parts[1]);
  return names;
}

// The upper half; made rolls have the same curves, turned or mirrored.
bool is_made(const std::string &name)
{
  return name.rfind("lower_", 0) == 0;
}

// Lines of the curves of all contacts or rolls of the upper half, a few in each drawing.
std::vector<std::string> drawings_of(const Run &run, const CurveKind &kind, const std::string &family,
                                     const Column &column, const char *title, const char *quantity)
{
  constexpr std::size_t most = std::size(stack_pens);
  std::vector<std::string> drawings;
  Plot plot = over_width(title, quantity, column.unit.c_str());
  for (const std::string &name : names_of(run, family)) {
    const Table *table = is_made(name) ? nullptr : stored_curve(run, kind, name);
    if (!table)
      continue;
    add_line(plot, *table, {"z", "mm"}, column, name, stack_pens[plot.lines.size() % most]);
    if (plot.lines.size() == most) {
      drawings.push_back(svg_plot(plot));
      plot.lines.clear();
    }
  }
  if (!plot.lines.empty())
    drawings.push_back(svg_plot(plot));
  return drawings;
}
}  // namespace

void stack_section(Page &page, const Run &run)
{
  const Table *strip = stored_curve(run, curve::stack_strip);
  if (run.manifest.kind != "stack" || !strip)
    return;
  page.section("stack", "Strip and rolls", Depth::manager);
  page.figure({strip_drawing(*strip, {"profile", "\u00b5m"}, "Thickness against the middle of the strip"),
               strip_drawing(*strip, {"line_load", "N/mm"}, "Line load of the strip")},
              "Profile and line load of the strip. A crowned strip is thinner at its edges.");
  page.figure({strip_drawing(*strip, {"flatness_I", "-"}, "Flatness, I-units")},
              "Flatness over the width, without flow across it: positive where fibres are longer.");
  page.figure(drawings_of(run, curve::stack_pair, family::pair, {"line_load", "N/mm"}, "Line loads", "line load"),
              "Line load of the contacts of the upper half.");
  page.figure(drawings_of(run, curve::stack_roll, family::roll, {"y", "mm"}, "Deflection upwards", "displacement"),
              "Axes of the rolls of the upper half, from the unloaded stack.");
}
}  // namespace mill::report
