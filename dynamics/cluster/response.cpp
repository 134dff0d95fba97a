#include "dynamics/cluster/response.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include <Eigen/LU>
#include <cmath>

namespace mill::cluster {
namespace {
using Complex = std::complex<double>;

// Stiffness with its losses.  (38.16)
Eigen::MatrixXcd complex_stiffness(const Stack &stack, const Motion &u)
{
  const Tangent K      = tangent(stack, stack.coupled && u.size() != stack.size() ? with_rotation(u) : u);
  Eigen::MatrixXcd sum = K.total.cast<Complex>();
  // what a force loses by turning with its contact comes back: the geometric term has no loss
  for (std::size_t i = 0; i < K.contacts.size(); ++i)
    if (const double loss = stack.contacts[i].loss_factor; loss != 0)
      sum += Complex(0, loss) * (K.contacts[i] - K.geometric[i]).cast<Complex>();
  for (std::size_t i = 0; i < K.supports.size(); ++i)
    if (const double loss = stack.supports[i].loss_factor; loss != 0)
      sum += Complex(0, loss) * K.supports[i].cast<Complex>();
  return sum;
}

Eigen::VectorXcd solve_at(const Eigen::MatrixXcd &K, const Eigen::VectorXd &m, const Eigen::VectorXd &force,
                          const double frequency)
{
  const double omega = 2 * M_PI * frequency;
  Eigen::MatrixXcd Z = K;
  Z.diagonal() -= (omega * omega * m).cast<Complex>();
  return Z.partialPivLu().solve(force.cast<Complex>());
}
}  // namespace

Eigen::VectorXcd harmonic_response(const Stack &stack, const Motion &u, const Eigen::VectorXd &force,
                                   const double frequency)
{
  return solve_at(complex_stiffness(stack, u), masses(stack), force, frequency);
}

Eigen::MatrixXcd harmonic_responses(const Stack &stack, const Motion &u, const Eigen::VectorXd &force,
                                    const Eigen::VectorXd &frequencies)
{
  const Eigen::MatrixXcd K = complex_stiffness(stack, u);
  const Eigen::VectorXd m  = masses(stack);
  Eigen::MatrixXcd all(m.size(), frequencies.size());
  for (Eigen::Index i = 0; i < frequencies.size(); ++i)
    all.col(i) = solve_at(K, m, force, frequencies[i]);
  return all;
}

double detuned_ratio(const double mode_frequency, const double frequency, const double loss_factor)
{
  const double square = mode_frequency * mode_frequency, away = square - frequency * frequency;
  return std::hypot(away, loss_factor * square) / std::abs(away);
}
}  // namespace mill::cluster
