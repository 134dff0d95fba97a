#include "fem/strip/elastic_plastic/strip_elastic_equations.h"
#include <array>

// Inside of the strip: stress along the rows, equilibrium, volume, streamlines.
namespace mill::fem {
namespace {
// Local columns: velocities, heights of the lower and the upper line, pressure here and upstream, upstream states
// of the three rows, factor on the flow stress, ends of the contact (they move the lines of the mesh).
constexpr int at_velocity = 0, at_lower = 18, at_upper = 21, at_pressure = 24, at_before = 27, at_state = 30,
              at_factor = 42, at_ends = 43;
int velocity_column(const int a, const int b, const int component)
{
  return at_velocity + 2 * (3 * a + b) + component;
}
// Linear pressure of an element: value in the middle, and slopes.
std::array<double, 3> pressure_shape(const double t, const double eta)
{
  return {1, t - 0.5, eta - 0.5};
}
}  // namespace

struct ElasticAssembly::Local {
  int I, J;
  double length;
  std::array<double, 2> length_by;  // by the ends of the contact
  std::array<int, n_local> id;
  std::array<double, n_local> u;
  std::array<std::array<double, 3>, 3> through, through_slope;  // (Gauss row, node)
  Eigen::Matrix<double, 18, n_local> K = Eigen::Matrix<double, 18, n_local>::Zero();
  Eigen::Matrix<double, 3, n_local> Kp = Eigen::Matrix<double, 3, n_local>::Zero();
  Eigen::Matrix<double, 18, 1> f       = Eigen::Matrix<double, 18, 1>::Zero();
  Eigen::Vector3d fp                   = Eigen::Vector3d::Zero();
};

ElasticAssembly::ElasticAssembly(const ElasticPass &p, const ElasticGrid &g, const ElasticRoll &r,
                                 const ElasticStage &s, Eigen::VectorXd &u, RowMemory &rows,
                                 const bool with_tangent)
    : pass(p), grid(g), roll(r), stage(s), unknowns(u), memory(rows), tangent(with_tangent)
{
  material        = {&p.bite->strip.flow_stress, p.stress, s.compliance * p.shear_compliance,
                     s.cutoff_strain_rate * p.mean_rate};
  bulk_compliance = s.compliance * p.bulk_compliance;
  out.residual.setZero(g.n_unknowns);
  out.force_by.setZero(g.n_unknowns);
  out.traction_by.setZero(g.n_unknowns);
  out.points.resize(6 * g.n_along * g.n_through);
  out.contacts.resize(g.x.size());
  if (with_tangent)
    out.entries.reserve(std::size_t(1400) * g.n_along * g.n_through);
}

ElasticAssembly::Flow ElasticAssembly::flow(const Local &e, const int r, const double t) const
{
  Flow q{};
  const double eta = gauss_rows().point[r];
  for (int a = 0; a < 3; ++a) {
    const double shape = along_shape(t, a), slope = along_slope(t, a);
    double u = 0, v = 0, u_through = 0, v_through = 0;
    for (int b = 0; b < 3; ++b) {
      const double x = e.u[velocity_column(a, b, 0)], y = e.u[velocity_column(a, b, 1)];
      u += e.through[r][b] * x;
      v += e.through[r][b] * y;
      u_through += e.through_slope[r][b] * x;
      v_through += e.through_slope[r][b] * y;
    }
    q.u += shape * u;
    q.u_along += slope * u;
    q.v_along += slope * v;
    q.u_through += shape * u_through;
    q.v_through += shape * v_through;
    q.slope += slope * ((1 - eta) * e.u[at_lower + a] + eta * e.u[at_upper + a]);
    q.height += shape * (e.u[at_upper + a] - e.u[at_lower + a]);
  }
  return q;
}

// Stress at the two points of a row with its derivatives by the local columns.
Eigen::Matrix<double, 8, ElasticAssembly::n_local> ElasticAssembly::stresses(Local &e, const int r,
                                                                             RowSolution &rows) const
{
  std::array<double, n_row_inputs> in{};
  Eigen::Matrix<double, n_row_inputs, n_local> by = Eigen::Matrix<double, n_row_inputs, n_local>::Zero();
  const double eta                                = gauss_rows().point[r];
  for (int k = 0; k < 2; ++k) {
    const double t = radau_point[k];
    const Flow q   = flow(e, r, t);
    using D        = bite::Dual<8>;
    const D ua = D::variable(q.u_along, 0), ut = D::variable(q.u_through, 1), va = D::variable(q.v_along, 2),
            vt = D::variable(q.v_through, 3), u = D::variable(q.u, 4), s = D::variable(q.slope, 5),
            h = D::variable(q.height, 6), length = D::variable(e.length, 7);
    const D lean = s / h, time = length / u;  // the element passes a point of the row in this time
    const std::array<D, n_at_point> g{(ua - ut * lean) / u, ut / h * time, (va - vt * lean) / u, vt / h * time,
                                      time};
    for (int m = 0; m < n_at_point; ++m) {
      in[n_at_point * k + m] = g[m].value;
      if (!tangent)
        continue;
      auto row = by.row(n_at_point * k + m);
      for (int a = 0; a < 3; ++a) {
        const double shape = along_shape(t, a), slope = along_slope(t, a);
        for (int b = 0; b < 3; ++b) {
          row[velocity_column(a, b, 0)] += g[m].by[0] * slope * e.through[r][b] +
                                           g[m].by[1] * shape * e.through_slope[r][b] +
                                           g[m].by[4] * shape * e.through[r][b];
          row[velocity_column(a, b, 1)] +=
              g[m].by[2] * slope * e.through[r][b] + g[m].by[3] * shape * e.through_slope[r][b];
        }
        row[at_lower + a] += g[m].by[5] * slope * (1 - eta) - g[m].by[6] * shape;
        row[at_upper + a] += g[m].by[5] * slope * eta + g[m].by[6] * shape;
      }
      for (int end = 0; end < 2; ++end)
        row[at_ends + end] += g[m].by[7] * e.length_by[end];
    }
  }
  for (int s = 0; s < 4; ++s) {
    in[upstream_xx + s]                       = e.u[at_state + 4 * r + s];
    by(upstream_xx + s, at_state + 4 * r + s) = 1;
  }
  in[stress_factor]            = e.u[at_factor];
  by(stress_factor, at_factor) = 1;
  const std::size_t place      = 3 * (e.I * grid.n_through + e.J) + r,
                    n_rows     = 3 * std::size_t(grid.n_along) * grid.n_through;
  rows = solve_row(material, in, memory.size() == n_rows ? &memory[place] : nullptr, tangent);
  if (!tangent)
    return Eigen::Matrix<double, 8, n_local>::Zero();
  return rows.by * by;
}

void ElasticAssembly::equilibrium(Local &e, const int r, const int k, const ElasticPoint &p,
                                  const Eigen::Matrix<double, 3, n_local> &by)
{
  const double t = radau_point[k], eta = gauss_rows().point[r], weight = radau_weight[k] * gauss_rows().weight[r];
  const Flow q     = flow(e, r, t);
  const auto shape = pressure_shape(t, eta);
  const double pressure =
      e.u[at_pressure] * shape[0] + e.u[at_pressure + 1] * shape[1] + e.u[at_pressure + 2] * shape[2];
  const double xx = p.xx - pressure, yy = p.yy - pressure;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const int row        = velocity_column(a, b, 0);
      const double along   = along_slope(t, a) * e.through[r][b],
                   through = along_shape(t, a) * e.through_slope[r][b];
      const double gx = weight * (along * q.height - through * q.slope), gy = weight * through * e.length;
      e.f[row] += xx * gx + p.xy * gy;
      e.f[row + 1] += p.xy * gx + yy * gy;
      if (!tangent)
        continue;
      e.K.row(row) += gx * by.row(0) + gy * by.row(2);
      e.K.row(row + 1) += gx * by.row(2) + gy * by.row(1);
      for (int m = 0; m < 3; ++m) {
        e.K(row, at_pressure + m) -= gx * shape[m];
        e.K(row + 1, at_pressure + m) -= gy * shape[m];
      }
      for (int end = 0; end < 2; ++end) {
        e.K(row, at_ends + end) += p.xy * weight * through * e.length_by[end];
        e.K(row + 1, at_ends + end) += yy * weight * through * e.length_by[end];
      }
      for (int c = 0; c < 3; ++c) {
        const double n = along_shape(t, c), d = along_slope(t, c);
        const double lower = weight * (-along * n - through * d * (1 - eta)),
                     upper = weight * (along * n - through * d * eta);
        e.K(row, at_lower + c) += xx * lower;
        e.K(row, at_upper + c) += xx * upper;
        e.K(row + 1, at_lower + c) += p.xy * lower;
        e.K(row + 1, at_upper + c) += p.xy * upper;
      }
    }
}

