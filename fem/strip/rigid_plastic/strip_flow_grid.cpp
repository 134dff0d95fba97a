#include "fem/strip/rigid_plastic/strip_flow_grid.h"
#include "core/case/errors.h"
#include <algorithm>
#include <cmath>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>
#include <fstream>

namespace mill::fem {
namespace {
using Eigen::VectorXd;

std::vector<double> distinct(std::vector<double> values, const double tolerance)
{
  std::sort(values.begin(), values.end());
  std::vector<double> out;
  for (const double v : values)
    if (out.empty() || v - out.back() > tolerance)
      out.push_back(v);
  return out;
}

VectorXd vector_of(const std::vector<double> &values)
{
  return Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size()));
}

VectorXd every_second(const VectorXd &lines)
{
  VectorXd out((lines.size() + 1) / 2);
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out[i] = lines[2 * i];
  return out;
}

// Interval of rising lines that holds t, and the place -1 .. 1 in it.
struct Place1 {
  int interval;
  double t;
};
Place1 place_in(const VectorXd &lines, const double t)
{
  const auto *begin = lines.data(), *end = begin + lines.size();
  const int i = std::clamp(int(std::upper_bound(begin, end, t) - begin) - 1, 0, int(lines.size()) - 2);
  return {i, std::clamp(2 * (t - lines[i]) / (lines[i + 1] - lines[i]) - 1, -1., 1.)};
}

// Place of a corner or middle spine along the strip: 0 to 1 before the contact, 1 to 2 on it, 2 to 3 behind it.
VectorXd along_strip(const StripLines &lines)
{
  VectorXd s(lines.inlet.size() + lines.arc.size() + lines.outlet.size() - 2);
  s << (1 - lines.inlet.array() / lines.inlet[0]).matrix(),
      (1 + lines.arc.tail(lines.arc.size() - 1).array()).matrix(),
      (2 + lines.outlet.tail(lines.outlet.size() - 1).array() / lines.outlet[lines.outlet.size() - 1]).matrix();
  return s;
}

double at_node(const VectorXd &lines, const int i)
{
  return i % 2 == 0 ? lines[i / 2] : 0.5 * (lines[i / 2] + lines[i / 2 + 1]);
}
}  // namespace

StripLines strip_lines(const MeshFile &mesh)
{
  dealii::Triangulation<2> triangulation;
  dealii::GridIn<2> reader(triangulation);
  std::ifstream file(mesh.path);
  if (!file)
    throw InputError("the mesh " + mesh.path + " of the strip cannot be read");
  reader.read_msh(file);
  const auto roll = mesh.groups.find("roll");
  if (roll == mesh.groups.end())
    throw InputError("the mesh " + mesh.path + " has no boundary group roll: it is no mesh of a strip");
  double low = 1e300, high = -1e300, inlet = -1e300;
  for (const auto &point : triangulation.get_vertices())
    inlet = std::max(inlet, point[0]);
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && int(face->boundary_id()) == roll->second)
        for (const int v : {0, 1}) {
          low  = std::min(low, face->vertex(v)[0]);
          high = std::max(high, face->vertex(v)[0]);
        }
  const double small = 1e-9 * (high - low);
  std::vector<double> x, y;
  for (const auto &point : triangulation.get_vertices()) {
    x.push_back(-point[0]);
    if (point[0] > inlet - small)
      y.push_back(point[1]);
  }
  x = distinct(x, small);
  y = distinct(y, 1e-9 * *std::max_element(y.begin(), y.end()));
  if (x.size() * y.size() != triangulation.n_vertices())
    throw InputError("the nodes of the mesh " + mesh.path + " are not on lines across the strip");
  std::vector<double> before, on, behind;
  for (const double v : x) {
    if (v <= -high + small)
      before.push_back(-high - v);
    if (v >= -high - small && v <= -low + small)
      on.push_back((v + high) / (high - low));
    if (v >= -low - small)
      behind.push_back(v + low);
  }
  StripLines lines{vector_of(before), vector_of(on), vector_of(behind), vector_of(y) / y.back()};
  lines.inlet[lines.inlet.size() - 1] = lines.outlet[0] = lines.arc[0] = 0;
  lines.arc[lines.arc.size() - 1]                                      = 1;
  return lines;
}

