#include "fem/body/condensed_surface.h"
#include "core/base/errors.h"
#include "fem/contact/mortar.h"
#include "fem/contact/segments.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace mill::fem {
struct CondensedSurface::Implementation {
  SymmetricSparse K;              // of the body
  Eigen::SparseMatrix<double> Q;  // (unknowns, free): the body's unknowns from the free ones, columns orthonormal
  std::vector<char> held;
  Surface surface;
  std::vector<int> kept;  // free unknown of each kept one, -1: held
  Eigen::MatrixXd directions, flexibility;
  std::unique_ptr<CondensingFactor> factor;

  std::vector<int> choose_unknowns(int components, const SurfaceOptions &options);
  SymmetricSparse free_stiffness() const;
  Eigen::VectorXd free_load(const LoadCase &load) const;
};

namespace {
Eigen::VectorXd product(const SymmetricSparse &K, const Eigen::VectorXd &x)
{
  return K.selfadjointView<Eigen::Upper>() * x;
}

// Orthonormal basis of the free directions of a surface node, the normal's part in them first.
Eigen::MatrixXd free_basis(const Eigen::VectorXd &normal, const std::vector<int> &free, const int node)
{
  const Eigen::Index d   = normal.size();
  Eigen::VectorXd inside = Eigen::VectorXd::Zero(d);
  for (const int c : free)
    inside[c] = normal[c];
  // A surface may meet a plane of symmetry at its right angle only; a quarter turn of slack is for curved facets.
  if (inside.norm() < 0.7)
    throw InputError("node " + std::to_string(node) + " of the contact surface is held along its normal");
  Eigen::MatrixXd basis(d, Eigen::Index(free.size()));
  basis.col(0) = inside.normalized();
  for (std::size_t k = 1; k < free.size(); ++k) {
    // The coordinate direction that is farthest from those already there, made orthogonal to them.
    Eigen::VectorXd best = Eigen::VectorXd::Zero(d);
    for (const int c : free) {
      Eigen::VectorXd candidate = Eigen::VectorXd::Unit(d, c);
      candidate -= basis.leftCols(Eigen::Index(k)) * (basis.leftCols(Eigen::Index(k)).transpose() * candidate);
      if (candidate.norm() > best.norm() * (1 + 1e-6))
        best = candidate;
    }
    basis.col(Eigen::Index(k)) = best.normalized();
  }
  return basis;
}
}  // namespace

// Fills Q, kept and directions; returns the node of each free unknown.
std::vector<int> CondensedSurface::Implementation::choose_unknowns(const int components,
                                                                   const SurfaceOptions &options)
{
  const bool tangential = options.tangential;
  const Eigen::MatrixXd normals =
      options.direction.size() > 0
          ? Eigen::MatrixXd(options.direction.normalized().transpose().replicate(surface.points.rows(), 1))
          : contact::nodal_normals(surface);
  const int n = int(surface.node.size()), n_nodes = int(K.rows()) / components,
            per_node = tangential ? components : 1;
  std::vector<int> place(n_nodes, -1), node_of;
  for (int i = 0; i < n; ++i)
    place[surface.node[i]] = i;
  directions.setZero(n * per_node, components);
  kept.assign(n * per_node, -1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < n_nodes; ++node) {
    std::vector<int> free;
    for (int c = 0; c < components; ++c)
      if (!held[components * node + c])
        free.push_back(c);
    const int i                 = place[node];
    const Eigen::MatrixXd basis = i >= 0 ? free_basis(normals.row(i), free, node) : Eigen::MatrixXd();
    for (std::size_t k = 0; k < free.size(); ++k) {
      const int column = int(node_of.size());
      node_of.push_back(node);
      if (i < 0)
        entries.emplace_back(components * node + free[k], column, 1);
      else {
        for (const int c : free)
          if (basis(c, Eigen::Index(k)) != 0)
            entries.emplace_back(components * node + c, column, basis(c, Eigen::Index(k)));
        if (int(k) < per_node) {
          kept[int(k) * n + i]           = column;
          directions.row(int(k) * n + i) = basis.col(Eigen::Index(k));
        }
      }
    }
  }
  Q.resize(K.rows(), Eigen::Index(node_of.size()));
  Q.setFromTriplets(entries.begin(), entries.end());
  return node_of;
}