// div v + v.grad p / K at a point, (19.9)
void ElasticAssembly::volume(Local &e, const int r, const int k)
{
  const double t = radau_point[k], eta = gauss_rows().point[r], weight = radau_weight[k] * gauss_rows().weight[r];
  const Flow q      = flow(e, r, t);
  const auto shape  = pressure_shape(t, eta);
  const double rise = bulk_compliance * e.u[at_pressure + 1];  // of pressure along the element
  const double swell =
      q.u_along * q.height - q.u_through * q.slope + q.v_through * e.length + q.u * rise * q.height;
  for (int m = 0; m < 3; ++m) {
    const double w = weight * shape[m];
    e.fp[m] += w * swell;
    if (!tangent)
      continue;
    for (int a = 0; a < 3; ++a) {
      const double n = along_shape(t, a), d = along_slope(t, a);
      for (int b = 0; b < 3; ++b) {
        e.Kp(m, velocity_column(a, b, 0)) +=
            w * (d * e.through[r][b] * q.height - n * e.through_slope[r][b] * q.slope +
                 rise * n * e.through[r][b] * q.height);
        e.Kp(m, velocity_column(a, b, 1)) += w * n * e.through_slope[r][b] * e.length;
      }
      const double wide = q.u_along + q.u * rise;
      e.Kp(m, at_lower + a) += w * (-wide * n - q.u_through * d * (1 - eta));
      e.Kp(m, at_upper + a) += w * (wide * n - q.u_through * d * eta);
    }
    e.Kp(m, at_pressure + 1) += w * bulk_compliance * q.u * q.height;
    for (int end = 0; end < 2; ++end)
      e.Kp(m, at_ends + end) += w * q.v_through * e.length_by[end];
  }
}

