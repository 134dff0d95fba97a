#include "twin/advice/joined_stand.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

std::string with_blanks(std::string name)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

Eigen::VectorXd row_of(const VibratingStand &stand, const Attachment &a)
{
  Eigen::VectorXd row = Eigen::VectorXd::Zero(stand.frequency.size());
  if (a.to >= 0)
    row += stand.point.row(a.to).transpose();
  if (a.from >= 0)
    row -= stand.point.row(a.from).transpose();
  return row;
}

// Displacements of places and attachments per force, at one frequency after the other, with some attachments
// joined: X = L D Q - (L D R') (I + Z G)^-1 Z (R D Q), G = R D R'.  (46.3)
class Receptances {
public:
  /// @param seen  (l, n) rows that are looked at
  /// @param driven  (n, q) forces on the modes
  Receptances(const VibratingStand &stand, const std::vector<Attachment> &joined, const Eigen::MatrixXd &seen,
              const Eigen::MatrixXd &driven)
      : stand_(stand), joined_(joined)
  {
    const Eigen::Index n = stand.frequency.size();
    const bool gap       = stand.gap_damper > 0;
    const auto r         = Eigen::Index(joined.size()) + (gap ? 1 : 0);
    rows_.resize(seen.rows() + r, n);
    rows_.topRows(seen.rows()) = seen;
    for (std::size_t i = 0; i < joined.size(); ++i)
      rows_.row(seen.rows() + Eigen::Index(i)) = row_of(stand, joined[i]).transpose();
    if (gap)
      rows_.bottomRows(1) = stand.force.transpose();
    columns_.resize(n, driven.cols() + r);
    columns_.leftCols(driven.cols()) = driven;
    columns_.rightCols(r)            = rows_.bottomRows(r).transpose();
    l_ = seen.rows(), q_ = driven.cols(), r_ = r;
    scaled_.resize(n, columns_.cols());
    all_.resize(rows_.rows(), columns_.cols());
  }
  /// (l, q) m/N at w in rad/s.
  const Eigen::MatrixXcd &at(const double w)
  {
    for (Eigen::Index i = 0; i < stand_.frequency.size(); ++i) {
      const double natural = stand_.frequency[i];
      scaled_.row(i) =
          columns_.row(i) / Complex((natural - w) * (natural + w), 2 * stand_.damping[i] * natural * w);
    }
    all_.noalias() = rows_ * scaled_;
    if (r_ == 0)
      return all_;
    Eigen::MatrixXcd system = Eigen::MatrixXcd::Identity(r_, r_), right(r_, q_);
    for (Eigen::Index i = 0; i < r_; ++i) {
      const Complex z = i < Eigen::Index(joined_.size()) ? dynamic_stiffness(joined_[std::size_t(i)], w)
                                                         : Complex(0, w * stand_.gap_damper);
      system.row(i) += z * all_.block(l_ + i, q_, 1, r_);
      right.row(i) = z * all_.block(l_ + i, 0, 1, q_);
    }
    const Eigen::MatrixXcd force = system.partialPivLu().solve(right);
    all_.topLeftCorner(l_, q_) -= all_.topRightCorner(l_, r_) * force;
    return all_;
  }

private:
  const VibratingStand &stand_;
  const std::vector<Attachment> &joined_;
  Eigen::MatrixXd rows_, columns_;
  Eigen::MatrixXcd scaled_, all_;
  Eigen::Index l_, q_, r_;
};

// Matrices of the stand in its modes, with one more unknown for each tuned damper.  (46.5)
struct JoinedMatrices {
  Eigen::MatrixXd M, C, K;
};

JoinedMatrices joined_matrices(const VibratingStand &stand, const std::vector<Attachment> &joined)
{
  const Eigen::Index n = stand.frequency.size();
  const auto tuned =
      Eigen::Index(std::count_if(joined.begin(), joined.end(), [](const Attachment &a) { return a.mass > 0; }));
  JoinedMatrices s;
  s.M = Eigen::MatrixXd::Identity(n + tuned, n + tuned);
  s.C = s.K               = Eigen::MatrixXd::Zero(n + tuned, n + tuned);
  s.K.topLeftCorner(n, n) = stand.frequency.cwiseAbs2().asDiagonal();
  s.C.topLeftCorner(n, n) = (2 * stand.damping.cwiseProduct(stand.frequency)).asDiagonal();
  s.C.topLeftCorner(n, n) += stand.gap_damper * stand.force * stand.force.transpose();
  Eigen::Index next = n;
  for (const Attachment &a : joined) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n + tuned);
    row.head(n)         = row_of(stand, a);
    if (a.mass > 0) {
      const double w  = 2 * M_PI * a.frequency;
      row[next]       = -1;
      s.M(next, next) = a.mass;
      s.K += a.mass * w * w * row * row.transpose();
      s.C += 2 * a.ratio * a.mass * w * row * row.transpose();
      ++next;
    } else
      s.C += a.damper * row * row.transpose();
  }
  return s;
}
}  // namespace

