#include "fem/dealii/dealii_bodies.h"
#include <algorithm>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <fstream>
#include <map>
#include <memory>

namespace mill::fem {
using namespace dealii;

namespace {
// A shape function at a quadrature point.
struct Shape {
  double value;
  Eigen::Vector2d gradient;
};

struct Lame {
  double lambda, mu;
  explicit Lame(const Material &m)
      : lambda(m.youngs_modulus * m.poisson_ratio / ((1 + m.poisson_ratio) * (1 - 2 * m.poisson_ratio))),
        mu(m.youngs_modulus / (2 * (1 + m.poisson_ratio)))
  {
  }
};

// Normal strains first, then engineering shears.
template <int n> Eigen::Matrix<double, n, n> elasticity(const Lame &lame, const int n_normal)
{
  Eigen::Matrix<double, n, n> D = Eigen::Matrix<double, n, n>::Zero();
  D.topLeftCorner(n_normal, n_normal).setConstant(lame.lambda);
  for (int i = 0; i < n; ++i)
    D(i, i) += i < n_normal ? 2 * lame.mu : lame.mu;
  return D;
}

// Strains (xx, yy, xy) of the two displacements.
Eigen::Matrix<double, 3, 2> plane_strain(const Shape &s)
{
  Eigen::Matrix<double, 3, 2> B;
  B << s.gradient[0], 0, 0, s.gradient[1], s.gradient[1], s.gradient[0];
  return B;
}

// Strains (rr, zz, tt, rz) of the two displacements.
Eigen::Matrix<double, 4, 2> ring_strain(const Shape &s, const double r)
{
  Eigen::Matrix<double, 4, 2> B;
  B << s.gradient[0], 0, 0, s.gradient[1], s.value / r, 0, s.gradient[1], s.gradient[0];
  return B;
}

// Strains (rr, zz, tt, rz, rt, tz) of U, V, W: the part without m ...
Eigen::Matrix<double, 6, 3> harmonic_strain_0(const Shape &s, const double r)
{
  const double dr = s.gradient[0], dz = s.gradient[1], over_r = s.value / r;
  Eigen::Matrix<double, 6, 3> B;
  B << dr, 0, 0, 0, 0, dz, over_r, 0, 0, dz, 0, dr, 0, dr - over_r, 0, 0, dz, 0;
  return B;
}

// ... and the part that is multiplied by m.
Eigen::Matrix<double, 6, 3> harmonic_strain_1(const Shape &s, const double r)
{
  const double over_r           = s.value / r;
  Eigen::Matrix<double, 6, 3> B = Eigen::Matrix<double, 6, 3>::Zero();
  B(2, 1)                       = over_r;
  B(4, 0)                       = -over_r;
  B(5, 2)                       = -over_r;
  return B;
}

class PlaneSection {
public:
  PlaneSection(const MeshFile &mesh_file, const Material &steel, const int degree, const Section kind,
               const std::vector<Circle> &circles)
      : mesh(mesh_file), material(steel), section(kind), fe(degree), dofs(triangulation), mapping(degree)
  {
    readable = read(circles);
    if (readable)
      collect_nodes();
  }
  SymmetricSparse stiffness() const;
  std::vector<SymmetricSparse> harmonics() const;
  Eigen::MatrixXi faces(const std::string &group) const;
  void each_cell(const VisitSection &visit) const;
  double measure() const;

  bool readable = false;
  Eigen::Matrix<double, Eigen::Dynamic, 2> nodes;
  std::map<std::string, std::vector<int>> groups;

private:
  bool read(const std::vector<Circle> &circles);
  void collect_nodes();
  template <int n> SymmetricSparse empty_matrix() const;
  template <int n, class Block> SymmetricSparse assemble(const Block &block) const;

