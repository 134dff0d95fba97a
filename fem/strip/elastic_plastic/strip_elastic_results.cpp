#include "fem/strip/elastic_plastic/strip_elastic_results.h"
#include "core/laws/friction_law.h"
#include "fem/strip/common/strip_results.h"
#include "fem/strip/common/unsymmetric_factor.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/neutral_point.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
using bite::sentence;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double touching = 1e-6;  // roll pressure over the unit of stress that is taken as contact

// Stress (deviatoric) and strain of a row at its upstream face, its first and its last Radau point.
std::array<std::array<double, 4>, 3> row_values(const ElasticGrid &grid, const ElasticEquations &e,
                                                const VectorXd &u, const int I, const int J, const int r)
{
  std::array<std::array<double, 4>, 3> v{};
  if (I == 0) {
    v[0] = {u[grid.bulk(Bulk::inlet_xx)], u[grid.bulk(Bulk::inlet_yy)], 0, u[grid.bulk(Bulk::inlet_strain)]};
  } else {
    for (int s = 0; s < 4; ++s)
      v[0][s] = u[grid.state(I - 1, J, r, s)];
  }
  for (int k = 0; k < 2; ++k) {
    const ElasticPoint &p = e.points[2 * (3 * (I * grid.n_through + J) + r) + k];
    v[k + 1]              = {p.xx, p.yy, p.xy, p.strain};
  }
  return v;
}

void add_fields(StripFlow &flow, const ElasticPass &pass, const ElasticGrid &grid, const ElasticEquations &e,
                const VectorXd &u)
{
  const int columns = int(grid.x.size()), rows = 2 * grid.n_through + 1, last = columns - 1;
  size_fields(flow, columns, rows);
  MatrixXd count      = MatrixXd::Zero(columns, rows);
  const auto value_at = [&](const int id) { return id < 0 ? 0 : u[id]; };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const int c  = last - i;  // columns of the result run the other way
      flow.x(c, j) = -grid.x[i] * pass.length;
      flow.y(c, j) = 0.5 * (value_at(grid.height(i, j / 2)) + value_at(grid.height(i, (j + 1) / 2))) * pass.length;
      flow.vx(c, j) = -value_at(grid.velocity(i, j, 0)) * pass.speed;
      flow.vy(c, j) = value_at(grid.velocity(i, j, 1)) * pass.speed;
    }
  const GaussRows &gauss = gauss_rows();
  const std::array<double, 3> along{0, radau_point[0], radau_point[1]};
  for (int I = 0; I < grid.n_along; ++I)
    for (int J = 0; J < grid.n_through; ++J)
      for (int a = 0; a < 3; ++a) {
        const double t = 0.5 * a;
        std::array<std::array<double, 5>, 3>
            row{};  // stress, strain and rate where the Gauss rows cross this line
        for (int r = 0; r < 3; ++r) {
          const auto v = row_values(grid, e, u, I, J, r);
          for (int s = 0; s < 4; ++s)
            for (int m = 0; m < 3; ++m)
              row[r][s] += lagrange(along, m, t) * v[m][s];
          const ElasticPoint *p = &e.points[2 * (3 * (I * grid.n_through + J) + r)];
          row[r][4]             = a == 0 ? p[0].rate : a == 1 ? 0.75 * p[0].rate + 0.25 * p[1].rate : p[1].rate;
        }
        for (int b = 0; b < 3; ++b) {
          const int c = last - 2 * I - a, j = 2 * J + b;
          std::array<double, 5> v{};
          for (int s = 0; s < 5; ++s)
            for (int r = 0; r < 3; ++r)
              v[s] += lagrange(gauss.point, r, 0.5 * b) * row[r][s];
          const double pressure = u[grid.pressure(I, J, 0)] + (t - 0.5) * u[grid.pressure(I, J, 1)] +
                                  (0.5 * b - 0.5) * u[grid.pressure(I, J, 2)];
          flow.pressure(c, j) += pressure * pass.stress;
          flow.sxx(c, j) += (v[0] - pressure) * pass.stress;
          flow.syy(c, j) += (v[1] - pressure) * pass.stress;
          flow.sxy(c, j) -= v[2] * pass.stress;  // x points against the strip
          flow.strain(c, j) += v[3];
          flow.rate(c, j) += 0.5 * std::max(v[4], 0.) * pass.speed / pass.length;
          ++count(c, j);
        }
      }
  for (MatrixXd *field : {&flow.pressure, &flow.sxx, &flow.syy, &flow.sxy, &flow.strain, &flow.rate})
    *field = field->cwiseQuotient(count);
}

