#include "fem/strip/rigid_plastic/strip_flow_equations.h"
#include <cmath>

// Elements, ends and streamlines of the rolled strip.  theory.md 18.2, 18.3
namespace mill::fem {
namespace {
using bite::Dual;

// What the equations of a point look at; the first ten come from the unknowns of the element.
enum Seen {
  x_along,
  x_through,
  y_along,
  y_through,
  mean_pressure,
  half_width,
  slope,
  half_height,
  strain,
  speed,
  flow_stress_factor,
  cutoff
};
constexpr int n_seen = 12;
using Number         = Dual<n_seen>;

// Unknowns of an element: velocities 2 (3 a + b) + component, corner pressures, heights of the lower and upper
// row, abscissae of both spines, strains on the left spine, factor on the flow stress, least rate g0.
constexpr int pressures = 18, lower = 22, upper = 25, abscissae = 28, strains = 30, factor = 33, least = 34,
              n_local = 35;
constexpr int n_rows  = 22;
using Local           = Eigen::Matrix<double, n_local, 1>;
using Seeing          = Eigen::Matrix<double, n_seen, n_local>;

struct Point {
  Seeing seeing;
  Number of[n_seen];
  Number xx, yy, xy, shear_square;  // rate of deformation, 2 D:D
  Number strain_increment;          // strain per unit of the path along the element
  Local strain_increment_by;
};

struct Element {
  const StripGrid &grid;
  int I, J;
  std::array<int, n_local> column;

  Element(const StripGrid &g, const int i, const int j) : grid(g), I(i), J(j)
  {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        for (int c = 0; c < 2; ++c)
          column[2 * (3 * a + b) + c] = g.velocity(2 * I + a, 2 * J + b, c);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        column[pressures + 2 * a + b] = g.pressure(I + a, J + b);
    for (int a = 0; a < 3; ++a) {
      column[lower + a]   = g.height(2 * I + a, J);
      column[upper + a]   = g.height(2 * I + a, J + 1);
      column[strains + a] = g.strain(I, J, a);
    }
    column[abscissae] = column[abscissae + 1] = column[least] = -1;  // spread over others by add()
    column[factor]                                            = g.input(bite::Input::flow_stress);
  }

  double abscissa(const StripAssembly &assembly, const int side) const
  {
    const auto &s = grid.spine[I + side];
    return s[0] * assembly.value(grid.whole(Whole::entry)) + s[1] * assembly.value(grid.whole(Whole::exit)) + s[2];
  }

