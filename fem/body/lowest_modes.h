#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>

namespace mill::fem {
/// Symmetric operator on vectors of n rows.
using SymmetricOperator = std::function<Eigen::VectorXd(const Eigen::VectorXd &)>;

/// Eigenvectors x of  T M x = t^2 x  with the largest t, M-normalised: the modes of lowest frequency 1/t, where T
/// takes loads to displacements and may be singular.
struct LowestModes {
  Eigen::VectorXd frequency;  ///< (k) rad per time unit, 1/t, ascending
  Eigen::MatrixXd shapes;     ///< (n, k)
};

/// @param what  for messages: "fixed-interface modes of the work roll"
/// @param rank  number of modes T has at most
/// @throws InputError   more modes than T has
/// @throws SolverError  fewer modes converged than asked for
/// Cost: 2 to 4 applications of T per mode (thick-restart Lanczos, Spectra).
LowestModes lowest_modes(const std::string &what, const SymmetricOperator &T, const SymmetricOperator &M, int n,
                         int rank, int n_modes);
}  // namespace mill::fem
