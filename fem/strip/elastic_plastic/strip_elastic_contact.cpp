#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "fem/strip/elastic_plastic/strip_elastic_equations.h"
#include "reduce/bite/arc/half_plane.h"
#include "reduce/bite/sentence.h"
#include <cmath>

// Where roll and strip meet, the ends of the strip, and what the pass is given.
namespace mill::fem {
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double gap_unit = 0.01;  // gap that weighs as much as a pressure of one, over the entry thickness

// Row i: shares of the values at `at` (rising) that make the linear interpolation at to[i].
MatrixXd linear(const VectorXd &position, const VectorXd &to)
{
  MatrixXd W = MatrixXd::Zero(to.size(), position.size());
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    Eigen::Index k = 0;
    while (k + 2 < position.size() && position[k + 1] < to[i])
      ++k;
    const double t = (to[i] - position[k]) / (position[k + 1] - position[k]);
    if (t < -1e-9 || t > 1 + 1e-9)
      continue;
    W(i, k)     = 1 - t;
    W(i, k + 1) = t;
  }
  return W;
}
}  // namespace

ElasticRoll elastic_roll(const ElasticPass &pass, const ElasticGrid &grid, const bite::ArcFlexibility *flexibility)
{
  ElasticRoll roll;
  if (pass.model.arc == bite::Arc::rigid)
    return roll;
  // Everything runs with x of the bite here, i.e. against the strip.
  const int n = int(grid.x.size());
  int first = n, last = 0;
  for (int i = 0; i < n; ++i)
    if (grid.may_touch[i]) {
      first = std::min(first, i);
      last  = std::max(last, i);
    }
  const int m           = last - first + 3;  // with one spine beyond each end, where the pressure is zero
  const VectorXd x      = -pass.length * grid.x.segment(first - 1, m).reverse();
  const Material &steel = pass.bite->roll;
  MatrixXd influence    = bite::half_plane_flexibility(x, steel, pass.bite->roll_radius).influence;
  MatrixXd slope        = bite::half_plane_slope(x, steel);
  if (flexibility) {
    const VectorXd &positions = flexibility->position;
    if (positions[0] > x[0] || positions[positions.size() - 1] < x[m - 1])
      throw InputError(bite::sentence("the flexibility of the roll's surface is given from ", positions[0] * 1e3,
                                      " to ", positions[positions.size() - 1] * 1e3,
                                      " mm; the strip may touch the roll from ", x[0] * 1e3, " to ",
                                      x[m - 1] * 1e3, " mm"));
    // What the roll differs from a half plane is smooth and can be interpolated.
    const MatrixXd rest =
        flexibility->influence - bite::half_plane_flexibility(positions, steel, pass.bite->roll_radius).influence;
    const MatrixXd more = linear(positions, x) * rest * linear(x, positions);
    influence += more;
    for (int i = 0; i < m; ++i) {
      const int a = std::max(i - 1, 0), b = std::min(i + 1, m - 1);
      slope.row(i) += (more.row(b) - more.row(a)) / (x[b] - x[a]);
    }
  }
  // Per nodal force, scaled; displacement relative to the line of centres, so that the roll's height keeps its
  // size.
  roll.displacement = roll.slope = MatrixXd::Zero(n, n);
  int centre                     = 0;
  for (int i = 0; i < m; ++i)
    if (std::abs(x[i]) < std::abs(x[centre]))
      centre = i;
  for (int i = 1; i + 1 < m; ++i)
    for (int j = 1; j + 1 < m; ++j) {
      const int row = first - 1 + (m - 1 - i), column = first - 1 + (m - 1 - j);
      const double unit              = pass.stress / grid.tributary[column];
      roll.displacement(row, column) = (influence(i, j) - influence(centre, j)) * unit / pass.length;
      roll.slope(row, column)        = -slope(i, j) * unit;
    }
  return roll;
}

