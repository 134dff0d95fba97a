#include "dynamics/bite.h"
#include "core/gauss.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <sstream>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

constexpr int n_gauss               = 48;  // per zone; 8 already reach rounding for a smooth flow stress
constexpr double largest_flattening = 20;  // R'/R; Hitchcock's ellipse has lost its meaning long before
constexpr double flattening_range   = 5;   // R'/R up to which the formula is used in practice

double real(const double value)
{
  return value;
}

double real(const Complex &value)
{
  return value.real();
}

template <class... Parts> std::string sentence(const Parts &...parts)
{
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

template <class T> T table_stress(const FlowStress &law, const T &strain)
{
  const auto &rows = law.table;
  if (rows.size() < 2)
    throw InputError("strip.flow_stress: a table needs at least two rows of strain and stress");
  const double e = real(strain), tolerance = 1e-12 * (1 + std::abs(e));  // ln(h0/h) at an end is rounded
  if (!(e >= rows.front()[0] - tolerance && e <= rows.back()[0] + tolerance))
    throw InputError(sentence("strip.flow_stress: the table covers strains ", rows.front()[0], " .. ",
                              rows.back()[0], " but the bite needs ", e, "; it is not extrapolated"));
  std::size_t i = 1;
  while (i + 1 < rows.size() && e > rows[i][0])
    ++i;
  if (!(rows[i][0] > rows[i - 1][0]))
    throw InputError("strip.flow_stress: the strains of the table must increase");
  return rows[i - 1][1] +
         (strain - rows[i - 1][0]) * ((rows[i][1] - rows[i - 1][1]) / (rows[i][0] - rows[i - 1][0]));
}

/// (8.1)
template <class T> T flow_stress_of(const FlowStress &law, const T &strain)
{
  using std::exp;
  using std::pow;
  if (law.law == "constant")
    return T(law.k);
  if (law.law == "swift")
    return law.k * pow(law.eps0 + strain, law.n);
  if (law.law == "ludwik")
    return law.k0 + law.k * pow(strain, law.n);
  if (law.law == "voce")
    return law.k0 + law.k * (1.0 - exp(-law.n * strain));
  if (law.law == "power")
    return law.k * pow(strain, law.n);
  if (law.law == "reduction-power")
    return law.k * pow(law.eps0 + 1.0 - exp(-strain), law.n);
  if (law.law == "table")
    return table_stress(law, strain);
  throw InputError("strip.flow_stress.law = \"" + law.law +
                   "\" is not known; constant, swift, ludwik, voce, power, reduction-power or table");
}

/// What is fixed while exit thickness and radius vary.
struct Slab {
  const Strip &strip;
  double initial_thickness;  ///< m, reference of the strain
  double entry_stress;       ///< Pa, k_fe
  double entry_factor;       ///< -, 1 - sigma_e / k_fe
};

template <class T> T stress_at(const Slab &slab, const T &thickness)
{
  using std::log;
  const T strain = log(slab.initial_thickness / thickness);
  return flow_stress_of(slab.strip.flow_stress, real(strain) < 0 ? T(0) : strain);  // rounding at the entry
}

/// 1 - tension / flow stress; without tension it is one even where an unhardened strip has no flow stress at all.
template <class T> T tension_factor(const double tension, const T &stress)
{
  return tension == 0 ? T(1) : T(1.0 - tension / stress);
}

/// The bite in the angle t of  x = sqrt(R h_d) tan t,  in which h = h_d / cos^2 t and H = 2 sqrt(R/h_d) t, (8.3).
/// T is double, or Complex with the derivative in its imaginary part.
template <class T> struct Arc {
  T exit_thickness, radius;
  T entry_angle;              ///< t_e
  T neutral_angle;            ///< t_n, between 0 and t_e
  T exit_factor;              ///< 1 - sigma_d / k_fd
  double free_neutral_angle;  ///< t_n before it is kept inside the arc: tells that there is no neutral point
  double balance;             ///< ln of the ratio of both pressure branches' ends, Lambda of (8.7)
};

template <class T> Arc<T> arc(const Slab &slab, const T &exit_thickness, const T &radius)
{
  using std::atan;
  using std::log;
  using std::sqrt;
  const double entry_thickness = slab.strip.entry_thickness;
  Arc<T> a;
  a.exit_thickness = exit_thickness;
  a.radius         = radius;
  a.entry_angle    = atan(sqrt((entry_thickness - exit_thickness) / exit_thickness));  // (8.2) in t
  a.exit_factor    = tension_factor(slab.strip.exit_tension, stress_at(slab, exit_thickness));
  const T balance  = log(a.exit_factor / slab.entry_factor * entry_thickness / exit_thickness);  // (8.7)
  a.neutral_angle  = 0.5 * a.entry_angle - sqrt(exit_thickness / radius) * balance / (4.0 * slab.strip.friction);
  a.balance        = real(balance);
  a.free_neutral_angle = real(a.neutral_angle);
  if (a.free_neutral_angle <= 0)
    a.neutral_angle = T(0);
  if (a.free_neutral_angle >= real(a.entry_angle))
    a.neutral_angle = a.entry_angle;
  return a;
}

template <class T> T thickness_at(const Arc<T> &a, const T &angle)
{
  using std::cos;
  return a.exit_thickness / (cos(angle) * cos(angle));
}

/// (8.5) on the entry side, (8.6) on the exit side
template <class T> T pressure_at(const Slab &slab, const Arc<T> &a, const T &angle, const bool entry_side)
{
  using std::exp;
  using std::sqrt;
  const T h         = thickness_at(a, angle);
  const T per_angle = 2.0 * slab.strip.friction * sqrt(a.radius / a.exit_thickness);  // mu dH/dt
  if (entry_side)
    return slab.entry_factor * stress_at(slab, h) * h / slab.strip.entry_thickness *
           exp(per_angle * (a.entry_angle - angle));
  return a.exit_factor * stress_at(slab, h) * h / a.exit_thickness * exp(per_angle * angle);
}

/// Angles at which the flow stress of a table has a kink; the quadrature must not run across one.
template <class T> std::vector<T> kinks(const Slab &slab, const Arc<T> &a, const T &from, const T &to)
{
  using std::atan;
  using std::sqrt;
  std::vector<T> angles{from};
  if (slab.strip.flow_stress.law == "table")
    for (auto row = slab.strip.flow_stress.table.rbegin(); row != slab.strip.flow_stress.table.rend(); ++row) {
      const double h = slab.initial_thickness * std::exp(-(*row)[0]);
      if (h <= real(a.exit_thickness))
        continue;
      const T angle = atan(sqrt(h / a.exit_thickness - 1.0));
      if (real(angle) > real(from) && real(angle) < real(to))
        angles.push_back(angle);
    }
  angles.push_back(to);
  return angles;
}

/// Force over the strip width, (8.8).
template <class T> T force(const Slab &slab, const Arc<T> &a)
{
  using std::cos;
  using std::sqrt;
  static const GaussRule rule = gauss_legendre(n_gauss);
  T sum(0);
  for (const bool entry_side : {false, true}) {
    const T from = entry_side ? a.neutral_angle : T(0), to = entry_side ? a.entry_angle : a.neutral_angle;
    const std::vector<T> panels = kinks(slab, a, from, to);
    for (std::size_t p = 1; p < panels.size(); ++p) {
      const T middle = 0.5 * (panels[p - 1] + panels[p]), half = 0.5 * (panels[p] - panels[p - 1]);
      for (int i = 0; i < n_gauss; ++i) {
        const T angle = middle + half * rule.node[i];
        sum += rule.weight[i] * half * pressure_at(slab, a, angle, entry_side) / (cos(angle) * cos(angle));
      }
    }
  }
  return slab.strip.width * sqrt(a.radius * a.exit_thickness) * sum;
}

template <class T> T force(const Slab &slab, const T &exit_thickness, const T &radius)
{
  return force(slab, arc(slab, exit_thickness, radius));
}

Slab checked_slab(const RollBite &bite)
{
  const Strip &s = bite.strip;
  if (!(s.exit_thickness > 0 && s.entry_thickness > s.exit_thickness))
    throw InputError(sentence("strip.exit_thickness = ", s.exit_thickness * 1e3,
                              " mm must be positive and below strip.entry_thickness = ", s.entry_thickness * 1e3,
                              " mm"));
  if (!(s.width > 0 && bite.roll_radius > 0))
    throw InputError("strip.width and the work roll diameter must be positive");
  if (!(s.friction > 0))
    throw InputError("strip.friction must be positive: without friction the rolls do not pull the strip through");
  const double h0 = std::isnan(s.initial_thickness) ? s.entry_thickness : s.initial_thickness;
  if (!(h0 >= s.entry_thickness))
    throw InputError(sentence("strip.initial_thickness = ", h0 * 1e3, " mm is below strip.entry_thickness = ",
                              s.entry_thickness * 1e3, " mm: the strip would have been rolled thicker"));
  Slab slab{s, h0, 0, 1};
  slab.entry_stress        = stress_at(slab, s.entry_thickness);
  const double exit_stress = stress_at(slab, s.exit_thickness);
  if (!(slab.entry_stress >= 0 && exit_stress > 0))
    throw InputError(sentence("strip.flow_stress gives ", slab.entry_stress / 1e6, " MPa at the entry and ",
                              exit_stress / 1e6, " MPa at the exit; it must be positive over the bite"));
  if (!(s.entry_tension < slab.entry_stress || s.entry_tension == 0))
    throw InputError(sentence("strip.entry_tension = ", s.entry_tension / 1e6, " MPa reaches the flow stress ",
                              slab.entry_stress / 1e6, " MPa at the entry: the strip yields before the bite"));
  if (!(s.exit_tension < exit_stress))
    throw InputError(sentence("strip.exit_tension = ", s.exit_tension / 1e6, " MPa reaches the flow stress ",
                              exit_stress / 1e6, " MPa at the exit: the strip yields behind the bite"));
  slab.entry_factor = tension_factor(s.entry_tension, slab.entry_stress);
  return slab;
}

/// There must be a point inside the arc at which strip and roll run equally fast.
void require_neutral_point(const Slab &slab, const Arc<double> &a)
{
  if (a.free_neutral_angle > 0 && a.free_neutral_angle < a.entry_angle)
    return;
  const double H_entry   = 2 * std::sqrt(a.radius / a.exit_thickness) * a.entry_angle;  // H of (8.3) at the entry
  const double needed    = std::abs(a.balance) / H_entry;
  const double angle     = std::sqrt((slab.strip.entry_thickness - a.exit_thickness) / a.radius);
  const bool beyond_exit = a.free_neutral_angle <= 0;
  throw InputError(sentence(
      "strip.friction = ", slab.strip.friction, " is too small for an angle of bite of ", angle, " rad",
      beyond_exit
          ? ": the rolls cannot pull the strip through, the neutral point would lie beyond the exit"
          : " and this front tension: the strip is torn through, the neutral point would lie before the entry",
      "; more than ", needed, " is needed, or ",
      beyond_exit ? "a smaller reduction, more front tension or less back tension" : "less front tension"));
}

std::vector<std::string> range_notes(const BiteState &state, const RollBite &bite)
{
  std::vector<std::string> notes;
  const double ratio = state.flattened_radius / bite.roll_radius;
  if (state.bite_angle > bite.strip.friction)
    notes.push_back(sentence("the angle of bite ", state.bite_angle, " rad is larger than the friction ",
                             bite.strip.friction,
                             ": the pass runs, but the strip has to be pushed in at its head"));
  if (state.largest_shear > 1)
    notes.push_back(
        sentence("the friction stress reaches ", state.largest_shear,
                 " times the shear yield stress: the strip would stick, which Coulomb friction does not know"));
  if (ratio > flattening_range)
    notes.push_back(sentence("R'/R = ", ratio, " is beyond ", flattening_range,
                             ", where Hitchcock's circular arc no longer holds"));
  return notes;
}

/// R' over force: R' = R (1 + compliance F / (h_e - h_d)), (8.9).  In m/N.
double flattening_compliance(const RollBite &bite)
{
  const Material &m = bite.roll;
  return 16 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus * bite.strip.width);
}