// Pressure that flows in over the upstream face, where it may step
void ElasticAssembly::upstream_face(Local &e, const int r)
{
  const double eta = gauss_rows().point[r], weight = bulk_compliance * gauss_rows().weight[r];
  const auto here = pressure_shape(0, eta), before = pressure_shape(1, eta);
  double u = 0, step = 0;
  for (int b = 0; b < 3; ++b)
    u += e.through[r][b] * e.u[velocity_column(0, b, 0)];
  for (int m = 0; m < 3; ++m)
    step += here[m] * e.u[at_pressure + m] - before[m] * e.u[at_before + m];
  const double height = e.u[at_upper] - e.u[at_lower];
  for (int m = 0; m < 3; ++m) {
    const double w = weight * here[m];
    e.fp[m] += w * step * u * height;
    if (!tangent)
      continue;
    for (int b = 0; b < 3; ++b)
      e.Kp(m, velocity_column(0, b, 0)) += w * step * height * e.through[r][b];
    e.Kp(m, at_upper) += w * step * u;
    e.Kp(m, at_lower) -= w * step * u;
    for (int n = 0; n < 3; ++n) {
      e.Kp(m, at_pressure + n) += w * u * height * here[n];
      e.Kp(m, at_before + n) -= w * u * height * before[n];
    }
  }
}

