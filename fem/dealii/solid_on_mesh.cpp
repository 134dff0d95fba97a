#include "fem/dealii/dealii_bodies.h"
#include <algorithm>
#include <array>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/work_stream.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/data_out.h>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

namespace mill::fem {
using namespace dealii;

namespace {
class Solid {
public:
  Solid(const MeshFile &mesh_file, const Material &steel, const int degree)
      : mesh(mesh_file), material(steel), fe(degree), dofs(triangulation), mapping(degree)
  {
    read();
    collect_nodes();
  }
  UnitStiffness unit_stiffness() const;
  SymmetricSparse mass() const;
  Eigen::MatrixXi faces(const std::string &group) const;
  Eigen::VectorXd face_integral(const std::string &group, const std::function<double(double)> &weight) const;
  Eigen::VectorXd volume_load(const std::function<double(const Eigen::Vector3d &)> &weight) const;
  void each_cell(const VisitSolid &visit) const;
  Eigen::MatrixXd nodal_stress(const Eigen::MatrixXd &displacement) const;
  std::string vtu(const Eigen::VectorXd &displacement, const Eigen::VectorXd &pressure);

  Eigen::Matrix<double, Eigen::Dynamic, 3> nodes;
  std::map<std::string, std::vector<int>> groups;

private:
  void read();
  void collect_nodes();

  MeshFile mesh;
  Material material;
  Triangulation<3> triangulation;
  FE_Q<3> fe;  // scalar: one unknown per node and direction keeps the graph of nodes at hand
  DoFHandler<3> dofs;
  MappingQ<3> mapping;
};

void Solid::read()
{
  std::ifstream in(mesh.path, std::ios::binary);
  GridIn<3> reader(triangulation);
  reader.read_msh(in);
  // Straight mesh lines become arcs of the true cylinder; the mapping of the element's degree follows them.
  triangulation.set_manifold(1, CylindricalManifold<3>(2));
  for (const char *curved : {"contact", "barrel", "neck"})
    if (const auto group = mesh.groups.find(curved); group != mesh.groups.end())
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && int(cell->face(face)->boundary_id()) == group->second)
            cell->face(face)->set_all_manifold_ids(1);
  dofs.distribute_dofs(fe);
  DoFRenumbering::Cuthill_McKee(dofs);
}

void Solid::collect_nodes()
{
  std::vector<dealii::Point<3>> points(dofs.n_dofs());
  DoFTools::map_dofs_to_support_points(mapping, dofs, points);
  nodes.resize(Eigen::Index(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c)
      nodes(Eigen::Index(i), c) = mesh.unit * points[i][c];
  for (const auto &[name, id] : mesh.groups) {
    const IndexSet set = DoFTools::extract_boundary_dofs(dofs, ComponentMask(), {types::boundary_id(id)});
    groups[name].assign(set.begin(), set.end());
  }
}

// Zeros on the pattern of the nodes, upper triangle, three unknowns each.
SymmetricSparse empty_stiffness(const DoFHandler<3> &dofs)
{
  DynamicSparsityPattern pattern(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, pattern);
  const int n_unknowns = int(3 * dofs.n_dofs());
  Eigen::VectorXi per_column(n_unknowns);
  for (unsigned j = 0; j < dofs.n_dofs(); ++j) {
    int above = 0;
    for (auto it = pattern.begin(j); it != pattern.end(j); ++it)
      above += it->column() < j;
    for (int c = 0; c < 3; ++c)
      per_column[3 * j + c] = 3 * above + c + 1;
  }
  SymmetricSparse stiffness;
  stiffness.resize(n_unknowns, n_unknowns);
  stiffness.reserve(per_column);
  for (unsigned j = 0; j < dofs.n_dofs(); ++j)
    for (int c = 0; c < 3; ++c) {
      for (auto it = pattern.begin(j); it != pattern.end(j); ++it)
        if (it->column() < j)
          for (int d = 0; d < 3; ++d)
            stiffness.insert(3 * int(it->column()) + d, 3 * int(j) + c) = 0;
      for (int d = 0; d <= c; ++d)
        stiffness.insert(3 * int(j) + d, 3 * int(j) + c) = 0;
    }
  stiffness.makeCompressed();
  return stiffness;
}

// The upper triangle of an element's stiffness and its volume.  S_cd(a, b) = integral of d_c N_a d_d N_b is one
// product of matrices for each pair of directions; all of the stiffness is made of them.
double element_stiffness(const FEValues<3> &v, const double lambda, const double mu, Eigen::MatrixXd &K)
{
  const int n = int(v.dofs_per_cell), n_points = int(v.n_quadrature_points);
  Eigen::RowVectorXd w(n_points);
  std::array<Eigen::MatrixXd, 3> gradient;
  gradient.fill(Eigen::MatrixXd(n, n_points));
  for (int q = 0; q < n_points; ++q) {
    w[q] = v.JxW(q);
    for (int a = 0; a < n; ++a)
      for (int c = 0; c < 3; ++c)
        gradient[c](a, q) = v.shape_grad(a, q)[c];
  }
  K.resize(3 * n, 3 * n);
  Eigen::MatrixXd S(n, n), shared = Eigen::MatrixXd::Zero(n, n);
  for (int c = 0; c < 3; ++c) {
    const Eigen::MatrixXd weighted = gradient[c].array().rowwise() * w.array();
    for (int d = c; d < 3; ++d) {
      S.noalias() = weighted * gradient[d].transpose();
      if (c == d)
        shared += mu * S;
      for (int b = 0; b < n; ++b)
        for (int a = 0; a <= b; ++a) {
          K(3 * a + c, 3 * b + d) = lambda * S(a, b) + mu * S(b, a);
          K(3 * a + d, 3 * b + c) = lambda * S(b, a) + mu * S(a, b);
        }
    }
  }
  for (int b = 0; b < n; ++b)
    for (int a = 0; a <= b; ++a)
      for (int c = 0; c < 3; ++c)
        K(3 * a + c, 3 * b + c) += shared(a, b);
  return w.sum();
}

// K_ab = integral of lambda grad_a (x) grad_b + mu grad_b (x) grad_a + mu (grad_a . grad_b) I          theory.md
// (1.2)
UnitStiffness Solid::unit_stiffness() const
{
  // In units of the mesh and of E; scaled at the end.
  const double nu     = material.poisson_ratio;
  const double lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu));
  const QGauss<3> quadrature(fe.degree + 1);
  const int n = int(fe.n_dofs_per_cell());

