#include "report/stack/figures.h"
#include "core/base/si_unit.h"
#include "core/records/rows_of_stack.h"
#include "core/records/stack_names.h"
#include "report/cluster/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace mill::report {
namespace {
using Eigen::Index;
using Eigen::VectorXd;

constexpr Pen stack_pens[]   = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::chained, Pen::pale};
constexpr Pen growing[]      = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::chained};
constexpr double small_width = 330, small_height = 210;  // px, of one of many

Plot over_width(const std::string &title, const char *quantity, const std::string &unit)
{
  Plot plot;
  plot.title = title;
  plot.x     = {"z, drive side positive", "mm"};
  plot.y     = {quantity, unit};
  return plot;
}

// What is in this place of results of these rows, in their order.
template <std::size_t n>
std::vector<std::string> names_of(const Run &run, const ResultRow *const (&rows)[n], const char *place)
{
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name); id && id->is_of(rows) && seen.insert(id->place(place)).second)
      names.push_back(id->place(place));
  return names;
}

std::vector<std::string> names_of_pairs(const Run &run)
{
  return names_of(run, row::pair::all, "pair");
}

std::vector<std::string> names_of_rolls(const Run &run)
{
  return names_of(run, row::roll::all, "roll");
}

// Made rolls and their pairs have the same curves as those they are made of, turned or mirrored.
std::set<std::string> made_rolls(const Run &run)
{
  std::set<std::string> names;
  for (const std::string &listed : names_of_rolls(run))
    names.insert(made_roll_name(listed));
  return names;
}

std::set<std::string> made_pairs(const Run &run)
{
  std::set<std::string> names;
  const auto rolls = names_of_rolls(run);
  for (const std::string &a : rolls)
    for (const std::string &b : rolls)
      names.insert(pair_name(made_roll_name(a), made_roll_name(b)));
  return names;
}

// Rows of a map whose first column is the same.
struct Rows {
  double value;
  Index first, count;
};
std::vector<Rows> rows_of(const VectorXd &column)
{
  std::vector<Rows> rows;
  for (Index i = 0; i < column.size(); ++i)
    if (rows.empty() || column[i] != rows.back().value)
      rows.push_back({column[i], i, 1});
    else
      ++rows.back().count;
  return rows;
}

// Every second of many, so that a legend stays short.
std::vector<Rows> some_of(std::vector<Rows> rows)
{
  while (rows.size() > std::size(growing)) {
    std::vector<Rows> fewer;
    for (std::size_t i = 0; i < rows.size(); i += 2)
      fewer.push_back(rows[i]);
    rows = std::move(fewer);
  }
  return rows;
}

// One quantity over the second setting, a line for each value of the first; dots where a contact is partly open.
Plot family_of_lines(const Table &table, const Column &first, const char *first_name, const Column &second,
                     const Column &quantity)
{
  Plot plot;
  const VectorXd by = values_of(table, first), x = values_of(table, second), y = values_of(table, quantity),
                 touching = values_of(table, {"touching", "-"});
  if (by.size() == 0 || x.size() != by.size() || y.size() != by.size() || touching.size() != by.size())
    return plot;
  std::size_t pen = 0;
  Line open;
  std::vector<double> open_x, open_y;
  for (const Rows &rows : some_of(rows_of(by))) {
    plot.lines.push_back({std::string(first_name) + " " + significant(rows.value, 4) + " " + first.unit,
                          x.segment(rows.first, rows.count), y.segment(rows.first, rows.count),
                          growing[pen++ % std::size(growing)]});
    for (Index i = rows.first; i < rows.first + rows.count; ++i)
      if (touching[i] < 1 - 1e-9) {
        open_x.push_back(x[i]);
        open_y.push_back(y[i]);
      }
  }
  if (!open_x.empty()) {
    open.label   = "a contact is partly open";
    open.x       = Eigen::Map<const VectorXd>(open_x.data(), Index(open_x.size()));
    open.y       = Eigen::Map<const VectorXd>(open_y.data(), Index(open_y.size()));
    open.pen     = Pen::warm;
    open.markers = true;
    open.joined  = false;
    plot.lines.push_back(open);
  }
  return plot;
}
}  // namespace