/// Smallest R' with R' = Phi(R').  Phi grows with R' and Phi(R) > R, so plain iteration from R climbs to the first
/// root and cannot jump over it; where it does not come to rest there is none.
double flattened_radius(const RollBite &bite, const Slab &slab, int &iterations)
{
  const double h = bite.strip.exit_thickness, reduction = bite.strip.entry_thickness - h;
  double R = bite.roll_radius;
  for (iterations = 1; iterations <= 2000; ++iterations) {
    const double next = bite.roll_radius * (1 + flattening_compliance(bite) * force(slab, h, R) / reduction);
    if (!(next <= largest_flattening * bite.roll_radius))
      break;
    const bool rests = std::abs(next - R) <= 1e-14 * next;
    R                = next;
    if (rests)
      return R;
  }
  throw SolverError(
      {"roll bite: no flattened radius",
       sentence("R'/R = ", R / bite.roll_radius, " and still growing after ", iterations, " steps, force there ",
                force(slab, h, R) / 1e3, " kN"),
       sentence("the strip is too thin or too hard for this roll: the arc flattens faster than the gap closes "
                "(exit thickness ",
                h * 1e3, " mm, friction ", bite.strip.friction, ")"),
       "a smaller work roll, less friction, more tension, or a thicker strip.exit_thickness", ""});
}

