#include "report/modes/model_data.h"
#include "report/page/cells.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/plot_layout.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace mill::report {
namespace {
constexpr double panel_width = 505, bar_height = 20, bar_step = 27, bars_left = 148;  // px
constexpr int colours = 8;

struct StackedBar {
  std::string label;
  bool real;
  const MassBreakdown *of;
};

double value_of(const PartMass &part, const bool real)
{
  const double value = real ? part.mass : part.equivalent;
  return std::isfinite(value) && value > 0 ? value : 0;
}

double sum_of(const MassBreakdown &breakdown, const bool real)
{
  double sum = 0;
  for (const PartMass &part : breakdown.parts)
    sum += real ? part.mass : part.equivalent;
  return sum;
}

// Real mass once where the routes agree on it, then the weighted mass by every route.
std::vector<StackedBar> bars_of(const ModelData &data, const std::string &mass)
{
  std::vector<StackedBar> bars;
  double real = std::nan("");
  for (const MassBreakdown &breakdown : data.breakdown) {
    if (breakdown.mass != mass || breakdown.parts.empty())
      continue;
    if (!(std::abs(sum_of(breakdown, true) - real) <= 1e-3 * real)) {
      bars.push_back({std::isnan(real) ? "real mass" : "real, " + breakdown.route, true, &breakdown});
      real = sum_of(breakdown, true);
    }
    bars.push_back({breakdown.route, false, &breakdown});
  }
  return bars;
}

// A part keeps its colour from panel to panel unless another one of the same panel has it.
using Colour = std::map<std::string, int>;

Colour colours_of(const std::vector<std::string> &names, Colour &wanted)
{
  Colour colour;
  const auto taken = [&](const int number) {
    return std::any_of(colour.begin(), colour.end(), [&](const auto &entry) { return entry.second == number; });
  };
  for (const std::string &name : names) {
    int number = wanted.emplace(name, int(wanted.size()) % colours).first->second;
    for (int tried = 0; tried < colours && taken(number); ++tried)
      number = (number + 1) % colours;
    colour[name] = number;
  }
  return colour;
}

std::vector<std::string> part_names(const std::vector<StackedBar> &bars)
{
  std::vector<std::string> names;
  for (const StackedBar &bar : bars)
    for (const PartMass &part : bar.of->parts)
      if (value_of(part, bar.real) > 0 && std::find(names.begin(), names.end(), part.name) == names.end())
        names.push_back(part.name);
  return names;
}

double draw_legend(Svg &svg, const std::vector<std::string> &names, const Colour &colour)
{
  double x = 34, y = 32;
  for (const std::string &name : names) {
    const double needed = 34 + text_width(name, plot_font);
    if (x > 34 && x + needed > panel_width) {
      x = 34;
      y += 17;
    }
    svg.rect(x, y - 5, 14, 10, "part-" + std::to_string(colour.at(name)));
    svg.text(x + 19, y + 4, name, "t");
    x += needed;
  }
  return y + 14;
}

std::string panel(const std::string &mass, const std::vector<StackedBar> &bars, Colour &wanted)
{
  const auto names    = part_names(bars);
  const Colour colour = colours_of(names, wanted);
  double largest      = 0;
  for (const StackedBar &bar : bars)
    largest = std::max(largest, sum_of(*bar.of, bar.real));
  // The legend decides about the height, so it is measured before it is drawn.
  Svg measured(1, 1, "");
  const double top = draw_legend(measured, names, colour), bottom = top + double(bars.size()) * bar_step + 4;
  Svg svg(panel_width, bottom + 44, mass + ": its parts in kg, real and weighted");
  draw_legend(svg, names, colour);
  svg.text(34, 15, mass, "title");
  const double high = largest > 0 ? 1.16 * largest : 1, right = panel_width - 14;
  const auto to_x   = [&](const double kg) { return bars_left + kg / high * (right - bars_left); };
  const Ticks ticks = linear_ticks(0, high, 5);
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    svg.line(to_x(ticks.at[i]), top, to_x(ticks.at[i]), bottom, "grid");
    svg.text(to_x(ticks.at[i]), bottom + 16, ticks.labels[i], "t tx", Anchor::middle);
  }
  svg.rect(bars_left, top, right - bars_left, bottom - top, "frame");
  svg.text((bars_left + right) / 2, bottom + 36, "mass [kg]", "axis", Anchor::middle);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double y = top + 4 + double(i) * bar_step;
    svg.text(bars_left - 8, y + 15, bars[i].label, "t ty", Anchor::end);
    double sum = 0;
    for (const PartMass &part : bars[i].of->parts) {
      const double value = value_of(part, bars[i].real), x = to_x(sum), width = to_x(sum + value) - x;
      if (width <= 0)
        continue;
      svg.rect(x, y, width, bar_height, "part-" + std::to_string(colour.at(part.name)));
      sum += value;
    }
    svg.text(to_x(sum) + 5, y + 15, fixed(sum_of(*bars[i].of, bars[i].real), 0), "t strong halo");
  }
  return svg.str();
}