// Q^T K Q.  Normals along the axes make Q a choice of unknowns with signs, which needs no product.
SymmetricSparse CondensedSurface::Implementation::free_stiffness() const
{
  if (Q.nonZeros() > Q.cols()) {
    const Eigen::SparseMatrix<double> whole = K.selfadjointView<Eigen::Upper>();
    const Eigen::SparseMatrix<double> KQ    = whole * Q;
    const Eigen::SparseMatrix<double> both  = Q.transpose() * KQ;
    return both.triangularView<Eigen::Upper>();
  }
  std::vector<int> to(K.rows(), -1);
  Eigen::VectorXd sign = Eigen::VectorXd::Zero(K.rows());
  for (int j = 0; j < Q.cols(); ++j) {
    const Eigen::SparseMatrix<double>::InnerIterator it(Q, j);
    to[it.row()]   = j;
    sign[it.row()] = it.value();
  }
  // Columns in the order of the unknowns; the directions of a surface node may change places among themselves.
  std::vector<Eigen::Triplet<double>> exchanged;
  std::vector<int> start(Q.cols() + 1, 0), rows;
  std::vector<double> values;
  bool ordered = true;
  for (int j = 0, last = -1; j < K.cols(); ++j)
    if (to[j] >= 0) {
      ordered = ordered && to[j] > last;
      last    = to[j];
    }
  if (!ordered) {
    for (int j = 0; j < K.cols(); ++j)
      for (SymmetricSparse::InnerIterator it(K, j); it; ++it)
        if (to[j] >= 0 && to[it.row()] >= 0)
          exchanged.emplace_back(std::min(to[it.row()], to[j]), std::max(to[it.row()], to[j]),
                                 sign[it.row()] * sign[j] * it.value());
    SymmetricSparse out(Q.cols(), Q.cols());
    out.setFromTriplets(exchanged.begin(), exchanged.end());
    return out;
  }
  rows.reserve(K.nonZeros());
  values.reserve(K.nonZeros());
  for (int j = 0; j < K.cols(); ++j) {
    if (to[j] < 0)
      continue;
    for (SymmetricSparse::InnerIterator it(K, j); it; ++it)
      if (to[it.row()] >= 0) {
        rows.push_back(to[it.row()]);
        values.push_back(sign[it.row()] * sign[j] * it.value());
      }
    start[to[j] + 1] = int(rows.size());
  }
  return Eigen::Map<SymmetricSparse>(Q.cols(), Q.cols(), int(rows.size()), start.data(), rows.data(),
                                     values.data());
}

// Q^T (force - K imposed)
Eigen::VectorXd CondensedSurface::Implementation::free_load(const LoadCase &load) const
{
  Eigen::VectorXd f = load.force.size() > 0 ? load.force : Eigen::VectorXd::Zero(K.rows());
  if (load.displacement.size() > 0) {
    Eigen::VectorXd imposed = Eigen::VectorXd::Zero(K.rows());
    for (Eigen::Index i = 0; i < imposed.size(); ++i)
      if (held[i])
        imposed[i] = load.displacement[i];
    f -= product(K, imposed);
  }
  return Q.transpose() * f;
}

