#include "dynamics/solver_poles.h"
#include <Eigen/Dense>
#include <cmath>
#include <complex>

namespace mill::dynamics {
namespace {
// One step of  M a(n+1-am) + K y(n+1-af) = 0  with Newmark's update of y and y', written for the state
// (y, h y', h^2 y''):  left * new = right * old.  (7.10)
Eigen::Matrix3d generalised_alpha_step(const double wh, const double rho)
{
  const double am = (2 * rho - 1) / (rho + 1), af = rho / (rho + 1);
  const double gamma = 0.5 - am + af, beta = std::pow(1 - am + af, 2) / 4;
  Eigen::Matrix3d left, right;
  left << 1, 0, -beta, 0, 1, -gamma, (1 - af) * wh * wh, 0, 1 - am;
  right << 1, 1, 0.5 - beta, 0, 1, 1 - gamma, -af * wh * wh, 0, -am;
  return left.partialPivLu().solve(right);
}

Pole of_amplification(const std::complex<double> factor, const double step)
{
  const double growth = std::log(std::abs(factor)), turn = std::abs(std::arg(factor));
  return {turn / (2 * M_PI * step), -growth / std::hypot(growth, turn)};
}
}  // namespace

Pole seen_through(const StepMethod method, const double frequency, const double step, const double rho)
{
  const double wh = 2 * M_PI * frequency * step;
  if (method == StepMethod::implicit_euler)
    return of_amplification(1.0 / std::complex<double>(1, -wh), step);  // (7.9)
  if (method == StepMethod::newmark)
    return {std::atan(wh / 2) / (M_PI * step), 0};  // (7.9): the amplification factor has modulus 1 exactly
  // Of the three factors the one that turns is the mode; the third belongs to the lagging acceleration.
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(generalised_alpha_step(wh, rho), false);
  std::complex<double> mode = solver.eigenvalues()[0];
  for (const std::complex<double> factor : solver.eigenvalues())
    if (factor.imag() > mode.imag())
      mode = factor;
  return of_amplification(mode, step);
}
}  // namespace mill::dynamics