std::pair<double, std::array<double, 2>> ElasticAssembly::element_length(const int I) const
{
  double length = grid.x[2 * I + 2] - grid.x[2 * I];
  std::array<double, 2> by{};
  if (grid.moves()) {
    const std::array<double, 2> moved{unknowns[grid.bulk(Bulk::entry_end)] - grid.x[grid.entry_spine],
                                      unknowns[grid.bulk(Bulk::exit_end)] - grid.x[grid.exit_spine]};
    for (int end = 0; end < 2; ++end) {
      by[end] = grid.share(2 * I + 2)[end] - grid.share(2 * I)[end];
      length += by[end] * moved[end];
    }
  }
  return {length, by};
}

void ElasticAssembly::element(const int I, const int J)
{
  Local e;
  e.I                            = I;
  e.J                            = J;
  const auto [length, length_by] = element_length(I);
  e.length                       = length;
  e.length_by                    = length_by;
  e.id.fill(-1);
  e.id[at_ends]     = grid.bulk(Bulk::entry_end);
  e.id[at_ends + 1] = grid.bulk(Bulk::exit_end);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 2; ++c)
        e.id[velocity_column(a, b, c)] = grid.velocity(2 * I + a, 2 * J + b, c);
    e.id[at_lower + a] = grid.height(2 * I + a, J);
    e.id[at_upper + a] = grid.height(2 * I + a, J + 1);
  }
  for (int m = 0; m < 3; ++m) {
    e.id[at_pressure + m] = grid.pressure(I, J, m);
    if (I > 0)
      e.id[at_before + m] = grid.pressure(I - 1, J, m);
  }
  for (int r = 0; r < 3; ++r)
    if (I > 0) {
      for (int s = 0; s < 4; ++s)
        e.id[at_state + 4 * r + s] = grid.state(I - 1, J, r, s);
    } else {
      e.id[at_state + 4 * r]     = grid.bulk(Bulk::inlet_xx);
      e.id[at_state + 4 * r + 1] = grid.bulk(Bulk::inlet_yy);
      e.id[at_state + 4 * r + 3] = grid.bulk(Bulk::inlet_strain);
    }
  if (I == 0)
    e.id[at_before] = grid.bulk(Bulk::inlet_pressure);
  e.id[at_factor] = grid.bulk(Bulk::stress_factor);
  for (int l = 0; l < n_local; ++l)
    e.u[l] = value(e.id[l]);
  for (int r = 0; r < 3; ++r)
    for (int b = 0; b < 3; ++b) {
      e.through[r][b]       = along_shape(gauss_rows().point[r], b);
      e.through_slope[r][b] = along_slope(gauss_rows().point[r], b);
    }
  for (int r = 0; r < 3; ++r) {
    RowSolution rows;
    const Eigen::Matrix<double, 8, n_local> by = stresses(e, r, rows);
    out.solved                                 = out.solved && rows.solved;
    solved_rows.push_back(rows.state);
    const double strain   = e.u[at_state + 4 * r + 3],
                 shear[2] = {rows.state[plastic_shear], rows.state[n_row_state + plastic_shear]};
    for (int k = 0; k < 2; ++k) {
      const RadauStage &stage_k = radau[k];
      ElasticPoint &p           = out.points[2 * (3 * (I * grid.n_through + J) + r) + k];
      p.xx                      = rows.state[n_row_state * k + stress_xx];
      p.yy                      = rows.state[n_row_state * k + stress_yy];
      p.xy                      = rows.state[n_row_state * k + stress_xy];
      p.shear                   = shear[k];
      p.strain     = strain + 0.5 * (stage_k.gathered_own * shear[k] + stage_k.gathered_other * shear[1 - k]);
      p.yields     = rows.plastic[k] && shear[k] > 1e-9;
      const Flow q = flow(e, r, radau_point[k]);
      p.rate       = shear[k] * q.u / e.length;
      // Dissipation: gamma times the shear stress |s|
      const double zz = p.xx + p.yy, size = std::sqrt(0.5 * (p.xx * p.xx + p.yy * p.yy + zz * zz) + p.xy * p.xy);
      out.plastic_power += radau_weight[k] * gauss_rows().weight[r] * e.length * q.height * p.rate * size;
      equilibrium(e, r, k, p, by.middleRows<3>(n_row_state * k));
      volume(e, r, k);
    }
    if (bulk_compliance > 0)
      upstream_face(e, r);
    // State behind the element: (xx, yy, xy, strain) of the last point
    const ElasticPoint &last = out.points[2 * (3 * (I * grid.n_through + J) + r) + 1];
    const double state[4]    = {last.xx, last.yy, last.xy, last.strain};
    for (int s = 0; s < 4; ++s) {
      const int row = grid.state(I, J, r, s);
      unknowns[row] = state[s];
      if (!tangent)
        continue;
      Row d = s < 3 ? Row(by.row(n_row_state + s))
                    : Row(0.5 * (radau[1].gathered_other * by.row(plastic_shear) +
                                 radau[1].gathered_own * by.row(n_row_state + plastic_shear)));
      if (s == 3)
        d[at_state + 4 * r + 3] += 1;
      add(row, row, 1);
      for (int l = 0; l < at_pressure; ++l)
        add(row, e.id[l], -d[l]);
      for (int m = 0; m < 4; ++m)
        add(row, e.id[at_state + 4 * r + m], -d[at_state + 4 * r + m]);
      for (int l = at_factor; l < n_local; ++l)
        add(row, e.id[l], -d[l]);
    }
  }
  for (int l = 0; l < 18; ++l) {
    if (e.id[l] < 0)
      continue;
    out.residual[e.id[l]] += e.f[l];
    for (int m = 0; m < n_local; ++m)
      if (m < at_before || m >= at_state)
        add(e.id[l], e.id[m], e.K(l, m));
  }
  for (int l = 0; l < 3; ++l) {
    const int row = e.id[at_pressure + l];
    out.residual[row] += e.fp[l];
    for (int m = 0; m < n_local; ++m)
      if (m < at_state || m >= at_ends)
        add(row, e.id[m], e.Kp(l, m));
  }
}

