#include "core/model/ground_profile.h"
#include <algorithm>
#include <cmath>

namespace mill {
double logarithmic_drop(const double line_load, const double half_width, const double modulus, const double length,
                        const double rounding, const double x)
{
  const double u = 2 * x / length;
  return line_load / (M_PI * modulus) * -std::log(1 - (1 - rounding * 2 * half_width / length) * u * u);
}

double table_drop(const std::vector<std::array<double, 2>> &table, const double x)
{
  const double distance = table.front()[0] >= 0 ? std::abs(x) : x;
  const auto next =
      std::upper_bound(table.begin(), table.end(), distance,
                       [](double value, const std::array<double, 2> &row) { return value < row[0]; });
  if (next == table.begin())
    return table.front()[1];  // a table from x > 0: level up to its first point
  if (next == table.end())
    return table.back()[1];
  const auto &low = *(next - 1);
  const double s  = (distance - low[0]) / ((*next)[0] - low[0]);
  return (1 - s) * low[1] + s * (*next)[1];
}
}  // namespace mill
