#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/laws/friction_law.h"
#include "core/numerics/derivative.h"
#include "reduce/bite/slab/orowan.h"
#include <array>
#include <vector>

// Horizontal equilibrium of a slice on one side of the neutral point, and its integration.  theory.md 17
namespace mill::bite {
/// Flow stress between two kinks of its law.
struct FlowPiece {
  double from;     ///< -, coordinate t of the thinner end, (17.5)
  FlowStress law;  ///< smooth between them
};

/// What the slices are made of.  Stresses Pa, lengths m; T is double or a number with derivatives.
template <class T> struct SliceInputs {
  T entry_thickness, exit_thickness, strain_reference;  // the strain is measured from the last
  T entry_tension, exit_tension;
  Traction<T> friction;
  T flow_factor;   // on the flow stress
  T radius;        // of the arc
  double arm = 0;  ///< m, of the torque: radius of the roll
  bool wedge = false, small_angles = false;
  std::vector<FlowPiece> pieces;  // rising
};

/// f, force and torque per width, integrated from an edge of the arc.
template <class T> using Branch = std::array<T, 3>;

/// One slice.
template <class T> struct Slice {
  T thickness, yield, pressure, shear;  // shear: magnitude
  T by_pressure, by_shear;              // dh/dt and 2 dx/dt
  T torque_by_shear;                    // arm times the length of the arc per t
  double excess = 0;                    ///< -, mu p over the limit of the friction stress, minus one
};

/// Slices of one side; `side` is +1 before the neutral point and -1 behind it.
template <class T> class SliceEquation {
public:
  SliceEquation(const SliceInputs<T> &inputs, const int side) : in(inputs), side_(side) {}

  std::size_t piece = 0;      ///< of the flow stress
  bool at_limit     = false;  ///< friction at its limit and not Coulomb's

  Slice<T> slice(const T &t, const T &f) const
  {
    using std::asin;
    using std::sqrt;
    Slice<T> s;
    T angle;
    if (in.small_angles) {  // t = x
      s.thickness       = in.exit_thickness + t * t / in.radius;
      s.by_pressure     = 2.0 * t / in.radius;
      s.by_shear        = T(2.0);
      s.torque_by_shear = T(in.arm);
    } else {  // t = sin(phi/2): the circle without trigonometric functions
      const T t2        = t * t;
      const T c         = sqrt(1.0 - t2);
      s.thickness       = in.exit_thickness + 4.0 * in.radius * t2;
      s.by_pressure     = 8.0 * in.radius * t;
      s.by_shear        = 4.0 * in.radius * (1.0 - 2.0 * t2) / c;
      s.torque_by_shear = in.arm * in.radius * 2.0 / c;
      if (in.wedge)
        angle = 2.0 * asin(t);
    }
    s.yield         = yield(s.thickness);
    const T mean    = f / s.thickness;
    const T limit   = largest_traction(in.friction, s.yield, side_);
    const bool slip = in.friction.slides && !at_limit;
    // A roll does not pull at the strip: no friction there, and who solves for the bite refuses the state.
    // Friction of the other sign would make the pressure run away.
    const bool pulls = slip && value_of(mean) + value_of(s.yield) < 0;
    if (pulls) {
      s.pressure = mean + s.yield;
      s.shear    = T(0.0);
    } else if (!in.wedge) {
      s.pressure = mean + s.yield;
      s.shear    = slip ? sliding_traction(in.friction, s.pressure) : limit;
    } else {
      const T lever = in.small_angles ? T(0.0) : wedge_lever(angle);
      const T phi   = in.small_angles ? T(0.0) : angle;
      if (slip)
        s.pressure = slipping_pressure(mean, s.yield, lever, phi);
      else
        s.pressure = mean +
                     s.yield * wedge_value(side_ > 0 ? in.friction.entry_factor : in.friction.exit_factor, phi) -
                     double(side_) * limit * lever;
      s.shear = slip ? sliding_traction(in.friction, s.pressure) : limit;
    }
    if (in.friction.limited && in.friction.slides)
      s.excess = value_of(sliding_traction(in.friction, s.pressure)) / (value_of(limit) + 1e-300) - 1;
    return s;
  }

  Branch<T> operator()(const T &t, const Branch<T> &y)
  {
    const Slice<T> s = slice(t, y[0]);
    if (s.excess != 0 && (at_limit ? s.excess < -1e-9 : s.excess > 1e-9))
      violated = true;
    const T side_shear = double(side_) * s.shear;
    const T vertical =
        in.small_angles ? s.pressure * s.by_shear : s.pressure * s.by_shear + side_shear * s.by_pressure;
    return {s.pressure * s.by_pressure - side_shear * s.by_shear, 0.5 * vertical, side_shear * s.torque_by_shear};
  }
  bool violated = false;  ///< the friction left its regime in some slice since this was last cleared

  T yield(const T &thickness) const
  {
    using std::log;
    return in.flow_factor * flow_stress(in.pieces[piece].law, T(log(in.strain_reference / thickness)));
  }

private:
  /// p (1 +- mu lever) = mean + k w(2 mu p/k, phi): rises monotonically in p, Newton from the last slice.  (17.4)
  T slipping_pressure(const T &mean, const T &yield, const T &lever, const T &phi) const
  {
    const double k = value_of(yield), mu = value_of(in.friction.coefficient), m = value_of(mean),
                 angle = value_of(phi);
    if (!(k > 0))  // a power law at the entry
      return mean / (1.0 + double(side_) * in.friction.coefficient * lever);
    const double straight = 1 + side_ * mu * value_of(lever);
    double p = guess_ > 0 ? guess_ : m + k, rise = straight;
    for (int i = 0; i < 30; ++i) {
      const double a      = 2 * mu * p / k;
      const bool sticking = a >= 1;  // past the limit w stays; the event that ends slipping is near
      const WedgeFactor w = wedge_factor(sticking ? 1.0 : a, angle);
      rise                = straight - (sticking ? 0 : 2 * mu * w.by_shear);
      double next         = p - (p * straight - m - k * w.value) / rise;
      if (sticking && 2 * mu * next < k)
        next = 0.999999 * k / (2 * mu);
      const bool last = std::abs(next - p) < 1e-6 * k;  // the step after that is in rounding; it is made below
      p               = next;
      if (last)
        break;
    }
    guess_ = p;
    // One more step, in numbers with derivatives: exact by the theorem of implicit functions.
    const bool slips    = 2 * mu * p < k;
    const T a           = slips ? T(2.0 * in.friction.coefficient * p / yield) : T(1.0);
    const WedgeFactor w = wedge_factor(value_of(a), angle);
    rise                = straight - (slips ? 2 * mu * w.by_shear : 0);
    return p -
           (p * (1.0 + double(side_) * in.friction.coefficient * lever) - mean - yield * wedge_number(w, a, phi)) /
               rise;
  }

  const SliceInputs<T> &in;
  int side_;
  mutable double guess_ = 0;
};

/// Step by the modified midpoint rule with 2, 4, .. 2 columns substeps, extrapolated to none: order 2 columns;
/// with six columns 37 slices.
/// @param error  largest difference of the last two extrapolations over the scales; nullptr: not wanted
/// Source: W. B. Gragg, SIAM J. Numer. Anal. 2 (1965) 384; R. Bulirsch, J. Stoer, Numer. Math. 8 (1966) 1.
template <int columns = 6, class T, class Equation>
Branch<T> extrapolated_step(Equation &equation, const T &t0, const Branch<T> &y0, const T &length,
                            const Branch<double> *scale = nullptr, double *error = nullptr)
{
  const Branch<T> at_start = equation(t0, y0);
  std::array<Branch<T>, columns> row;
  Branch<T> before{};
  for (int j = 0; j < columns; ++j) {
    const int n = 2 * (j + 1);
    const T h   = length / double(n);
    Branch<T> a = y0, b;
    for (int c = 0; c < 3; ++c)
      b[c] = y0[c] + h * at_start[c];
    equation.violated = false;  // judged by the finest rule
    for (int m = 1; m < n; ++m) {
      const Branch<T> slope = equation(T(t0 + double(m) * h), b);
      for (int c = 0; c < 3; ++c) {
        const T next = a[c] + 2.0 * h * slope[c];
        a[c]         = b[c];
        b[c]         = next;
      }
    }
    // Neville's scheme in the square of the substep; row[i] holds the i times extrapolated value.
    for (int i = 0; i < j; ++i) {
      const double ratio  = double(n) / (2 * (j - i));
      const double factor = 1 / (ratio * ratio - 1);
      Branch<T> better;
      for (int c = 0; c < 3; ++c)
        better[c] = b[c] + factor * (b[c] - row[i][c]);
      row[i] = b;
      b      = better;
    }
    before = j > 0 ? row[j - 1] : b;
    row[j] = b;
  }
  if (error && scale) {
    *error = 0;
    for (int c = 0; c < 3; ++c)
      *error = std::max(*error, std::abs(value_of(row[columns - 1][c]) - value_of(before[c])) / (*scale)[c]);
  }
  return row[columns - 1];
}
}  // namespace mill::bite
