#include "report/study/study_values.h"
#include "report/plot/number.h"
#include "report/twin/analysis/written_document.h"
#include <cmath>

namespace mill::report {
FloorUnit floor_unit(const nlohmann::json &result)
{
  const double base      = std::abs(number_in(result["base"]));
  const std::string unit = result["unit"];
  if (!(base > 0))
    return {1, unit_sign(unit)};
  const Shown shown = engineering(base, unit);
  return {shown.value / base, unit_sign(shown.unit)};
}

Axis axis_of_key(const nlohmann::json &key)
{
  const std::string unit = key["unit"];
  return {key["name"], unit.empty() ? "-" : unit_sign(unit)};
}

Axis axis_of_result(const nlohmann::json &result)
{
  const FloorUnit unit = floor_unit(result);
  return {result["name"], unit.sign.empty() ? "-" : unit.sign};
}
}  // namespace mill::report
