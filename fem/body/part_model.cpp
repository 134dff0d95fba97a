#include "fem/body/part_model.h"
#include "core/base/errors.h"
#include "fem/body/free_unknowns.h"
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <utility>

namespace mill::fem {
struct PartModel::Implementation {
  std::string name;
  const ElasticBody *body;
  PartSupport support;
  FreeUnknowns free;
  std::unique_ptr<CondensingFactor> factor;
};

namespace {
// The six rigid motions about the centre of the nodes, in one length scale.
Eigen::MatrixXd rigid_motions(const Eigen::Matrix<double, Eigen::Dynamic, 3> &nodes)
{
  const Eigen::RowVector3d centre = nodes.colwise().mean();
  const double size               = (nodes.rowwise() - centre).rowwise().norm().maxCoeff();
  Eigen::MatrixXd out             = Eigen::MatrixXd::Zero(3 * nodes.rows(), 6);
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    const Eigen::RowVector3d x = (nodes.row(n) - centre) / size;
    out.block<3, 3>(3 * n, 0).setIdentity();
    out.block<3, 3>(3 * n, 3) << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0;
  }
  return out;
}

const char *const motion_names[] = {"along x", "along y", "along z", "about x", "about y", "about z"};

// A rigid motion that no held unknown resists, in words; empty: none.
std::string left_over(const ElasticBody &body, const std::vector<char> &held)
{
  const Eigen::MatrixXd motions = rigid_motions(body.nodes());
  Eigen::MatrixXd resisted      = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index i = 0; i < motions.rows(); ++i)
    if (held[std::size_t(i)])
      resisted += motions.row(i).transpose() * motions.row(i);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(resisted, Eigen::ComputeFullV);
  // One held unknown gives an eigenvalue of about one; two of them closer than 1e-5 of the body hold no rotation.
  if (svd.singularValues()[5] > 1e-10)
    return "";
  Eigen::Index largest = 0;
  svd.matrixV().col(5).cwiseAbs().maxCoeff(&largest);
  return motion_names[largest];
}
}  // namespace

PartModel::PartModel(std::string name, const ElasticBody &body, PartSupport support)
    : self(std::make_unique<Implementation>())
{
  self->name    = std::move(name);
  self->body    = &body;
  self->support = std::move(support);
  if (self->support.rigid.size() == 0)
    self->support.rigid.resize(3 * body.nodes().rows(), 0);
  if (const std::string motion = left_over(body, self->support.held); !motion.empty())
    throw InputError("the " + self->name + " can move freely " + motion +
                     ": no support, symmetry or pin holds it in that direction; give it a support");
  self->free   = free_unknowns(body.unit_stiffness(), self->support.held);
  self->factor = std::make_unique<CondensingFactor>(self->free.K, self->free.node, std::vector<int>());
}
PartModel::~PartModel()                     = default;
PartModel::PartModel(PartModel &&) noexcept = default;

const std::string &PartModel::name() const
{
  return self->name;
}
const ElasticBody &PartModel::body() const
{
  return *self->body;
}
const PartSupport &PartModel::support() const
{
  return self->support;
}
int PartModel::copies() const
{
  return self->support.copies;
}
int PartModel::n_unknowns() const
{
  return int(self->free.unknown.size());
}
double PartModel::mass() const
{
  // One by one, not M.sum(): Eigen sums packets from the first aligned address, and a sparse matrix lies at any
  // multiple of 16 bytes.  Which one depends on the schedule, and Lanczos' iteration makes 1e-11 of the last bit.
  const SymmetricSparse &M = self->body->mass();
  double sum               = 0;
  for (Eigen::Index j = 0; j < M.outerSize(); ++j)
    for (SymmetricSparse::InnerIterator entry(M, j); entry; ++entry)
      sum += (entry.row() == j ? 1 : 2) * entry.value();
  return copies() * sum;
}
double PartModel::time_unit() const
{
  return std::sqrt(mass() / copies() / self->body->stiffness_unit());
}
double PartModel::factor_bytes() const
{
  return self->factor->cost().bytes;
}

Eigen::MatrixXd PartModel::solve(const Eigen::MatrixXd &F) const
{
  const auto &unknown = self->free.unknown;
  Eigen::MatrixXd load(Eigen::Index(unknown.size()), F.cols());
  for (std::size_t i = 0; i < unknown.size(); ++i)
    load.row(Eigen::Index(i)) = F.row(unknown[i]);
  const Eigen::MatrixXd u = self->factor->solve(load) / self->body->stiffness_unit();
  Eigen::MatrixXd out     = Eigen::MatrixXd::Zero(F.rows(), F.cols());
  for (std::size_t i = 0; i < unknown.size(); ++i)
    out.row(unknown[i]) = u.row(Eigen::Index(i));
  return out;
}