  MeshFile mesh;
  Material material;
  Section section;
  Triangulation<2> triangulation;
  FE_Q<2> fe;  // scalar: one unknown per node and direction keeps the graph of nodes at hand
  DoFHandler<2> dofs;
  MappingQ<2> mapping;
};

bool PlaneSection::read(const std::vector<Circle> &circles)
{
  std::ifstream in(mesh.path, std::ios::binary);
  GridIn<2> reader(triangulation);
  try {
    reader.read_msh(in);
  } catch (const std::exception &) {  // a page of text about deal.II's insides
    return false;
  }
  types::manifold_id manifold = 1;
  for (const Circle &circle : circles) {
    const Point<2> centre(circle.centre[0], circle.centre[1]);
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto f : cell->face_indices())
        if (cell->at_boundary(f) && int(cell->face(f)->boundary_id()) == mesh.groups.at(circle.group)) {
          cell->face(f)->set_manifold_id(manifold);
          for (unsigned v = 0; v < 2; ++v) {
            Point<2> &corner = cell->face(f)->vertex(v);
            corner           = centre + circle.radius / (corner - centre).norm() * (corner - centre);
          }
        }
    triangulation.set_manifold(manifold++, PolarManifold<2>(centre));
  }
  dofs.distribute_dofs(fe);
  DoFRenumbering::Cuthill_McKee(dofs);
  return true;
}

void PlaneSection::collect_nodes()
{
  std::vector<Point<2>> points(dofs.n_dofs());
  DoFTools::map_dofs_to_support_points(mapping, dofs, points);
  nodes.resize(Eigen::Index(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    nodes.row(Eigen::Index(i)) << points[i][0], points[i][1];
  for (const auto &[name, id] : mesh.groups) {
    const IndexSet set = DoFTools::extract_boundary_dofs(dofs, ComponentMask(), {types::boundary_id(id)});
    groups[name].assign(set.begin(), set.end());
  }
}

// n unknowns per node, all entries of neighbouring nodes in the upper triangle present and zero.
template <int n> SymmetricSparse PlaneSection::empty_matrix() const
{
  DynamicSparsityPattern pattern(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, pattern);
  const int n_nodes = int(dofs.n_dofs());
  std::vector<int> start{0}, rows;
  for (int j = 0; j < n_nodes; ++j)
    for (int c = 0; c < n; ++c) {
      for (auto it = pattern.begin(j); it != pattern.end(j); ++it)
        if (int(it->column()) < j)
          for (int d = 0; d < n; ++d)
            rows.push_back(n * int(it->column()) + d);
      for (int d = 0; d <= c; ++d)
        rows.push_back(n * j + d);
      start.push_back(int(rows.size()));
    }
  std::vector<double> zeros(rows.size(), 0.);
  return Eigen::Map<SymmetricSparse>(n * n_nodes, n * n_nodes, int(rows.size()), start.data(), rows.data(),
                                     zeros.data());
}

// Sum over cells and quadrature points of  block(shape a, shape b, r) dV,  block of n x n.
template <int n, class Block> SymmetricSparse PlaneSection::assemble(const Block &block) const
{
  SymmetricSparse K = empty_matrix<n>();
  // The radius in the measure raises the degree by one, which this rule still integrates on a straight mesh.
  FEValues<2> v(mapping, fe, QGauss<2>(fe.degree + 1),
                update_values | update_gradients | update_quadrature_points | update_JxW_values);
  const int n_local = int(fe.n_dofs_per_cell());
  std::vector<types::global_dof_index> index(n_local);
  std::vector<Shape> shape(n_local);
  Eigen::MatrixXd local(n * n_local, n * n_local);
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    local.setZero();
    for (const unsigned q : v.quadrature_point_indices()) {
      const double r = v.quadrature_point(q)[0];
      const double w = v.JxW(q) * (section == Section::axisymmetric ? 2 * M_PI * r : 1);
      for (int a = 0; a < n_local; ++a)
        shape[a] = {v.shape_value(a, q), {v.shape_grad(a, q)[0], v.shape_grad(a, q)[1]}};
      for (int b = 0; b < n_local; ++b)
        for (int a = 0; a <= b; ++a)
          local.block<n, n>(n * a, n * b) += w * block(shape[a], shape[b], r);
    }
    for (int b = 0; b < n_local; ++b)
      for (int a = 0; a <= b; ++a) {
        const int i = int(index[a]), j = int(index[b]);
        for (int d = 0; d < n; ++d)
          for (int c = 0; c < n; ++c) {
            const double value = local(n * a + c, n * b + d);
            if (i < j || (i == j && c <= d))
              K.coeffRef(n * i + c, n * j + d) += value;
            else if (i > j)
              K.coeffRef(n * j + d, n * i + c) += value;
          }
      }
  }
  return K;
}

SymmetricSparse PlaneSection::stiffness() const
{
  const Lame lame(material);
  if (section == Section::plane_strain) {
    const auto D = elasticity<3>(lame, 2);
    return assemble<2>([&](const Shape &a, const Shape &b, double) -> Eigen::Matrix2d {
      return plane_strain(a).transpose() * D * plane_strain(b);
    });
  }
  const auto D = elasticity<4>(lame, 3);
  return assemble<2>([&](const Shape &a, const Shape &b, const double r) -> Eigen::Matrix2d {
    return ring_strain(a, r).transpose() * D * ring_strain(b, r);
  });
}

// (B0 + m B1)^T D (B0 + m B1) is a polynomial in m: its three coefficients serve every harmonic.
std::vector<SymmetricSparse> PlaneSection::harmonics() const
{
  const auto D = elasticity<6>(Lame(material), 3);
  std::vector<SymmetricSparse> harmonic(3);
  harmonic[0] = assemble<3>([&](const Shape &a, const Shape &b, const double r) -> Eigen::Matrix3d {
    return harmonic_strain_0(a, r).transpose() * D * harmonic_strain_0(b, r);
  });
  harmonic[1] = assemble<3>([&](const Shape &a, const Shape &b, const double r) -> Eigen::Matrix3d {
    return harmonic_strain_0(a, r).transpose() * D * harmonic_strain_1(b, r) +
           harmonic_strain_1(a, r).transpose() * D * harmonic_strain_0(b, r);
  });
  harmonic[2] = assemble<3>([&](const Shape &a, const Shape &b, const double r) -> Eigen::Matrix3d {
    return harmonic_strain_1(a, r).transpose() * D * harmonic_strain_1(b, r);
  });
  return harmonic;
}

Eigen::MatrixXi PlaneSection::faces(const std::string &group) const
{
  const int id = mesh.groups.at(group), per_face = int(fe.degree) + 1;
  std::vector<types::global_dof_index> index(per_face);
  std::vector<int> nodes_of;
  for (const auto &cell : dofs.active_cell_iterators())
    for (const auto f : cell->face_indices()) {
      if (!cell->at_boundary(f) || int(cell->face(f)->boundary_id()) != id)
        continue;
      cell->face(f)->get_dof_indices(index);  // both corners, then the inside
      std::vector<int> along{int(index[0])};
      for (int i = 2; i < per_face; ++i)
        along.push_back(int(index[i]));
      along.push_back(int(index[1]));
      const auto run = cell->face(f)->vertex(1) - cell->face(f)->vertex(0);
      const auto in  = cell->center() - cell->face(f)->vertex(0);
      if (run[0] * in[1] - run[1] * in[0] < 0)
        std::reverse(along.begin(), along.end());
      nodes_of.insert(nodes_of.end(), along.begin(), along.end());
    }
  return Eigen::Map<Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      nodes_of.data(), Eigen::Index(nodes_of.size()) / per_face, per_face);
}

void PlaneSection::each_cell(const VisitSection &visit) const
{
  FEValues<2> v(mapping, fe, QGauss<2>(fe.degree + 1),
                update_gradients | update_quadrature_points | update_JxW_values);
  const unsigned n_local = fe.n_dofs_per_cell();
  std::vector<types::global_dof_index> index(n_local);
  std::vector<int> of_cell(n_local);
  CellPoint empty;
  empty.gradient.resize(n_local, 2);
  std::vector<CellPoint> points(v.n_quadrature_points, empty);
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    std::copy(index.begin(), index.end(), of_cell.begin());
    for (const unsigned q : v.quadrature_point_indices()) {
      points[q].weight = v.JxW(q) * (section == Section::axisymmetric ? 2 * M_PI * v.quadrature_point(q)[0] : 1);
      for (unsigned a = 0; a < n_local; ++a)
        points[q].gradient.row(a) << v.shape_grad(a, q)[0], v.shape_grad(a, q)[1];
    }
    visit(of_cell, points);
  }
}

double PlaneSection::measure() const
{
  FEValues<2> v(mapping, fe, QGauss<2>(fe.degree + 1), update_quadrature_points | update_JxW_values);
  double sum = 0;
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    for (const unsigned q : v.quadrature_point_indices())
      sum += v.JxW(q) * (section == Section::axisymmetric ? 2 * M_PI * v.quadrature_point(q)[0] : 1);
  }
  return sum;
}
}  // namespace

SectionOnMesh dealii_section(const MeshFile &mesh, const Material &material, const int degree,
                             const Section section, const std::vector<Circle> &circles)
{
  const auto body = std::make_shared<PlaneSection>(mesh, material, degree, section, circles);
  SectionOnMesh out;
  out.readable  = body->readable;
  out.nodes     = body->nodes;
  out.groups    = body->groups;
  out.stiffness = [body] { return body->stiffness(); };
  out.harmonics = [body] { return body->harmonics(); };
  out.faces     = [body](const std::string &group) { return body->faces(group); };
  out.each_cell = [body](const VisitSection &visit) { body->each_cell(visit); };
  out.measure   = [body] { return body->measure(); };
  return out;
}
}  // namespace mill::fem