bool coarsened(StripLines &lines)
{
  for (const VectorXd *v : {&lines.inlet, &lines.arc, &lines.outlet, &lines.rows})
    if (v->size() % 2 == 0)
      return false;
  if (lines.arc.size() < 25 || lines.rows.size() < 7)
    return false;
  for (VectorXd *v : {&lines.inlet, &lines.arc, &lines.outlet, &lines.rows})
    *v = every_second(*v);
  return true;
}

StripGrid strip_grid(const StripLines &lines)
{
  StripGrid g;
  g.lines          = lines;
  const int before = int(lines.inlet.size()) - 1, on = int(lines.arc.size()) - 1,
            behind = int(lines.outlet.size()) - 1;
  g.n_along        = before + on + behind;
  g.n_through      = int(lines.rows.size()) - 1;
  g.first          = 2 * before;
  g.last           = 2 * (before + on);
  for (int i = 0; i < before; ++i)
    g.spine.push_back({1, 0, -lines.inlet[i]});
  for (int i = 0; i < on; ++i)
    g.spine.push_back({1 - lines.arc[i], lines.arc[i], 0});
  for (int i = 0; i <= behind; ++i)
    g.spine.push_back({0, 1, lines.outlet[i]});

  // The mesh in its own indices: spines and rows are placed by unknowns, so that this is all deal.II needs to
  // know.
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {unsigned(g.n_along), unsigned(g.n_through)},
                                                    dealii::Point<2>(0, 0),
                                                    dealii::Point<2>(g.n_along, g.n_through));
  const dealii::FESystem<2> fe(dealii::FE_Q<2>(2), 2, dealii::FE_Q<2>(1), 1);
  dealii::DoFHandler<2> dofs(triangulation);
  dofs.distribute_dofs(fe);
  const int columns = 2 * g.n_along + 1, rows = 2 * g.n_through + 1;
  g.velocity_of.resize(2 * columns * rows);
  g.pressure_of.resize((g.n_along + 1) * (g.n_through + 1));
  std::vector<dealii::types::global_dof_index> local(fe.n_dofs_per_cell());
  for (const auto &cell : dofs.active_cell_iterators()) {
    cell->get_dof_indices(local);
    for (unsigned l = 0; l < local.size(); ++l) {
      const auto at       = cell->vertex(0) + fe.unit_support_point(l);
      const int component = int(fe.system_to_component_index(l).first);
      const int i = int(std::lround(2 * at[0])), j = int(std::lround(2 * at[1]));
      if (component < 2)
        g.velocity_of[2 * (i * rows + j) + component] = int(local[l]);
      else
        g.pressure_of[i / 2 * (g.n_through + 1) + j / 2] = int(local[l]);
    }
  }
  int n             = int(dofs.n_dofs());
  const auto number = [&n](std::vector<int> &of, const std::size_t size) {
    of.resize(size);
    for (int &index : of)
      index = n++;
  };
  number(g.height_of, std::size_t(columns) * g.n_through);
  number(g.strain_of, std::size_t(3) * (g.n_along + 1) * g.n_through);
  g.contact_of.assign(columns, -1);
  for (int i = g.first; i <= g.last; ++i)
    g.contact_of[i] = n++;
  g.n_unknowns = n + n_whole;
  g.held.assign(g.n_unknowns, 0);
  for (int i = 0; i < columns; ++i)
    g.held[g.velocity(i, 0, 1)] = 1;
  for (int j = 0; j < rows; ++j)
    g.held[g.velocity(0, j, 1)] = g.held[g.velocity(columns - 1, j, 1)] = 1;
  return g;
}

