#include "report/pressure_map.h"
#include "report/curves.h"
#include "report/heat_map.h"

namespace mill::report {
std::string pressure_map(const Table &table, const std::string &title, const std::string &along,
                         const double width, const double height)
{
  const Eigen::VectorXd z = values_of(table, {"z", "mm"}), x = values_of(table, {"x", "mm"}),
                        p = values_of(table, {"pressure", "MPa"});
  Eigen::Index across     = 0;
  while (across < z.size() && z[across] == z[0])
    ++across;
  if (across == 0 || z.size() % across != 0 || x.size() != z.size() || p.size() != z.size())
    return "";
  HeatMap map;
  map.title               = title;
  map.x                   = {along, "mm"};
  map.y                   = {"distance from the contact line", "mm"};
  map.quantity            = "pressure";
  map.unit                = "MPa";
  map.width               = width;
  map.height              = height;
  const Eigen::Index rows = z.size() / across;
  map.at_x.resize(rows);
  map.value.resize(rows, across);
  for (Eigen::Index k = 0; k < rows; ++k) {
    map.at_x[k]      = z[k * across];
    map.value.row(k) = p.segment(k * across, across).transpose();
  }
  map.at_y = x.head(across);
  return heat_map(map);
}
}  // namespace mill::report