int VibratingStand::place(const std::string &name) const
{
  const std::string wanted = with_blanks(name);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (with_blanks(places[i]) == wanted)
      return int(i);
  return -1;
}

VibratingStand vibrating_stand(const dynamics::MillModel &model, const Eigen::VectorXd &damping,
                               const double gap_damper)
{
  const dynamics::Modes undamped = dynamics::modes(model);
  require(damping.size() == undamped.frequency.size(), "every mode needs a damping ratio");
  return {
      model.labels, undamped.shape, 2 * M_PI * undamped.frequency, damping, undamped.shape.transpose() * model.b,
      gap_damper};
}

VibratingStand vibrating_stand(const dynamics::ModalModel &model)
{
  return {model.labels,
          model.point,
          2 * M_PI * model.frequency,
          Eigen::VectorXd::Constant(model.frequency.size(), model.damping),
          model.force,
          model.gap_damper};
}

Complex dynamic_stiffness(const Attachment &a, const double w)
{
  if (!(a.mass > 0))
    return {0, w * a.damper};
  const double natural = 2 * M_PI * a.frequency;
  const Complex held   = a.mass * Complex(natural * natural, 2 * a.ratio * natural * w);  // k + i w c
  return -w * w * a.mass * held / (held - w * w * a.mass);
}

Eigen::VectorXd levels(const VibratingStand &stand, const std::vector<Attachment> &joined, const ForceBand &force)
{
  const auto m = Eigen::Index(stand.places.size());
  Receptances response(stand, joined, stand.point, stand.force);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w = 2 * M_PI * force.frequency[k];
    square += force.square[k] * std::pow(w, 4) * response.at(w).col(0).head(m).cwiseAbs2();
  }
  return square.cwiseSqrt();
}

Eigen::VectorXd amplitude(const VibratingStand &stand, const std::vector<Attachment> &joined, const int place,
                          const Eigen::VectorXd &frequency)
{
  Receptances response(stand, joined, stand.point.row(place), stand.force);
  Eigen::VectorXd a(frequency.size());
  for (Eigen::Index k = 0; k < frequency.size(); ++k) {
    const double w = 2 * M_PI * frequency[k];
    a[k]           = w * w * std::abs(response.at(w)(0, 0));
  }
  return a;
}

Eigen::MatrixXcd bite_receptances(const VibratingStand &stand, const std::vector<Attachment> &joined,
                                  const Eigen::VectorXd &frequency)
{
  Eigen::MatrixXd seen(stand.point.rows() + 1, stand.force.size());
  seen << stand.point, stand.force.transpose();
  Receptances response(stand, joined, seen, stand.force);
  Eigen::MatrixXcd X(frequency.size(), seen.rows());
  for (Eigen::Index k = 0; k < frequency.size(); ++k)
    X.row(k) = response.at(2 * M_PI * frequency[k]).col(0).head(seen.rows()).transpose();
  return X;
}

dynamics::StandStructure joined_structure(const VibratingStand &stand, const std::vector<Attachment> &joined)
{
  JoinedMatrices s     = joined_matrices(stand, joined);
  const Eigen::Index n = stand.frequency.size();
  dynamics::StandStructure structure;
  structure.name              = "with what is joined";
  structure.labels            = stand.places;
  structure.b                 = Eigen::VectorXd::Zero(s.M.rows());
  structure.b.head(n)         = stand.force;
  structure.point             = Eigen::MatrixXd::Zero(stand.point.rows(), s.M.rows());
  structure.point.leftCols(n) = stand.point;
  structure.M                 = std::move(s.M);
  structure.C                 = std::move(s.C);
  structure.K                 = std::move(s.K);
  return structure;
}

