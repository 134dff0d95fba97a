#include "dynamics/chatter/history.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "dynamics/response/matrix_exponential.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
Eigen::Index row_of(const StandStructure &s, const std::string &label)
{
  return std::find(s.labels.begin(), s.labels.end(), label) - s.labels.begin();
}

// Rows that say where both work rolls are, if their sum is the gap.
Eigen::MatrixXd work_roll_rows(const StandStructure &s)
{
  const Eigen::Index upper = row_of(s, "upper work roll"), lower = row_of(s, "lower work roll");
  const Eigen::Index n = s.point.rows();
  if (upper < n && lower < n && s.n() > 1 &&
      (s.b.transpose() - s.point.row(upper) - s.point.row(lower)).norm() <= 1e-12 * s.b.norm()) {
    Eigen::MatrixXd rows(2, s.n());
    rows << s.point.row(upper), s.point.row(lower);
    return rows;
  }
  return 0.5 * s.b.transpose();
}
}  // namespace

Eigen::VectorXd displaced_rolls(const StandStructure &s, const double distance)
{
  const Eigen::MatrixXd rows = work_roll_rows(s);
  const Eigen::MatrixXd lift =
      s.M.ldlt().solve(Eigen::MatrixXd(rows.transpose()));  // least x'Mx with rows x given: M^-1 rows' (..)
  Eigen::VectorXd z = Eigen::VectorXd::Zero(2 * s.n() + 2);
  z.head(s.n())     = lift * Eigen::MatrixXd(rows * lift)
                             .fullPivLu()
                             .solve(Eigen::VectorXd(Eigen::VectorXd::Constant(rows.rows(), distance)));
  return z;
}

Eigen::VectorXd critical_mode(const ChatterStandModel &stand, const bite::LinearCoefficients &by, const double gap)
{
  const Eigen::MatrixXd A     = chatter_matrix(stand, by);
  const Eigen::VectorXd scale = balance(A);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal()));
  Eigen::Index fastest = 0;
  solver.eigenvalues().real().maxCoeff(&fastest);
  const Eigen::VectorXcd mode = scale.asDiagonal() * solver.eigenvectors().col(fastest);
  const std::complex<double> sum =
      stand.structure.b.cast<std::complex<double>>().dot(mode.head(stand.structure.n()));
  return (gap / sum * mode).real();
}

ChatterHistory linear_history(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                              const Eigen::VectorXd &start, const double duration, const double rate)
{
  const StandStructure &s = stand.structure;
  const Eigen::Index n    = s.n();
  require(start.size() == 2 * n + 2, "the initial state does not belong to this stand");
  if (!(duration > 0) || !(rate > 0) || !std::isfinite(duration * rate))
    throw InputError(
        fmt::format("a history needs a duration and a rate above zero, not {} s and {} Hz", duration, rate));
  const Eigen::MatrixXd A     = chatter_matrix(stand, by);
  const Eigen::VectorXd scale = balance(A);
  const Eigen::MatrixXd step =
      matrix_exponential(scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal() / rate);
  const auto moments = Eigen::Index(std::floor(duration * rate * (1 + 1e-12))) + 1;

  Eigen::MatrixXd z(2 * n + 2, moments);  // scaled states, one in a column
  z.col(0) = start.cwiseQuotient(scale);
  for (Eigen::Index k = 1; k < moments; ++k)
    z.col(k).noalias() = step * z.col(k - 1);
  z = scale.asDiagonal() * z;

  ChatterHistory h;
  h.time          = Eigen::VectorXd::LinSpaced(moments, 0, double(moments - 1)) / rate;
  h.gap           = z.topRows(n).transpose() * s.b;
  h.gap_rate      = z.middleRows(n, n).transpose() * s.b;
  h.entry_tension = z.row(2 * n).transpose();
  h.exit_tension  = z.row(2 * n + 1).transpose();
  const auto sum  = [&](const bite::StripRow &row) -> Eigen::VectorXd {
    return row[0] * h.gap + row[1] * h.gap_rate + row[2] * h.entry_tension + row[3] * h.exit_tension;
  };
  h.force    = sum(by.force);
  h.friction = sum(by.friction);
  h.point    = s.point * z.topRows(n);
  h.last     = z.col(moments - 1);
  return h;
}
}  // namespace mill::dynamics
