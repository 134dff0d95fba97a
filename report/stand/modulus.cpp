#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <cmath>

namespace mill::report {
namespace {
// Modulus over the force, with strip and with touching work rolls.
std::string modulus_plot(const Run &run, const Table &curve)
{
  Plot plot;
  plot.title = "Mill modulus";
  plot.x     = {"rolling force", "kN"};
  plot.y     = {"stiffness of the stand", "kN/mm"};
  const Column load{"load", "kN"};
  add_line(plot, curve, load, {"tangent", "kN/mm"}, "with strip, tangent", Pen::dark);
  add_line(plot, curve, load, {"secant", "kN/mm"}, "with strip, secant", Pen::dark_dashed);
  add_line(plot, curve, load, {"kiss_tangent", "kN/mm"}, "work rolls touching, tangent", Pen::warm);
  add_line(plot, curve, load, {"kiss_secant", "kN/mm"}, "work rolls touching, secant", Pen::warm_dashed);
  for (const char *name : {"stand.modulus.tangent", "stand.modulus.kiss"})
    if (const Result *m = run.find(name); m && std::isfinite(quantity_at(*m, "kN")))
      plot.points.push_back({quantity_at(*m, "kN"), 1e-6 * m->value, ""});
  return svg_plot(plot);
}

// What a calibration records: how far the screws turn from the first touch.
std::string stretch_plot(const Table &curve)
{
  Plot plot;
  plot.title = "Stretch of the stand";
  plot.x     = {"stretch", "mm"};
  plot.y     = {"rolling force", "kN"};
  add_line(plot, curve, {"stretch", "mm"}, {"load", "kN"}, "with strip", Pen::dark);
  add_line(plot, curve, {"kiss_stretch", "mm"}, {"load", "kN"}, "work rolls touching", Pen::warm);
  return svg_plot(plot);
}

struct GaugeRow {
  const char *result, *words;
  double step;        ///< of the input, SI
  const char *moved;  ///< that step in words
};

const GaugeRow gauge_rows[] = {
    {"stand.screw_sensitivity", "screw opened", 1e-5, "10 \u00b5m"},
    {"stand.thickness_by.entry_thickness", "strip enters thicker", 1e-5, "10 \u00b5m"},
    {"stand.thickness_by.eccentricity", "roll radius larger", 1e-5, "10 \u00b5m"},
    {"stand.thickness_by.friction", "friction coefficient", 0.01, "0.01"},
    {"stand.thickness_by.flow_stress", "flow stress", 0.01, "1\u00a0%"},
    {"stand.thickness_by.entry_tension", "back tension", 1e6, "1\u00a0MPa"},
    {"stand.thickness_by.exit_tension", "front tension", 1e6, "1\u00a0MPa"},
    {"stand.thickness_by.roll_speed", "speed of the rolls", 0.1, "0.1\u00a0m/s"},
};

std::string gauge_table(const Run &run)
{
  std::string body;
  for (const GaugeRow &row : gauge_rows) {
    const Result *r = run.find(row.result);
    if (!r || !std::isfinite(r->value))
      continue;
    const std::string coupled = r->checks.empty()
                                    ? "\u2013"
                                    : significant(1e6 * row.step * r->checks.front().value, 3) +
                                          " <span class=\"deviation\">(" +
                                          percent(r->checks.front().value / r->value - 1) + ")</span>";
    body += std::string("<tr><th scope=\"row\">") + row.words + "</th><td class=\"num\">" + row.moved +
            "</td><td class=\"num\"><b>" + known_digits(1e6 * row.step * r->value, r->error_estimate, 3) +
            "</b></td><td>" + accuracy_cell(*r) + "</td><td class=\"num\">" + coupled + "</td></tr>\n";
  }
  if (body.empty())
    return "";
  return "<table><thead><tr><th>what changes</th><th>by</th><th>exit thickness [\u00b5m]</th><th>accuracy</th>"
         "<th>coupled solution [\u00b5m]</th></tr></thead>\n<tbody>\n" +
         body + "</tbody></table>\n";
}
}  // namespace

void modulus_part(Page &page, const Run &run)
{
  const Table *curve = stored_curve(run, curve::stand_modulus);
  if (!curve)
    return;
  page.heading("Mill modulus");
  page.figure(
      {modulus_plot(run, *curve), stretch_plot(*curve)},
      "How stiff the stand is between its rolls, over the rolling force: the springs on the path of the force "
      "in series. With strip its flattening and the bending of the work rolls are in it; with touching work "
      "rolls, as in a calibration, their contact over the barrel. The tangent says how the thickness follows "
      "a change of force, the secant how far the screws have to turn from the first touch.");
  if (const std::string table = gauge_table(run); !table.empty())
    page.table(table,
               "What moves the thickness of the strip when the screws stand still: mill modulus and plastic slope "
               "of the first pass together. The last column solves stand and strip together, by a slab theory "
               "on the circle of the loaded roll.");
}
}  // namespace mill::report