/// Pressure hill: 101 points on each side of the neutral point, which belongs to both.
void sample_pressure(BiteState &state, const Slab &slab, const Arc<double> &a)
{
  constexpr int n = 101;
  state.position.resize(2 * n - 1);
  state.thickness.resize(2 * n - 1);
  state.pressure.resize(2 * n - 1);
  for (int i = 0; i < 2 * n - 1; ++i) {
    const bool entry_side = i >= n;
    const double x =
        entry_side ? state.neutral_position + (state.arc_length - state.neutral_position) * (i - n + 1) / (n - 1)
                   : state.neutral_position * i / (n - 1);
    const double t      = std::atan(x / std::sqrt(a.radius * a.exit_thickness));
    state.position[i]   = x;
    state.thickness[i]  = thickness_at(a, t);
    state.pressure[i]   = pressure_at(slab, a, t, entry_side);
    const double stress = stress_at(slab, std::min(state.thickness[i], slab.strip.entry_thickness));
    if (stress > 0)
      state.largest_shear = std::max(state.largest_shear, 2 * slab.strip.friction * state.pressure[i] / stress);
  }
  state.peak_pressure = state.pressure.maxCoeff();
}
}  // namespace

double flow_stress(const FlowStress &law, const double strain)
{
  return flow_stress_of(law, strain);
}

