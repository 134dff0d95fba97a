#include "core/base/errors.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/response/matrix_exponential.h"
#include "dynamics/tandem/delay.h"
#include <array>
#include <cmath>

// Time history of a delay system.
namespace mill::dynamics {
namespace {
/// A signal and its rate.
struct Point {
  double value = 0;  ///< y
  double rate  = 0;  ///< dy/dt
};

// Cubic with values and rates of both ends at the part x of an interval of length h.
Point between(const Point &a, const Point &b, const double h, const double x)
{
  const double rise = b.value - a.value, bend = 3 * rise - h * (2 * a.rate + b.rate),
               twist = h * (a.rate + b.rate) - 2 * rise;
  return {a.value + x * (h * a.rate + x * (bend + x * twist)), a.rate + x * (2 * bend + 3 * x * twist) / h};
}

/// Step of the undelayed part: z -> keep z + sum_p drive_p c_p  for signals  y = sum_p c_p (t/h)^p / p!
struct HeldStep {
  Eigen::MatrixXd keep;                  // (n, n)
  std::array<Eigen::MatrixXd, 4> drive;  // (n, m)
};

HeldStep held_step(const Eigen::MatrixXd &A, const Eigen::MatrixXd &U, const double h)
{
  const Eigen::Index n = A.rows(), m = U.cols();
  Eigen::MatrixXd all     = Eigen::MatrixXd::Zero(n + 4 * m, n + 4 * m);
  all.topLeftCorner(n, n) = h * A;
  all.block(0, n, n, m)   = h * U;
  all.block(n, n + m, 3 * m, 3 * m).setIdentity();  // derivative by t/h of every power is the one below
  const Eigen::MatrixXd e = matrix_exponential(all);
  HeldStep step;
  step.keep = e.topLeftCorner(n, n);
  for (int p = 0; p < 4; ++p)
    step.drive[p] = e.block(0, n + p * m, n, m);
  return step;
}
}  // namespace

DelayMotion delay_motion(const DelaySystem &system, const Eigen::VectorXd &start, const double duration,
                         const double step, const DelayHistory &history)
{
  const Eigen::Index n = system.A.rows(), m = system.delay.size();
  if (!(step > 0) || !(duration > 0) || !std::isfinite(duration / step))
    throw InputError("motion with delay: step " + std::to_string(step) + " s and duration " +
                     std::to_string(duration) + " s have to be above 0");
  // Signals without delay belong to the undelayed part.
  Eigen::MatrixXd A = system.A, U = system.U;
  double h = step;
  for (Eigen::Index k = 0; k < m; ++k) {
    if (system.delay[k] == 0) {
      A += U.col(k) * system.W.col(k).transpose();
      U.col(k).setZero();
      continue;
    }
    if (h == step)
      h = system.delay[k] / std::ceil(system.delay[k] / step * (1 - 1e-12));
    if (h > system.delay[k] * (1 + 1e-12))
      throw InputError("motion with delay: a step of " + std::to_string(step) + " s is longer than the delay of " +
                       std::to_string(system.delay[k]) + " s");
  }
  const Eigen::VectorXd scale = balance(A.cwiseAbs() + U.cwiseAbs() * system.W.cwiseAbs().transpose());
  A                           = scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal();
  U                           = scale.cwiseInverse().asDiagonal() * U;
  const Eigen::MatrixXd Wt = (scale.asDiagonal() * system.W).transpose(), rate_of = Wt * A, jump_of = Wt * U;
  const HeldStep hold      = held_step(A, U, h);
  const Eigen::Index steps = Eigen::Index(std::ceil(duration / h * (1 - 1e-12)));
  DelayMotion motion;
  motion.time = Eigen::VectorXd::LinSpaced(steps + 1, 0, double(steps) * h);
  motion.signal.resize(m, steps + 1);
  motion.state.resize(n, steps + 1);
  Eigen::MatrixXd rate(m, steps + 1);  // of the signals
  const auto before = [&](const Eigen::Index k, const double t) -> Point {
    if (!history)
      return {};
    const Eigen::MatrixXd y = history(t);
    return {y(k, 0), y(k, 1)};
  };
  // Signal k at time t, in steps; `left`: as it was before a jump at t = 0.
  const auto past = [&](const Eigen::Index k, const double t, const bool left) -> Point {
    const double whole = std::round(t);
    if (t < 0 && std::abs(t - whole) > 1e-9)
      return before(k, t * h);
    if (std::abs(t - whole) <= 1e-9) {
      const auto i = Eigen::Index(whole);
      return i < 0 || (i == 0 && left) ? before(k, whole * h) : Point{motion.signal(k, i), rate(k, i)};
    }
    const auto i = Eigen::Index(std::floor(t));
    return between({motion.signal(k, i), rate(k, i)}, {motion.signal(k, i + 1), rate(k, i + 1)}, h, t - double(i));
  };
  Eigen::VectorXd z = scale.cwiseInverse().asDiagonal() * start, late(m);
  for (Eigen::Index i = 0; i <= steps; ++i) {
    motion.state.col(i)  = scale.asDiagonal() * z;
    motion.signal.col(i) = Wt * z;
    std::array<Eigen::VectorXd, 4> c;
    c.fill(Eigen::VectorXd::Zero(m));
    late.setZero();
    for (Eigen::Index k = 0; k < m; ++k)
      if (system.delay[k] > 0)
        late[k] = past(k, double(i) - system.delay[k] / h, false).value;
    rate.col(i) = rate_of * z + jump_of * late;
    if (i == steps)
      break;
    for (Eigen::Index k = 0; k < m; ++k) {
      if (system.delay[k] == 0)
        continue;
      const double t = double(i) - system.delay[k] / h;
      const Point a = past(k, t, false), b = past(k, t + 1, true);
      c[0][k] = a.value;
      c[1][k] = h * a.rate;
      c[2][k] = 2 * (3 * (b.value - a.value) - h * (2 * a.rate + b.rate));
      c[3][k] = 6 * (h * (a.rate + b.rate) - 2 * (b.value - a.value));
    }
    z = hold.keep * z;
    for (int p = 0; p < 4; ++p)
      z += hold.drive[p] * c[p];
  }
  return motion;
}
}  // namespace mill::dynamics