// Everything along the arc, from the exit to the entry.
void add_arc(StripElastic &out, const ElasticPass &pass, const ElasticGrid &grid, const ElasticStage &stage,
             const ElasticEquations &e, const VectorXd &u)
{
  StripFlow &flow    = out.flow;
  bite::BiteState &s = flow.state;
  const int last     = int(grid.x.size()) - 1;
  int entry = -1, exit = -1;
  for (int i = 0; i <= last; ++i)
    if (grid.force(i) >= 0 && e.contacts[i].pressure > touching) {
      entry = entry < 0 ? i : entry;
      exit  = i;
    }
  const int n    = entry < 0 ? 0 : exit - entry + 1;
  const double L = pass.length, k = pass.stress, d0 = stage.cutoff_slip * pass.reduction;
  for (VectorXd *v : {&s.position, &s.pressure, &s.shear, &s.slip, &s.thickness, &flow.nodal_force,
                      &flow.roll_surface, &flow.flattening})
    v->resize(n);
  flow.first_contact     = last - exit;
  flow.last_contact      = last - entry;
  out.smallest_thickness = 1e300;
  for (int m = 0; m < n; ++m) {
    const int i             = exit - m;
    const ElasticContact &c = e.contacts[i];
    s.position[m]           = -grid.x[i] * L;
    s.pressure[m]           = c.pressure * k;
    s.shear[m]              = c.shear * k;
    s.slip[m]               = c.slip;
    s.thickness[m]          = 2 * u[grid.height(i, grid.n_through)] * L;
    flow.nodal_force[m]     = c.pressure * grid.tributary[i] * k * L * pass.bite->strip.width;
    flow.roll_surface[m]    = c.surface * L;
    const double R          = pass.radius;
    flow.flattening[m] =
        (c.surface - u[grid.bulk(Bulk::roll_height)] - (R - std::sqrt(R * R - grid.x[i] * grid.x[i]))) * L;
    out.smallest_thickness = std::min(out.smallest_thickness, s.thickness[m]);
    if (c.limited > pass.bite->strip.friction.shear_limit || std::abs(c.slip) < d0)
      s.sticking_length += L * grid.tributary[i];
    s.largest_shear = std::max(s.largest_shear, c.limited);
  }
  flow.slip_changes = bite::find_neutral_point(s, 1e-3 * d0);
  if (n == 0)
    return;
  int edge = n - 1;
  while (edge > 0 && s.pressure[edge] <= s.pressure[edge - 1])
    --edge;
  find_peak(flow, edge);
  flow.entry_position = s.arc_length = n > 0 ? s.position[n - 1] : 0;
  s.exit_position                    = n > 0 ? s.position[0] : 0;
  // Elastic ends of the contact, where no point of the surface row yields
  double first_yield = 1e300, last_yield = -1e300;
  for (int I = 0; I < grid.n_along; ++I)
    for (int kk = 0; kk < 2; ++kk)
      if (e.points[2 * (3 * (I * grid.n_through + grid.n_through - 1) + 2) + kk].yields) {
        const double x = grid.x[2 * I] + radau_point[kk] * (grid.x[2 * I + 2] - grid.x[2 * I]);
        first_yield    = std::min(first_yield, x);
        last_yield     = std::max(last_yield, x);
      }
  if (n > 0 && first_yield < last_yield) {
    out.elastic_entry = std::max(0., first_yield - grid.x[entry]) * L;
    out.elastic_exit  = std::max(0., grid.x[exit] - last_yield) * L;
  }
  s.flattened_radius = pass.radius * L;
  if (pass.model.arc == bite::Arc::elastic && n > 2)
    s.flattened_radius = radius_of_arc(s);
  s.bite_angle = s.arc_length / s.flattened_radius;
}

