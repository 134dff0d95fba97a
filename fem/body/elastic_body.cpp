#include "fem/body/elastic_body.h"
#include "core/case/errors.h"
#include "core/records/files.h"
#include <deal.II/base/multithread_info.h>
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
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace mill::fem {
using namespace dealii;

struct ElasticBody::Implementation {
  Implementation(const MeshFile &mesh_file, const Material &steel, const int degree)
      : mesh(mesh_file), material(steel), fe(degree), dofs(triangulation), mapping(degree)
  {
  }
  MeshFile mesh;
  Material material;
  Triangulation<3> triangulation;
  FE_Q<3> fe;  // scalar: one unknown per node and direction keeps the graph of nodes at hand
  DoFHandler<3> dofs;
  MappingQ<3> mapping;
  SymmetricSparse stiffness;   // in units of stiffness_unit()
  SymmetricSparse in_newtons;  // empty until asked for
  SymmetricSparse mass;        // kg, empty until asked for
  Eigen::Matrix<double, Eigen::Dynamic, 3> nodes;
  std::map<std::string, std::vector<int>> groups;
  std::vector<int> axis;
  double volume  = 0;
  bool assembled = false;

  void read();
  void collect_nodes();
  void assemble();
  void assemble_mass();
  template <class Weight> Eigen::VectorXd face_integral(const std::string &group, const Weight &weight) const;
};

void ElasticBody::Implementation::read()
{
  std::ifstream in(mesh.path, std::ios::binary);
  if (!in)
    throw InputError({mesh.path, 0, 0}, "the mesh cannot be read");
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

void ElasticBody::Implementation::collect_nodes()
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
  // What moves with the axis: the axis itself, in a hollow body the line of the bore in the neutral plane.
  double innermost = std::numeric_limits<double>::infinity();
  for (const int node : groups["symmetry.y"])
    innermost = std::min(innermost, nodes(node, 0));
  for (const int node : groups["symmetry.y"])
    if (nodes(node, 0) <= innermost + 1e-9 * mesh.geometry.radius)
      axis.push_back(node);
  std::sort(axis.begin(), axis.end(), [&](const int a, const int b) { return nodes(a, 2) < nodes(b, 2); });
}

// K_ab = integral of lambda grad_a (x) grad_b + mu grad_b (x) grad_a + mu (grad_a . grad_b) I          theory.md
// (1.2)
void ElasticBody::Implementation::assemble()
{
  // In units of the mesh and of E; scaled at the end.
  const double nu     = material.poisson_ratio;
  const double lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu));
  const QGauss<3> quadrature(fe.degree + 1);
  const int n = int(fe.n_dofs_per_cell());

  // Pattern of nodes, upper triangle, then three unknowns each.
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
    FEValues<3> &v = scratch.values;
    v.reinit(cell);
    copy.index.resize(n);
    cell->get_dof_indices(copy.index);
    copy.matrix.setZero(3 * n, 3 * n);
    copy.volume = 0;
    Eigen::MatrixXd gradient(3, n);
    for (const unsigned q : v.quadrature_point_indices()) {
      const double w = v.JxW(q);
      copy.volume += w;
      for (int a = 0; a < n; ++a)
        for (int c = 0; c < 3; ++c)
          gradient(c, a) = v.shape_grad(a, q)[c];
      for (int b = 0; b < n; ++b)
        for (int a = 0; a <= b; ++a) {
          const double dot = mu * w * gradient.col(a).dot(gradient.col(b));
          for (int d = 0; d < 3; ++d)
            for (int c = 0; c < 3; ++c)
              copy.matrix(3 * a + c, 3 * b + d) +=
                  w * (lambda * gradient(c, a) * gradient(d, b) + mu * gradient(d, a) * gradient(c, b)) +
                  (c == d ? dot : 0);
        }
    }
  };
  const auto add = [&](const Copy &copy) {
    volume += copy.volume;
    for (int b = 0; b < n; ++b)
      for (int a = 0; a <= b; ++a) {
        const int i = int(copy.index[a]), j = int(copy.index[b]);
        for (int d = 0; d < 3; ++d)
          for (int c = 0; c < 3; ++c) {
            const double value = copy.matrix(3 * a + c, 3 * b + d);
            if (i < j || (i == j && c <= d))
              stiffness.coeffRef(3 * i + c, 3 * j + d) += value;
            else if (i > j)
              stiffness.coeffRef(3 * j + d, 3 * i + c) += value;
          }
      }
  };
  assembled = true;
  WorkStream::run(dofs.begin_active(), dofs.end(), local, add, Scratch(mapping, fe, quadrature), Copy());
  volume *= std::pow(mesh.unit, 3);
}

