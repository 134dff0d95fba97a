#include "bearing/roller_law.h"
#include "bearing/geometry.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
constexpr double exponent = 10.0 / 9;
// Bearing steel.  The empirical laws hold for it only, so it is a constant of this file and no input.
constexpr double E_steel = 206e9, nu_steel = 0.3;
constexpr double E_plane = E_steel / (2 * (1 - nu_steel * nu_steel));
// Contact pressure for which the "log" profile gives an even pressure along the roller.
constexpr double design_pressure = 2e9;

/// Radius of the roller against a raceway; the inner one is convex, the outer one concave.
double effective_radius(const RollerBearing &b, const bool inner)
{
  const double D_race = pitch_diameter(b) + (inner ? -b.roller_diameter : b.roller_diameter);
  return 1 / (2 / b.roller_diameter + (inner ? 2 : -2) / D_race);
}

/// Drop of one contact at distance x from the middle of the roller, m.
double iso_drop(const RollerBearing &b, const double x)
{
  const double D = b.roller_diameter, L = b.roller_length;
  const auto curve = [](double u) { return -std::log(1 - u * u); };
  if (b.type.find("tapered") != std::string::npos)
    return 0.00045 * D * curve(2 * x / L);  // (5.6a)
  if (L <= 2.5 * D)
    return 0.00035 * D * curve(2 * x / L);  // (5.6b)
  const double flat = L - 2.5 * D;          // long rollers: cylindrical in the middle, (5.6c)
  return 0.0005 * D * curve(std::max(0.0, 2 * std::abs(x) - flat) / (2.5 * D));
}

/// Johns-Gohar drop for the line load that gives the design pressure on the inner raceway, (5.7).
double log_drop(const RollerBearing &b, const double x)
{
  const double R = effective_radius(b, true), L = b.roller_length;
  const double q          = M_PI * R * design_pressure * design_pressure / E_plane;  // p0 = sqrt(q E'/(pi R))
  const double half_width = 2 * q / (M_PI * design_pressure);
  const double u          = 2 * x / L;
  return q / (M_PI * E_plane) * -std::log(1 - (1 - 0.3033 * 2 * half_width / L) * u * u);
}

double crown_drop(const RollerBearing &b, const double x)
{
  return b.crown_drop * std::pow(2 * x / b.roller_length, 2);  // (5.8): circle of large radius
}

double drop(const RollerBearing &b, const double x)
{
  if (b.profile == "none")
    return 0;
  if (b.profile == "crown") {
    if (!std::isfinite(b.crown_drop))
      throw InputError(
          "bearing." + b.name +
          ": profile = \"crown\" needs crown_drop, the drop at the roller end, for example \"20 um\"");
    return crown_drop(b, x);
  }
  if (b.profile != "iso" && b.profile != "log")
    throw InputError("bearing." + b.name + ": profile \"" + b.profile +
                     "\" is not known; none, iso, log or crown");
  if (!std::isfinite(b.roller_diameter))
    throw InputError("bearing." + b.name + ": profile = \"" + b.profile + "\" needs roller_diameter");
  if (b.profile == "log" && !std::isfinite(pitch_diameter(b)))
    throw InputError("bearing." + b.name +
                     ": profile = \"log\" needs pitch_diameter, or bore and outside_diameter");
  return b.profile == "iso" ? iso_drop(b, x) : log_drop(b, x);
}
}  // namespace

double roller_constant(const std::string &law, const double roller_length)
{
  const double l      = 1e3 * roller_length;      // both constants are stated in N and mm
  const double per_mm = std::pow(1e3, exponent);  // N/mm^(10/9) -> N/m^(10/9)
  if (law == "iso")
    return 35948 * std::pow(l, 8.0 / 9) * per_mm;  // (5.3)
  if (law == "palmgren")
    return std::pow(std::pow(l, 0.8) / (2 * 3.84e-5), exponent) * per_mm;  // (5.4)
  throw InputError("bearing: roller_law \"" + law + "\" is not known; iso or palmgren");
}

RollerLaw roller_law(const RollerBearing &b)
{
  if (b.slices < 1)
    throw InputError("bearing." + b.name + ": slices must be at least 1");
  const int n = b.slices;
  RollerLaw law;
  law.lamina_constant = roller_constant(b.roller_law, b.roller_length) / n;
  law.position.resize(n);
  law.drop.resize(n);
  for (int k = 0; k < n; ++k) {
    law.position[k] = ((k + 0.5) / n - 0.5) * b.roller_length;
    law.drop[k]     = 2 * drop(b, law.position[k]);  // once on each raceway
  }
  return law;
}

RollerLoad roller_load(const RollerLaw &law, const double approach, const double tilt)
{
  const double slope = std::tan(tilt);
  RollerLoad sum{0, 0};
  for (Eigen::Index k = 0; k < law.position.size(); ++k) {
    const double d = approach + law.position[k] * slope - law.drop[k];  // (5.5)
    if (d > 0) {
      const double q = law.lamina_constant * std::pow(d, exponent);
      sum.load += q;
      sum.stiffness += exponent * q / d;
    }
  }
  return sum;
}

double roller_approach(const RollerLaw &law, const double load)
{
  if (!(load > 0))
    throw InputError("roller: the load must be positive");
  // Q(d) is convex and grows, so Newton from a point with Q >= load comes down to the root without leaving it.
  double d = law.drop.maxCoeff() + std::pow(load / (law.lamina_constant * double(law.drop.size())), 1 / exponent);
  for (int i = 0; i < 100; ++i) {
    const RollerLoad at = roller_load(law, d, 0);
    const double step   = (at.load - load) / at.stiffness;
    d -= step;
    if (std::abs(step) <= 1e-15 * d)
      break;
  }
  return d;
}

ElasticRoller elastic_roller(const RollerBearing &b, const double load, const double depth)
{
  const double D = b.roller_diameter;
  if (!(load > 0 && depth > 0 && D > 0 && pitch_diameter(b) > 0))
    throw InputError("bearing." + b.name +
                     ": the elastic check needs a load, a raceway depth, roller_diameter and a pitch diameter");
  const double q = load / b.roller_length, nu = nu_steel;
  const double A        = q * (1 - nu * nu) / (M_PI * E_steel);
  const auto half_width = [&](bool inner) {
    return std::sqrt(4 * q * effective_radius(b, inner) / (M_PI * E_plane));
  };
  const auto roller  = [&](double w) { return A * (2 * std::log(2 * D / w) - 1); };                  // (5.9)
  const auto raceway = [&](double w) { return A * (2 * std::log(2 * depth / w) - nu / (1 - nu)); };  // (5.10)
  const double bi = half_width(true), bo = half_width(false);
  const double inside = roller(bi) + roller(bo);
  return {inside + raceway(bi) + raceway(bo), inside, bi, bo, 2 * q / (M_PI * bi), 2 * q / (M_PI * bo)};
}
}  // namespace mill::bearing
