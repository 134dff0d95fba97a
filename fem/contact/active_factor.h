#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::contact {
/// Nodes that may join an active set, seen through it: what is left of their equations when the active nodes have
/// been eliminated.
struct Border {
  std::vector<int> nodes;  ///< (m) candidates
  Eigen::MatrixXd V;       ///< (a, m) L^-1 C_AU
  Eigen::MatrixXd S;       ///< (m, m) Schur complement C_UU - V^T V, positive definite
  Eigen::MatrixXd rhs;     ///< (m, c) reduced right-hand sides B_U - V^T X
};

/// Cholesky factor of C_AA for a set A that grows and shrinks by a few nodes at a time, with the forward-solved
/// right-hand sides X = L^-1 B_A next to it.  theory.md 9
///
/// Growing appends rows and shrinking adds rank-one terms: both are stable for any positive definite C, no
/// downdate occurs.  Nodes keep the order in which they came, so those that come last go cheapest.
class ActiveFactor {
public:
  /// @param C    (n, n) symmetric positive definite; referred to, not copied: must outlive the factor
  /// @param rhs  (n, c) right-hand sides B
  ActiveFactor(const Eigen::MatrixXd &C, Eigen::MatrixXd rhs);

  /// A = order, factorised again.  Cost a^3 / 3.
  /// @throws SolverError  C_AA not positive definite
  void reset(const std::vector<int> &order);
  /// Takes nodes out.  One: a rank-one update, 2 t^2 with t nodes behind it.  Several: the trailing block again.
  void remove(const std::vector<int> &nodes);
  /// Cost a^2 m.
  Border border(const std::vector<int> &nodes) const;
  /// Adds the chosen nodes of a border made with the present set.
  /// @throws SolverError  C not positive definite
  void append(const Border &border, const std::vector<char> &chosen);
  /// Replaces column j of B.
  void set_rhs(int j, const Eigen::VectorXd &column);

  const std::vector<int> &order() const
  {
    return order_;
  }
  bool contains(int node) const
  {
    return position_[node] >= 0;
  }
  /// (n) 1 for the nodes of A.
  std::vector<char> indicator() const;
  const Eigen::MatrixXd &rhs() const
  {
    return B_;
  }
  /// (c, c) B_A^T C_AA^-1 B_A.
  Eigen::MatrixXd gram() const;
  /// (a, p) C_AA^-1 B_A coefficients, coefficients (c, p).
  Eigen::MatrixXd combine(const Eigen::MatrixXd &coefficients) const;
  /// (a, p) C_AA^-1 values.
  Eigen::MatrixXd solve(const Eigen::MatrixXd &values) const;
  /// (n, p) C_(:,A) values.
  Eigen::MatrixXd product(const Eigen::MatrixXd &values) const;

private:
  void reserve(int size);
  void rebuild(int from);

  const Eigen::MatrixXd *C_;
  Eigen::MatrixXd B_, L_, X_;  // L_, X_: the first order_.size() rows are in use
  std::vector<int> order_, position_;
};
}  // namespace mill::contact