// M_ab = density integral of N_a N_b                                                                theory.md
// (21.1)
void ElasticBody::Implementation::assemble_mass()
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
}

template <class Weight>
Eigen::VectorXd ElasticBody::Implementation::face_integral(const std::string &group, const Weight &weight) const
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

ElasticBody::ElasticBody(const MeshFile &mesh, const Material &material, const int degree)
    : self(std::make_unique<Implementation>(mesh, material, degree))
{
  self->read();
  self->collect_nodes();
}
ElasticBody::~ElasticBody()                       = default;
ElasticBody::ElasticBody(ElasticBody &&) noexcept = default;

const SymmetricSparse &ElasticBody::unit_stiffness() const
{
  if (!self->assembled)
    self->assemble();
  return self->stiffness;
}
double ElasticBody::stiffness_unit() const
{
  return self->material.youngs_modulus * self->mesh.unit;
}
const SymmetricSparse &ElasticBody::stiffness() const
{
  if (self->in_newtons.size() == 0)
    self->in_newtons = unit_stiffness() * stiffness_unit();
  return self->in_newtons;
}
const SymmetricSparse &ElasticBody::mass() const
{
  if (self->mass.size() == 0)
    self->assemble_mass();
  return self->mass;
}
const Eigen::Matrix<double, Eigen::Dynamic, 3> &ElasticBody::nodes() const
{
  return self->nodes;
}
const std::vector<int> &ElasticBody::group(const std::string &name) const
{
  return self->groups.at(name);
}
Surface ElasticBody::surface(const std::string &group) const
{
  // Unknowns of a face come corners first, then sides x = 0, x = 1, y = 0, y = 1, then the middle.
  const std::vector<int> lexicographic =
      degree() == 1 ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 6, 1, 4, 8, 5, 2, 7, 3};
  const int per_face = int(lexicographic.size()), side = degree() + 1, id = self->mesh.groups.at(group);
  Surface out;
  out.node = self->groups.at(group);
  out.points.resize(Eigen::Index(out.node.size()), 3);
  std::map<int, int> place;
  for (std::size_t i = 0; i < out.node.size(); ++i) {
    out.points.row(Eigen::Index(i)) = self->nodes.row(out.node[i]);
    place[out.node[i]]              = int(i);
  }
  std::vector<int> faces;
  std::vector<types::global_dof_index> index(per_face);
  for (const auto &cell : self->dofs.active_cell_iterators())
    for (const auto f : cell->face_indices()) {
      if (!cell->at_boundary(f) || int(cell->face(f)->boundary_id()) != id)
        continue;
      const auto face = cell->face(f);
      face->get_dof_indices(index);
      const auto first = face->vertex(1) - face->vertex(0), second = face->vertex(2) - face->vertex(0);
      const bool outward = cross_product_3d(first, second) * (face->center() - cell->center()) > 0;
      for (int k = 0; k < per_face; ++k)  // otherwise the two parameters change places
        faces.push_back(place.at(int(index[lexicographic[outward ? k : (k % side) * side + k / side]])));
    }
  out.faces = Eigen::Map<Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      faces.data(), Eigen::Index(faces.size()) / per_face, per_face);
  return out;
}
const std::vector<int> &ElasticBody::axis() const
{
  return self->axis;
}
Eigen::VectorXd ElasticBody::volume_load(const std::function<double(const Eigen::Vector3d &)> &weight) const
{
  // Four points more than the shape functions need: weights are polynomials or cosines over many cells.
  FEValues<3> v(self->mapping, self->fe, QGauss<3>(self->fe.degree + 4),
                update_values | update_quadrature_points | update_JxW_values);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(self->dofs.n_dofs()));
  std::vector<types::global_dof_index> index(self->fe.n_dofs_per_cell());
  for (const auto &cell : self->dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    for (const unsigned q : v.quadrature_point_indices()) {
      const auto &x  = v.quadrature_point(q);
      const double w = v.JxW(q) * weight(self->mesh.unit * Eigen::Vector3d(x[0], x[1], x[2]));
      if (w != 0)
        for (unsigned a = 0; a < index.size(); ++a)
          out[Eigen::Index(index[a])] += w * v.shape_value(a, q);
    }
  }
  return out * std::pow(self->mesh.unit, 3);
}
int ElasticBody::degree() const
{
  return int(self->fe.degree);
}
void ElasticBody::each_cell(
    const std::function<void(const std::vector<int> &nodes, const std::vector<SolidPoint> &points)> &visit) const
{
  FEValues<3> v(self->mapping, self->fe, QGauss<3>(self->fe.degree + 1), update_gradients | update_JxW_values);
  const double unit      = self->mesh.unit;
  const unsigned n_local = self->fe.n_dofs_per_cell();
  std::vector<types::global_dof_index> index(n_local);
  std::vector<int> nodes(n_local);
  SolidPoint empty;
  empty.gradient.resize(3, n_local);
  std::vector<SolidPoint> points(v.n_quadrature_points, empty);
  for (const auto &cell : self->dofs.active_cell_iterators()) {
    v.reinit(cell);
    cell->get_dof_indices(index);
    std::copy(index.begin(), index.end(), nodes.begin());
    for (const unsigned q : v.quadrature_point_indices()) {
      points[q].weight = v.JxW(q) * std::pow(unit, 3);
      for (unsigned a = 0; a < n_local; ++a)
        for (int c = 0; c < 3; ++c)
          points[q].gradient(c, a) = v.shape_grad(a, q)[c] / unit;
    }
    visit(nodes, points);
  }
}

