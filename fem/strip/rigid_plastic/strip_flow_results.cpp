#include "fem/strip/rigid_plastic/strip_flow_results.h"
#include "core/laws/friction_law.h"
#include "fem/strip/common/strip_results.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/neutral_point.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

double place_of(const StripGrid &grid, const VectorXd &u, const int i)
{
  const auto corner = [&](const int I) {
    const auto &s = grid.spine[I];
    return s[0] * u[grid.whole(Whole::entry)] + s[1] * u[grid.whole(Whole::exit)] + s[2];
  };
  return i % 2 == 0 ? corner(i / 2) : 0.5 * (corner(i / 2) + corner(i / 2 + 1));
}

double height_of(const StripGrid &grid, const VectorXd &u, const int i, const int j)
{
  const auto row = [&](const int J) { return J == 0 ? 0 : u[grid.height(i, J)]; };
  return j % 2 == 0 ? row(j / 2) : 0.5 * (row(j / 2) + row(j / 2 + 1));
}

// Strain at a node from the Gauss rows of the elements below and above it, on corner spine I.
double strain_at(const StripGrid &grid, const VectorXd &u, const int I, const int j)
{
  const StripShapes &s = strip_shapes();
  const auto in        = [&](const int J, const double t) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += u[grid.strain(I, J, k)] * lagrange(s.point, k, t);
    return sum;
  };
  if (j % 2)
    return in(j / 2, 0);
  const bool below = j > 0, above = j < 2 * grid.n_through;
  return ((below ? in(j / 2 - 1, 1) : 0) + (above ? in(j / 2, -1) : 0)) / (int(below) + int(above));
}

// Fields at the nodes, scaled; rates and stresses are means over the elements at a node.
void add_fields(StripFlow &flow, const StripPass &pass, const StripGrid &grid, const StripStage &stage,
                const VectorXd &u)
{
  const int columns = 2 * grid.n_along + 1, rows = 2 * grid.n_through + 1, last = columns - 1;
  const double g0 = stage.cutoff_strain_rate * pass.mean_rate;
  size_fields(flow, columns, rows);
  MatrixXd xx = MatrixXd::Zero(columns, rows), yy = xx, xy = xx, count = xx;
  for (int I = 0; I < grid.n_along; ++I)
    for (int J = 0; J < grid.n_through; ++J)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          const int i = 2 * I + a, j = 2 * J + b;
          double u_along = 0, u_through = 0, v_along = 0, v_through = 0, slope = 0;
          for (int m = 0; m < 3; ++m) {
            slope += quadratic_slope(a - 1, m) * height_of(grid, u, 2 * I + m, j);
            const double along_x = u[grid.velocity(2 * I + m, j, 0)], along_y = u[grid.velocity(2 * I + m, j, 1)];
            u_along += quadratic_slope(a - 1, m) * along_x;
            v_along += quadratic_slope(a - 1, m) * along_y;
            u_through += quadratic_slope(b - 1, m) * u[grid.velocity(i, 2 * J + m, 0)];
            v_through += quadratic_slope(b - 1, m) * u[grid.velocity(i, 2 * J + m, 1)];
          }
          const double width = 0.5 * (place_of(grid, u, 2 * I + 2) - place_of(grid, u, 2 * I));
          const double half  = 0.5 * (height_of(grid, u, i, 2 * J + 2) - height_of(grid, u, i, 2 * J));
          xx(last - i, j) += (u_along - u_through * slope / half) / width;
          yy(last - i, j) += v_through / half;
          xy(last - i, j) += 0.5 * (u_through / half + (v_along - v_through * slope / half) / width);
          const double right = 0.5 * a, up = 0.5 * b;
          flow.pressure(last - i, j) +=
              (1 - right) * ((1 - up) * u[grid.pressure(I, J)] + up * u[grid.pressure(I, J + 1)]) +
              right * ((1 - up) * u[grid.pressure(I + 1, J)] + up * u[grid.pressure(I + 1, J + 1)]);
          ++count(last - i, j);
        }
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const int c   = last - i;  // columns of the result run the other way
      flow.x(c, j)  = -place_of(grid, u, i) * pass.length;
      flow.y(c, j)  = height_of(grid, u, i, j) * pass.length;
      flow.vx(c, j) = -u[grid.velocity(i, j, 0)] * pass.speed;
      flow.vy(c, j) = u[grid.velocity(i, j, 1)] * pass.speed;
      const int I   = i / 2;
      flow.strain(c, j) =
          i % 2 == 0 ? strain_at(grid, u, I, j) : 0.5 * (strain_at(grid, u, I, j) + strain_at(grid, u, I + 1, j));
      const double x = xx(c, j) / count(c, j), y = yy(c, j) / count(c, j), s = xy(c, j) / count(c, j);
      const double square    = 2 * (x * x + y * y + 2 * s * s);
      const double viscosity = 0.5 * scaled_flow_stress(pass, flow.strain(c, j)) / std::sqrt(square + g0 * g0);
      flow.pressure(c, j) *= pass.stress / count(c, j);
      flow.rate(c, j) = 0.5 * square / std::sqrt(square + g0 * g0) * pass.speed / pass.length;
      flow.sxx(c, j)  = 2 * viscosity * x * pass.stress - flow.pressure(c, j);
      flow.syy(c, j)  = 2 * viscosity * y * pass.stress - flow.pressure(c, j);
      flow.sxy(c, j)  = -2 * viscosity * s * pass.stress;  // x points against the strip
    }
}