std::string stack_section_drawing(const Run &run)
{
  const ClusterData data = read_cluster_record(run.directory, stack_file);
  return data.record ? stack_drawing(*data.record, data.record->passes[0]) : "";
}

std::vector<std::string> line_load_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  double largest = 0;
  std::vector<std::pair<std::string, const Table *>> curves;
  const auto made = made_pairs(run);
  for (const std::string &name : names_of_pairs(run))
    if (const Table *table = made.count(name) ? nullptr : stored_curve(run, curve::stack_pair, name)) {
      curves.emplace_back(name, table);
      const VectorXd load = values_of(*table, {"line_load", "N/mm"});
      if (load.size() > 0)
        largest = std::max(largest, load.maxCoeff());
    }
  for (const auto &[name, table] : curves) {
    Plot plot   = over_width(name, "line load", "N/mm");
    plot.y.low  = 0;
    plot.y.high = 1.05 * largest;
    if (curves.size() > 2) {
      plot.width  = small_width;
      plot.height = small_height;
    }
    add_line(plot, *table, {"z", "mm"}, {"line_load", "N/mm"}, "", Pen::dark);
    drawings.push_back(svg_plot(plot));
  }
  return drawings;
}

std::vector<std::string> strip_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  const Table *table = stored_curve(run, curve::stack_strip);
  if (!table)
    return drawings;
  const auto add = [&](const Column &column, const char *title, const char *quantity) {
    Plot plot = over_width(title, quantity, column.unit);
    if (add_line(plot, *table, {"z", "mm"}, column, "", Pen::dark))
      drawings.push_back(svg_plot(plot));
  };
  add({"profile", "\u00b5m"}, "Thickness against the middle of the strip", "thickness");
  add({"line_load", "N/mm"}, "Line load of the strip", "line load");
  add({"flatness_I", "-"}, "Flatness, I-units", "flatness");
  return drawings;
}

std::vector<std::string> influence_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  const Table *table = stored_curve(run, curve::stack_influence);
  if (!table)
    return drawings;
  const auto draw = [&](const char *title, const char *unit, const bool pure) {
    constexpr std::size_t most = std::size(stack_pens);
    Plot plot                  = over_width(title, "change of thickness", unit);
    for (std::size_t k = 1; k < table->names.size(); ++k) {
      if (is_pure(table->units[k]) != pure)
        continue;
      add_line(plot, *table, {"z", "mm"}, {table->names[k], unit}, table->names[k],
               stack_pens[plot.lines.size() % most]);
      if (plot.lines.size() == most) {
        drawings.push_back(svg_plot(plot));
        plot.lines.clear();
      }
    }
    if (!plot.lines.empty())
      drawings.push_back(svg_plot(plot));
  };
  draw("Per unit of force", "\u00b5m/kN", false);
  draw("Per unit of an eccentric", "-", true);
  return drawings;
}

std::vector<std::string> deflection_drawings(const Run &run)
{
  constexpr std::size_t most = std::size(stack_pens);
  const auto made            = made_rolls(run);
  std::vector<std::string> drawings;
  for (const auto &[title, quantity, column] :
       {std::tuple<const char *, const char *, Column>{"Deflection upwards", "displacement", {"y", "mm"}},
        {"Bending stress", "stress", {"bending_stress", "MPa"}}}) {
    Plot plot = over_width(title, quantity, column.unit);
    for (const std::string &name : names_of_rolls(run)) {
      const Table *table = made.count(name) ? nullptr : stored_curve(run, curve::stack_roll, name);
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
  }
  return drawings;
}

std::vector<std::string> modulus_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  const Table *table = stored_curve(run, curve::stack_modulus);
  if (!table)
    return drawings;
  const Column force{"force", "kN"};
  Plot modulus;
  modulus.title = "Modulus over the rolling force";
  modulus.x     = {"rolling force", "kN"};
  modulus.y     = {"modulus", "kN/mm"};
  add_line(modulus, *table, force, {"mid", "kN/mm"}, "middle of the strip", Pen::dark);
  add_line(modulus, *table, force, {"mean", "kN/mm"}, "mean that the line load weighs", Pen::dashed);
  Plot crown  = modulus;
  crown.lines = {};
  crown.title = "Crown over the rolling force";
  crown.y     = {"crown", "\u00b5m"};
  add_line(crown, *table, force, {"crown", "\u00b5m"}, "", Pen::dark);
  for (Plot *plot : {&modulus, &crown})
    if (!plot->lines.empty())
      drawings.push_back(svg_plot(*plot));
  return drawings;
}

