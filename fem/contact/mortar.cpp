#include "fem/contact/mortar.h"
#include "core/base/errors.h"
#include "fem/contact/segments.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mill::contact {
namespace {
using Triplets = std::vector<Eigen::Triplet<double>>;

// The multiplier functions of one slave face as values at its points.
struct Multipliers {
  Eigen::MatrixXd psi;  // (points, nodes)
  bool dual = false;    // biorthogonal to the shape functions over the covered part
};

// psi = A phi with  A M = D ,  M = integral phi phi^T ,  D = diag(integral phi):  biorthogonal, sum one.
// theory.md 12
Multipliers multipliers(const FaceRule &rule, const bool whole)
{
  const Eigen::VectorXd D = rule.slave.transpose() * rule.weight;
  // Nodes of a quadratic face at the axis have no weight; hats have.
  if (whole && D.minCoeff() > 1e-3 * D.sum()) {
    const Eigen::MatrixXd M = rule.slave.transpose() * rule.weight.asDiagonal() * rule.slave;
    return {rule.slave * M.ldlt().solve(Eigen::MatrixXd(D.asDiagonal())), true};
  }
  return {rule.hat, false};
}

// A node with next to no weight hands its multiplier to the heaviest node of a face they share: two almost equal
// rows would make the operator almost singular.
std::vector<int> heirs(const Surface &slave, const Eigen::VectorXd &weight, const Eigen::VectorXd &whole)
{
  std::vector<int> heir(weight.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    heir[i] = weight[i] > 0.02 * whole[i] ? int(i) : -1;
  std::vector<int> out = heir;
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f)
    for (Eigen::Index k = 0; k < slave.faces.cols(); ++k)
      if (const int i = slave.faces(f, k); heir[i] < 0 && weight[i] > 0)
        for (Eigen::Index l = 0; l < slave.faces.cols(); ++l)
          if (const int j = slave.faces(f, l); heir[j] >= 0 && (out[i] < 0 || weight[j] > weight[out[i]]))
            out[i] = j;
  return out;
}

Coupling collect(const Surface &slave, const Eigen::Index n_master, const std::vector<FaceRule> &rules)
{
  const Eigen::Index n_slave = slave.points.rows();
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(n_slave), whole = Eigen::VectorXd::Zero(n_slave);
  Triplets on_slave, on_master, mean;
  double covered = 0, measure = 0;
  Eigen::Index n_points = 0;
  for (const FaceRule &rule : rules)
    n_points += rule.weight.size();
  Coupling out;
  out.points.resize(n_points, slave.points.cols());
  out.gap.resize(n_points);
  n_points = 0;
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f) {
    const FaceRule &rule = rules[f];
    covered += rule.weight.sum();
    measure += rule.measure;
    for (Eigen::Index k = 0; k < slave.faces.cols(); ++k)
      whole[slave.faces(f, k)] += rule.whole_hat[k];
    if (rule.weight.size() == 0)
      continue;
    // A thousandth: what clipping between chords loses on a curved face.
    const Multipliers m      = multipliers(rule, rule.weight.sum() > (1 - 1e-3) * rule.measure);
    const Eigen::MatrixXd wp = rule.weight.asDiagonal() * m.psi;
    const Eigen::MatrixXd S  = wp.transpose() * rule.slave;
    for (Eigen::Index k = 0; k < slave.faces.cols(); ++k) {
      const int row = slave.faces(f, k);
      weight[row] += wp.col(k).sum();
      for (Eigen::Index l = 0; l < slave.faces.cols(); ++l)
        if (!m.dual)
          on_slave.emplace_back(row, slave.faces(f, l), S(k, l));
        else if (k == l)
          on_slave.emplace_back(row, row, wp.col(k).sum());
      for (Eigen::Index q = 0; q < rule.weight.size(); ++q)
        mean.emplace_back(row, int(n_points + q), wp(q, k));
    }
    // Points on one master face stand together: one small product for each run of them.
    for (Eigen::Index from = 0, to; from < rule.weight.size() && rule.master.cols() > 0; from = to) {
      for (to = from + 1; to < rule.weight.size() && rule.master_node.row(to) == rule.master_node.row(from); ++to)
        ;
      const Eigen::MatrixXd M =
          wp.middleRows(from, to - from).transpose() * rule.master.middleRows(from, to - from);
      for (Eigen::Index k = 0; k < M.rows(); ++k)
        for (Eigen::Index l = 0; l < M.cols(); ++l)
          on_master.emplace_back(slave.faces(f, k), rule.master_node(from, l), M(k, l));
    }
    out.points.middleRows(n_points, rule.weight.size()) = rule.points;
    out.gap.segment(n_points, rule.weight.size())       = rule.gap;
    n_points += rule.weight.size();
  }
  if (covered <= 0)
    throw InputError(
        "the two contact surfaces do not face each other: check their groups, and the placement of the "
        "second body");