// v h - u y' = 0 at the Radau points of the upper line of an element, (19.10)
void ElasticAssembly::streamline(const int I, const int J)
{
  const auto [length, length_by] = element_length(I);
  for (int k = 0; k < 2; ++k) {
    const int row = grid.height(2 * I + 1 + k, J + 1);
    if (stage.held_shape) {
      add(row, row, 1);
      continue;
    }
    double u = 0, v = 0, slope = 0;
    for (int a = 0; a < 3; ++a) {
      const int i = 2 * I + a;
      u += along_shape(radau_point[k], a) * value(grid.velocity(i, 2 * J + 2, 0));
      v += along_shape(radau_point[k], a) * value(grid.velocity(i, 2 * J + 2, 1));
      slope += along_slope(radau_point[k], a) * value(grid.height(i, J + 1));
    }
    out.residual[row] += v * length - u * slope;
    add(row, grid.bulk(Bulk::entry_end), v * length_by[0]);
    add(row, grid.bulk(Bulk::exit_end), v * length_by[1]);
    for (int a = 0; a < 3; ++a) {
      const int i = 2 * I + a;
      add(row, grid.velocity(i, 2 * J + 2, 0), -along_shape(radau_point[k], a) * slope);
      add(row, grid.velocity(i, 2 * J + 2, 1), along_shape(radau_point[k], a) * length);
      add(row, grid.height(i, J + 1), -along_slope(radau_point[k], a) * u);
    }
  }
}
}  // namespace mill::fem
