#include "report/modes/named_modes.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace mill::report {
namespace {
const char *const mass_names[] = {"M1 upper frame",     "M2 upper backup roll", "M3 upper work roll",
                                  "M4 lower work roll", "M5 lower backup roll", "M6 lower frame"};

constexpr double label_width = 150, column = 138, row = 52, figure_head = 64;  // px, grid of the shape figure

void draw_arrow(Svg &svg, const double x, const double y, const double displacement)
{
  const double length = 21 * displacement;  // px, up is positive
  svg.line(x - 11, y, x + 11, y, "rest");
  if (std::abs(length) < 1.5) {
    svg.circle(x, y, 2, "dot dark");
    return;
  }
  const double size = std::abs(length), half = std::min(4.5, 0.6 * size);
  const double tip = y - length, back = tip + std::copysign(std::min(6.0, size), length);
  svg.line(x, y, x, back, "arrow");
  svg.polyline({{x, tip}, {x - half, back}, {x + half, back}}, "arrowhead", true);
}

std::string shapes(const Table &modes)
{
  const Eigen::VectorXd frequency = values_of(modes, {"frequency", "Hz"});
  Svg svg(label_width + double(frequency.size()) * column, figure_head + 6 * row + 28,
          "shapes of the modes, displacement relative to the largest");
  for (int mass = 0; mass < 6; ++mass) {
    const double y = figure_head + (mass + 0.5) * row;
    svg.line(0, figure_head + mass * row, label_width + double(frequency.size()) * column,
             figure_head + mass * row, "grid");
    svg.text(0, y + 4, mass_names[mass], "t");
  }
  for (Eigen::Index mode = 0; mode < frequency.size(); ++mode) {
    const double x = label_width + (double(mode) + 0.5) * column;
    svg.text(x, 18, "f" + std::to_string(mode + 1), "title", Anchor::middle);
    svg.text(x, 36, fixed(frequency[mode], 1) + " Hz", "t strong", Anchor::middle);
    for (int mass = 0; mass < 6; ++mass) {
      const Eigen::VectorXd y = values_of(modes, {"y" + std::to_string(mass + 1), "-"});
      if (y.size() != frequency.size())
        continue;
      const double centre = figure_head + (mass + 0.5) * row;
      draw_arrow(svg, x - 18, centre, y[mode]);
      svg.text(x + 42, centre + 4, fixed(y[mode], 2), "t", Anchor::end);
    }
  }
  svg.text(label_width + double(frequency.size()) * column / 2, figure_head + 6 * row + 22,
           "vertical displacement, largest of the mode = 1 [-]; arrow up: upwards", "axis", Anchor::middle);
  return svg.str();
}

std::string energy_shares(const Table &modes)
{
  const Eigen::VectorXd frequency = values_of(modes, {"frequency", "Hz"});
  constexpr double left = 150, cell = 110, height = 30, top = 30;
  const double n = double(frequency.size());
  Svg svg(left + 7 * cell, top + n * height + 32,
          "share of each spring in the strain energy of each mode, in percent");
  for (int spring = 1; spring <= 7; ++spring) {
    const std::string name      = "K" + std::to_string(spring);
    const Eigen::VectorXd share = values_of(modes, {"energy_" + name, "%"});
    svg.text(left + (spring - 0.5) * cell, 20, name, "title", Anchor::middle);
    for (Eigen::Index mode = 0; mode < share.size(); ++mode) {
      const double x = left + (spring - 1) * cell, y = top + double(mode) * height;
      const double full = std::max(0.0, std::min(100.0, share[mode]));
      svg.rect(x + 2, y + 3, cell - 4, height - 6, "cell");
      svg.rect(x + 2, y + 3, (cell - 4) * full / 100, height - 6, "share");
      svg.text(x + cell - 8, y + 19, share[mode] < 0.05 ? "0" : fixed(share[mode], 1), "t", Anchor::end);
    }
  }
  for (Eigen::Index mode = 0; mode < frequency.size(); ++mode)
    svg.text(left - 10, top + double(mode) * height + 19,
             "f" + std::to_string(mode + 1) + "  " + fixed(frequency[mode], 1) + " Hz", "t", Anchor::end);
  svg.text(left + 3.5 * cell, top + n * height + 24, "share of the strain energy of the mode [%]", "axis",
           Anchor::middle);
  return svg.str();
}

std::string horizontal_table(const Table &modes)
{
  const Eigen::VectorXd frequency = values_of(modes, {"frequency", "Hz"});
  std::string heading             = "<th>mode</th><th>frequency [Hz]</th>";
  std::vector<Eigen::VectorXd> shapes;
  static const std::set<std::string> not_places{"mode", "frequency"};
  for (const std::string &name : modes.names)
    if (!not_places.count(name)) {
      const Eigen::VectorXd shape = values_of(modes, {name, "-"});
      if (shape.size() != frequency.size())
        continue;
      std::string label = name;
      std::replace_if(
          label.begin(), label.end(), [](const char c) { return c == '_' || c == '-'; }, ' ');
      heading += "<th>" + escaped(label) + " [-]</th>";
      shapes.push_back(shape);
    }
  std::string rows;
  for (Eigen::Index mode = 0; mode < frequency.size(); ++mode) {
    rows += "<tr><th scope=\"row\">fh" + std::to_string(mode + 1) + "</th><td class=\"num\"><b>" +
            fixed(frequency[mode], 1) + "</b></td>";
    for (const Eigen::VectorXd &shape : shapes)
      rows += "<td class=\"num\">" + fixed(shape[mode], 2) + "</td>";
    rows += "</tr>\n";
  }
  return "<table><thead><tr>" + heading + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string pole_table(const Table &poles)
{
  const Eigen::VectorXd frequency = values_of(poles, {"frequency", "Hz"});
  const Eigen::VectorXd damping   = values_of(poles, {"damping", "%"});
  std::string rows;
  for (Eigen::Index i = 0; i < std::min(frequency.size(), damping.size()); ++i)
    rows += "<tr><td class=\"num\">" + fixed(frequency[i], 1) + "</td><td class=\"num\">" +
            significant(damping[i], 3) + "</td></tr>\n";
  return "<table><thead><tr><th>natural frequency of the pole [Hz]</th><th>damping ratio [%]</th></tr></thead>\n"
         "<tbody>\n" +
         rows + "</tbody></table>\n";
}
}  // namespace

void mode_section(Page &page, const Run &run)
{
  if (!has_chain(run))
    return;
  page.section("modes", "Natural modes");
  if (const Table *modes = stored_curve(run, curve::modes)) {
    page.figure({shapes(*modes)},
                "Shapes of the vertical modes of the six-mass chain. Masses that move together keep "
                "the direction of their arrows; two neighbours that move against each other strain "
                "the spring between them.");
    page.figure(
        {energy_shares(*modes)},
        "Where each mode keeps its strain energy. A long bar says which stiffness decides the frequency: a "
        "spring with a share of 50&nbsp;% moves it by a quarter of its own relative change.");
  } else
    page.absent("Mode shapes and energy shares are", curve_path(curve::modes) + ".csv");
  if (const std::string table = named_mode_table(run); !table.empty())
    page.table(
        table + folded_modes(run),
        "The modes that the gap between the work rolls or a sensor sees, of the most detailed model of this "
        "run: as the stand rolls, with the strip as a spring between the work rolls, and open, without it, "
        "which is what a measured force drives. A name says what the mode does to the gap; its share is that "
        "of the static compliance of the gap.");
  if (const Table *poles = stored_curve(run, curve::poles))
    page.table(pole_table(*poles),
               "Poles of the chain with its dampers, of which real ones stand by themselves; with a "
               "damper in the bite they are not those of the undamped modes above.");
  if (const Table *modes = stored_curve(run, curve::modes_horizontal))
    page.table(horizontal_table(*modes),
               "Horizontal modes: rolls on their bearings and chock seats, uncoupled from "
               "the vertical chain; shapes with the largest displacement as 1.");
}
}  // namespace mill::report