std::vector<std::string> panels(const ModelData &data)
{
  std::vector<std::string> drawings, masses;
  for (const MassBreakdown &breakdown : data.breakdown)
    if (std::find(masses.begin(), masses.end(), breakdown.mass) == masses.end())
      masses.push_back(breakdown.mass);
  std::sort(masses.begin(), masses.end());
  Colour colour;
  for (const std::string &mass : masses)
    if (const auto bars = bars_of(data, mass); !bars.empty())
      drawings.push_back(panel(mass, bars, colour));
  return drawings;
}

// Two in a row, also on paper, where the drawings of other figures share one.
std::string side_by_side(const std::vector<std::string> &drawings)
{
  std::string all = "<div class=\"panels\">\n";
  for (const std::string &drawing : drawings)
    all += drawing;
  return all + "</div>\n";
}

// A number and how far it is from the chain's.
std::string mass_cell(const double value, const double reference)
{
  return cell(fixed(value, std::abs(value) < 1e4 ? 1 : 0) + deviation_note(value, reference));
}

std::string routes_table(const ModelData &data)
{
  std::string body;
  for (const MassRoutes &row : data.routes)
    body += "<tr><th scope=\"row\">" + escaped(row.mass) + "</th>" + mass_cell(row.chain, NAN) +
            mass_cell(row.fe_integral, row.chain) + mass_cell(row.fe_solid, row.chain) +
            mass_cell(row.published, row.chain) + "</tr>\n";
  return body.empty() ? ""
                      : "<table><thead><tr><th>mass</th><th>shape of the chain [kg]</th><th>finite-element shape "
                        "[kg]</th><th>kinetic energy of the solid [kg]</th><th>published "
                        "[kg]</th></tr></thead>\n<tbody>\n" +
                            body + "</tbody></table>\n";
}
}  // namespace

void mass_section(Page &page, const ModelData &data)
{
  const auto drawings     = panels(data);
  const std::string table = routes_table(data);
  if (drawings.empty() && table.empty())
    return;
  page.section("masses", "Equivalent masses", Depth::expert);
  if (!table.empty())
    page.table(table, "Every equivalent mass by every route; in brackets how far it is from the chain's. The "
                      "first two take the published integrals along the roll axis, with the shape of a beam and "
                      "with that of the meshed roll; the third adds up the motion of all its material.");
  if (!drawings.empty())
    page.figure({side_by_side(drawings)},
                "What the equivalent masses are made of: the real parts (first bar) and the weighted parts. A "
                "part is weighted with the square of its displacement over that of the reference "
                "point, so <b>what lies near the reference keeps its weight and what lies towards the "
                "ground loses it</b>.");
}
}  // namespace mill::report
