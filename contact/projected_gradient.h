#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace mill::contact {
/// Contact whose operator is too large to be stored: only products with it are asked for.  One driven mode.
///     gap = initial_gap + C nodal - G motion >= 0 ,   nodal >= 0 ,   nodal . gap = 0 ,   G . nodal = resultant
struct OperatorProblem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd &)> product;  ///< C times (n), m; C positive definite
  Eigen::VectorXd G;                                                ///< (n) closing per unit of motion, >= 0
  Eigen::VectorXd initial_gap;                                      ///< (n) m
};

struct ProjectedState {
  double motion    = 0;      ///< m or rad
  double resultant = 0;      ///< N or N m
  Eigen::VectorXd nodal;     ///< (n) N, >= 0
  Eigen::VectorXd gap;       ///< (n) m, >= 0
  std::vector<char> active;  ///< (n)
  int products    = 0;       ///< with C, of all stages
  double residual = 0;       ///< -, largest violation of the conditions, relative
};

/// Conjugate gradients with projection for an imposed resultant or an imposed motion, and a final polish: plain
/// conjugate gradients on the set found, exchanged until no node violates a condition.  For more nodes than an
/// ActiveSet can hold (about 4000); there the active set is faster and more accurate.
///
/// @param value    N or m
/// @param start    (n) forces to begin with, for instance of the last load; empty: spread over all nodes
/// @throws InputError   sizes, NaN, G < 0
/// @throws SolverError  the resultant needs tension; not converged within `most_products`
/// Cost: some ten to hundred products with C.
/// Source: I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206.  theory.md 9
ProjectedState contact_by_projection(const OperatorProblem &problem, double value, bool by_motion,
                                     const Eigen::VectorXd &start = {}, int most_products = 20000);
}  // namespace mill::contact