// Sums over a cross-section of half the strip at a face: volume, elastic energy and stress carried through it.
struct Section {
  double volume = 0, mass = 0, energy = 0;
};
Section section(const ElasticPass &pass, const ElasticGrid &grid, const ElasticEquations &e, const VectorXd &u,
                const bool outlet)
{
  Section sum;
  const int I = outlet ? grid.n_along - 1 : 0, i = outlet ? 2 * grid.n_along : 0;
  const double speed = u[grid.bulk(outlet ? Bulk::exit_speed : Bulk::entry_speed)];
  for (int J = 0; J < grid.n_through; ++J) {
    const double lower = J == 0 ? 0 : u[grid.height(i, J)], height = u[grid.height(i, J + 1)] - lower;
    for (int r = 0; r < 3; ++r) {
      const auto v          = row_values(grid, e, u, I, J, r)[outlet ? 2 : 0];
      const double pressure = outlet ? u[grid.pressure(I, J, 0)] + 0.5 * u[grid.pressure(I, J, 1)] +
                                           (gauss_rows().point[r] - 0.5) * u[grid.pressure(I, J, 2)]
                                     : u[grid.bulk(Bulk::inlet_pressure)];
      const double zz = v[0] + v[1], w = gauss_rows().weight[r] * height * speed;
      sum.volume += w;
      sum.mass += w * (1 + pass.bulk_compliance * pressure);
      sum.energy += w * 0.5 *
                    (pass.shear_compliance * (v[0] * v[0] + v[1] * v[1] + zz * zz + 2 * v[2] * v[2]) +
                     pass.bulk_compliance * pressure * pressure);
    }
  }
  return sum;
}

void add_balances(StripElastic &out, const ElasticPass &pass, const ElasticGrid &grid, const ElasticEquations &e,
                  const VectorXd &u)
{
  StripFlow &flow  = out.flow;
  const Section in = section(pass, grid, e, u, false), leaving = section(pass, grid, e, u, true);
  const double s1 = u[grid.bulk(Bulk::entry_tension)], s2 = u[grid.bulk(Bulk::exit_tension)];
  const double h1 = u[grid.bulk(Bulk::entry_thickness)], h2 = 2 * u[grid.height(2 * grid.n_along, grid.n_through)];
  flow.balance.flux    = (leaving.mass - in.mass) / in.mass;
  flow.balance.force_x = e.force_x + 0.5 * (s2 * h2 - s1 * h1);
  const double carried = leaving.energy - in.energy, spent = e.plastic_power + e.friction_power + carried;
  const double brought    = e.traction + s2 * leaving.volume - s1 * in.volume;
  flow.balance.power      = (brought - spent) / spent;
  out.elastic_power       = carried / spent;
  flow.exit_thickness     = h2 * pass.length;
  flow.exit_tension       = s2 * pass.stress;
  flow.state.forward_slip = u[grid.bulk(Bulk::exit_speed)] - 1;
  if (!std::isnan(pass.bite->roll_speed)) {
    flow.state.exit_speed  = u[grid.bulk(Bulk::exit_speed)] * pass.speed;
    flow.state.entry_speed = u[grid.bulk(Bulk::entry_speed)] * pass.speed;
  }
  // What stays in the strip
  const int m = 3 * grid.n_through, I = grid.n_along - 1, last = 2 * grid.n_along;
  out.outlet_height.resize(m);
  out.outlet_stress.resize(m);
  out.outlet_weight.resize(m);
  for (int J = 0; J < grid.n_through; ++J)
    for (int r = 0; r < 3; ++r) {
      const double lower = J == 0 ? 0 : u[grid.height(last, J)], height = u[grid.height(last, J + 1)] - lower;
      const double pressure = u[grid.pressure(I, J, 0)] + 0.5 * u[grid.pressure(I, J, 1)] +
                              (gauss_rows().point[r] - 0.5) * u[grid.pressure(I, J, 2)];
      out.outlet_height[3 * J + r] = (lower + gauss_rows().point[r] * height) * pass.length;
      out.outlet_weight[3 * J + r] = gauss_rows().weight[r] * height * pass.length;
      out.outlet_stress[3 * J + r] = (row_values(grid, e, u, I, J, r)[2][0] - pressure) * pass.stress;
    }
  out.n_points = int(e.points.size());
  for (const ElasticPoint &p : e.points)
    out.n_yielding += p.yields;
}

