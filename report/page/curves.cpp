#include "report/page/curves.h"
#include "report/page/number.h"
#include <charconv>
#include <cmath>
#include <system_error>

namespace mill::report {
namespace {
struct KnownUnit {
  const char *name;
  const char *dimension;
  double si;
};
const KnownUnit known_units[] = {
    {"-",           "number",         1               },
    {"%",           "number",         0.01            },
    {"s",           "time",           1               },
    {"ms",          "time",           1e-3            },
    {"Hz",          "frequency",      1               },
    {"N",           "force",          1               },
    {"kN",          "force",          1e3             },
    {"MN",          "force",          1e6             },
    {"m",           "length",         1               },
    {"mm",          "length",         1e-3            },
    {"\u00b5m",     "length",         1e-6            },
    {"Pa",          "pressure",       1               },
    {"MPa",         "pressure",       1e6             },
    {"N/m",         "stiffness",      1               },
    {"kN/mm",       "stiffness",      1e6             },
    {"N/mm",        "stiffness",      1e3             },
    {"N/m\u00b2",   "bedding",        1               },
    {"kN/mm per m", "bedding",        1e6             },
    {"m/N",         "flexibility",    1               },
    {"\u00b5m/MN",  "flexibility",    1e-12           },
    {"rad",         "angle",          1               },
    {"mrad",        "angle",          1e-3            },
    {"\u00b0",      "angle",          EIGEN_PI / 180  },
    {"N m",         "moment",         1               },
    {"kN m",        "moment",         1e3             },
    {"1/s",         "rate",           1               },
    {"N s/m",       "damper",         1               },
    {"kN s/m",      "damper",         1e3             },
    {"MN s/m",      "damper",         1e6             },
    {"Pa s",        "viscosity",      1               },
    {"mPa s",       "viscosity",      1e-3            },
    {"m/s",         "speed",          1               },
    {"m/s\u00b2",   "acceleration",   1               },
    {"g",           "acceleration",   standard_gravity},
    {"N/\u221aHz",  "force density",  1               },
    {"kN/\u221aHz", "force density",  1e3             },
    {"g/\u221aHz",  "accel. density", standard_gravity},
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

double quantity_in_text(const std::string &text, const std::string &unit)
{
  double value   = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc())
    return std::numeric_limits<double>::quiet_NaN();
  std::string written(end.ptr, text.data() + text.size());
  written.erase(0, written.find_first_not_of(' '));
  return value * factor_between(written.substr(0, written.find_first_of(" ,;")), unit);
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

double interpolated(const Eigen::VectorXd &x, const Eigen::VectorXd &y, const double at)
{
  for (Eigen::Index i = 0; i + 1 < std::min(x.size(), y.size()); ++i)
    if (x[i] <= at && at <= x[i + 1]) {
      const double share =
          x[i] > 0 ? std::log(at / x[i]) / std::log(x[i + 1] / x[i]) : (at - x[i]) / (x[i + 1] - x[i]);
      return y[i] + share * (y[i + 1] - y[i]);
    }
  return std::numeric_limits<double>::quiet_NaN();
}
}  // namespace mill::report
