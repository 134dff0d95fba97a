#include "reduce/chain/roll_profile.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
double table_at(const std::vector<std::array<double, 2>> &table, const double z)
{
  if (z <= table.front()[0])
    return table.front()[1];
  for (std::size_t i = 1; i < table.size(); ++i)
    if (z <= table[i][0]) {
      const double t = (z - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
      return table[i - 1][1] + t * (table[i][1] - table[i - 1][1]);
    }
  return table.back()[1];
}

// Diameter minus nominal.
double ground(const Roll &roll, const double z)
{
  const double s = 2 * z / roll.barrel_length;
  double d       = 0;
  if (!roll.crown_polynomial.empty())
    for (const auto &[power, coefficient] : roll.crown_polynomial)
      d += coefficient * std::pow(s, std::lround(power));
  else if (!roll.crown_table.empty())
    d = table_at(roll.crown_table, z) - table_at(roll.crown_table, 0);
  else
    d = -roll.crown * s * s;
  return d;
}

double thermal(const Roll &roll, const double z)
{
  if (!roll.thermal_crown_table.empty())
    return table_at(roll.thermal_crown_table, z) - table_at(roll.thermal_crown_table, 0);
  return -roll.thermal_crown * std::pow(2 * z / roll.barrel_length, 2);
}

double chamfer(const Roll &roll, const double z)
{
  if (roll.end_chamfer_length <= 0)
    return 0;
  const double inside = 0.5 * roll.barrel_length - std::abs(z);  // distance from the barrel end
  return roll.end_chamfer_depth * std::max(0., 1 - inside / roll.end_chamfer_length);
}
}  // namespace

double radius_drop(const Roll &roll, const double z)
{
  return -0.5 * (ground(roll, z) + thermal(roll, z)) + chamfer(roll, z);
}

bool is_one_sided(const Roll &roll)
{
  for (int i = 1; i <= 200; ++i) {
    const double z = 0.5 * roll.barrel_length * i / 200;
    if (std::abs(radius_drop(roll, z) - radius_drop(roll, -z)) > 1e-8)
      return true;
  }
  return false;
}

double crossing_gap(const double between, const double angle, const double offset, const double z)
{
  const double aside = offset + z * std::tan(angle);
  return aside * aside / (std::hypot(between, aside) + between);
}
}  // namespace mill::reduce