CondensedSurface::CondensedSurface(const SymmetricSparse &stiffness, const int components, std::vector<char> held,
                                   Surface surface, const SurfaceOptions &options)
    : self(std::make_unique<Implementation>())
{
  if (components != surface.points.cols() || Eigen::Index(held.size()) != stiffness.rows() ||
      stiffness.rows() % components != 0)
    throw InputError("condensed surface: stiffness, held unknowns and surface are not of the same body");
  self->K                        = stiffness;
  self->held                     = std::move(held);
  self->surface                  = std::move(surface);
  const std::vector<int> node_of = self->choose_unknowns(components, options);
  std::vector<int> retained;
  for (const int column : self->kept)
    if (column >= 0)
      retained.push_back(column);
  self->factor = std::make_unique<CondensingFactor>(self->free_stiffness(), node_of, retained, options.memory);
  const Eigen::MatrixXd C = inverse_from_factor(self->factor->schur_factor());
  if (retained.size() == self->kept.size())
    self->flexibility = C;
  else {
    std::vector<int> present;
    for (std::size_t i = 0; i < self->kept.size(); ++i)
      if (self->kept[i] >= 0)
        present.push_back(int(i));
    self->flexibility.setZero(Eigen::Index(self->kept.size()), Eigen::Index(self->kept.size()));
    self->flexibility(present, present) = C;
  }
}
CondensedSurface::~CondensedSurface()                            = default;
CondensedSurface::CondensedSurface(CondensedSurface &&) noexcept = default;

const Surface &CondensedSurface::surface() const
{
  return self->surface;
}
const Eigen::MatrixXd &CondensedSurface::directions() const
{
  return self->directions;
}
const Eigen::MatrixXd &CondensedSurface::flexibility() const
{
  return self->flexibility;
}
int CondensedSurface::n_unknowns() const
{
  return int(self->Q.cols());
}
const FactorCost &CondensedSurface::cost() const
{
  return self->factor->cost();
}

Eigen::VectorXd CondensedSurface::response(const LoadCase &load) const
{
  const Eigen::VectorXd u = self->factor->solve(self->free_load(load));
  Eigen::VectorXd out     = Eigen::VectorXd::Zero(Eigen::Index(self->kept.size()));
  for (std::size_t i = 0; i < self->kept.size(); ++i)
    if (self->kept[i] >= 0)
      out[Eigen::Index(i)] = u[self->kept[i]];
  return out;
}

Eigen::VectorXd CondensedSurface::displacement(const Eigen::VectorXd &forces, const LoadCase &load) const
{
  Eigen::VectorXd f = self->free_load(load);
  for (std::size_t i = 0; i < self->kept.size(); ++i)
    if (self->kept[i] >= 0)
      f[self->kept[i]] += forces[Eigen::Index(i)];
  Eigen::VectorXd u = self->Q * Eigen::VectorXd(self->factor->solve(f));
  if (load.displacement.size() > 0)
    for (Eigen::Index i = 0; i < u.size(); ++i)
      if (self->held[i])
        u[i] = load.displacement[i];
  return u;
}

Eigen::VectorXd CondensedSurface::reactions(const Eigen::VectorXd &field, const LoadCase &load) const
{
  Eigen::VectorXd r = product(self->K, field);
  if (load.force.size() > 0)
    r -= load.force;
  for (Eigen::Index i = 0; i < r.size(); ++i)
    if (!self->held[i])
      r[i] = 0;
  return r;
}

Eigen::MatrixXd pressure_load(const Surface &surface,
                              const std::function<double(const Eigen::VectorXd &)> &pressure)
{
  Eigen::MatrixXd out                        = Eigen::MatrixXd::Zero(surface.points.rows(), surface.points.cols());
  const std::vector<contact::FaceRule> rules = contact::whole_faces(surface);
  for (std::size_t f = 0; f < rules.size(); ++f)
    for (Eigen::Index q = 0; q < rules[f].weight.size(); ++q) {
      const double force = -pressure(rules[f].points.row(q)) * rules[f].weight[q];
      for (Eigen::Index k = 0; k < surface.faces.cols(); ++k)
        out.row(surface.faces(Eigen::Index(f), k)) += force * rules[f].slave(q, k) * rules[f].normals.row(q);
    }
  return out;
}

LoadCase load_on(const Surface &surface, const Eigen::MatrixXd &forces, const Eigen::Index n_unknowns)
{
  LoadCase out;
  out.force            = Eigen::VectorXd::Zero(n_unknowns);
  const Eigen::Index d = surface.points.cols();
  for (std::size_t i = 0; i < surface.node.size(); ++i)
    out.force.segment(d * surface.node[i], d) += forces.row(Eigen::Index(i)).transpose();
  return out;
}
}  // namespace mill::fem