  UnitStiffness out;
  SymmetricSparse &stiffness = out.matrix;
  stiffness                  = empty_stiffness(dofs);

  struct Scratch {
    FEValues<3> values;
    Scratch(const Mapping<3> &m, const FE_Q<3> &f, const QGauss<3> &q)
        : values(m, f, q, update_gradients | update_JxW_values)
    {
    }
    Scratch(const Scratch &s)
        : values(s.values.get_mapping(), s.values.get_fe(), s.values.get_quadrature(), s.values.get_update_flags())
    {
    }
  };
  struct Copy {
    std::vector<types::global_dof_index> index;
    Eigen::MatrixXd matrix;
    double volume;
  };
  const auto local = [&](const DoFHandler<3>::active_cell_iterator &cell, Scratch &scratch, Copy &copy) {
    scratch.values.reinit(cell);
    copy.index.resize(n);
    cell->get_dof_indices(copy.index);
    copy.volume = element_stiffness(scratch.values, lambda, mu, copy.matrix);
  };
  // The three columns of a node hold the same rows of the nodes before it, three each, and then its own.
  const int *outer = stiffness.outerIndexPtr(), *inner = stiffness.innerIndexPtr();
  double *values = stiffness.valuePtr();
  const auto add = [&](const Copy &copy) {
    out.volume += copy.volume;
    for (int b = 0; b < n; ++b)
      for (int a = 0; a <= b; ++a) {
        int i = int(copy.index[a]), j = int(copy.index[b]);
        Eigen::Matrix3d block = copy.matrix.block<3, 3>(3 * a, 3 * b);
        if (i > j) {
          std::swap(i, j);
          block.transposeInPlace();
        }
        const int *begin = inner + outer[3 * j], *own = inner + outer[3 * j + 1] - 1;
        const auto place = std::lower_bound(begin, own, 3 * i) - begin;
        for (int d = 0; d < 3; ++d)
          for (int c = 0; c < (i == j ? d + 1 : 3); ++c)
            values[outer[3 * j + d] + place + c] += block(c, d);
      }
  };
  WorkStream::run(dofs.begin_active(), dofs.end(), local, add, Scratch(mapping, fe, quadrature), Copy());
  out.volume *= std::pow(mesh.unit, 3);
  return out;
}

