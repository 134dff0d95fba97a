#pragma once
#include <array>
#include <vector>

namespace mill::bearing {
/// Dynamic viscosity, Pa s, at a temperature, K: Walther's law through two points of the kinematic viscosity,
///   lg lg(nu / (mm2/s) + 0.7) = A - B lg(T/K)
/// or the one value that is given.  theory.md (29.11); source: ASTM D341.
/// @param points   (K, Pa s), one or two
/// @param density  kg/m3
/// @throws InputError  another number of points, temperatures that are equal, a viscosity below 0.4 mm2/s
double oil_viscosity(const std::vector<std::array<double, 2>> &points, double density, double temperature);
}  // namespace mill::bearing
