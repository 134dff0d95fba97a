#include "fem/body/lowest_modes.h"
#include "core/base/errors.h"
#include <Spectra/SymGEigsShiftSolver.h>
#include <cmath>

namespace mill::fem {
namespace {
// What Spectra asks of an operator.
struct Applied {
  using Scalar = double;
  const SymmetricOperator *apply;
  int n;
  Eigen::Index rows() const
  {
    return n;
  }
  Eigen::Index cols() const
  {
    return n;
  }
  void set_shift(const double &) {}  // T is the inverse at the shift zero already
  void perform_op(const double *in, double *out) const
  {
    Eigen::Map<Eigen::VectorXd>(out, n) = (*apply)(Eigen::Map<const Eigen::VectorXd>(in, n));
  }
};
}  // namespace

LowestModes lowest_modes(const std::string &what, const SymmetricOperator &T, const SymmetricOperator &M,
                         const int n, const int rank, const int n_modes)
{
  if (n_modes >= rank)
    throw InputError(std::to_string(n_modes) + " " + what + " are asked for, the mesh has fewer than " +
                     std::to_string(rank) + ": use a finer mesh or ask for fewer");
  LowestModes out{Eigen::VectorXd(n_modes), Eigen::MatrixXd(n, n_modes)};
  if (n_modes == 0)
    return out;
  // The start lies in the range of T, so that no vector of the iteration leaves it.  Its entries are fixed numbers
  // without a pattern: results do not depend on the clock.
  Eigen::VectorXd start(n);
  for (int i = 0; i < n; ++i)
    start[i] = std::sin(1 + 12.9898 * i);
  start = T(M(start));
  Applied inverse{&T, n}, mass{&M, n};
  const int n_lanczos = std::min(rank, std::max(2 * n_modes, n_modes + 20));
  Spectra::SymGEigsShiftSolver<Applied, Applied, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, n_modes,
                                                                                         n_lanczos, 0.);
  solver.init(start.data());
  const auto n_converged =
      solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-12, Spectra::SortRule::SmallestAlge);
  if (n_converged < n_modes || solver.info() != Spectra::CompInfo::Successful)
    throw SolverError({std::to_string(n_converged) + " of " + std::to_string(n_modes) + " " + what + " converged",
                       "after " + std::to_string(solver.num_iterations()) + " restarts of the Lanczos iteration",
                       "more modes than the mesh can distinguish", "ask for fewer modes or use a finer mesh", ""});
  out.frequency = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  out.shapes    = solver.eigenvectors();
  for (int k = 0; k < n_modes; ++k)  // once more through T: what rounding put outside its range goes
    out.shapes.col(k) = T(M(out.shapes.col(k)));
  for (int k = 0; k < n_modes; ++k)
    out.shapes.col(k) /= std::sqrt(out.shapes.col(k).dot(M(out.shapes.col(k))));
  return out;
}
}  // namespace mill::fem
