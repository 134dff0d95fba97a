#include "report/bearing/figures.h"
#include "report/contact/pressure_map.h"
#include "report/page/curves.h"

// Oil films.
namespace mill::report {
namespace {
// One figure of some columns over load or speed.
std::string over(const Table &table, const Column &x, const char *label, const char *title, const Axis &y,
                 const std::vector<std::pair<Column, const char *>> &lines, const std::vector<Mark> &marks)
{
  const Pen pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted};
  Plot plot;
  plot.title    = title;
  plot.width    = 500;
  plot.height   = 320;
  plot.x        = {label, x.unit, Scale::logarithmic};
  plot.y        = y;
  std::size_t i = 0;
  for (const auto &[column, name] : lines)
    add_line(plot, table, x, column, name, pens[i++ % 4], false);
  plot.marks = marks;
  return svg_plot(plot);
}

std::vector<std::string> film_drawings(const Table &t, const Column &x, const char *label,
                                       const std::vector<Mark> &marks)
{
  return {over(t, x, label, "Stiffness", {"stiffness of one bearing", "kN/mm"},
               {{{"k_xx", "kN/mm"}, "along the load"},
                {{"k_yy", "kN/mm"}, "across it"},
                {{"k_xy", "kN/mm"}, "along by motion across"},
                {{"k_yx", "kN/mm"}, "across by motion along"}},
               marks),
          over(t, x, label, "Damping", {"damping of one bearing", "kN s/m"},
               {{{"b_xx", "kN s/m"}, "along the load"},
                {{"b_yy", "kN s/m"}, "across it"},
                {{"b_xy", "kN s/m"}, "along by motion across"}},
               marks),
          over(t, x, label, "Eccentricity", {"over the clearance", "-"}, {{{"eccentricity", "-"}, ""}}, marks),
          over(t, x, label, "Thinnest film", {"film", "\u00b5m"}, {{{"minimum_film", "\u00b5m"}, ""}}, marks)};
}
}  // namespace

bool oil_film_figures(Page &page, const Run &run, const std::string &bearing)
{
  const Table *pressure = stored_curve(run, curve::bearing_film_pressure, bearing);
  if (!pressure)
    return false;
  if (const Table *loads = stored_curve(run, curve::bearing, bearing))
    page.figure(
        film_drawings(*loads, {"load", "kN"}, "radial load of one bearing", bearing_loads(run, bearing)),
        "The oil film over its load, at the speed of the run; the temperature follows at every point. A line "
        "ends where no film carries any more. First axis along the load, second 90\u00b0 on in the direction "
        "of rotation.");
  if (const Table *speeds = stored_curve(run, curve::bearing_film_speed, bearing))
    page.figure(
        film_drawings(*speeds, {"speed", "Hz"}, "speed of the sleeve", {}),
        "The same over the speed of the sleeve, at the load of the run. Slower sleeves drag in less oil: the "
        "film becomes thin and stiff, and below the least speed sleeve and bush touch.");
  page.figure(
      {pressure_map(*pressure, "Pressure in the film", "distance from mid-length")},
      "Pressure at the working load, the bush unrolled: x from the direction of the load, in the direction of "
      "rotation. Beyond the narrowest gap the film ruptures and carries nothing.");
  return true;
}
}  // namespace mill::report