// Exact derivatives of force and traction: what is given is among the unknowns, so they can be read off one
// transposed solution each, (19.15).
void add_derivatives(StripElastic &out, const ElasticPass &pass, const ElasticGrid &grid, const ElasticRoll &roll,
                     ElasticStage stage, VectorXd u, const bool held)
{
  stage.held_arc = held;
  RowMemory memory;
  const ElasticEquations e = elastic_equations(pass, grid, roll, stage, u, memory, true);
  UnsymmetricFactor factor;
  bite::BiteState &s = out.flow.state;
  if (!factor.factorise(grid.n_unknowns, e.entries))
    return;
  const double unit = pass.stress * pass.length * pass.bite->strip.width;
  const bool speed  = !std::isnan(pass.bite->roll_speed);
  // Friction by the speed of the roll where the law knows one; speeds of the strip in proportion
  double friction_by_speed = speed ? 0 : not_given;
  const Friction &law      = pass.bite->strip.friction;
  if (speed && needs_speed(law)) {
    using D        = bite::Dual<1>;
    const D v      = D::variable(pass.speed, 0);
    const double k = s.entry_flow_stress;
    friction_by_speed =
        bite::coulomb_coefficient(law, bite::Inlet<D>{v, v * u[grid.bulk(Bulk::entry_speed)],
                                                      v * u[grid.bulk(Bulk::exit_speed)],
                                                      D(pass.bite->roll_radius), D(pass.arc_length * pass.length),
                                                      D(k - pass.bite->strip.entry_tension)})
            .by[0];
  }
  const auto read = [&](const VectorXd &by, const double scale, bite::Gradient &gradient) {
    const VectorXd w = factor.solve_transposed(by);
    const auto set   = [&](const bite::Input input, const Bulk b, const double per) {
      gradient[int(input)] = w[grid.bulk(b)] * scale / per;
    };
    gradient.fill(not_given);
    set(bite::Input::entry_thickness, Bulk::entry_thickness, pass.length);
    set(bite::Input::exit_thickness, Bulk::exit_thickness, pass.length);
    set(bite::Input::entry_tension, Bulk::entry_tension, pass.stress);
    set(bite::Input::exit_tension, Bulk::exit_tension, pass.stress);
    set(bite::Input::friction, Bulk::friction, 1);
    set(bite::Input::flow_stress, Bulk::stress_factor, 1);
    set(bite::Input::arc_radius, Bulk::radius, pass.length);
    gradient[int(bite::Input::roll_speed)] = w[grid.bulk(Bulk::friction)] * scale * friction_by_speed;
  };
  if (held) {
    read(e.force_by, unit, s.force_by);
    read(e.traction_by, unit * pass.bite->roll_radius, s.torque_by);
    s.force_by_exit_following = bite::by(s.force_by, bite::Input::exit_thickness);
  } else {
    bite::Gradient following;
    read(e.force_by, unit, following);
    s.force_by_exit_following = bite::by(following, bite::Input::exit_thickness);
  }
}

