#pragma once
#include "core/laws/friction_law.h"
#include "reduce/bite/arc/elastic_arc_grid.h"
#include "reduce/bite/arc/elastic_arc_response.h"

// Pressures of an elastic arc on one set of points, and Newton's method for all of them.  theory.md 17.6
namespace mill::bite {
// Directions of the response: the shape at all points, then these inputs.
constexpr int n_arc_directions = 8;  // the first eight of Input

template <class T> Inlet<T> inlet_of(const ArcStrip<T> &strip, const ArcResponse<T> &r, const T &roll_speed)
{
  // The film forms in the wedge before the entry: of it the law knows arc length over radius, here that of the
  // circle through both ends of the plastic arc.
  const T flux = roll_speed * r.neutral_thickness;
  return {roll_speed,
          flux / strip.entry_thickness,
          flux / strip.exit_thickness,
          T(1.0),
          (strip.entry_thickness - strip.exit_thickness) / r.plastic_length,
          r.entry_yield - strip.entry_tension};
}

/// The strip of a bite; `make` turns a value into a number, with its direction.
template <class T, class Make> ArcStrip<T> arc_strip(const RollBite &bite, const T &mu, const Make &make)
{
  const Strip &s = bite.strip;
  ArcStrip<T> in;
  in.entry_thickness  = make(s.entry_thickness, Input::entry_thickness);
  in.exit_thickness   = make(s.exit_thickness, Input::exit_thickness);
  in.strain_reference = std::isfinite(s.initial_thickness) ? T(s.initial_thickness) : in.entry_thickness;
  in.entry_tension    = make(s.entry_tension, Input::entry_tension);
  in.exit_tension     = make(s.exit_tension, Input::exit_tension);
  in.flow_factor      = make(1.0, Input::flow_stress);
  in.radius           = make(bite.roll_radius, Input::arc_radius);
  in.arm              = bite.roll_radius;
  in.elastic_modulus  = s.youngs_modulus / (1 - s.poisson_ratio * s.poisson_ratio);
  in.law              = s.flow_stress;
  in.friction         = traction_of(s.friction, slides(s.friction) ? mu : make(0.0, Input::friction));
  return in;
}

/// Pressures and friction on one set of points.
struct Unknowns {
  Eigen::VectorXd pressure;  ///< (n) Pa
  double mu = 0;             ///< -
};

class ArcProblem {
public:
  ArcProblem(const RollBite &bite, const Eigen::VectorXd &position, const ArcFlexibility *given)
      : bite_(bite), x(position), n(position.size()),
        roll(flexibility_at(position, bite.roll, bite.roll_radius, given)), weight(arc_weights(position))
  {
  }

