#include "dynamics/response/modal_model.h"
#include "core/base/require.h"
#include "core/records/stand_place.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
// Parts share no mass; the rows of one stack alone.
Eigen::MatrixXd mass_of_stack(const StandModel &stand, const Eigen::MatrixXd &shape, const bool lower)
{
  Eigen::MatrixXd of_stack = Eigen::MatrixXd::Zero(shape.rows(), shape.cols());
  for (Eigen::Index i = 0; i < shape.rows(); ++i) {
    const StandPlace part = stand_place(stand.parts[std::size_t(stand.part_of[std::size_t(i)])]);
    if (!part.housing && part.lower == lower)
      of_stack.row(i) = shape.row(i);
  }
  return of_stack.transpose() * stand.M * of_stack;
}
}  // namespace

ModalModel modal_model(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                       const double damping, const double highest, const double gap_damper)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  const Eigen::Index n       = std::upper_bound(frequency.begin(), frequency.end(), highest) - frequency.begin();
  const Eigen::MatrixXd kept = shape.leftCols(n);
  ModalModel model;
  model.frequency = frequency.head(n);
  model.point.resize(Eigen::Index(stand.points.size()), n);
  for (std::size_t p = 0; p < stand.points.size(); ++p) {
    model.labels.push_back(stand.points[p].name);
    model.point.row(Eigen::Index(p)) = stand.points[p].row.transpose() * kept;
  }
  model.force           = kept.transpose() * stand.b;
  model.load_cell       = kept.transpose() * stand.load_cell;
  model.load_cell_share = stand.load_cell_share;
  model.damping         = damping;
  model.gap_damper      = gap_damper;
  if (const Eigen::MatrixXd C = dampers_of(stand); !C.isZero(0))
    model.dampers = kept.transpose() * C * kept;
  if (stand.parts.size() > 1)
    model.stack_mass = {mass_of_stack(stand, kept, false), mass_of_stack(stand, kept, true)};
  return model;
}

Eigen::MatrixXd damping_matrix(const StandModel &stand, const Eigen::VectorXd &frequency,
                               const Eigen::MatrixXd &shape, const double damping, const double gap_damper)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  const Eigen::MatrixXd MV = stand.M * shape;
  const Eigen::VectorXd c  = 4 * M_PI * damping * frequency;  // 2 zeta omega
  const Eigen::MatrixXd C =
      MV * c.asDiagonal() * MV.transpose() + gap_damper * stand.b * stand.b.transpose() + dampers_of(stand);
  return 0.5 * (C + C.transpose());
}

Eigen::MatrixXd damper_rows(const Eigen::MatrixXd &C)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(C);
  const Eigen::VectorXd &c = solver.eigenvalues();  // ascending
  const double least       = 1e-12 * c.cwiseAbs().maxCoeff();
  const auto rank          = (c.array() > least).count();
  return c.tail(rank).cwiseSqrt().asDiagonal() * solver.eigenvectors().rightCols(rank).transpose();
}

StateSpace state_space(const ModalModel &model)
{
  const Eigen::Index n = model.frequency.size(), m = model.point.rows();
  const Eigen::VectorXd rad = 2 * M_PI * model.frequency;
  StateSpace system;
  system.A                         = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  system.A.topRightCorner(n, n)    = rad.asDiagonal();
  system.A.bottomLeftCorner(n, n)  = (-rad).asDiagonal();
  system.A.bottomRightCorner(n, n) = (-2 * model.damping * rad).asDiagonal();
  // The bite force works on the gap, so its damper couples the modes by the same row, as in (6.3).
  system.A.bottomRightCorner(n, n) -= model.gap_damper * model.force * model.force.transpose();
  if (model.dampers.size() > 0)
    system.A.bottomRightCorner(n, n) -= model.dampers;
  system.B                = Eigen::VectorXd::Zero(2 * n);
  system.B.tail(n)        = model.force;
  system.C                = Eigen::MatrixXd::Zero(m + 1, 2 * n);
  system.C.topRows(m)     = model.point * system.A.bottomRows(n);
  system.C.row(m).head(n) = model.load_cell.cwiseQuotient(rad).transpose();
  system.D                = Eigen::VectorXd::Zero(m + 1);
  system.D.head(m)        = model.point * model.force;
  return system;
}
}  // namespace mill::dynamics