Eigen::VectorXd interpolated(const StripGrid &from, const VectorXd &unknowns, const StripGrid &to)
{
  VectorXd out       = VectorXd::Zero(to.n_unknowns);
  const VectorXd old = along_strip(from.lines), lines = along_strip(to.lines);
  const StripShapes &shapes = strip_shapes();
  const auto value          = [&](const int index) { return index < 0 ? 0. : unknowns[index]; };
  // Strain between the Gauss rows of an element, on one corner spine.
  const auto strain = [&](const int I, const Place1 &row) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      double l = 1;
      for (int m = 0; m < 3; ++m)
        if (m != k)
          l *= (row.t - shapes.point[m]) / (shapes.point[k] - shapes.point[m]);
      sum += l * value(from.strain(I, row.interval, k));
    }
    return sum;
  };
  for (int i = 0; i <= 2 * to.n_along; ++i) {
    const Place1 along = place_in(old, at_node(lines, i));
    const int I        = along.interval;
    const double right = 0.5 * (1 + along.t);
    for (int j = 0; j <= 2 * to.n_through; ++j) {
      const Place1 row = place_in(from.lines.rows, at_node(to.lines.rows, j));
      const int J      = row.interval;
      for (int c = 0; c < 2; ++c)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            out[to.velocity(i, j, c)] +=
                quadratic(along.t, a) * quadratic(row.t, b) * unknowns[from.velocity(2 * I + a, 2 * J + b, c)];
      const double up = 0.5 * (1 + row.t);
      if (j % 2 == 0 && j > 0)
        for (int a = 0; a < 3; ++a)
          out[to.height(i, j / 2)] += quadratic(along.t, a) * ((1 - up) * value(from.height(2 * I + a, J)) +
                                                               up * value(from.height(2 * I + a, J + 1)));
      if (i % 2 == 0 && j % 2 == 0)
        out[to.pressure(i / 2, j / 2)] =
            (1 - right) * ((1 - up) * unknowns[from.pressure(I, J)] + up * unknowns[from.pressure(I, J + 1)]) +
            right * ((1 - up) * unknowns[from.pressure(I + 1, J)] + up * unknowns[from.pressure(I + 1, J + 1)]);
    }
    if (i % 2 == 0)
      for (int J = 0; J < to.n_through; ++J)
        for (int k = 0; k < 3; ++k) {
          const double r = to.lines.rows[J], dr = to.lines.rows[J + 1] - r;
          const Place1 row            = place_in(from.lines.rows, r + 0.5 * dr * (1 + shapes.point[k]));
          out[to.strain(i / 2, J, k)] = (1 - right) * strain(I, row) + right * strain(I + 1, row);
        }
    if (to.contact(i) >= 0)
      for (int a = 0; a < 3; ++a)
        if (const int index = from.contact(2 * I + a); index >= 0)
          out[to.contact(i)] += quadratic(along.t, a) * unknowns[index];
  }
  out.tail(n_whole) = unknowns.tail(n_whole);
  for (int u = 0; u < to.n_unknowns; ++u)
    if (to.held[u])
      out[u] = 0;
  return out;
}

const StripShapes &strip_shapes()
{
  static const StripShapes shapes = [] {
    StripShapes s;
    const dealii::QGauss<1> gauss(3);
    for (int k = 0; k < 3; ++k) {
      s.point[k]  = 2 * gauss.point(k)[0] - 1;
      s.weight[k] = 2 * gauss.weight(k);
    }
    const dealii::FE_Q<2> velocity(2), pressure(1);
    // deal.II's unit square is 0 .. 1, ours -1 .. 1.
    for (int q = 0; q < 9; ++q) {
      const dealii::Point<2> at(0.5 * (1 + s.point[q / 3]), 0.5 * (1 + s.point[q % 3]));
      for (unsigned l = 0; l < 9; ++l) {
        const auto node     = velocity.get_unit_support_points()[l];
        const int n         = 3 * int(std::lround(2 * node[0])) + int(std::lround(2 * node[1]));
        s.value(q, n)       = velocity.shape_value(l, at);
        const auto gradient = velocity.shape_grad(l, at);
        s.along(q, n)       = 0.5 * gradient[0];
        s.through(q, n)     = 0.5 * gradient[1];
      }
      for (unsigned l = 0; l < 4; ++l) {
        const auto node = pressure.get_unit_support_points()[l];
        s.corner(q, 2 * int(std::lround(node[0])) + int(std::lround(node[1]))) = pressure.shape_value(l, at);
      }
    }
    // Integrals of the Lagrange polynomials of the Gauss points up to each point, exact with the same rule.
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        s.gathered(k, l)  = 0;
        const double half = 0.5 * (s.point[k] + 1);
        for (int q = 0; q < 3; ++q) {
          const double t    = -1 + half * (1 + s.point[q]);
          double polynomial = 1;
          for (int m = 0; m < 3; ++m)
            if (m != l)
              polynomial *= (t - s.point[m]) / (s.point[l] - s.point[m]);
          s.gathered(k, l) += half * s.weight[q] * polynomial;
        }
      }
    return s;
  }();
  return shapes;
}
}  // namespace mill::fem
