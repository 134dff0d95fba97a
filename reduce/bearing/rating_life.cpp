#include "reduce/bearing/rating_life.h"
#include "core/base/errors.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_profile.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::bearing {
namespace {
using Eigen::Index;

constexpr double roller_density = 7850;  // kg/m3, bearing steel
constexpr double lambda_nu      = 0.83;  // line contacts that are not loaded evenly; ISO/TS 16281

bool carries_both_ways(const RollerBearing &b)
{
  return b.rows > 1 && b.arrangement.find('+') != std::string::npos &&
         b.arrangement.find('-') != std::string::npos;
}

// (60) of ISO/TS 16281: what the end of a contact adds to the load of slice k of n.
double edge(const Index k, const Index n)
{
  const double x = std::abs(double(2 * (k + 1) - n - 1)) / (2. * n - 2);
  return n < 2 || x == 0 ? 1 : 1 - 0.01 / std::log(1.985 * x);
}

// Its mean over 64 parts of the slice, with the exponent of the damage.
double edge_of_thin_slices(const Index k, const Index n)
{
  constexpr Index parts = 64;
  double sum            = 0;
  for (Index i = 0; i < parts; ++i)
    sum += std::pow(edge(k * parts + i, n * parts), 4.5);
  return std::pow(sum / parts, 1 / 4.5);
}

double end_factor(const EndFactor ends, const Index k, const Index n)
{
  switch (ends) {
  case EndFactor::none:
    return 1;
  case EndFactor::standard:
    return edge(k, n);
  case EndFactor::thin_slices:
    return edge_of_thin_slices(k, n);
  }
  return 1;
}

struct SliceRatings {
  double inner, outer;  // N, that a slice bears for 1e6 revolutions
};

// (5.35)
SliceRatings slice_ratings(const RollerBearing &b, const double C, const Index slices)
{
  const double ca = std::cos(b.cup_angle), g = b.roller_diameter * ca / pitch_diameter(b);
  const double A    = std::pow(1.038 * std::pow((1 - g) / (1 + g), 143.0 / 108), 4.5);
  const double even = C / (lambda_nu * b.rollers_per_row * ca * std::pow(b.rows, 7.0 / 9));
  const double part = std::pow(1.0 / double(slices), 7.0 / 9);
  return {part * even / 0.378 * std::pow(1 + A, 2.0 / 9), part * even / 0.364 * std::pow(1 + 1 / A, 2.0 / 9)};
}

// Power mean over the rollers of a row of one slice's load.
double mean_load(const Eigen::ArrayXd &q, const double exponent)
{
  const double largest = q.maxCoeff();
  return largest > 0 ? largest * std::pow((q / largest).pow(exponent).mean(), 1 / exponent) : 0;
}
}  // namespace

EquivalentLoads equivalent_loads(const RollerBearing &b, const double radial, const double axial)
{
  const double Fr = std::abs(radial), Fa = std::abs(axial);
  if (!(b.cup_angle > 0))
    return {Fr, Fr};
  const double cot = 1 / std::tan(b.cup_angle), e = 1.5 * std::tan(b.cup_angle);
  const bool small = Fa <= e * Fr;
  if (carries_both_ways(b))
    return {small ? Fr + 0.45 * cot * Fa : 0.67 * Fr + 0.67 * cot * Fa, Fr + 0.44 * cot * Fa};
  return {small ? Fr : 0.4 * Fr + 0.4 * cot * Fa, std::max(Fr, 0.5 * Fr + 0.22 * cot * Fa)};
}

double basic_life(const double C, const double P)
{
  return P > 0 ? 1e6 * std::pow(C / P, 10.0 / 3) : std::numeric_limits<double>::infinity();
}

ReferenceLife reference_life(const RollerBearing &b, const AssemblyState &state, const double C,
                             const EndFactor ends)
{
  if (!(b.roller_diameter > 0 && pitch_diameter(b) > 0))
    throw InputError("bearing." + b.name + ": the life by slices needs roller_diameter and a pitch diameter");
  const Index n = state.slice_load.rows(), Z = state.roller_load.cols(), rows = state.roller_load.rows();
  const SliceRatings rating = slice_ratings(b, C, n);
  Eigen::ArrayXd damage     = Eigen::ArrayXd::Zero(rows);
  for (Index r = 0; r < rows; ++r)
    for (Index k = 0; k < n; ++k) {
      Eigen::ArrayXd outer = end_factor(ends, k, n) * state.slice_load.row(k).segment(r * Z, Z).array();
      Eigen::ArrayXd inner = outer;
      for (Index j = 0; j < Z; ++j)
        inner[j] *= state.roller_load(r, j) > 0 ? state.inner_load(r, j) / state.roller_load(r, j) : 0;
      damage[r] += std::pow(mean_load(inner, 4) / rating.inner, 4.5) +  // turns under the load
                   std::pow(mean_load(outer, 4.5) / rating.outer, 4.5);
    }
  const auto life = [](const double sum) {  // (5.37)
    return sum > 0 ? 1e6 * std::pow(sum, -8.0 / 9) : std::numeric_limits<double>::infinity();
  };
  ReferenceLife out{life(damage.sum()), 0, Eigen::VectorXd(rows)};
  for (Index r = 0; r < rows; ++r)
    out.row_life[r] = life(damage[r]);
  out.equivalent_load = C * std::pow(out.life / 1e6, -0.3);
  return out;
}

double fatigue_load_limit(const double C0, const double D_pw)
{
  return C0 / 8.2 * (D_pw > 0.1 ? std::pow(0.1 / D_pw, 0.3) : 1);
}

double life_factor(const double viscosity_ratio, const double contamination, const double load_ratio)
{
  const double kappa = std::clamp(viscosity_ratio, 0.1, 4.0);
  const double film  = kappa < 0.4 ? 1.3993 / std::pow(kappa, 0.054381)
                       : kappa < 1 ? 1.2348 / std::pow(kappa, 0.19087)
                                   : 1.2348 / std::pow(kappa, 0.071739);
  const double rest  = 1 - (1.5859 - film) * std::pow(std::max(0.0, contamination * load_ratio), 0.4);
  return rest > 0 ? std::clamp(0.1 * std::pow(rest, -9.185), 0.1, 50.0) : 50;
}

double radial_load_of_pressure(const RollerBearing &b, const double pressure)
{
  const double modulus  = b.youngs_modulus / (2 * (1 - b.poisson_ratio * b.poisson_ratio));
  const double heaviest = M_PI * effective_radius(b, true) * pressure * pressure / modulus * b.roller_length;
  return heaviest * b.rows * b.rollers_per_row * std::cos(b.cup_angle) / 5;
}

double cage_speed(const RollerBearing &b, const double shaft_speed)
{
  return shaft_speed / 2 * (1 - b.roller_diameter * std::cos(b.cup_angle) / pitch_diameter(b));
}

double centrifugal_force(const RollerBearing &b, const double shaft_speed)
{
  const double length = std::isfinite(b.roller_total_length) ? b.roller_total_length : b.roller_length;
  const double mass   = roller_density * M_PI / 4 * b.roller_diameter * b.roller_diameter * length;
  const double omega  = 2 * M_PI * cage_speed(b, shaft_speed);
  const double force  = mass * pitch_diameter(b) / 2 * omega * omega;
  return std::isfinite(force) ? force : 0;
}
}  // namespace mill::bearing
