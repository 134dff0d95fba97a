#include "report/bearing/figures.h"
#include "report/page/curves.h"

namespace mill::report {
namespace {
struct Law {
  const char *column, *label;
  Pen pen;
  bool markers;
};
const Law laws[] = {
    {"fe", "contact elements", Pen::dark, true},
    {"slices", "slices, as the assembly uses them", Pen::warm, false},
    {"elastic", "plane strain, both bodies", Pen::dashed, false},
    {"iso", "ISO/TS 16281", Pen::pale, false},
    {"palmgren", "Palmgren, two contacts", Pen::dotted, false},
};
}  // namespace

std::vector<std::string> roller_law_drawings(const Table &law, const std::vector<Mark> &heaviest)
{
  std::vector<std::string> drawings;
  for (const std::string slope : {"secant", "tangent"}) {
    Plot plot;
    plot.title  = "One roller between its raceways, " + slope;
    plot.height = 360;
    plot.x      = {"load of the roller", "kN", Scale::logarithmic};
    plot.y      = {slope + " of one roller", "kN/mm"};
    for (const Law &entry : laws)
      add_line(plot, law, {"load", "kN"}, {slope + "_" + entry.column, "kN/mm"}, entry.label, entry.pen,
               entry.markers);
    if (plot.lines.empty())
      continue;
    plot.marks = heaviest;
    drawings.push_back(svg_plot(plot));
  }
  return drawings;
}

std::vector<std::string> roller_tilt_drawings(const Table &tilt)
{
  std::vector<std::string> drawings;
  const auto draw = [&](const std::string &column, const std::string &quantity, const std::string &unit) {
    Plot plot;
    plot.title  = quantity + " over tilt";
    plot.height = 280;
    plot.x      = {"tilt of the roller", "mrad"};
    plot.y      = {quantity, unit};
    add_line(plot, tilt, {"tilt", "mrad"}, {column, unit}, "contact elements", Pen::dark, true);
    add_line(plot, tilt, {"tilt", "mrad"}, {column + "_slices", unit}, "slices, as the assembly uses them",
             Pen::warm);
    if (!plot.lines.empty())
      drawings.push_back(svg_plot(plot));
  };
  draw("load", "roller load", "kN");
  draw("moment", "moment about mid-roller", "N m");
  return drawings;
}
}  // namespace mill::report
