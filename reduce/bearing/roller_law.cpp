#include "reduce/bearing/roller_law.h"
#include "core/base/errors.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_profile.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
using Eigen::VectorXd;

/// Slices and profile, no law yet.
RollerLaw sliced_roller(const RollerBearing &b)
{
  if (b.slices < 1)
    throw InputError("bearing." + b.name + ": slices must be at least 1");
  const int n = b.slices;
  RollerLaw law;
  law.slice_length = b.roller_length / n;
  law.position     = law.slice_length * VectorXd::LinSpaced(n, -(n - 1) / 2.0, (n - 1) / 2.0);
  law.drop         = 2 * profile_drop(b, law.position);  // once on each raceway
  return law;
}

/// (5.9) and (5.10) for both contacts, per line load, m/(N/m).
double plane_flexibility(const RollerBearing &b, const double line_load, const RingWalls &depth)
{
  const double load = line_load * b.roller_length;
  return (elastic_roller(b, load, depth.inner).approach + elastic_roller(b, load, depth.outer).approach) /
         (2 * line_load);  // each call takes both contacts at one depth, and depth enters by its logarithm
}

/// Newton inside a bracket: the load never falls with the approach.
double bracketed_approach(const RollerLaw &law, const double load)
{
  double low = 0, high = 1e-6;
  while (roller_load(law, high, 0).load < load) {
    low = high;
    high *= 2;
  }
  double d = high;
  for (int i = 0; i < 200; ++i) {
    const RollerLoad roller_state           = roller_load(law, d, 0);
    (roller_state.load > load ? high : low) = d;
    double next                             = d - (roller_state.load - load) / roller_state.stiffness;
    if (!(next >= low && next <= high))
      next = (low + high) / 2;
    if (std::abs(next - d) <= 1e-14 * high)
      return next;
    d = next;
  }
  return d;
}
}  // namespace

RollerLaw stiffened(RollerLaw law, const double factor)
{
  if (!(factor > 0))
    throw InputError("roller: the factor on the load must be positive");
  // With q' = factor q in (5.2) and (5.16) the approach stays.
  law.lamina_constant *= factor;
  law.influence /= factor;
  law.kappa /= factor;
  for (double *line_load : {&law.reference_line_load, &law.separate_line_load, &law.shared_line_load})
    *line_load *= factor;
  return law;
}

RingWalls ring_walls(const RollerBearing &b)
{
  const double D_pw = pitch_diameter(b);
  const RingWalls walls{(D_pw - b.roller_diameter - b.bore) / 2,
                        (b.outside_diameter - D_pw - b.roller_diameter) / 2};
  if (!(walls.inner > 0 && walls.outer > 0))
    throw InputError(
        "bearing." + b.name +
        ": the depth behind the raceways needs bore, outside_diameter and roller_diameter that leave a "
        "wall on both rings");
  return walls;
}

double roller_constant(const OneRollerLaw law, const double roller_length)
{
  const double l      = 1e3 * roller_length;             // both constants are stated in N and mm
  const double per_mm = std::pow(1e3, lamina_exponent);  // N/mm^(10/9) -> N/m^(10/9)
  switch (law) {
  case OneRollerLaw::iso:
    return 35948 * std::pow(l, 8.0 / 9) * per_mm;  // (5.3)
  case OneRollerLaw::palmgren:
    return std::pow(std::pow(l, 0.8) / (2 * 3.84e-5), lamina_exponent) * per_mm;  // (5.4)
  case OneRollerLaw::fe:
  case OneRollerLaw::elastic:
    break;
  }
  throw InputError(std::string("bearing: roller_law \"") + word_of(law) + "\" has no constant; iso or palmgren");
}

RollerLaw roller_law(const RollerBearing &b)
{
  if (b.roller_law == OneRollerLaw::fe)
    throw InputError("bearing." + b.name +
                     ": roller_law = \"fe\" is computed from a mesh; here iso, palmgren or elastic");
  if (b.roller_law == OneRollerLaw::elastic)
    return elastic_law(b, ring_walls(b));
  RollerLaw law       = sliced_roller(b);
  law.lamina_constant = roller_constant(b.roller_law, b.roller_length) / b.slices;
  return law;
}

RollerLaw elastic_law(const RollerBearing &b, const RingWalls &depth)
{
  RollerLaw law   = sliced_roller(b);
  const double nu = b.poisson_ratio;
  law.kappa       = 4 * (1 - nu * nu) / (M_PI * b.youngs_modulus);
  // Any reference gives the same law here, since (5.9) and (5.10) hold at every load; this one is a usual load.
  law.reference_line_load = 3e5;
  law.influence           = plane_flexibility(b, law.reference_line_load, depth) / law.slice_length *
                  Eigen::MatrixXd::Identity(b.slices, b.slices);
  return with_limits(law);
}

RollerLoad roller_load(const RollerLaw &law, const double approach, const double tilt)
{
  const auto n           = law.position.size();
  const VectorXd d       = (approach + std::tan(tilt) * law.position.array()).matrix();  // (5.5)
  const SliceLoads loads = slice_loads(law, d, VectorXd::Ones(n));
  return {loads.load.sum(), loads.slope.sum()};
}

double roller_approach(const RollerLaw &law, const double load)
{
  if (!(load > 0))
    throw InputError("roller: the load must be positive");
  if (law.lamina_constant == 0)
    return bracketed_approach(law, load);
  // Q(d) is convex and grows, so Newton from a point with Q >= load comes down to the root without leaving it.
  double d =
      law.drop.maxCoeff() + std::pow(load / (law.lamina_constant * double(law.drop.size())), 1 / lamina_exponent);
  for (int i = 0; i < 100; ++i) {
    const RollerLoad roller_state = roller_load(law, d, 0);
    const double step             = (roller_state.load - load) / roller_state.stiffness;
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
  const double q = load / b.roller_length, nu = b.poisson_ratio;
  const double E_plane  = b.youngs_modulus / (2 * (1 - nu * nu));
  const double A        = q * (1 - nu * nu) / (M_PI * b.youngs_modulus);
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