Eigen::VectorXd first_order(const VibratingStand &stand, const std::vector<Attachment> &joined,
                            const std::vector<Attachment> &added, const ForceBand &force)
{
  const auto m = Eigen::Index(stand.places.size()), r = Eigen::Index(added.size());
  Eigen::MatrixXd seen(m + r, stand.frequency.size()), driven(stand.frequency.size(), r + 1);
  seen.topRows(m) = stand.point;
  driven.col(0)   = stand.force;
  for (Eigen::Index j = 0; j < r; ++j) {
    driven.col(1 + j) = row_of(stand, added[std::size_t(j)]);
    seen.row(m + j)   = driven.col(1 + j).transpose();
  }
  Receptances response(stand, joined, seen, driven);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(m), slope = Eigen::VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w            = 2 * M_PI * force.frequency[k];
    const Eigen::MatrixXcd &X = response.at(w);
    const double weight       = force.square[k] * std::pow(w, 4);
    square += weight * X.col(0).head(m).cwiseAbs2();
    for (Eigen::Index j = 0; j < r; ++j) {
      const Complex push = dynamic_stiffness(added[std::size_t(j)], w) * X(m + j, 0);
      slope -= weight * (X.col(0).head(m).conjugate().cwiseProduct(X.col(1 + j).head(m)) * push).real();
    }
  }
  return (square.array() > 0).select(slope.cwiseQuotient(square), 0.0);
}

std::vector<dynamics::Pole> poles(const VibratingStand &stand, const std::vector<Attachment> &joined)
{
  const JoinedMatrices s  = joined_matrices(stand, joined);
  const Eigen::Index n    = s.K.rows();
  const Eigen::VectorXd m = s.M.diagonal().cwiseInverse();
  // Time in units of the highest mode: displacement and velocity are then of like size.
  const double unit = std::max(1.0, std::sqrt((m.asDiagonal() * s.K).diagonal().maxCoeff()));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n)  = -(m.asDiagonal() * s.K) / (unit * unit);
  A.bottomRightCorner(n, n) = -(m.asDiagonal() * s.C) / unit;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  if (solver.info() != Eigen::Success)
    throw SolverError({"eigenvalues of the stand with its dampers: no convergence", "",
                       "a number that is not finite", "check the dampers of [advice]", ""});
  std::vector<dynamics::Pole> poles;
  for (const Complex lambda : solver.eigenvalues())
    if (lambda.imag() >= 0 && std::abs(lambda) > 0)
      poles.push_back({unit * std::abs(lambda) / (2 * M_PI), -lambda.real() / std::abs(lambda)});
  std::sort(poles.begin(), poles.end(),
            [](const dynamics::Pole &a, const dynamics::Pole &b) { return a.frequency < b.frequency; });
  return poles;
}

TunedLevel::TunedLevel(const VibratingStand &stand, const std::vector<Attachment> &joined, const int seen,
                       const int place, const ForceBand &force)
    : w_(2 * M_PI * force.frequency), square_(force.square), to_place_(w_.size()), to_damper_(w_.size()),
      crossed_(w_.size()), own_(w_.size())
{
  Eigen::MatrixXd rows(2, stand.frequency.size()), driven(stand.frequency.size(), 2);
  rows.row(0)   = stand.point.row(seen);
  rows.row(1)   = stand.point.row(place);
  driven.col(0) = stand.force;
  driven.col(1) = rows.row(1).transpose();
  square_.array() *= w_.array().square().square();
  Receptances response(stand, joined, rows, driven);
  for (Eigen::Index k = 0; k < w_.size(); ++k) {
    const Eigen::MatrixXcd &X = response.at(w_[k]);
    to_place_[k] = X(0, 0), to_damper_[k] = X(1, 0);
    crossed_[k] = X(0, 1), own_[k] = X(1, 1);
  }
}

double TunedLevel::operator()(const Attachment &tuned) const
{
  double square = 0;
  for (Eigen::Index k = 0; k < w_.size(); ++k) {
    const Complex z = dynamic_stiffness(tuned, w_[k]);
    square += square_[k] * std::norm(to_place_[k] - crossed_[k] * z * to_damper_[k] / (1.0 + z * own_[k]));
  }
  return std::sqrt(square);
}
}  // namespace mill::twin
