#include "tests/manual/bite/slab_models.h"
#include "core/base/errors.h"
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"
#include "reduce/bite/slab/slab_bite.h"
#include <cmath>

namespace mill::verify {
using namespace bite;

RollBite demo_bite()
{
  return plain_bite(210, 8, 5, 28, 0.2);
}

RollBite plain_bite(const double R, const double h1, const double h2, const double k, const double mu)
{
  RollBite b;
  b.roll_radius                = R * 1e-3;
  b.roll                       = {2.1e11, 0.28, 7700};
  b.strip.width                = 1;
  b.strip.entry_thickness      = h1 * 1e-3;
  b.strip.exit_thickness       = h2 * 1e-3;
  b.strip.flow_stress.k        = k * 1e6;
  b.strip.friction.coefficient = mu;
  return b;
}

RollBite film_bite(const int condition, const double roll_speed)
{
  const double table[3][5] = {
      {0.755, 0.568, 156, 197, 1.206}, {0.789, 0.577, 180, 189, 1.206}, {0.705, 0.506, 185, 175, 1.020}};
  const double *row         = table[condition - 1];
  RollBite b                = plain_bite(300, row[0], row[1], 84.6 * 9.80665, 0);
  b.roll                    = {2.1e11, 0.3, 7850};
  b.roll_speed              = roll_speed;
  b.strip.width             = row[4];
  b.strip.entry_tension     = row[2] * 1e6;
  b.strip.exit_tension      = row[3] * 1e6;
  b.strip.initial_thickness = 3e-3;
  b.strip.flow_stress.law   = FlowStressLaw::reduction_power;
  b.strip.flow_stress.eps0  = 0.00817;
  b.strip.flow_stress.n     = 0.3;
  Friction &film            = b.strip.friction;
  film.law                  = FrictionLaw::film;
  film.mu0                  = 0.012;
  film.mu1                  = 0.142;
  film.decay                = 2.43e6;
  film.viscosity            = 0.005;
  film.pressure_viscosity   = 2e-8;
  return b;
}

BiteState solved(const RollBite &bite, const Arc arc)
{
  return solve_slab(bite, {Theory::bland_ford, arc});
}

std::vector<Working> working_conditions()
{
  const RollBite one = film_bite(1, 18.9), two = film_bite(2, 18.2);
  return {{"condition 1: ", one, solved(one)}, {"condition 2: ", two, solved(two)}};
}

RollBite cluster_bite(const int pass, const double flow_stress, const double mu)
{
  const double table[5][4] = {{0.260, 0.180, 38, 35},
                              {0.180, 0.145, 31, 34},
                              {0.145, 0.120, 31, 28},
                              {0.120, 0.105, 23, 25},
                              {0.105, 0.095, 22, 20}};
  const double *row        = table[pass - 1];
  RollBite b               = plain_bite(34.8, row[0], row[1], flow_stress * 1e-6, mu);
  b.roll                   = {2.1e11, 0.3, 7850};
  b.strip.width            = 0.505;
  b.strip.entry_tension    = row[2] * 1e3 / (0.505 * row[0] * 1e-3);
  b.strip.exit_tension     = row[3] * 1e3 / (0.505 * row[1] * 1e-3);
  return b;
}

double cluster_friction(const int pass)
{
  const double v[5] = {178, 235, 248, 265, 500};  // m/min
  return 0.066723 - 0.00662 * std::log(v[pass - 1] / 60);
}

double cluster_force(const int pass)
{
  const double kN[5] = {1148, 1878, 1507, 1459, 1302};
  return kN[pass - 1] * 1e3;
}

SlabIntegral integrate_slab(const RollBite &bite, const double R, const double mu, const bool full)
{
  constexpr int n  = 4000;  // fourth order: 1e-12 at exponents of a few
  const Strip &s   = bite.strip;
  const double h0  = std::isnan(s.initial_thickness) ? s.entry_thickness : s.initial_thickness;
  const double x_e = std::sqrt(R * (s.entry_thickness - s.exit_thickness));
  const auto yield = [&](const double h) {
    return flow_stress(s.flow_stress, std::log(h0) - log(Dual<1>::variable(h, 0)));
  };
  const auto slope = [&](const double x, const double p, const double side) {
    const double h = s.exit_thickness + x * x / R, dh = 2 * x / R;
    const Dual<1> k = yield(h);
    return full ? (dh * k.value + h * dh * k.by[0] + side * 2 * mu * p) / h
                : p * (dh + side * 2 * mu) / h + p / k.value * dh * k.by[0];
  };
  struct End {
    double pressure, force;
  };
  // Side +1 from the exit, -1 from the entry (friction reverses).
  const auto branch = [&](const double from, double p, const double to, const double side) {
    const double d = (to - from) / n;
    double force   = 0;
    for (int i = 0; i < n; ++i) {
      const double x  = from + i * d;
      const double k1 = slope(x, p, side), k2 = slope(x + d / 2, p + d / 2 * k1, side),
                   k3 = slope(x + d / 2, p + d / 2 * k2, side), k4 = slope(x + d, p + d * k3, side);
      const double next   = p + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      const double middle = (p + next) / 2 + d / 8 * (k1 - slope(x + d, next, side));  // cubic Hermite
      force += std::abs(d) / 6 * (p + 4 * middle + next);                              // Simpson
      p = next;
    }
    return End{p, force};
  };
  const double p_exit  = yield(s.exit_thickness).value - s.exit_tension;
  const double p_entry = yield(s.entry_thickness).value - s.entry_tension;
  double x             = 0.4 * x_e;
  End behind{}, before{};
  for (int i = 0; i < 20; ++i) {  // Newton for equal pressures; both slopes are those of the equation
    behind = branch(0, p_exit, x, 1);
    before = branch(x_e, p_entry, x, -1);
    const double step =
        (before.pressure - behind.pressure) / (slope(x, behind.pressure, 1) - slope(x, before.pressure, -1));
    x += step;
    if (std::abs(step) < 1e-13 * x_e)
      break;
  }
  return {s.width * (behind.force + before.force), x};
}

double rising_root(double low, double high, const double target, const std::function<double(double)> &function)
{
  for (int i = 0; i < 60; ++i) {
    const double x                      = 0.5 * (low + high);
    (function(x) < target ? low : high) = x;
  }
  return 0.5 * (low + high);
}

double force_or_limit(const RollBite &bite, const Arc arc)
{
  const Theory theory = slides(bite.strip.friction) ? Theory::bland_ford : Theory::hu_ehmann;
  try {
    return solve_slab(bite, {theory, arc, 0}).force;
  } catch (const SolverError &) {
    return INFINITY;
  } catch (const InputError &) {
    return 0;
  }
}

const char *const film_source =
    "X. Liu, Y. Zang, Z. Gao, L. Zeng, J. Vibroengineering 19 (2017); values by an independent "
    "program, entries ";
const char *const film_passes =
    "Cold strip under an oil film between flattened rolls: 0.755 -> 0.568 mm at 18.9 m/s "
    "(condition 1), 0.789 -> 0.577 mm at 18.2 m/s (condition 2). ";
}  // namespace mill::verify
