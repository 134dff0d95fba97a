#include "reduce/bearing/oil_film/viscosity.h"
#include "core/base/errors.h"
#include <cmath>

namespace mill::bearing {
namespace {
// lg lg of the kinematic viscosity in mm2/s.
double walther(const double viscosity, const double density)
{
  const double kinematic = 1e6 * viscosity / density;
  require_input(kinematic > 0.4, "Walther's law needs kinematic viscosities above 0.4 mm2/s");
  return std::log10(std::log10(kinematic + 0.7));
}
}  // namespace

double oil_viscosity(const std::vector<std::array<double, 2>> &points, const double density,
                     const double temperature)
{
  require_input(points.size() == 1 || points.size() == 2,
                "the viscosity of an oil is given at one or two temperatures");
  if (points.size() == 1)
    return points[0][1];
  require_input(points[0][0] != points[1][0], "the two viscosities of an oil belong to two temperatures");
  require_input(temperature > 0, "the temperature of an oil is above absolute zero");
  const double first = walther(points[0][1], density), second = walther(points[1][1], density);
  const double share = std::log(temperature / points[0][0]) / std::log(points[1][0] / points[0][0]);
  return 1e-6 * density * (std::pow(10, std::pow(10, first + share * (second - first))) - 0.7);
}
}  // namespace mill::bearing