// Volume through a corner spine per width of half the strip, scaled.
double flux(const StripGrid &grid, const VectorXd &u, const int i)
{
  double sum = 0;
  for (int J = 0; J < grid.n_through; ++J) {
    const double side = height_of(grid, u, i, 2 * J + 2) - height_of(grid, u, i, 2 * J);
    sum += side / 6 *
           (u[grid.velocity(i, 2 * J, 0)] + 4 * u[grid.velocity(i, 2 * J + 1, 0)] +
            u[grid.velocity(i, 2 * J + 2, 0)]);
  }
  return sum;
}

// Neutral point, changes of sign, sticking: everything along the arc.
void add_arc(StripFlow &flow, const StripPass &pass, const StripGrid &grid, const StripStage &stage,
             const StripEquations &e)
{
  bite::BiteState &s  = flow.state;
  const int n         = int(e.nodes.rows());
  const MatrixXd node = e.nodes.colwise().reverse();  // from exit to entry
  const double L = pass.length, k = pass.stress;
  s.position = -L * node.col(0);
  s.pressure = k * node.col(1);
  s.shear    = k * node.col(2);
  s.slip     = node.col(3);
  s.thickness.resize(n);
  flow.first_contact = 2 * grid.n_along - grid.last;
  flow.last_contact  = 2 * grid.n_along - grid.first;
  for (int i = 0; i < n; ++i)
    s.thickness[i] = 2 * flow.y(flow.first_contact + i, flow.y.cols() - 1);
  flow.roll_surface   = 0.5 * s.thickness;
  flow.nodal_force    = k * L * pass.bite->strip.width * node.col(1).cwiseProduct(node.col(4));
  flow.slip_changes   = bite::find_neutral_point(s, 1e-3 * stage.cutoff_slip);
  const Friction &law = pass.bite->strip.friction;
  for (int i = 0; i < n; ++i) {
    const bool limited = slides(law) && node(i, 5) > law.shear_limit;
    if (limited || std::abs(node(i, 3)) < stage.cutoff_slip)
      s.sticking_length += L * node(i, 4);
    if (node(i, 1) < 0)
      flow.negative_length += L * node(i, 4);
    if (i < n - 1)  // the edge of entry is singular
      s.largest_shear = std::max(s.largest_shear, node(i, 5));
  }
  find_peak(flow, n - 1);
}

void add_balances(StripFlow &flow, const StripPass &pass, const StripGrid &grid, const StripEquations &e,
                  const VectorXd &u)
{
  const double in = flux(grid, u, 0), out = flux(grid, u, 2 * grid.n_along);
  const Strip &strip   = pass.bite->strip;
  const double opening = 0.5 * pass.bite->gap_rate / pass.speed;  // of the upper roll
  const double swept   = opening * (u[grid.whole(Whole::exit)] - u[grid.whole(Whole::entry)]);
  flow.balance.flux    = (out + swept - in) / in;
  const double s1 = strip.entry_tension / pass.stress, s2 = u[grid.whole(Whole::tension)];
  const double h1         = 2 * height_of(grid, u, 0, 2 * grid.n_through),
               h2         = 2 * height_of(grid, u, 2 * grid.n_along, 2 * grid.n_through);
  flow.balance.force_x    = e.force_x + 0.5 * (s2 * h2 - s1 * h1);
  const double brought    = e.traction.value + s2 * out - s1 * in - opening * e.force.value;
  const double spent      = e.dissipation + e.friction_power;
  flow.balance.power      = (brought - spent) / spent;
  flow.exit_thickness     = h2 * pass.length;
  flow.exit_tension       = s2 * pass.stress;
  flow.state.forward_slip = out / (0.5 * h2) - 1;
  if (!std::isnan(pass.bite->roll_speed)) {
    flow.state.exit_speed  = out / (0.5 * h2) * pass.speed;
    flow.state.entry_speed = in / (0.5 * h1) * pass.speed;
  }
}