// M_ab = density integral of N_a N_b                                                                theory.md
// (21.1)
SymmetricSparse Solid::mass() const
{
  // Shape functions of degree p and a Jacobian of degree 3 p - 1 per direction: 5 p - 1 together.
  FEValues<3> v(mapping, fe, QGauss<3>(2 * fe.degree + 1), update_values | update_JxW_values);
  const unsigned n = fe.n_dofs_per_cell();
  std::vector<types::global_dof_index> index(n);
  DynamicSparsityPattern pattern(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, pattern);
  Eigen::VectorXi per_column = Eigen::VectorXi::Zero(Eigen::Index(dofs.n_dofs()));
  for (unsigned j = 0; j < dofs.n_dofs(); ++j)
    for (auto it = pattern.begin(j); it != pattern.end(j); ++it)
      per_column[j] += it->column() <= j;
  SymmetricSparse mass;
  mass.resize(int(dofs.n_dofs()), int(dofs.n_dofs()));
  mass.reserve(per_column);
  for (unsigned j = 0; j < dofs.n_dofs(); ++j)
    for (auto it = pattern.begin(j); it != pattern.end(j); ++it)
      if (it->column() <= j)
        mass.insert(int(it->column()), int(j)) = 0;
  Eigen::MatrixXd values(n, v.n_quadrature_points), weighted(n, v.n_quadrature_points);
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    for (const unsigned q : v.quadrature_point_indices())
      for (unsigned a = 0; a < n; ++a) {
        values(a, q)   = v.shape_value(a, q);
        weighted(a, q) = values(a, q) * v.JxW(q);
      }
    const Eigen::MatrixXd local = weighted * values.transpose();
    for (unsigned b = 0; b < n; ++b)
      for (unsigned a = 0; a < n; ++a)
        if (index[a] <= index[b])
          mass.coeffRef(int(index[a]), int(index[b])) += local(a, b);
  }
  mass *= material.density * std::pow(mesh.unit, 3);
  mass.makeCompressed();
  return mass;
}

Eigen::VectorXd Solid::face_integral(const std::string &group, const std::function<double(double)> &weight) const
{
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(dofs.n_dofs()));
  const auto id       = mesh.groups.at(group);
  FEFaceValues<3> v(mapping, fe, QGauss<2>(fe.degree + 3),
                    update_values | update_quadrature_points | update_JxW_values);
  std::vector<types::global_dof_index> index(fe.n_dofs_per_cell());
  for (const auto &cell : dofs.active_cell_iterators())
    for (const auto face : cell->face_indices())
      if (cell->at_boundary(face) && int(cell->face(face)->boundary_id()) == id) {
        v.reinit(cell, face);
        cell->get_dof_indices(index);
        for (const unsigned q : v.quadrature_point_indices())
          for (unsigned a = 0; a < index.size(); ++a)
            out[Eigen::Index(index[a])] +=
                v.shape_value(a, q) * weight(mesh.unit * v.quadrature_point(q)[2]) * v.JxW(q);
      }
  return out * std::pow(mesh.unit, 2);
}

Eigen::MatrixXi Solid::faces(const std::string &group) const
{
  // Unknowns of a face come corners first, then sides x = 0, x = 1, y = 0, y = 1, then the middle.
  const std::vector<int> lexicographic =
      fe.degree == 1 ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 6, 1, 4, 8, 5, 2, 7, 3};
  const int per_face = int(lexicographic.size()), side = int(fe.degree) + 1, id = mesh.groups.at(group);
  std::vector<int> nodes_of;
  std::vector<types::global_dof_index> index(per_face);
  for (const auto &cell : dofs.active_cell_iterators())
    for (const auto f : cell->face_indices()) {
      if (!cell->at_boundary(f) || int(cell->face(f)->boundary_id()) != id)
        continue;
      const auto face = cell->face(f);
      face->get_dof_indices(index);
      const auto first = face->vertex(1) - face->vertex(0), second = face->vertex(2) - face->vertex(0);
      const bool outward = cross_product_3d(first, second) * (face->center() - cell->center()) > 0;
      for (int k = 0; k < per_face; ++k)  // otherwise the two parameters change places
        nodes_of.push_back(int(index[lexicographic[outward ? k : (k % side) * side + k / side]]));
    }
  return Eigen::Map<Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      nodes_of.data(), Eigen::Index(nodes_of.size()) / per_face, per_face);
}

