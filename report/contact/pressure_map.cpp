#include "report/contact/pressure_map.h"
#include "report/page/curves.h"
#include "report/plot/heat_map.h"
#include <algorithm>

namespace mill::report {
std::string pressure_map(const Table &table, const std::string &title, const std::string &along,
                         const double width, const double height)
{
  return patch_map(table, {"pressure", "pressure", "MPa"}, title, along, width, height);
}

std::string patch_map(const Table &table, const PatchQuantity &what, const std::string &title,
                      const std::string &along, const double width, const double height)
{
  const Eigen::VectorXd z = values_of(table, {"z", "mm"}), x = values_of(table, {"x", "mm"}),
                        p = values_of(table, {what.column, what.unit});
  Eigen::Index across     = 0;
  while (across < z.size() && z[across] == z[0])
    ++across;
  if (across == 0 || z.size() % across != 0 || x.size() != z.size() || p.size() != z.size())
    return "";
  HeatMap map;
  map.title               = title;
  map.x                   = {along, "mm"};
  map.y                   = {"distance from the contact line", "mm"};
  map.quantity            = what.quantity;
  map.unit                = what.unit;
  map.width               = width;
  map.height              = height;
  const Eigen::Index rows = z.size() / across;
  const auto pressure     = p.reshaped(across, rows);  // (across, along)
  // The surface outside of the patch is left out, except for a margin.
  Eigen::Index first = 0, end = across;
  while (first < across && !(pressure.row(first).maxCoeff() > 0))
    ++first;
  while (end > first && !(pressure.row(end - 1).maxCoeff() > 0))
    --end;
  first = std::max<Eigen::Index>(0, first - 2);
  end   = std::min(across, end + 2);
  map.at_x.resize(rows);
  for (Eigen::Index k = 0; k < rows; ++k)
    map.at_x[k] = z[k * across];
  map.at_y  = x.segment(first, end - first);
  map.value = pressure.middleRows(first, end - first).transpose();
  return heat_map(map);
}
}  // namespace mill::report