void ElasticAssembly::spine_contact(const int i)
{
  const int top = 2 * grid.n_through, row = grid.force(i), ux = grid.velocity(i, top, 0),
            vy = grid.velocity(i, top, 1), high = grid.height(i, grid.n_through);
  const int radius = grid.bulk(Bulk::radius), height = grid.bulk(Bulk::roll_height);
  ElasticContact &c = out.contacts[i];
  if (row < 0)
    return;
  // Abscissa and weight move with the ends of the contact.
  const int ends[2]                  = {grid.bulk(Bulk::entry_end), grid.bulk(Bulk::exit_end)};
  const std::array<double, 2> moving = grid.share(i);
  double x = grid.x[i], stretch_by[2] = {0, 0};
  const double longer = stretch(grid, unknowns), weight = longer * grid.tributary[i];
  if (grid.moves()) {
    x += moving[0] * (unknowns[ends[0]] - grid.x[grid.entry_spine]) +
         moving[1] * (unknowns[ends[1]] - grid.x[grid.exit_spine]);
    stretch_by[1] = 1 / (grid.x[grid.exit_spine] - grid.x[grid.entry_spine]);
    stretch_by[0] = -stretch_by[1];
  }
  // The roll here: its circle, lifted by the flattening
  using bite::Dual;
  const Dual<2> R = Dual<2>::variable(unknowns[radius], 0), along_x = Dual<2>::variable(x, 1);
  const Dual<2> under = sqrt(R * R - along_x * along_x), circle = R - under, lean = along_x / under;
  double surface = unknowns[height] + circle.value, slope = lean.value;
  const double flattened_slope = lifted_slope[i];
  const bool flattens          = roll.displacement.size() > 0 && stage.flattening > 0;
  if (flattens)
    for (int j = 0; j < grid.x.size(); ++j)
      if (grid.force(j) >= 0) {
        surface += stage.flattening * roll.displacement(i, j) * unknowns[grid.force(j)];
      }
  slope += flattened_slope;
  const bool follows = flattens && !stage.held_arc;
  // Slope and curvature of the flattening at a place of the roll, where its shape is held
  double held_slope = 0, held_curvature = 0;
  if (flattens && stage.held_arc) {
    held_slope     = flattened_slope;
    held_curvature = (lifted_slope[i + 1] - lifted_slope[i - 1]) / ((grid.x[i + 1] - grid.x[i - 1]) * longer);
  }
  const double force = unknowns[row], gap = surface - unknowns[high];
  c.surface  = surface;
  c.gap      = gap;
  c.pressure = force / weight;
  if (stage.held_shape) {
    const bool pressed = x > -pass.arc_length * (1 + 1e-9) && x < 1e-9;
    if (!pressed) {
      out.residual[row] += force;
      add(row, row, 1);
      return;
    }
    out.residual[row] += unknowns[vy] - slope * unknowns[ux];
    add(row, vy, 1);
    add(row, ux, -slope);
  } else {
    double by_gap = 0;
    if (grid.ends_of_contact) {
      // At both ends of the contact pressure and gap are zero: the gap here, the pressure in bulk().
      const bool touches = i >= grid.entry_spine && i <= grid.exit_spine;
      out.residual[row] += touches ? gap : force;
      add(row, row, touches ? 0 : 1);
      by_gap = touches ? 1 : 0;
    } else {
      // pressure >= 0, gap >= 0, one of them zero: Fischer and Burmeister's function, smoothed, (19.12)
      const double a = c.pressure, b = gap / gap_unit, S = std::sqrt(a * a + b * b + 2 * stage.softness);
      by_gap = -(1 - b / S);
      out.residual[row] -= gap_unit * (a + b - S);
      add(row, row, -gap_unit * (1 - a / S) / weight);
    }
    add(row, high, -by_gap);
    add(row, height, by_gap);
    add(row, radius, by_gap * circle.by[0]);
    for (int end = 0; end < 2; ++end)
      add(row, ends[end], by_gap * (circle.by[1] + held_slope) * moving[end]);
    if (follows)
      for (int j = 0; j < grid.x.size(); ++j)
        if (grid.force(j) >= 0)
          add(row, grid.force(j), by_gap * stage.flattening * roll.displacement(i, j));
  }
  // Forces on the strip: normal n, down, and friction along t, against the slip
  const int strain = i > 1 ? grid.state((i - 1) / 2, grid.n_through - 1, 2, 3) : grid.bulk(Bulk::inlet_strain);
  const int mu = grid.bulk(Bulk::friction), factor = grid.bulk(Bulk::stress_factor);
  const int h1 = grid.bulk(Bulk::entry_thickness), h2 = grid.bulk(Bulk::exit_thickness);
  using D   = Dual<10>;
  const D f = D::variable(force, 0), m = D::variable(slope, 1), u = D::variable(value(ux), 2),
          v = D::variable(value(vy), 3), coefficient = D::variable(unknowns[mu], 4),
          e = D::variable(unknowns[strain], 5), k_factor = D::variable(unknowns[factor], 6),
          w    = D::variable(weight, 9);
  const D norm = 1.0 / sqrt(1.0 + m * m), slip = (u + v * m) * norm - 1.0;
  const D d0              = stage.cutoff_slip * log(D::variable(unknowns[h1], 7) / D::variable(unknowns[h2], 8));
  const D sign            = slip / sqrt(slip * slip + d0 * d0),
          shear_yield     = 0.5 * k_factor * material_flow_stress(material, e);
  const Friction &law     = pass.bite->strip.friction;
  const auto traction_law = bite::traction_of(law, coefficient);
  const D k               = 2.0 * shear_yield * w;  // as a force, as f
  D limit(0.);
  if (!traction_law.slides) {
    // none where nothing presses
    const D pressure = f / w, pressed = stage.held_shape ? D(1.) : pressure / (sqrt(pressure * pressure) + 0.01);
    limit = bite::traction_limit(traction_law, f, k, D(-sign)) * pressed;
  } else {
    const D pressing = stage.held_shape ? D(1.2 * k.value) : f;
    c.limited        = coefficient.value * pressing.value / (shear_yield.value * weight);
    limit            = bite::traction_limit(traction_law, pressing, k, 1);
  }
  const D along = -1.0 * limit * sign, fx = (f * m + along) * norm, fy = (along * m - f) * norm;
  c.shear = along.value / weight;
  c.slip  = slip.value;
  out.force -= fy.value;
  out.force_x += fx.value;
  out.traction += along.value;
  out.friction_power -= along.value * slip.value;
  if (ux >= 0)
    out.residual[ux] -= fx.value;
  if (vy >= 0)
    out.residual[vy] -= fy.value;
  if (!tangent)
    return;
  const int columns[9] = {row, -1, ux, vy, mu, strain, factor, h1, h2};
  const auto each      = [&](const D &what, const auto &give) {
    for (int q = 0; q < 9; ++q)
      if (columns[q] >= 0)
        give(columns[q], what.by[q]);
    give(radius, what.by[1] * lean.by[0]);
    for (int end = 0; end < 2; ++end)
      give(ends[end], what.by[1] * ((lean.by[1] + held_curvature) * moving[end] -
                                    (follows ? flattened_slope / longer * stretch_by[end] : 0)) +
                               what.by[9] * grid.tributary[i] * stretch_by[end]);
    if (follows)
      for (int j = 0; j < grid.x.size(); ++j)
        if (grid.force(j) >= 0)
          give(grid.force(j), what.by[1] * stage.flattening * roll.slope(i, j) / longer);
  };
  each(fx, [&](const int column, const double d) { add(ux, column, -d); });
  each(fy, [&](const int column, const double d) {
    add(vy, column, -d);
    out.force_by[column] -= d;
  });
  each(along, [&](const int column, const double d) { out.traction_by[column] += d; });
}