void add_notes(StripFlow &flow, const StripPass &pass)
{
  using bite::sentence;
  bite::BiteState &s = flow.state;
  const bool factor  = !slides(pass.bite->strip.friction);
  if (!factor && s.bite_angle > s.friction)
    s.notes.push_back(bite::large_angle(s, s.friction));
  add_slip_notes(flow, !std::isnan(pass.model.exit_speed));
  if (flow.negative_length > 0)
    s.notes.push_back({WarningId::bite_suction, "",
                       sentence("roll and strip pull at each other over ", flow.negative_length * 1e3, " mm"), "",
                       "more elements along the arc, or the release of the last spine"});
  if (pass.model.arc == bite::Arc::hitchcock && bite::beyond_hitchcock(*pass.bite, s.flattened_radius))
    s.notes.push_back(bite::beyond_hitchcock_note(*pass.bite, s.flattened_radius));
  if (pass.model.arc == bite::Arc::elastic)
    s.notes.push_back(
        {WarningId::bite_strip_model, "",
         "a rigid-plastic strip ends with a step of pressure, to which an elastic roll answers with a slope "
         "that grows with the mesh",
         "the elastic-plastic strip is the model for this roll"});
}
}  // namespace

StripFlow strip_flow_results(const StripPass &pass, const StripGrid &grid, const StripStage &stage,
                             const VectorXd &u)
{
  const StripEquations e = strip_equations(pass, grid, stage, u);
  const Strip &strip     = pass.bite->strip;
  StripFlow flow;
  flow.n_unknowns = grid.n_unknowns;
  flow.unknowns   = u;
  add_fields(flow, pass, grid, stage, u);
  add_arc(flow, pass, grid, stage, e);
  bite::BiteState &s = flow.state;
  s.model            = std::string("finite elements, rigid-plastic strip, ") +
            (pass.model.arc == bite::Arc::rigid       ? "rigid roll"
             : pass.model.arc == bite::Arc::hitchcock ? "Hitchcock's arc"
                                                      : "elastic roll");
  s.force             = e.force.value * pass.stress * pass.length * strip.width;
  s.torque            = e.traction.value * pass.stress * pass.length * strip.width * pass.bite->roll_radius;
  s.friction          = friction_value(strip.friction, u[grid.whole(Whole::friction)]);
  flow.entry_position = s.arc_length = -u[grid.whole(Whole::entry)] * pass.length;
  s.exit_position                    = -u[grid.whole(Whole::exit)] * pass.length;
  s.flattened_radius                 = u[grid.whole(Whole::radius)] * pass.length;
  if (pass.flexibility) {
    s.flattened_radius = radius_of_arc(s);
    flow.flattening    = flattened_arc(pass, grid, u).displacement.reverse() * pass.length;
  } else {
    flow.flattening = VectorXd::Zero(s.position.size());
  }
  s.bite_angle = s.arc_length / s.flattened_radius;
  add_balances(flow, pass, grid, e, u);
  const double before = entry_strain(strip);
  s.entry_flow_stress = scaled_flow_stress(pass, before) * pass.stress;
  s.exit_flow_stress =
      scaled_flow_stress(pass, before + std::log(strip.entry_thickness / flow.exit_thickness)) * pass.stress;
  if (has_film(strip.friction))
    s.film_thickness = bite::film_thickness(
        strip.friction, bite::Inlet<double>{pass.speed, s.entry_speed, s.exit_speed, s.flattened_radius,
                                            s.arc_length, s.entry_flow_stress - strip.entry_tension});
  add_notes(flow, pass);
  return flow;
}
}  // namespace mill::fem
