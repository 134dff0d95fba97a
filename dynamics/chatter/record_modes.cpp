#include "core/base/errors.h"
#include "dynamics/chatter/history.h"
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <utility>

namespace mill::dynamics {
namespace {
constexpr Eigen::Index most_rows = 60, most_motions = 14;

// Slope of the straight line through values at 0, 1, 2, ..
double slope(const Eigen::VectorXd &value)
{
  const Eigen::Index n         = value.size();
  const Eigen::VectorXd offset = Eigen::VectorXd::LinSpaced(n, -0.5 * double(n - 1), 0.5 * double(n - 1));
  return offset.dot(value) / offset.squaredNorm();
}

// Logarithm of a rotating number along a record, its angle continued without jumps.
struct Unwound {
  Eigen::VectorXd log_size, angle;
};
Unwound unwound(const Eigen::VectorXcd &rotating, const double angle_per_step)
{
  Unwound u{rotating.cwiseAbs().array().log(), Eigen::VectorXd(rotating.size())};
  double last = std::arg(rotating[0]);
  u.angle[0]  = last;
  for (Eigen::Index k = 1; k < rotating.size(); ++k) {
    const double expected = last + angle_per_step;
    last                  = expected + std::remainder(std::arg(rotating[k]) - expected, 2 * M_PI);
    u.angle[k]            = last;
  }
  return u;
}
}  // namespace

std::vector<RecordMode> record_modes(const Eigen::VectorXd &signal, const double step, const double noise)
{
  const Eigen::Index n = signal.size();
  if (n < 40 || !(signal.cwiseAbs().maxCoeff() > 0))
    return {};
  // Rows are copies delayed by `delay`, columns the moments: as long a span as leaves half the record for the fit.
  const Eigen::Index rows = std::min(most_rows, n / 4), delay = std::max<Eigen::Index>(1, n / 2 / rows);
  const Eigen::Index columns = n - (rows - 1) * delay;
  Eigen::MatrixXd copies(rows, columns);
  for (Eigen::Index r = 0; r < rows; ++r)
    copies.row(r) = signal.segment(r * delay, columns).transpose();

  // Directions of the copies, through the triangle of a QR of the transpose: the record is long.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(copies.transpose());
  const Eigen::MatrixXd triangle = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Eigen::MatrixXd(triangle.transpose()), Eigen::ComputeFullU);
  const Eigen::VectorXd &sizes = svd.singularValues();
  Eigen::Index rank            = 0;
  while (rank < std::min(rows, most_motions) && sizes[rank] > noise * sizes[0])
    ++rank;
  const Eigen::MatrixXd w = svd.matrixU().leftCols(rank).transpose() * copies;  // (rank, columns)

  // One step of them, w_k+1 = T w_k, and their motions, each of which rotates and grows independently.
  const Eigen::MatrixXd before = w.leftCols(columns - 1), after = w.rightCols(columns - 1);
  const Eigen::MatrixXd T = Eigen::MatrixXd(before.transpose())
                                .colPivHouseholderQr()
                                .solve(Eigen::MatrixXd(after.transpose()))
                                .transpose();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(T);
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::MatrixXcd motion  = vectors.fullPivLu().solve(w.cast<std::complex<double>>());
  const Eigen::RowVectorXcd seen = svd.matrixU().row(0).leftCols(rank) * vectors;  // in the undelayed signal

  std::vector<std::pair<double, RecordMode>> result;  // with the size at the end
  for (Eigen::Index j = 0; j < rank; ++j) {
    const std::complex<double> per_step = solver.eigenvalues()[j];
    if (per_step.imag() < 0)
      continue;
    const Unwound u = unwound(motion.row(j).transpose(), std::arg(per_step));
    RecordMode mode;
    mode.growth    = slope(u.log_size) / step;
    mode.frequency = slope(u.angle) / step / (2 * M_PI);
    mode.amplitude = (per_step.imag() > 0 ? 2 : 1) * std::abs(seen[j]) *
                     std::exp(u.log_size.mean() - mode.growth * step * 0.5 * double(columns - 1));
    result.push_back({mode.amplitude * std::exp(mode.growth * step * double(n - 1)), mode});
  }
  std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) { return a.first > b.first; });
  std::vector<RecordMode> modes;
  for (const auto &[size, mode] : result)
    modes.push_back(mode);
  return modes;
}

RecordMode mode_near(const std::vector<RecordMode> &modes, const double frequency)
{
  const auto nearest = std::min_element(modes.begin(), modes.end(), [&](const auto &a, const auto &b) {
    return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
  });
  if (nearest == modes.end() || std::abs(nearest->frequency - frequency) > 0.1 * frequency)
    throw SolverError({fmt::format("the record has no motion near {:.6g} Hz", frequency),
                       nearest == modes.end() ? "it has none at all"
                                              : fmt::format("the nearest has {:.6g} Hz", nearest->frequency),
                       "a record shorter than some periods, or a mode that has died out", "take a longer record",
                       "the record"});
  return *nearest;
}
}  // namespace mill::dynamics
