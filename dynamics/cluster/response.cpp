#include "dynamics/cluster/response.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include <Eigen/LU>
#include <cmath>

namespace mill::cluster {
namespace {
using Complex = std::complex<double>;

// Stiffness with its losses.
Eigen::MatrixXcd complex_stiffness(const Stack &stack, const Motion &u)
{
  const Tangent K       = tangent(stack, stack.coupled && u.size() != stack.size() ? with_rotation(u) : u);
  Eigen::MatrixXcd sum  = K.total.cast<Complex>();
  const auto add_losses = [&](const auto &parts, const auto &owners) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (owners[i].loss_factor != 0)
        sum += Complex(0, owners[i].loss_factor) * parts[i].template cast<Complex>();
  };
  add_losses(K.contacts, stack.contacts);
  add_losses(K.supports, stack.supports);
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
