#include "dynamics/response/frequency_response.h"
#include "dynamics/response/matrix_exponential.h"
#include "dynamics/response/state_space.h"
#include <Eigen/LU>
#include <cmath>
#include <complex>

namespace mill::dynamics {
FrequencyResponse frequency_response(const MillModel &model, const Eigen::VectorXd &frequency)
{
  using Complex = std::complex<double>;
  FrequencyResponse result{frequency, Eigen::MatrixXcd(frequency.size(), model.M.size()),
                           Eigen::VectorXcd(frequency.size())};
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const double w           = 2 * M_PI * frequency[i];
    Eigen::MatrixXcd dynamic = model.K.cast<Complex>() + Complex(0, w) * model.C.cast<Complex>();
    dynamic.diagonal() -= (w * w * model.M).cast<Complex>();
    const Eigen::VectorXcd y   = dynamic.partialPivLu().solve(model.b.cast<Complex>());  // (6.16)
    result.acceleration.row(i) = -w * w * y.transpose();
    result.load_cell[i]        = model.load_cell.cast<Complex>().dot(y);
  }
  return result;
}

Eigen::VectorXd largest_response(const MillModel &model, const double half_range, const double duration,
                                 const double rate)
{
  const StateSpace system = state_space(model);
  const Eigen::Index n    = model.M.size();
  const Eigen::MatrixXd E = matrix_exponential(system.A / rate);
  const Eigen::MatrixXd C = system.C.topRows(n);
  // Release from the equilibrium under 1 N: the unit step seen from its other end.  Acceleration jumps by D first.
  Eigen::VectorXd x      = equilibrium(system, 1);
  Eigen::VectorXd before = C * x, variation = system.D.head(n).cwiseAbs();
  Eigen::VectorXd next, now;
  for (auto left = std::llround(duration * rate); left > 0; --left) {
    next.noalias() = E * x;
    x.swap(next);
    now.noalias() = C * x;
    variation += (now - before).cwiseAbs();  // exact while the acceleration is monotone over the step
    before.swap(now);
  }
  return half_range * variation;  // (7.8)
}
}  // namespace mill::dynamics