Eigen::VectorXd Solid::volume_load(const std::function<double(const Eigen::Vector3d &)> &weight) const
{
  // Four points more than the shape functions need: weights are polynomials or cosines over many cells.
  FEValues<3> v(mapping, fe, QGauss<3>(fe.degree + 4),
                update_values | update_quadrature_points | update_JxW_values);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(dofs.n_dofs()));
  std::vector<types::global_dof_index> index(fe.n_dofs_per_cell());
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    for (const unsigned q : v.quadrature_point_indices()) {
      const auto &x  = v.quadrature_point(q);
      const double w = v.JxW(q) * weight(mesh.unit * Eigen::Vector3d(x[0], x[1], x[2]));
      if (w != 0)
        for (unsigned a = 0; a < index.size(); ++a)
          out[Eigen::Index(index[a])] += w * v.shape_value(a, q);
    }
  }
  return out * std::pow(mesh.unit, 3);
}
void Solid::each_cell(const VisitSolid &visit) const
{
  FEValues<3> v(mapping, fe, QGauss<3>(fe.degree + 1), update_values | update_gradients | update_JxW_values);
  const double unit      = mesh.unit;
  const unsigned n_local = fe.n_dofs_per_cell();
  std::vector<types::global_dof_index> index(n_local);
  std::vector<int> of_cell(n_local);
  SolidPoint empty;
  empty.gradient.resize(3, n_local);
  empty.value.resize(n_local);
  std::vector<SolidPoint> points(v.n_quadrature_points, empty);
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    std::copy(index.begin(), index.end(), of_cell.begin());
    for (const unsigned q : v.quadrature_point_indices()) {
      points[q].weight = v.JxW(q) * std::pow(unit, 3);
      for (unsigned a = 0; a < n_local; ++a) {
        points[q].value[a] = v.shape_value(a, q);
        for (int c = 0; c < 3; ++c)
          points[q].gradient(c, a) = v.shape_grad(a, q)[c] / unit;
      }
    }
    visit(of_cell, points);
  }
}

/// A field of several components on the nodes of a scalar one, as pictures want it.
class NodeField {
public:
  /// @param at_nodes  (nodes, components)
  NodeField(const DoFHandler<3> &nodes, const Eigen::MatrixXd &at_nodes)
      : dofs_(nodes.get_triangulation()), n_(unsigned(at_nodes.cols()))
  {
    const FESystem<3> several(nodes.get_fe(), n_);
    dofs_.distribute_dofs(several);
    values_.reinit(dofs_.n_dofs());
    std::vector<types::global_dof_index> one(nodes.get_fe().dofs_per_cell), all(several.dofs_per_cell);
    auto cell = dofs_.begin_active();
    for (const auto &node_cell : nodes.active_cell_iterators()) {
      node_cell->get_dof_indices(one);
      cell->get_dof_indices(all);
      for (unsigned i = 0; i < all.size(); ++i) {
        const auto [component, base] = several.system_to_component_index(i);
        values_[all[i]]              = at_nodes(Eigen::Index(one[base]), component);
      }
      ++cell;
    }
  }
  /// The field has to live until the picture is written.
  void add_to(DataOut<3> &out, const std::string &name,
              const DataComponentInterpretation::DataComponentInterpretation kind) const
  {
    out.add_data_vector(dofs_, values_, std::vector<std::string>(n_, name),
                        std::vector<DataComponentInterpretation::DataComponentInterpretation>(n_, kind));
  }

private:
  DoFHandler<3> dofs_;
  unsigned n_;
  Vector<double> values_;
};

