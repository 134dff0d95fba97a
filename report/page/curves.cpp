#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <system_error>

namespace mill::report {
namespace {
struct KnownUnit {
  const char *name;
  const char *dimension;
  double si;
};
const KnownUnit known_units[] = {
    {"-", "number", 1},
    {"%", "number", 0.01},
    {"s", "time", 1},
    {"ms", "time", 1e-3},
    {"Hz", "frequency", 1},
    {"N", "force", 1},
    {"kN", "force", 1e3},
    {"MN", "force", 1e6},
    {"m", "length", 1},
    {"mm", "length", 1e-3},
    {"\u00b5m", "length", 1e-6},
    {"Pa", "pressure", 1},
    {"MPa", "pressure", 1e6},
    {"N/m", "stiffness", 1},
    {"kN/mm", "stiffness", 1e6},
    {"N/mm", "stiffness", 1e3},
    {"N/m\u00b2", "bedding", 1},
    {"kN/mm per m", "bedding", 1e6},
    {"m/N", "flexibility", 1},
    {"\u00b5m/MN", "flexibility", 1e-12},
    {"\u00b5m/kN", "flexibility", 1e-9},
    {"rad", "angle", 1},
    {"mrad", "angle", 1e-3},
    {"\u00b0", "angle", EIGEN_PI / 180},
    {"N m", "moment", 1},
    {"kN m", "moment", 1e3},
    {"1/s", "rate", 1},
    {"N s/m", "damper", 1},
    {"kN s/m", "damper", 1e3},
    {"MN s/m", "damper", 1e6},
    {"Pa s", "viscosity", 1},
    {"mPa s", "viscosity", 1e-3},
    {"m/s", "speed", 1},
    {"m/s\u00b2", "acceleration", 1},
    {"g", "acceleration", standard_gravity},
    {"N/\u221aHz", "force density", 1},
    {"kN/\u221aHz", "force density", 1e3},
    {"g/\u221aHz", "accel. density", standard_gravity},
};

const KnownUnit *known(const std::string &unit)
{
  const std::string sign = unit_sign(unit).empty() ? "-" : unit_sign(unit);
  for (const KnownUnit &candidate : known_units)
    if (sign == candidate.name)
      return &candidate;
  return nullptr;
}
}  // namespace

double factor_between(const std::string &from, const std::string &to)
{
  const KnownUnit *const a = known(from), *const b = known(to);
  if (!a || !b || std::string(a->dimension) != b->dimension)
    return std::numeric_limits<double>::quiet_NaN();
  return a->si / b->si;
}

double quantity_at(const Result &result, const std::string &unit)
{
  for (const OperatingPoint::Value &operating_point : result.at_values)
    if (const double value = operating_point.value * factor_between(operating_point.unit, unit);
        !std::isnan(value))
      return value;
  return std::numeric_limits<double>::quiet_NaN();
}

Eigen::VectorXd values_of(const Table &table, const Column &column)
{
  for (std::size_t i = 0; i < table.names.size(); ++i)
    if (table.names[i] == column.name) {
      const double factor = factor_between(table.units[i], column.unit);
      return std::isnan(factor) ? Eigen::VectorXd() : Eigen::VectorXd(table.columns[i] * factor);
    }
  return {};
}

bool add_line(Plot &plot, const Table &table, const Column &x, const Column &y, const std::string &label,
              const Pen pen, const bool markers)
{
  const Eigen::VectorXd xs = values_of(table, x), ys = values_of(table, y);
  if (xs.size() == 0 || ys.size() != xs.size())
    return false;
  plot.lines.push_back({label, xs, ys, pen, markers});
  return true;
}

double interpolated(const Eigen::VectorXd &x, const Eigen::VectorXd &y, const double position)
{
  for (Eigen::Index i = 0; i + 1 < std::min(x.size(), y.size()); ++i)
    if (x[i] <= position && position <= x[i + 1]) {
      const double share =
          x[i] > 0 ? std::log(position / x[i]) / std::log(x[i + 1] / x[i]) : (position - x[i]) / (x[i + 1] - x[i]);
      return y[i] + share * (y[i + 1] - y[i]);
    }
  return std::numeric_limits<double>::quiet_NaN();
}

const Table *stored_curve(const Run &run, const CurveKind &kind, const std::string &item, const std::string &owner)
{
  return run.table(curve_path(kind, item, owner));
}

std::vector<StoredCurve> curves_in(const Run &run, const Figure figure, const std::string &family,
                                   const std::string &item)
{
  std::vector<StoredCurve> collected;
  for (const CurveKind *kind : curve::all)
    if (kind->figure == figure && kind->family == family)
      if (const Table *table = stored_curve(run, *kind, item))
        collected.push_back({kind, table});
  return collected;
}

std::vector<std::string> items_of(const Run &run, const CurveKind &kind)
{
  std::vector<std::string> items;
  for (const auto &[path, table] : run.tables)
    if (const auto name = curve_name(path); name && name->kind == &kind)
      items.push_back(name->item);
  std::sort(items.begin(), items.end(), std::greater<>());  // upper before lower, trb before crb: the load path
  return items;
}

namespace {
std::string in_words(std::string name)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// A column in the unit in which its largest value reads best.
struct ReadableColumn {
  Axis axis;
  Eigen::VectorXd value;
};

ReadableColumn readable(const Table &table, const std::size_t i)
{
  const Eigen::VectorXd &column = table.columns[i];
  const double largest          = column.array().isNaN().select(0, column.cwiseAbs()).maxCoeff();
  const Shown shown             = engineering(largest, table.units[i]);
  ReadableColumn out{{in_words(table.names[i]), shown.unit.empty() ? "-" : shown.unit}, column};
  if (largest > 0)
    out.value *= shown.value / largest;
  return out;
}
}  // namespace

std::vector<std::string> plain_drawings(const CurveKind &kind, const Table &table)
{
  std::vector<Plot> plots;
  std::vector<std::string> units;
  const ReadableColumn x = readable(table, 0);
  for (std::size_t i = 1; i < table.names.size(); ++i) {
    const auto known = std::find(units.begin(), units.end(), table.units[i]) - units.begin();
    ReadableColumn y = readable(table, i);
    if (std::size_t(known) == units.size()) {
      units.push_back(table.units[i]);
      plots.emplace_back();
      plots.back().title = kind.title;
      plots.back().x     = x.axis;
      plots.back().y     = y.axis;
    }
    Plot &plot = plots[std::size_t(known)];
    if (y.axis.unit != plot.y.unit)
      y.value *= factor_between(y.axis.unit, plot.y.unit);
    constexpr Pen pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::pale, Pen::dotted};
    plot.lines.push_back({y.axis.quantity, x.value, y.value, pens[plot.lines.size() % std::size(pens)]});
  }
  std::vector<std::string> drawings;
  for (const Plot &plot : plots)
    drawings.push_back(svg_plot(plot));
  return drawings;
}

void own_figures(Page &page, const Run &run, const std::string &family, const std::string &item)
{
  for (const auto &[kind, table] : curves_in(run, Figure::own, family, item))
    if (table->names.size() > 1 && table->columns[0].size() > 0) {
      std::string title = kind->title;
      title[0]          = char(std::toupper(static_cast<unsigned char>(title[0])));
      page.figure(plain_drawings(*kind, *table),
                  title + ", as stored in <code>" + curve_path(*kind, item) + ".csv</code>.");
    }
}
}  // namespace mill::report
