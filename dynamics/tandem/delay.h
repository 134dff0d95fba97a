#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <functional>
#include <vector>

// Linear systems with delays: where all their roots are, and how they move.  theory.md 28
namespace mill::dynamics {
/// z' = A z + sum_k U_k y_k(t - delay_k) ,  y_k = W_k . z :  n states, m delayed signals.  theory.md (28.4)
struct DelaySystem {
  Eigen::MatrixXd A;      ///< (n, n) 1/s, SI
  Eigen::MatrixXd U;      ///< (n, m) what each delayed signal drives
  Eigen::MatrixXd W;      ///< (n, m) how each signal is made of the state
  Eigen::VectorXd delay;  ///< (m) s, >= 0
};

/// (n, n) A + U W^T: the system when every delay is zero.  1/s
Eigen::MatrixXd without_delay(const DelaySystem &system);

/// A root s of  [ s - A - sum_k U_k W_k^T exp(-s delay_k) ] z = 0.
struct DelayRoot {
  std::complex<double> value;  ///< 1/s
  Eigen::VectorXcd shape;      ///< (n) z, largest component 1 in balanced coordinates
  double residual = 0;         ///< -, backward error: norm of the bracket times z over the norms of both, balanced
};

/// The system in the modes of A, where its characteristic function costs m^2 n operations:
///   f(s) = det M(s) ,  M = I - diag(exp(-s delay)) W^T (s - A)^{-1} U                     theory.md (28.5)
/// Its zeros are the roots, its poles the eigenvalues of A.
class DelaySpectrum {
public:
  /// @throws InputError   shapes that do not fit, a delay below zero or not finite
  /// @throws SolverError  A has no usable modes (a defective eigenvalue)
  /// Cost O(n^3): 0.3 ms for n = 27.
  explicit DelaySpectrum(DelaySystem system);

  /// Number of roots with real part above c, both of a pair, multiple ones as often as they are: poles on that
  /// side plus the turns of f along Re s = c (argument principle).  The steps along the line are bounded so that
  /// f cannot turn unseen between two of them: the number is proven up to rounding.
  /// @param c  1/s
  /// @throws SolverError  a root or pole on the line itself, or more than 2e5 steps
  int roots_right_of(double c) const;

  /// All roots with real part above c and |Im| <= limit, by falling real part, of a pair the positive imaginary
  /// part first.  Newton's method from the line Re s = c and from lines to the right of it; what was found is
  /// compared with the number of roots in the rectangle, and where some are missing it is divided until all are
  /// found.
  /// @param c      1/s
  /// @param limit  rad/s
  /// @throws SolverError  roots that cannot be separated
  std::vector<std::complex<double>> roots(double c, double limit = 2 * M_PI * 1000) const;

  /// The root of largest real part; of a pair that with positive imaginary part.  No root is to the right of it
  /// by roots_right_of.
  /// @param near  roots at a neighbouring parameter, which save time; may be empty or wrong
  std::complex<double> rightmost(const std::vector<std::complex<double>> &near = {}) const;

  /// Newton's method on the bordered matrix from a start near a root, to rounding; with the shape.
  /// @throws SolverError  no convergence
  /// Cost: 6 factorisations of n + 1.
  DelayRoot polished(std::complex<double> start) const;

  /// Largest over w of the spectral radius of |W^T (i w - A)^{-1} U|, -.  Below one, with A stable, the system is
  /// stable for any delays; with one delay, above one means that some delay makes it unstable.  theory.md (28.8)
  double loop_gain() const;

  const Eigen::VectorXcd &poles() const  ///< (n) 1/s, eigenvalues of A
  {
    return poles_;
  }
  const DelaySystem &system() const
  {
    return system_;
  }

  /// f at s with what bounds its change.
  struct Sample {
    std::complex<double> f;       ///< -
    std::complex<double> newton;  ///< 1/s, -f/f': to the root, to first order
    double nearest = 0;           ///< 1/s, distance to the nearest pole of f
    /// Norms of M^{-1} exp(-s delay) times W^T (s - A)^{-p-1} U for p = 0, 1, 2 and, as a sum of moduli, 3
    std::array<double, 4> term{};
  };
  Sample sample(std::complex<double> s) const;

private:
  Sample sample_of_one(std::complex<double> s) const;
  double step(const Sample &point, double leftward) const;
  double turn(std::complex<double> from, std::complex<double> to, std::vector<std::complex<double>> *starts) const;
  double height(double c) const;
  int line_count(double c, std::vector<std::complex<double>> *starts) const;
  int box_count(std::complex<double> low, std::complex<double> high) const;
  bool newton(std::complex<double> &s) const;
  void search_box(std::complex<double> low, std::complex<double> high, std::vector<std::complex<double>> &roots,
                  int depth) const;
  std::vector<std::complex<double>> starts_at_poles(double c) const;

  DelaySystem system_;
  Eigen::VectorXd scale_;     ///< (n) of the balanced states
  Eigen::VectorXcd poles_;    ///< (n) 1/s
  Eigen::VectorXcd shift_;    ///< (n) 1/s, of a root from its pole to first order
  Eigen::VectorXcd active_;   ///< (a) 1/s, the poles that f has
  Eigen::MatrixXcd residue_;  ///< (m^2, a) of W^T (s - A)^{-1} U, by columns
  Eigen::MatrixXd modulus_;   ///< (m^2, a) of their entries
  double longest_ = 0;        ///< s, longest delay
};

/// Free motion of the system.
struct DelayMotion {
  Eigen::VectorXd time;    ///< (k) s, from 0
  Eigen::MatrixXd signal;  ///< (m, k) y
  Eigen::MatrixXd state;   ///< (n, k) z
};

/// Signals at a time t <= 0 and their rates, in two columns (m, 2).
using DelayHistory = std::function<Eigen::MatrixXd(double)>;

/// Motion from a state at t = 0.  The undelayed part is exact (matrix exponential); a delayed signal is a cubic
/// over each step, from values and rates at its ends.  theory.md (28.10)
/// @param step     s; shortened so that the first delay is a whole number of steps
/// @param history  before t = 0; empty: at rest
/// @throws InputError  step or duration not above 0; a step beyond a delay that is not zero
/// Error (w step)^4/384 of a delayed signal of frequency w.  Cost O(n^2) per step.
DelayMotion delay_motion(const DelaySystem &system, const Eigen::VectorXd &start, double duration, double step,
                         const DelayHistory &history = {});
}  // namespace mill::dynamics