Eigen::MatrixXd Solid::nodal_stress(const Eigen::MatrixXd &displacement) const
{
  const double E = material.youngs_modulus, nu = material.poisson_ratio;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const int n_nodes = int(dofs.n_dofs()), k = int(displacement.cols());
  // Each cell is evaluated at its own support points.
  const Quadrature<3> points(fe.get_unit_support_points());
  FEValues<3> v(mapping, fe, points, update_gradients);
  std::vector<types::global_dof_index> index(fe.n_dofs_per_cell());
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6 * Eigen::Index(n_nodes), k);
  std::vector<int> count(std::size_t(n_nodes), 0);
  Eigen::MatrixXd moved(index.size(), 3), by(3, index.size());
  for (const auto &cell : dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    for (unsigned q = 0; q < index.size(); ++q)
      ++count[index[q]];
    for (int j = 0; j < k; ++j) {
      for (unsigned a = 0; a < index.size(); ++a)
        moved.row(a) = displacement.col(j).segment<3>(3 * Eigen::Index(index[a])).transpose();
      for (unsigned q = 0; q < index.size(); ++q) {
        for (unsigned a = 0; a < index.size(); ++a)
          for (int d = 0; d < 3; ++d)
            by(d, a) = v.shape_grad(a, q)[d] / mesh.unit;
        const Eigen::Matrix3d gradient = by * moved;
        const Eigen::Matrix3d strain   = 0.5 * (gradient + gradient.transpose());
        const Eigen::Matrix3d s        = lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2 * mu * strain;
        Eigen::Matrix<double, 6, 1> six;
        six << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2);
        stress.col(j).segment<6>(6 * Eigen::Index(index[q])) += six;
      }
    }
  }
  for (int i = 0; i < n_nodes; ++i)
    stress.middleRows(6 * Eigen::Index(i), 6) /= std::max(1, count[std::size_t(i)]);
  return stress;
}

std::string Solid::vtu(const Eigen::VectorXd &displacement, const Eigen::VectorXd &pressure)
{
  const int n_nodes            = int(dofs.n_dofs());
  const Eigen::MatrixXd stress = nodal_stress(displacement);
  Eigen::MatrixXd vector(n_nodes, 3), tensor(n_nodes, 9);
  Vector<double> von_mises(n_nodes), contact(n_nodes);
  for (int i = 0; i < n_nodes; ++i) {
    const auto six = stress.col(0).segment<6>(6 * Eigen::Index(i));
    Eigen::Matrix3d s;
    s << six[0], six[3], six[4], six[3], six[1], six[5], six[4], six[5], six[2];
    const Eigen::Matrix3d d = s - s.trace() / 3 * Eigen::Matrix3d::Identity();
    vector.row(i)           = displacement.segment<3>(3 * i).transpose();
    tensor.row(i)           = Eigen::Map<const Eigen::RowVectorXd>(s.data(), 9);  // symmetric: either order
    von_mises[i]            = std::sqrt(1.5 * d.squaredNorm());
    contact[i]              = pressure[i];
  }
  DataOut<3> out;
  out.attach_dof_handler(dofs);
  using Kind = DataComponentInterpretation::DataComponentInterpretation;
  NodeField displacements(dofs, vector), stresses(dofs, tensor);
  displacements.add_to(out, "displacement_m", Kind::component_is_part_of_vector);
  stresses.add_to(out, "stress_Pa", Kind::component_is_part_of_tensor);
  out.add_data_vector(von_mises, "von_mises_Pa");
  out.add_data_vector(contact, "contact_pressure_Pa");
  GridTools::scale(mesh.unit, triangulation);  // pictures are in metres
  out.build_patches(mapping, fe.degree, DataOut<3>::curved_boundary);
  GridTools::scale(1 / mesh.unit, triangulation);
  DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false;  // the same run writes the same bits
  out.set_flags(flags);
  std::ostringstream text;
  out.write_vtu(text);
  return text.str();
}
}  // namespace

SolidOnMesh dealii_solid(const MeshFile &mesh, const Material &material, const int degree)
{
  const auto solid = std::make_shared<Solid>(mesh, material, degree);
  SolidOnMesh out;
  out.nodes          = solid->nodes;
  out.groups         = solid->groups;
  out.unit_stiffness = [solid] { return solid->unit_stiffness(); };
  out.mass           = [solid] { return solid->mass(); };
  out.faces          = [solid](const std::string &group) { return solid->faces(group); };
  out.face_integral  = [solid](const std::string &group, const std::function<double(double)> &weight) {
    return solid->face_integral(group, weight);
  };
  out.volume_load = [solid](const std::function<double(const Eigen::Vector3d &)> &weight) {
    return solid->volume_load(weight);
  };
  out.each_cell    = [solid](const VisitSolid &visit) { solid->each_cell(visit); };
  out.nodal_stress = [solid](const Eigen::MatrixXd &displacement) { return solid->nodal_stress(displacement); };
  out.vtu          = [solid](const Eigen::VectorXd &displacement, const Eigen::VectorXd &pressure) {
    return solid->vtu(displacement, pressure);
  };
  return out;
}

}  // namespace mill::fem
