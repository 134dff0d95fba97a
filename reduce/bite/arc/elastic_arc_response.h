#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/laws/friction_law.h"
#include "reduce/bite/arc/elastic_arc_row.h"
#include "reduce/bite/bite.h"
#include <algorithm>
#include <array>
#include <vector>

// Pressure of the strip on an arc of given shape, with its elastic zones.  theory.md 17.6
namespace mill::bite {
/// What the strip brings; T is double or a number with derivatives.
template <class T> struct ArcStrip {
  T entry_thickness, exit_thickness, strain_reference;
  T entry_tension, exit_tension;
  Traction<T> friction;
  T flow_factor, radius;
  double elastic_modulus = 0;  ///< Pa, E/(1 - nu^2) of the strip
  double arm             = 0;  ///< m, radius of the roll
  FlowStress law;
};

/// Pressure along the arc, and what follows from it, per width.
template <class T> struct ArcResponse {
  std::vector<T> pressure, shear;  // (n) at the points
  T torque, neutral_thickness, plastic_length, entry_yield, exit_yield;
  double smallest = 0;                      ///< m, of the shape, in the window
  double exit = 0, entry = 0, neutral = 0;  ///< m, ends of the plastic zone, meeting of the branches
  double first = 0, last = 0;               ///< m, ends of the contact
  double neutral_pressure = 0;              ///< Pa
  double largest_shear    = 0;              ///< -, mu p over the shear yield stress
  double sticking_length  = 0;              ///< m, with friction at its limit
  bool monotone           = true;           // the plastic arc closes all along
  bool skids              = false;          // the branches do not meet
};

/// A cell of the shape between two points: the cubic with the values and slopes at its ends.
template <class T> struct ShapeCell {
  T left, right, left_slope, right_slope;  // slopes times the length of the cell
  T at(const T &s) const
  {
    return left + s * (left_slope + s * (3.0 * (right - left) - 2.0 * left_slope - right_slope +
                                         s * (2.0 * (left - right) + left_slope + right_slope)));
  }
  T slope(const T &s) const
  {
    return left_slope + s * (2.0 * (3.0 * (right - left) - 2.0 * left_slope - right_slope) +
                             s * (3.0 * (2.0 * (left - right) + left_slope + right_slope)));
  }
};

/// Opening of the gap that the surfaces of both rolls make.
template <class T> struct ArcShape {
  std::vector<T> value;  // (n) m
  std::vector<T> slope;  // (n) -
};

template <class T> class ArcResponder {
public:
  /// @param shape  opening of the gap at the points, up to a constant, with its slope
  ArcResponder(const ArcStrip<T> &strip, const Eigen::VectorXd &position, const ArcShape<T> &shape)
      : in(strip), x(position), g(shape.value), g_slope(shape.slope), n(static_cast<int>(position.size()))
  {
  }

  /// @throws SolverError  the points do not reach the entry or the exit of the strip
  ArcResponse<T> respond()
  {
    r.pressure.assign(n, T(0.0));
    r.shear.assign(n, T(0.0));
    find_exit();
    h.resize(n);
    for (int i = 0; i < n; ++i)
      h[i] = in.exit_thickness + (g[i] - g_min);
    find_entry();
    march();
    elastic_zones();
    return std::move(r);
  }

private:
  ShapeCell<T> cell(const int i) const
  {
    const double w = x[i + 1] - x[i];
    return {g[i], g[i + 1], g_slope[i] * w, g_slope[i + 1] * w};
  }
  void find_exit()
  {
    using std::sqrt;
    int i = 0;
    for (int j = 1; j < n; ++j)
      if (g[j] < g[i])
        i = j;
    if (i < 2 || i > n - 3)
      refuse_window("exit");
    exit_cell            = value_of(g_slope[i]) <= 0 ? i : i - 1;
    const ShapeCell<T> c = cell(exit_cell);
    // Root of the quadratic slope at which the shape turns upwards, in the form without cancellation
    const T a = 3.0 * (2.0 * (c.left - c.right) + c.left_slope + c.right_slope);
    const T b = 2.0 * (3.0 * (c.right - c.left) - 2.0 * c.left_slope - c.right_slope);
    const T s =
        value_of(c.left_slope) == 0 ? T(0.0) : -2.0 * c.left_slope / (b + sqrt(b * b - 4.0 * a * c.left_slope));
    g_min      = c.at(s);
    x_exit     = x[exit_cell] + s * (x[exit_cell + 1] - x[exit_cell]);
    r.exit     = value_of(x_exit);
    r.smallest = value_of(g_min);
  }
  void find_entry()
  {
    int i = exit_cell + 1;
    while (i < n && h[i] < in.entry_thickness)
      ++i;
    if (i > n - 3)
      refuse_window("entry");
    entry_cell           = i - 1;
    const ShapeCell<T> c = cell(entry_cell);
    const T target       = in.entry_thickness - in.exit_thickness + g_min;
    double s             = 0.5;
    for (int step = 0; step < 40; ++step) {
      const double ds = (value_of(c.at(T(s))) - value_of(target)) / value_of(c.slope(T(s)));
      s               = std::clamp(s - ds, 0.0, 1.0);
      if (std::abs(ds) < 1e-14)
        break;
    }
    const T root = s - (c.at(T(s)) - target) / value_of(c.slope(T(s)));
    x_entry      = x[entry_cell] + root * (x[entry_cell + 1] - x[entry_cell]);
    r.entry      = value_of(x_entry);
    entry_slope  = c.slope(root) / (x[entry_cell + 1] - x[entry_cell]);
  }
  T yield(const T &thickness) const
  {
    using std::log;
    return in.flow_factor * flow_stress(in.law, T(log(in.strain_reference / thickness)));
  }
  struct Place {
    T x, h, dh, k;  // dh: slope of the thickness
    T f, p, tau;
  };
  Place place(const T &position, const T &thickness, const T &slope) const
  {
    return {position, thickness, slope, yield(thickness), T(0.0), T(0.0), T(0.0)};
  }
  /// Between the points, on the cubic of their cell.
  Place place_inside(const int in_cell, const T &position) const
  {
    const double w       = x[in_cell + 1] - x[in_cell];
    const ShapeCell<T> c = cell(in_cell);
    const T s            = (position - x[in_cell]) / w;
    return place(position, in.exit_thickness + (c.at(s) - g_min), c.slope(s) / w);
  }
  void settle(Place &e, const T &f, const int side) const
  {
    e.f   = f;
    e.p   = f / e.h + e.k;
    e.tau = traction_limit(in.friction, e.p, e.k, side);
  }
  /// From one place to another of the same cell:  f' = p h' - side 2 tau  is linear in f while the friction keeps
  /// its regime; collocation at both ends and the middle (Lobatto, order 4), solved for the far end.
  void advance(const Place &from, Place &to, const int in_cell, const int side) const
  {
    const T w          = to.x - from.x;
    const Place middle = place_inside(in_cell, T(0.5 * (from.x + to.x)));
    const T &mu        = in.friction.coefficient;
    const auto reach   = [&](const bool limited) {
      const auto rate = [&](const Place &e) {  // of f, and the constant part
        const double twice = 2.0 * side;
        return limited
                     ? std::array<T, 2>{e.dh / e.h, e.k * e.dh - twice * largest_traction(in.friction, e.k, side)}
                     : std::array<T, 2>{(e.dh - twice * mu) / e.h, e.k * (e.dh - twice * mu)};
      };
      const auto a = rate(from), m = rate(middle), b = rate(to);
      const T start = a[0] * from.f + a[1];
      const T known =
          from.f + w / 6.0 * (start + 4.0 * (m[0] * (0.5 * from.f + w / 8.0 * (start - b[1])) + m[1]) + b[1]);
      return known / (1.0 - w / 6.0 * (4.0 * m[0] * (0.5 - w / 8.0 * b[0]) + b[0]));
    };
    settle(to, reach(!in.friction.slides), side);
    if (in.friction.slides && at_limit(in.friction, to.p, to.k, side))
      settle(to, reach(true), side);
  }
  void march()
  {
    const int first = exit_cell + 1, last = entry_cell;  // points inside the plastic arc
    std::vector<Place> exits;
    exits.push_back(place(x_exit, in.exit_thickness, T(0.0)));
    for (int i = first; i <= last; ++i)
      exits.push_back(place(T(x[i]), h[i], g_slope[i]));
    exits.push_back(place(x_entry, in.entry_thickness, entry_slope));
    std::vector<Place> entries = exits;
    const std::size_t n_places = exits.size();
    settle(exits[0], -in.exit_tension * in.exit_thickness, -1);
    for (std::size_t c = 0; c + 1 < n_places; ++c)
      advance(exits[c], exits[c + 1], exit_cell + static_cast<int>(c), -1);
    settle(entries[n_places - 1], -in.entry_tension * in.entry_thickness, +1);
    for (std::size_t c = n_places - 1; c > 0; --c)
      advance(entries[c], entries[c - 1], exit_cell + static_cast<int>(c) - 1, +1);
    exit_pressure  = exits[0].p;
    entry_pressure = entries[n_places - 1].p;
    // Both are there from exit to entry; the smaller pressure is taken.
    const auto gap = [&](const std::size_t j) { return exits[j].f - entries[j].f; };
    std::size_t j  = 0;
    while (j + 1 < exits.size() && value_of(gap(j + 1)) < 0)
      ++j;
    r.skids = j + 1 == exits.size() || value_of(gap(0)) > 0;
    if (j + 1 == exits.size())
      --j;
    // Meeting inside the cell j..j+1 with both branches straight there
    const T s         = r.skids ? (value_of(gap(0)) > 0 ? T(0.0) : T(1.0)) : gap(j) / (gap(j) - gap(j + 1));
    const T x_n       = exits[j].x + s * (exits[j + 1].x - exits[j].x);
    const T tau_exit  = exits[j].tau + s * (exits[j + 1].tau - exits[j].tau);
    const T tau_entry = entries[j].tau + s * (entries[j + 1].tau - entries[j].tau);
    T drive(0.0);
    for (std::size_t c = 0; c + 1 < exits.size(); ++c) {
      const double exit_x = value_of(exits[c].x), length = value_of(exits[c + 1].x) - exit_x;
      if (c < j)
        drive = drive - 0.5 * (exits[c].tau + exits[c + 1].tau) * (exits[c + 1].x - exits[c].x);
      else if (c > j)
        drive = drive + 0.5 * (entries[c].tau + entries[c + 1].tau) * (entries[c + 1].x - entries[c].x);
      else
        drive = drive - 0.5 * (exits[c].tau + tau_exit) * (x_n - exits[c].x) +
                0.5 * (tau_entry + entries[c + 1].tau) * (entries[c + 1].x - x_n);
      const Place &b = c < j ? exits[c] : entries[c + 1];
      if (value_of(b.tau) < value_of(sliding_traction(in.friction, b.p)) * (1 - 1e-12) || !in.friction.slides)
        r.sticking_length += length;
    }
    r.torque            = in.arm * drive;
    r.neutral           = value_of(x_n);
    r.neutral_thickness = exits[j].h + s * (exits[j + 1].h - exits[j].h);
    r.neutral_pressure  = value_of(exits[j].p) + value_of(s) * (value_of(exits[j + 1].p) - value_of(exits[j].p));
    for (int i = first; i <= last; ++i) {
      const std::size_t c = i - first + 1;
      const bool exit     = c <= j;
      r.pressure[i]       = exit ? exits[c].p : entries[c].p;
      r.shear[i]          = exit ? -exits[c].tau : entries[c].tau;
      if (value_of(h[i]) < value_of(i > first ? h[i - 1] : in.exit_thickness))
        r.monotone = false;
    }
    const T k_n      = yield(r.neutral_thickness);
    r.plastic_length = x_entry - x_exit;
    r.entry_yield    = yield(in.entry_thickness);
    r.exit_yield     = yield(in.exit_thickness);
    const auto &law  = in.friction;
    r.largest_shear  = law.slides ? value_of(law.coefficient) * r.neutral_pressure / (0.5 * value_of(k_n))
                                  : std::max(value_of(law.entry_factor), value_of(law.exit_factor));
  }
  /// Ends of the contact: where the straight pressure of the last cell with any would be zero.
  static double nil_between(const double x0, const double p0, const double x1, const double p1)
  {
    return p0 == p1 ? x1 : x0 + (x1 - x0) * p0 / (p0 - p1);
  }
  void elastic_zones()
  {
    double position = r.exit, p_at = value_of(exit_pressure);
    r.first = x[0];
    for (int i = exit_cell; i >= 0; --i) {
      const T p = exit_pressure - in.elastic_modulus * (h[i] - in.exit_thickness) / in.exit_thickness;
      if (!(value_of(p) > 0)) {
        r.first = nil_between(position, p_at, x[i], value_of(p));
        break;
      }
      r.pressure[i] = p;
      position      = x[i];
      p_at          = value_of(p);
    }
    position = r.entry;
    p_at     = value_of(entry_pressure);
    r.last   = x[n - 1];
    for (int i = entry_cell + 1; i < n; ++i) {
      const T p = entry_pressure - in.elastic_modulus * (h[i] - in.entry_thickness) / in.entry_thickness;
      if (!(value_of(p) > 0)) {
        r.last = nil_between(position, p_at, x[i], value_of(p));
        break;
      }
      r.pressure[i] = p;
      position      = x[i];
      p_at          = value_of(p);
    }
  }
  [[noreturn]] void refuse_window(const char *end) const;

  const ArcStrip<T> &in;
  const Eigen::VectorXd &x;
  const std::vector<T> &g, &g_slope;
  int n, exit_cell = 0, entry_cell = 0;
  T g_min, x_exit, x_entry, entry_slope, exit_pressure, entry_pressure;
  std::vector<T> h;
  ArcResponse<T> r;
};

/// @throws SolverError always
[[noreturn]] void refuse_arc_window(const char *end, double first, double last);
template <class T> void ArcResponder<T>::refuse_window(const char *end) const
{
  refuse_arc_window(end, x[0], x[n - 1]);
}
}  // namespace mill::bite