void ElasticAssembly::contact()
{
  // Of given forces the differences of displacement do not change when the arc is stretched, the slopes do.
  lifted_slope.setZero(grid.x.size());
  if (roll.displacement.size() > 0 && stage.flattening > 0)
    for (int j = 0; j < grid.x.size(); ++j)
      if (grid.force(j) >= 0)
        lifted_slope += stage.flattening / stretch(grid, unknowns) * unknowns[grid.force(j)] * roll.slope.col(j);
  for (int i = 0; i < grid.x.size(); ++i)
    spine_contact(i);
}

void ElasticAssembly::bulk()
{
  const auto value_at = [&](const Bulk b) { return grid.bulk(b); };
  const auto entry_of = [&](const Bulk b) { return unknowns[grid.bulk(b)]; };
  const auto give     = [&](const Bulk b, const double given) {
    out.residual[value_at(b)] += entry_of(b) - given;
    add(value_at(b), value_at(b), 1);
  };
  const Strip &strip = pass.bite->strip;
  // Ends: the strip moves as a whole under its tension.
  const int last = int(grid.x.size()) - 1, outlet = grid.height(last, grid.n_through);
  const double s1 = entry_of(Bulk::entry_tension), s2 = entry_of(Bulk::exit_tension),
               h1 = entry_of(Bulk::entry_thickness);
  out.residual[value_at(Bulk::entry_speed)] += 0.5 * s1 * h1;
  add(value_at(Bulk::entry_speed), value_at(Bulk::entry_tension), 0.5 * h1);
  add(value_at(Bulk::entry_speed), value_at(Bulk::entry_thickness), 0.5 * s1);
  out.residual[value_at(Bulk::exit_speed)] -= s2 * unknowns[outlet];
  add(value_at(Bulk::exit_speed), value_at(Bulk::exit_tension), -unknowns[outlet]);
  add(value_at(Bulk::exit_speed), outlet, -s2);
  for (int J = 1; J <= grid.n_through; ++J) {
    const double share = 0.5 * J / grid.n_through;
    out.residual[grid.height(0, J)] += unknowns[grid.height(0, J)] - share * h1;
    add(grid.height(0, J), grid.height(0, J), 1);
    add(grid.height(0, J), value_at(Bulk::entry_thickness), -share);
  }
  // Stress at the inlet: tension, plane strain, elastic
  const double nu = strip.poisson_ratio;
  for (const auto &[which, share] :
       {std::pair(Bulk::inlet_pressure, -(1 + nu) / 3), std::pair(Bulk::inlet_xx, (2 - nu) / 3),
        std::pair(Bulk::inlet_yy, -(1 + nu) / 3)}) {
    give(which, share * s1);
    add(value_at(which), value_at(Bulk::entry_tension), -share);
  }
  const bool rolled_before = !std::isnan(strip.initial_thickness);
  give(Bulk::inlet_strain, rolled_before ? std::log(strip.initial_thickness / pass.length / h1) : 0);
  if (rolled_before)
    add(value_at(Bulk::inlet_strain), value_at(Bulk::entry_thickness), 1 / h1);
  // Height of the roll
  const int height   = value_at(Bulk::roll_height);
  const bool follows = roll.displacement.size() > 0 && !stage.held_shape;
  const int gauge    = follows ? grid.height(stage.thinnest, grid.n_through) : height;
  out.residual[height] += unknowns[gauge] - 0.5 * entry_of(Bulk::exit_thickness);
  add(height, gauge, 1);
  add(height, value_at(Bulk::exit_thickness), -0.5);
  give(Bulk::entry_thickness, 1);
  give(Bulk::exit_thickness, pass.exit);
  give(Bulk::entry_tension, strip.entry_tension / pass.stress);
  give(Bulk::exit_tension, strip.exit_tension / pass.stress);
  give(Bulk::stress_factor, 1);
  give(Bulk::radius, pass.radius);
  for (const auto &[end, spine] :
       {std::pair(Bulk::entry_end, grid.entry_spine), std::pair(Bulk::exit_end, grid.exit_spine)})
    if (grid.ends_of_contact) {
      out.residual[value_at(end)] += unknowns[grid.force(spine)] / grid.tributary[spine];
      add(value_at(end), grid.force(spine), 1 / grid.tributary[spine]);
    } else {
      give(end, grid.moves() ? grid.x[spine] : 0);
    }
  if (grid.moves() && !grid.ends_of_contact) {
    using D   = bite::Dual<3>;
    const D a = D::variable(h1, 0), b = D::variable(entry_of(Bulk::exit_thickness), 1),
            R      = D::variable(entry_of(Bulk::radius), 2);
    const D centre = R - 0.5 * (a - b), arc = -grid.entry_ratio * sqrt(R * R - centre * centre);
    const int row = value_at(Bulk::entry_end);
    out.residual[row] += grid.x[grid.entry_spine] - arc.value;
    add(row, value_at(Bulk::entry_thickness), -arc.by[0]);
    add(row, value_at(Bulk::exit_thickness), -arc.by[1]);
    add(row, value_at(Bulk::radius), -arc.by[2]);
  }
  if (!slides(strip.friction)) {
    give(Bulk::friction, 0);
  } else if (!pass.film) {
    give(Bulk::friction,
         bite::coulomb_coefficient(strip.friction, bite::Inlet<double>{pass.speed, 0, 0, 1, 1, 1}));
  } else {
    using D    = bite::Dual<2>;
    const D in = D::variable(entry_of(Bulk::entry_speed), 0), leaves = D::variable(entry_of(Bulk::exit_speed), 1);
    const double k = material_flow_stress(material, entry_of(Bulk::inlet_strain)) * pass.stress;
    const D mu     = bite::coulomb_coefficient(
            strip.friction,
            bite::Inlet<D>{D(pass.speed), pass.speed * in, pass.speed * leaves, D(pass.bite->roll_radius),
                           D(pass.arc_length * pass.length), D(k - strip.entry_tension)});
    give(Bulk::friction, mu.value);
    add(value_at(Bulk::friction), value_at(Bulk::entry_speed), -mu.by[0]);
    add(value_at(Bulk::friction), value_at(Bulk::exit_speed), -mu.by[1]);
  }
}

ElasticEquations elastic_equations(const ElasticPass &pass, const ElasticGrid &grid, const ElasticRoll &roll,
                                   const ElasticStage &stage, VectorXd &unknowns, RowMemory &memory,
                                   const bool tangent)
{
  ElasticAssembly a(pass, grid, roll, stage, unknowns, memory, tangent);
  for (int I = 0; I < grid.n_along; ++I)
    for (int J = 0; J < grid.n_through; ++J) {
      a.element(I, J);
      a.streamline(I, J);
    }
  a.contact();
  a.bulk();
  if (!a.out.solved)
    a.out.residual[0] = NAN;
  else
    memory = std::move(a.solved_rows);
  return std::move(a.out);
}
}  // namespace mill::fem