  const std::vector<int> heir = heirs(slave, weight, whole);
  std::vector<int> row(n_slave, -1);
  Eigen::VectorXd total = Eigen::VectorXd::Zero(n_slave);
  for (Eigen::Index i = 0; i < n_slave; ++i)
    if (heir[i] >= 0)
      total[heir[i]] += weight[i];
  for (Eigen::Index i = 0; i < n_slave; ++i)
    if (total[i] > 0) {
      row[i] = int(out.node.size());
      out.node.push_back(int(i));
    }
  out.weight          = total(out.node);
  const auto finished = [&](const Triplets &entries, const Eigen::Index n_columns) {
    Triplets kept;
    kept.reserve(entries.size());
    for (const auto &e : entries)
      if (const int to = heir[e.row()]; to >= 0)
        kept.emplace_back(row[to], e.col(), e.value() / total[to]);
    Coupling::Sparse A(Eigen::Index(out.node.size()), n_columns);
    A.setFromTriplets(kept.begin(), kept.end());
    return A;
  };
  out.slave   = finished(on_slave, n_slave);
  out.master  = finished(on_master, n_master);
  out.mean    = finished(mean, n_points);
  out.covered = covered / measure;
  return out;
}
}  // namespace

Surface placed(const Surface &surface, const Eigen::MatrixXd &turn, const Eigen::VectorXd &shift)
{
  Surface out = surface;
  out.points  = (surface.points * turn.transpose()).rowwise() + shift.transpose();
  if (turn.determinant() < 0) {
    const Eigen::Index m = surface.faces.cols();
    const int side       = surface.points.cols() == 3 ? int(std::lround(std::sqrt(double(m)))) : 0;
    for (Eigen::Index k = 0; k < m; ++k)  // a line runs backwards; a quadrilateral swaps its parameters
      out.faces.col(k) = surface.faces.col(side == 0 ? m - 1 - k : (k % side) * side + k / side);
  }
  return out;
}

Eigen::MatrixXd nodal_normals(const Surface &surface)
{
  Eigen::MatrixXd normals        = Eigen::MatrixXd::Zero(surface.points.rows(), surface.points.cols());
  const Eigen::MatrixXd position = node_parameters(surface);
  for (Eigen::Index f = 0; f < surface.faces.rows(); ++f)
    for (Eigen::Index k = 0; k < surface.faces.cols(); ++k)
      normals.row(surface.faces(f, k)) += area_vector(surface, f, position.row(k)).transpose();
  normals.rowwise().normalize();
  return normals;
}

Coupling couple(const Surface &slave, const Surface &master, const CouplingOptions &options)
{
  const Eigen::VectorXd extent = slave.points.colwise().maxCoeff() - slave.points.colwise().minCoeff();
  const double reach           = options.reach > 0 ? options.reach : 0.25 * extent.norm();
  return collect(slave, master.points.rows(),
                 slave.points.cols() == 2 ? line_overlaps(slave, master, reach)
                                          : polygon_overlaps(slave, master, reach));
}

Coupling couple_to_rigid(const Surface &slave)
{
  return collect(slave, 0, whole_faces(slave));
}
}  // namespace mill::contact