double ElasticBody::volume() const
{
  unit_stiffness();
  return self->volume;
}
Eigen::VectorXd ElasticBody::face_weights(const std::string &group) const
{
  return self->face_integral(group, [](double) { return 1.; });
}
Eigen::VectorXd ElasticBody::face_load(const std::string &group, double (*weight)(double, const void *),
                                       const void *context) const
{
  return self->face_integral(group, [&](const double z) { return weight(z, context); });
}

std::string library_version()
{
  return DEAL_II_PACKAGE_VERSION;
}

void set_assembly_threads(const int n)
{
  MultithreadInfo::set_thread_limit(unsigned(n));
}

namespace {
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
}  // namespace

Eigen::MatrixXd ElasticBody::nodal_stress(const Eigen::MatrixXd &displacement) const
{
  const double E = self->material.youngs_modulus, nu = self->material.poisson_ratio;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const int n_nodes = int(self->dofs.n_dofs()), k = int(displacement.cols());
  // Each cell is evaluated at its own support points.
  const Quadrature<3> points(self->fe.get_unit_support_points());
  FEValues<3> v(self->mapping, self->fe, points, update_gradients);
  std::vector<types::global_dof_index> index(self->fe.n_dofs_per_cell());
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6 * Eigen::Index(n_nodes), k);
  std::vector<int> count(std::size_t(n_nodes), 0);
  Eigen::MatrixXd moved(index.size(), 3), by(3, index.size());
  for (const auto &cell : self->dofs.active_cell_iterators()) {
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
            by(d, a) = v.shape_grad(a, q)[d] / self->mesh.unit;
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

void ElasticBody::write_vtu(const std::string &path, const Eigen::VectorXd &displacement,
                            const Eigen::VectorXd &pressure) const
{
  const int n_nodes            = int(self->dofs.n_dofs());
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
  out.attach_dof_handler(self->dofs);
  using Kind = DataComponentInterpretation::DataComponentInterpretation;
  NodeField displacements(self->dofs, vector), stresses(self->dofs, tensor);
  displacements.add_to(out, "displacement_m", Kind::component_is_part_of_vector);
  stresses.add_to(out, "stress_Pa", Kind::component_is_part_of_tensor);
  out.add_data_vector(von_mises, "von_mises_Pa");
  out.add_data_vector(contact, "contact_pressure_Pa");
  GridTools::scale(self->mesh.unit, self->triangulation);  // pictures are in metres
  out.build_patches(self->mapping, self->fe.degree, DataOut<3>::curved_boundary);
  GridTools::scale(1 / self->mesh.unit, self->triangulation);
  DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false;  // the same run writes the same bits
  out.set_flags(flags);
  std::ostringstream text;
  out.write_vtu(text);
  write_atomically(path, text.str());
}
}  // namespace mill::fem