BiteState solve_bite(const RollBite &bite)
{
  const Slab slab = checked_slab(bite);
  BiteState state;
  state.flattened_radius = bite.flattening ? flattened_radius(bite, slab, state.iterations) : bite.roll_radius;
  const Arc<double> a    = arc(slab, bite.strip.exit_thickness, state.flattened_radius);
  require_neutral_point(slab, a);
  const double scale      = std::sqrt(a.radius * a.exit_thickness);
  state.force             = force(slab, a);
  state.arc_length        = scale * std::tan(a.entry_angle);
  state.bite_angle        = state.arc_length / a.radius;
  state.neutral_position  = scale * std::tan(a.neutral_angle);
  state.neutral_thickness = thickness_at(a, a.neutral_angle);
  state.forward_slip      = state.neutral_thickness / a.exit_thickness - 1;  // volume flow: v_d h_d = v_r h_n
  state.entry_flow_stress = slab.entry_stress;
  state.exit_flow_stress  = stress_at(slab, a.exit_thickness);
  sample_pressure(state, slab, a);
  state.notes = range_notes(state, bite);
  return state;
}

BiteStiffness bite_stiffness(const RollBite &bite, const BiteState &state)
{
  const Slab slab = checked_slab(bite);
  const double h = bite.strip.exit_thickness, R = state.flattened_radius,
               reduction = bite.strip.entry_thickness - h;
  const double step      = 1e-30;  // relative; no difference is formed, so it may be as small as it likes
  const double F_h       = force(slab, Complex(h, h * step), Complex(R, 0)).imag() / (h * step);
  const double F_R       = force(slab, Complex(h, 0), Complex(R, R * step)).imag() / (R * step);
  // (8.11): R' = Phi(R', h) differentiated along the flattened states
  const double c         = bite.flattening ? bite.roll_radius * flattening_compliance(bite) / reduction : 0;
  const double following = F_h + F_R * c * (F_h + state.force / reduction) / (1 - c * F_R);

  const Material &m = bite.roll;
  const double A    = 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
  const double l    = std::sqrt(bite.roll_radius * reduction);
  BiteStiffness k;
  k.plastic_slope           = -F_h;
  k.plastic_slope_following = -following;
  k.flattening              = bite.strip.width / (A * (std::log(4 * bite.roll_radius / (l / 2)) - 0.5));  // (8.12)
  k.combined                = 1 / (1 / k.plastic_slope + 2 / k.flattening);                               // (8.13)
  return k;
}
}  // namespace mill::dynamics