std::string settings_drawing(const Run &run)
{
  const Table *table = stored_curve(run, curve::stack_settings);
  if (!table)
    return "";
  Plot plot   = family_of_lines(*table, {"shift", "mm"}, "shift", {"bending_force", "kN"}, {"crown", "\u00b5m"});
  plot.title  = "Crown over bending force and shift";
  plot.x      = {"bending force of each chock", "kN"};
  plot.y      = {"crown", "\u00b5m"};
  plot.width  = 620;
  plot.height = 380;
  return plot.lines.empty() ? "" : svg_plot(plot);
}

std::vector<std::string> window_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  const Table *table = stored_curve(run, curve::stack_window);
  if (!table)
    return drawings;
  for (const auto &[title, quantity, column] :
       {std::tuple<const char *, const char *, Column>{"Crown", "crown", {"crown", "\u00b5m"}},
        {"Edge drop", "edge drop", {"edge_drop", "\u00b5m"}},
        {"Largest pressure between rolls", "pressure", {"peak_pressure", "MPa"}}}) {
    Plot plot  = family_of_lines(*table, {"width", "mm"}, "width", {"force", "kN"}, column);
    plot.title = title;
    plot.x     = {"rolling force", "kN"};
    plot.y     = {quantity, column.unit};
    if (!plot.lines.empty())
      drawings.push_back(svg_plot(plot));
  }
  return drawings;
}

std::vector<std::string> mode_drawings(const Run &run)
{
  std::vector<std::string> drawings;
  constexpr int most_modes = 400;
  std::vector<std::string> modes;
  for (int k = 1; k <= most_modes; ++k)
    if (stored_curve(run, curve::stack_mode, std::to_string(k)))
      modes.push_back(std::to_string(k));
  const auto names = names_of_rolls(run);
  const auto made  = made_rolls(run);
  for (const std::string &mode : modes) {
    const Table *table       = stored_curve(run, curve::stack_mode, mode);
    const Table *frequencies = stored_curve(run, curve::modes_of_model, "stack");
    if (!frequencies)
      frequencies = stored_curve(run, curve::modes_of_model, "stack-open");
    const VectorXd hertz = frequencies ? values_of(*frequencies, {"frequency", "Hz"}) : VectorXd();
    const Index number   = std::atoi(mode.c_str());
    Plot plot =
        over_width(number >= 1 && number <= hertz.size() ? fixed(hertz[number - 1], 1) + " Hz" : "mode " + mode,
                   "axis over the largest", "-");
    plot.width          = small_width;
    plot.height         = small_height;
    plot.y.low          = -1.05;
    plot.y.high         = 1.05;
    const VectorXd roll = values_of(*table, {"roll", "-"}), z = values_of(*table, {"z", "mm"}),
                   y = values_of(*table, {"y", "-"});
    if (roll.size() == 0 || z.size() != roll.size() || y.size() != roll.size())
      continue;
    for (const Rows &rows : rows_of(roll)) {
      const auto r = std::size_t(rows.value) - 1;
      plot.lines.push_back({"", z.segment(rows.first, rows.count), y.segment(rows.first, rows.count),
                            r < names.size() && made.count(names[r]) ? Pen::pale : Pen::dark});
    }
    drawings.push_back(svg_plot(plot));
  }
  return drawings;
}
}  // namespace mill::report