  void add(StripAssembly &assembly, const int row, const double value, const Local &by) const
  {
    assembly.add(row, value);
    for (int l = 0; l < n_local; ++l)
      assembly.add(row, column[l], by[l]);
    for (int side = 0; side < 2; ++side) {
      assembly.add(row, grid.whole(Whole::entry), by[abscissae + side] * grid.spine[I + side][0]);
      assembly.add(row, grid.whole(Whole::exit), by[abscissae + side] * grid.spine[I + side][1]);
    }
    const double share = assembly.stage.cutoff_strain_rate * by[least];
    assembly.add(row, grid.input(bite::Input::entry_thickness), share * assembly.pass.mean_rate_by[0]);
    assembly.add(row, grid.input(bite::Input::exit_thickness), share * assembly.pass.mean_rate_by[1]);
    assembly.add(row, grid.input(bite::Input::arc_radius), share * assembly.pass.mean_rate_by[2]);
  }
};

// How the values at a point follow from the unknowns of the element.
Seeing seeing_of(const StripShapes &s, const int q)
{
  Seeing see     = Seeing::Zero();
  const double t = s.point[q / 3], up = 0.5 * (1 + s.point[q % 3]);
  for (int n = 0; n < 9; ++n) {
    see(x_along, 2 * n)       = s.along(q, n);
    see(x_through, 2 * n)     = s.through(q, n);
    see(y_along, 2 * n + 1)   = s.along(q, n);
    see(y_through, 2 * n + 1) = s.through(q, n);
    see(speed, 2 * n)         = s.value(q, n);
  }
  for (int n = 0; n < 4; ++n)
    see(mean_pressure, pressures + n) = s.corner(q, n);
  see(half_width, abscissae)     = -0.5;
  see(half_width, abscissae + 1) = 0.5;
  for (int a = 0; a < 3; ++a) {
    see(slope, lower + a)       = (1 - up) * quadratic_slope(t, a);
    see(slope, upper + a)       = up * quadratic_slope(t, a);
    see(half_height, lower + a) = -0.5 * quadratic(t, a);
    see(half_height, upper + a) = 0.5 * quadratic(t, a);
  }
  see(flow_stress_factor, factor) = 1;
  see(cutoff, least)              = 1;
  return see;
}

void see_point(Point &p, const Seeing &seeing, const Local &local)
{
  p.seeing                                      = seeing;
  const Eigen::Matrix<double, n_seen, 1> values = seeing * local;
  for (int m = 0; m < n_seen; ++m)
    p.of[m] = Number::variable(values[m], m);
  // Spines are straight and upright: dx = half_width dxi, dy = slope dxi + half_height deta.
  const Number tilt = p.of[slope] / p.of[half_height];
  p.xx              = (p.of[x_along] - p.of[x_through] * tilt) / p.of[half_width];
  p.yy              = p.of[y_through] / p.of[half_height];
  p.xy = 0.5 * (p.of[x_through] / p.of[half_height] + (p.of[y_along] - p.of[y_through] * tilt) / p.of[half_width]);
  p.shear_square = 2.0 * (p.xx * p.xx + p.yy * p.yy + 2.0 * (p.xy * p.xy));
  // Strain by plastic work, (18.6): its rate vanishes where the strip is all but rigid.
  p.strain_increment =
      p.shear_square * p.of[half_width] / (2.0 * sqrt(p.shear_square + p.of[cutoff] * p.of[cutoff]) * p.of[speed]);
  p.strain_increment_by.setZero();
  for (int m = 0; m < n_seen; ++m)
    if (m != strain)
      p.strain_increment_by += p.strain_increment.by[m] * p.seeing.row(m).transpose();
}

// D/norm as the last Newton step predicted it from there, (18.14), cut in length; kept for the next step.
Eigen::Vector3d predicted_direction(StripAssembly &assembly, const int point, const Eigen::Vector3d &rate,
                                    const double norm)
{
  const auto inner = [](const Eigen::Vector3d &a, const Eigen::Vector3d &b) {
    return 2 * (a[0] * b[0] + a[1] * b[1] + 2 * a[2] * b[2]);
  };
  Eigen::Vector3d direction = rate / norm;
  if (assembly.before) {
    const double *old = &assembly.before->bulk(0, point);
    const Eigen::Vector3d old_rate(old[0], old[1], old[2]), old_direction(old[4], old[5], old[6]);
    direction           = old[3] == 0 ? old_direction
                                      : Eigen::Vector3d(rate / old[3] - old_direction * (inner(old_rate, rate - old_rate) /
                                                                               (old[3] * old[3])));
    const double length = std::sqrt(inner(direction, direction));
    if (!(length <= assembly.longest))
      direction *= assembly.longest / length;
  }
  double *kept = &assembly.after.bulk(0, point);
  for (int m = 0; m < 3; ++m) {
    kept[m]     = rate[m];
    kept[4 + m] = direction[m];
  }
  kept[3] = norm;
  return direction;
}
}  // namespace

double StripAssembly::value(const int column) const
{
  if (column < 0)
    return 0;
  if (column < grid.n_unknowns)
    return unknowns[column];
  const Strip &strip = pass.bite->strip;
  switch (bite::Input(column - grid.n_unknowns)) {
  case bite::Input::entry_thickness:
    return strip.entry_thickness / pass.length;
  case bite::Input::exit_thickness:
    return strip.exit_thickness / pass.length;
  case bite::Input::entry_tension:
    return strip.entry_tension / pass.stress;
  case bite::Input::exit_tension:
    return strip.exit_tension / pass.stress;
  case bite::Input::friction:
    return 0;  // added to what the law says
  case bite::Input::flow_stress:
    return 1;
  case bite::Input::arc_radius:
    return std::isnan(pass.held_radius) ? pass.bite->roll_radius / pass.length : pass.held_radius;
  case bite::Input::roll_speed:
    return 1;
  case bite::Input::gap_rate:
    return pass.bite->gap_rate / pass.speed;
  }
  return 0;
}

void StripAssembly::add(const int row, const int column, const double derivative)
{
  if (column < 0 || grid.held[row])
    return;
  if (column < grid.n_unknowns)
    out.entries.emplace_back(row, column, derivative);
  else
    out.by_input(row, column - grid.n_unknowns) += derivative;
}

void StripAssembly::bulk()
{
  const StripShapes &shapes               = strip_shapes();
  const double g0                         = stage.cutoff_strain_rate * pass.mean_rate;
  static const std::vector<Seeing> seeing = [&] {
    std::vector<Seeing> s;
    for (int q = 0; q < 9; ++q)
      s.push_back(seeing_of(shapes, q));
    return s;
  }();
  Eigen::Matrix<double, n_rows, n_local> K;
  Eigen::Matrix<double, n_rows, 1> f;
  Eigen::Matrix<double, 5, n_seen> flux_by;
  Eigen::Matrix<double, 5, n_local> by_local;
  Point points[3];
  for (int I = 0; I < grid.n_along; ++I)
    for (int J = 0; J < grid.n_through; ++J) {
      const Element element(grid, I, J);
      Local local;
      for (int l = 0; l < n_local; ++l)
        local[l] = l == abscissae || l == abscissae + 1 ? element.abscissa(*this, l - abscissae)
                   : l == least                         ? g0
                                                        : value(element.column[l]);
      K.setZero();
      f.setZero();
      for (int b = 0; b < 3; ++b) {
        for (int a = 0; a < 3; ++a)
          see_point(points[a], seeing[3 * a + b], local);
        double strain_out   = local[strains + b];
        Local strain_out_by = Local::Unit(strains + b);
        for (int a = 0; a < 3; ++a) {
          strain_out += shapes.weight[a] * points[a].strain_increment.value;
          strain_out_by += shapes.weight[a] * points[a].strain_increment_by;
        }
        const int row = grid.strain(I + 1, J, b);
        element.add(*this, row, unknowns[row] - strain_out, -strain_out_by);
        add(row, row, 1);
        for (int a = 0; a < 3; ++a) {
          Point &p           = points[a];
          p.of[strain].value = local[strains + b];
          Local here         = Local::Unit(strains + b);
          for (int l = 0; l < 3; ++l) {
            p.of[strain].value += shapes.gathered(a, l) * points[l].strain_increment.value;
            here += shapes.gathered(a, l) * points[l].strain_increment_by;
          }
          p.seeing.row(strain) = here.transpose();
          Number viscosity     = 0.5 * p.of[flow_stress_factor] * scaled_flow_stress(pass, p.of[strain]) /
                             sqrt(p.shear_square + p.of[cutoff] * p.of[cutoff]);
          if (stage.picard)
            viscosity = Number(viscosity.value);
          const int q                     = 3 * a + b;
          const double norm               = std::sqrt(p.shear_square.value + g0 * g0);
          const Eigen::Vector3d direction = predicted_direction(*this, (I * grid.n_through + J) * 9 + q,
                                                                {p.xx.value, p.yy.value, p.xy.value}, norm);
          // 2 viscosity D, with the predicted direction in the place of D/norm in the slope of the viscosity.
          const auto stress = [&](const Number &rate, const double along_direction) {
            Number s = 2 * viscosity.value * rate;
            for (int n = 0; n < n_seen; ++n)
              s.by[n] += 2 * along_direction * norm * viscosity.by[n];
            return s;
          };
          const Number sx  = stress(p.xx, direction[0]) - p.of[mean_pressure];
          const Number sy  = stress(p.yy, direction[1]) - p.of[mean_pressure];
          const Number sxy = stress(p.xy, direction[2]);
          // Stress through the sides of the unit square, and the flux out of it.
          const Number flux[5] = {sx * p.of[half_height], sxy * p.of[half_width] - sx * p.of[slope],
                                  sxy * p.of[half_height], sy * p.of[half_width] - sxy * p.of[slope],
                                  p.of[half_height] * p.of[x_along] - p.of[slope] * p.of[x_through] +
                                      p.of[half_width] * p.of[y_through]};
          const double w       = shapes.weight[a] * shapes.weight[b];
          out.dissipation +=
              w * viscosity.value * p.shear_square.value * p.of[half_width].value * p.of[half_height].value;
          for (int m = 0; m < 5; ++m)
            for (int n = 0; n < n_seen; ++n)
              flux_by(m, n) = w * flux[m].by[n];
          by_local.noalias() = flux_by * p.seeing;
          for (int n = 0; n < 9; ++n)
            for (int c = 0; c < 2; ++c) {
              f[2 * n + c] +=
                  w * (shapes.along(q, n) * flux[2 * c].value + shapes.through(q, n) * flux[2 * c + 1].value);
              K.row(2 * n + c) +=
                  shapes.along(q, n) * by_local.row(2 * c) + shapes.through(q, n) * by_local.row(2 * c + 1);
            }
          for (int n = 0; n < 4; ++n) {
            f[pressures + n] -= w * shapes.corner(q, n) * flux[4].value;
            K.row(pressures + n) -= shapes.corner(q, n) * by_local.row(4);
          }
        }
      }
      for (int r = 0; r < n_rows; ++r)
        element.add(*this, element.column[r], f[r], K.row(r).transpose());
    }
}

void StripAssembly::ends()
{
  const int last_spine    = 2 * grid.n_along;
  const double simpson[3] = {1. / 6, 4. / 6, 1. / 6};
  using Flat              = Dual<3>;
  for (const bool outlet : {false, true})
    for (int J = 0; J < grid.n_through; ++J) {
      const int i = outlet ? last_spine : 0;
      const std::array<int, 3> columns{outlet ? grid.whole(Whole::tension)
                                              : grid.input(bite::Input::entry_tension),
                                       grid.height(i, J + 1), grid.height(i, J)};
      const Flat pull = Flat::variable(value(columns[0]), 0);
      const Flat side = Flat::variable(value(columns[1]), 1) - Flat::variable(value(columns[2]), 2);
      for (int a = 0; a < 3; ++a)
        add(grid.velocity(i, 2 * J + a, 0), (outlet ? -simpson[a] : stage.tension * simpson[a]) * (pull * side),
            columns);
    }
  // The strip comes in at its entry thickness, with the strain of the passes before.
  const double reference = pass.bite->strip.initial_thickness / pass.length;
  const std::array<int, 1> entry{grid.input(bite::Input::entry_thickness)};
  const auto thickness = Dual<1>::variable(value(entry[0]), 0);
  for (int J = 1; J <= grid.n_through; ++J) {
    const int row = grid.height(0, J);
    add(row, unknowns[row]);
    add(row, row, 1);
    add(row, -0.5 * grid.lines.rows[J] * thickness, entry);
  }
  for (int J = 0; J < grid.n_through; ++J)
    for (int k = 0; k < 3; ++k) {
      const int row = grid.strain(0, J, k);
      add(row, unknowns[row]);
      add(row, row, 1);
      if (!std::isnan(reference))
        add(row, log(thickness / reference), entry);
    }
}

void StripAssembly::streamlines()
{
  const double gauss = 1 / std::sqrt(3.);
  const int top      = grid.n_through;
  for (int J = 1; J <= top; ++J)
    for (int I = 0; I < grid.n_along; ++I) {
      const bool touches = J == top && 2 * I >= grid.first && 2 * I + 2 <= grid.last;
      if (!stage.free_surface) {
        for (const int i : {2 * I + 1, 2 * I + 2}) {
          if (J == top && i >= grid.first && i <= grid.last)
            continue;  // lies on the roll
          const int row = grid.height(i, J);
          const int from =
              J < top ? grid.height(i, top)
                      : grid.input(i < grid.first ? bite::Input::entry_thickness : bite::Input::exit_thickness);
          const double share = J < top ? grid.lines.rows[J] : 0.5;
          add(row, unknowns[row] - share * value(from));
          add(row, row, 1);
          add(row, from, -share);
        }
        continue;
      }
      if (touches)
        continue;
      // No flux through either half of the edge, (18.8).
      using Edge = Dual<11>;
      std::array<int, 11> columns;
      Edge u[3], v[3], y[3];
      for (int a = 0; a < 3; ++a) {
        columns[3 * a]     = grid.velocity(2 * I + a, 2 * J, 0);
        columns[3 * a + 1] = grid.velocity(2 * I + a, 2 * J, 1);
        columns[3 * a + 2] = grid.height(2 * I + a, J);
        u[a]               = Edge::variable(value(columns[3 * a]), 3 * a);
        v[a]               = Edge::variable(value(columns[3 * a + 1]), 3 * a + 1);
        y[a]               = Edge::variable(value(columns[3 * a + 2]), 3 * a + 2);
      }
      columns[9]    = grid.whole(Whole::entry);
      columns[10]   = grid.whole(Whole::exit);
      const auto &s = grid.spine[I], &e = grid.spine[I + 1];
      const Edge half = 0.5 * ((e[0] - s[0]) * Edge::variable(value(columns[9]), 9) +
                               (e[1] - s[1]) * Edge::variable(value(columns[10]), 10) + (e[2] - s[2]));
      for (const int part : {0, 1}) {
        Edge flux(0.);
        for (const double sign : {-1., 1.}) {
          const double t = 0.5 * ((part ? 1 : -1) + sign * gauss);
          Edge uu(0.), vv(0.), slope_here(0.);
          for (int a = 0; a < 3; ++a) {
            uu += quadratic(t, a) * u[a];
            vv += quadratic(t, a) * v[a];
            slope_here += quadratic_slope(t, a) * y[a];
          }
          flux += 0.5 * (uu * slope_here - vv * half);
        }
        const int i = 2 * I + 1 + part;
        // Where the surface reaches the roll its height is the roll's, and the flux places the entry.
        add(J == top && i == grid.first ? grid.whole(Whole::entry) : grid.height(i, J), flux, columns);
      }
    }
}
}  // namespace mill::fem