  ArcShape<double> shape(const Unknowns &u, const double share) const
  {
    const Eigen::VectorXd value = roll.value * u.pressure, slope = roll.slope * u.pressure;
    ArcShape<double> g{std::vector<double>(n), std::vector<double>(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      g.value[i] = x[i] * x[i] / bite_.roll_radius + 2 * share * value[i];
      g.slope[i] = 2 * x[i] / bite_.roll_radius + 2 * share * slope[i];
    }
    return g;
  }

  ArcResponse<double> response(const Unknowns &u, const double share) const
  {
    return response_of(bite_, u, share);
  }
  /// Of another strip between the same rolls.
  ArcResponse<double> response_of(const RollBite &bite, const Unknowns &u, const double share) const
  {
    const auto strip = arc_strip<double>(bite, u.mu, [](const double v, Input) { return v; });
    const auto g     = shape(u, share);
    return ArcResponder<double>(strip, x, g).respond();
  }

  /// What pressures and friction answer to the shape that they make.
  Unknowns answer(const Unknowns &u, const double share) const
  {
    const auto r = response(u, share);
    return {Eigen::Map<const Eigen::VectorXd>(r.pressure.data(), n), law(u.mu, r)};
  }

  double law(const double mu, const ArcResponse<double> &r) const
  {
    if (!follows_bite(bite_.strip.friction))
      return mu;
    const auto strip = arc_strip<double>(bite_, mu, [](const double v, Input) { return v; });
    return coulomb_coefficient(bite_.strip.friction, inlet_of<double>(strip, r, bite_.roll_speed));
  }

  /// Answer with its derivatives by the n pressures (through the shape), mu and the inputs (shape held).
  struct Tangent {
    Eigen::MatrixXd by_pressure;       // (n+1, n): pressures, then friction law
    Eigen::VectorXd by_mu;             // (n+1), the law's own included
    Eigen::MatrixXd by_inputs;         // (n+1, n_arc_directions)
    double torque_by_mu = 0;           ///< N per unit of mu
    Eigen::VectorXd torque_by_inputs;  // (n_arc_directions)
    ArcResponse<Row> response;
  };
  Tangent tangent(const Unknowns &u, const double share, const bool with_inputs) const
  {
    const Eigen::Index size = n + 1 + (with_inputs ? n_arc_directions : 0);
    const auto make         = [&](const double v, const Input which) {
      return with_inputs ? Row::variable(v, n + 1 + static_cast<int>(which), size) : Row(v);
    };
    const Row mu     = Row::variable(u.mu, n, size);
    const auto strip = arc_strip<Row>(bite_, mu, make);
    const auto plain = shape(u, share);
    ArcShape<Row> g;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto row = [&](const double value, const Eigen::MatrixXd &influence, const double by_radius) {
        Row r(value, Eigen::ArrayXd::Zero(size));
        r.by.head(n) = 2 * share * influence.row(i).transpose().array();
        if (with_inputs)
          r.by[n + 1 + static_cast<int>(Input::arc_radius)] = by_radius;
        return r;
      };
      const double square = bite_.roll_radius * bite_.roll_radius;
      g.value.push_back(row(plain.value[i], roll.value, -x[i] * x[i] / square));
      g.slope.push_back(row(plain.slope[i], roll.slope, -2 * x[i] / square));
    }
    Tangent t;
    t.response     = ArcResponder<Row>(strip, x, g).respond();
    t.by_pressure  = Eigen::MatrixXd::Zero(n + 1, n);
    t.by_mu        = Eigen::VectorXd::Zero(n + 1);
    t.by_inputs    = Eigen::MatrixXd::Zero(n + 1, n_arc_directions);
    const auto put = [&](const Eigen::Index row, const Row &value) {
      if (value.by.size() == 0)
        return;
      t.by_pressure.row(row) = value.by.head(n).matrix().transpose();
      t.by_mu[row]           = value.by[n];
      if (with_inputs)
        t.by_inputs.row(row) = value.by.tail(n_arc_directions).matrix().transpose();
    };
    for (Eigen::Index i = 0; i < n; ++i)
      put(i, t.response.pressure[i]);
    const Friction &friction = bite_.strip.friction;
    if (follows_bite(friction)) {
      const Row speed = make(bite_.roll_speed, Input::roll_speed);
      put(n, coulomb_coefficient(friction, inlet_of<Row>(strip, t.response, speed)));
    } else {
      t.by_mu[n] = 0;
      if (with_inputs && needs_speed(friction)) {
        Inlet<Row> inlet;
        inlet.roll_speed = make(bite_.roll_speed, Input::roll_speed);
        put(n, coulomb_coefficient(friction, inlet));
      }
    }
    // mu is the law's number plus what is added to it
    if (with_inputs)
      t.by_inputs(n, static_cast<int>(Input::friction)) += 1;
    const Row &torque = t.response.torque;
    if (with_inputs) {
      t.torque_by_mu     = torque.by[n];
      t.torque_by_inputs = torque.by.tail(n_arc_directions).matrix();
    }
    return t;
  }

  /// Matrix of Newton's method: unknowns minus their answer, by the unknowns.
  Eigen::MatrixXd matrix(const Tangent &t) const
  {
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n + 1, n + 1);
    m.leftCols(n) -= t.by_pressure;
    m.col(n) -= t.by_mu;
    return m;
  }

  const RollBite &bite_;
  Eigen::VectorXd x;
  Eigen::Index n;
  ArcMatrices roll;
  Eigen::VectorXd weight;
};

/// Newton's method with halved steps where a whole one does not come closer; from the rigid arc, or near the
/// solution, to full compliance, which is raised in steps where one is too much.
/// @param near       the unknowns are close to the solution
/// @param stress     Pa, by which pressures are judged
/// @param tolerance  -, root mean square of the distance of the unknowns from their answer
/// @return  steps of Newton's method
/// @throws SolverError  with the share of the compliance that was reached
int solve_on(const ArcProblem &problem, Unknowns &u, bool near, double stress, double tolerance);
}  // namespace mill::bite