Eigen::MatrixXd PartModel::mass_times(const Eigen::MatrixXd &U) const
{
  // The scalar matrix of the nodes, its upper triangle, times the three directions of each vector at once.
  const SymmetricSparse &M = self->body->mass();
  Eigen::MatrixXd out      = Eigen::MatrixXd::Zero(U.rows(), U.cols());
  for (Eigen::Index k = 0; k < U.cols(); ++k) {
    const Eigen::Map<const Eigen::Matrix3Xd> u(U.col(k).data(), 3, U.rows() / 3);
    Eigen::Map<Eigen::Matrix3Xd> product(out.col(k).data(), 3, U.rows() / 3);
    for (Eigen::Index j = 0; j < M.outerSize(); ++j) {
      const Eigen::Vector3d of_node = u.col(j);
      Eigen::Vector3d sum           = Eigen::Vector3d::Zero();
      for (SymmetricSparse::InnerIterator entry(M, j); entry; ++entry)
        if (entry.row() == j)
          sum += entry.value() * of_node;
        else {
          sum += entry.value() * u.col(entry.row());
          product.col(entry.row()) += entry.value() * of_node;
        }
      product.col(j) += sum;
    }
  }
  return out;
}

BorderedPart::BorderedPart(const PartModel &p, const PartInterface &i) : part(&p), interface(&i)
{
  const Eigen::MatrixXd &W = i.weights, &R = p.support().rigid;
  const Eigen::Index n = W.cols(), r = R.cols();
  const Eigen::MatrixXd WR = W.transpose() * R;
  if (r > 0) {
    // W^T R is of order one, since W takes means and R is given per unit of motion.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(WR, Eigen::ComputeFullV);
    if (n < r || svd.singularValues()[r - 1] < 1e-9 * std::max(1., svd.singularValues()[0])) {
      Eigen::Index largest = 0;
      svd.matrixV().col(r - 1).cwiseAbs().maxCoeff(&largest);
      throw InputError("the interface of the " + p.name() + " does not hold it " +
                       p.support().rigid_names.at(std::size_t(largest)) +
                       ": a rigid motion is left over; add an interface displacement that follows this motion");
    }
  }
  GW = p.solve(W);
  Eigen::MatrixXd border(n + r, n + r);
  border << W.transpose() * GW, WR, WR.transpose(), Eigen::MatrixXd::Zero(r, r);
  // In equal units: flexibilities are of order 1e-11 m/N, next to entries of order one.
  const double scale = border.topLeftCorner(n, n).diagonal().mean();
  Eigen::VectorXd s  = Eigen::VectorXd::Constant(n + r, 1 / std::sqrt(scale));
  s.tail(r).setConstant(std::sqrt(scale));
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(s.asDiagonal() * border * s.asDiagonal());
  if (!lu.isInvertible())
    throw InputError("the interface displacements of the " + p.name() +
                     " depend on each other: two of them are the same, or more are given than the mesh can "
                     "distinguish; leave some out or use a finer mesh");
  border_inverse   = s.asDiagonal() * lu.inverse() * s.asDiagonal();
  reactions        = border_inverse.topLeftCorner(n, n);
  reactions        = 0.5 * (reactions + reactions.transpose()).eval();
  constraint_modes = GW * border_inverse.topLeftCorner(n, n) + R * border_inverse.bottomLeftCorner(r, n);
}

Eigen::MatrixXd BorderedPart::held_solve(const Eigen::MatrixXd &F) const
{
  const Eigen::MatrixXd &W = interface->weights, &R = part->support().rigid;
  const Eigen::Index n = W.cols(), r = R.cols();
  const Eigen::MatrixXd u = part->solve(F);
  Eigen::MatrixXd right(n + r, F.cols());
  right << -W.transpose() * u, -R.transpose() * F;
  const Eigen::MatrixXd answer = border_inverse * right;
  return u + GW * answer.topRows(n) + R * answer.bottomRows(r);
}

double mesh_reach(const double element, const double radius, const Material &material)
{
  const double nu = material.poisson_ratio, E = material.youngs_modulus, rho = material.density;
  const double kappa = 6 * (1 + nu) / (7 + 6 * nu), shear = kappa * E / (2 * (1 + nu));
  const double gyration = 0.25 * radius * radius;  // I / A
  // (21.11): x = (k h)^2 where the frequency is too high by as much as that of a shear wave of four elements.
  const double locking = shear / E * element * element / gyration, limit = std::pow(M_PI / 2, 4);
  const double x  = 2 * limit / (locking + std::sqrt(locking * locking + 4 * limit));
  const double k2 = x / (element * element);
  // (21.12): a w^4 - b w^2 + c = 0 for Timoshenko's waves, divided by rho A.
  const double a = rho * gyration / shear, b = 1 + gyration * (1 + E / shear) * k2,
               c      = E * gyration / rho * k2 * k2;
  const double square = 2 * c / (b + std::sqrt(b * b - 4 * a * c));
  return std::sqrt(square) / (2 * M_PI);
}
}  // namespace mill::fem