void add_notes(StripElastic &out, const ElasticPass &pass)
{
  bite::BiteState &s  = out.flow.state;
  const double length = s.arc_length - s.exit_position;
  add_slip_notes(out.flow, false);
  if (out.elastic_entry + out.elastic_exit > 0.1 * length)
    s.remarks.push_back(sentence("the strip's surface is elastic over ", out.elastic_entry * 1e3,
                                 " mm of the contact at the entry and ", out.elastic_exit * 1e3,
                                 " mm at the exit, of ", length * 1e3,
                                 " mm: a rigid-plastic theory is wrong by about that share"));
  if (pass.model.arc == bite::Arc::elastic && s.flattened_radius > 5 * pass.bite->roll_radius)
    s.notes.push_back({WarningId::bite_foil, "",
                       sentence("the arc is as flat as that of a roll ",
                                s.flattened_radius / pass.bite->roll_radius, " times as large"),
                       "foil, where strip and roll stick"});
}
}  // namespace

StripElastic elastic_results(const ElasticPass &pass, const ElasticGrid &solved, const ElasticRoll &roll,
                             ElasticStage stage, const VectorXd &unknowns)
{
  const ElasticGrid grid = moved(solved, unknowns);
  VectorXd u             = unknowns;
  stage.thinnest         = roll.displacement.size() > 0 ? thinnest_spine(solved, u, 0) : 0;
  RowMemory memory;
  const ElasticEquations e = elastic_equations(pass, solved, roll, stage, u, memory, false);
  const Strip &strip       = pass.bite->strip;
  StripElastic out;
  StripFlow &flow    = out.flow;
  bite::BiteState &s = flow.state;
  flow.n_unknowns    = grid.n_unknowns;
  flow.unknowns      = u;
  out.stress_unit    = pass.stress;
  out.entry_spine    = solved.entry_spine;
  out.exit_spine     = solved.exit_spine;
  out.entry_ratio    = solved.entry_ratio;
  out.ends_fitted    = solved.ends_of_contact;
  for (int i = 0; i < grid.x.size(); i += 2)
    out.lines.push_back(grid.x[i] * pass.length);
  add_fields(flow, pass, grid, e, u);
  add_arc(out, pass, grid, stage, e, u);
  s.model = std::string("finite elements, elastic-plastic strip, ") +
            (pass.model.arc == bite::Arc::rigid ? "rigid roll" : "elastic roll");
  s.force    = e.force * pass.stress * pass.length * strip.width;
  s.torque   = e.traction * pass.stress * pass.length * strip.width * pass.bite->roll_radius;
  s.friction = friction_value(strip.friction, u[grid.bulk(Bulk::friction)]);
  add_balances(out, pass, grid, e, u);
  const StripMaterial material{&strip.flow_stress, 1, 0, 0};
  s.entry_flow_stress = material_flow_stress(material, pass.inlet_strain);
  s.exit_flow_stress =
      material_flow_stress(material, pass.inlet_strain + std::log(strip.entry_thickness / flow.exit_thickness));
  if (has_film(strip.friction))
    s.film_thickness = bite::film_thickness(
        strip.friction,
        bite::Inlet<double>{pass.speed, s.entry_speed, s.exit_speed, pass.bite->roll_radius,
                            pass.arc_length * pass.length, s.entry_flow_stress - strip.entry_tension});
  s.force_by.fill(not_given);
  s.torque_by.fill(not_given);
  if (pass.model.derivatives) {
    add_derivatives(out, pass, solved, roll, stage, u, true);
    if (pass.model.arc == bite::Arc::elastic)
      add_derivatives(out, pass, solved, roll, stage, u, false);
  }
  add_notes(out, pass);
  return out;
}
}  // namespace mill::fem
