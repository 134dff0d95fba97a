#include "dynamics/chatter/loop.h"
#include "core/base/errors.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <vector>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

// Tensions that answer a unit motion of the gap, from their two equations by Cramer's rule.
struct Tensions {
  Complex determinant;  ///< (1/s)^2
  Complex force;        ///< N/m (1/s)^2, force by the tensions times the determinant

  Tensions(const ChatterStandModel &stand, const bite::LinearCoefficients &by, const Complex s)
  {
    const auto &[P, Q, F, mu, xn] = by;
    const double entry            = stand.strip_modulus / stand.entry_distance,
                 exit             = stand.strip_modulus / stand.exit_distance;
    const Complex a = s - entry * P[2], b = -entry * P[3], c = exit * Q[2], d = s + exit * Q[3];
    const Complex p = entry * (P[0] + s * P[1]), q = -exit * (Q[0] + s * Q[1]);
    determinant = a * d - b * c;
    force       = F[2] * (d * p - b * q) + F[3] * (a * q - c * p);
  }
};

// Poles of the structure alone.
Eigen::VectorXcd structure_poles(const ChatterStandModel &stand)
{
  const Eigen::Index n = stand.structure.n();
  return eigenvalues(chatter_matrix(stand, {}).topLeftCorner(2 * n, 2 * n));
}

// How fast the tensions settle, 1/s.
double tension_rate(const ChatterStandModel &stand, const bite::LinearCoefficients &by)
{
  return stand.strip_modulus *
         (std::abs(by.entry_speed[2]) / stand.entry_distance + std::abs(by.exit_speed[3]) / stand.exit_distance);
}

// Where the argument may turn quickly: at the height of every pole, in steps that grow from its distance to the
// line.  A root close to a pole would otherwise pass unseen between two points, as both turn in opposite sense.
std::vector<double> first_grid(const Eigen::VectorXcd &poles, const double right_of, const double highest)
{
  std::vector<double> w{0, highest};
  for (int i = -40; i < 20; ++i)
    w.push_back(highest * std::exp2(0.5 * (i - 20)));
  for (const Complex &p : poles) {
    const double centre = std::abs(p.imag()), width = std::max(std::abs(p.real() - right_of), 1e-12 * highest) / 8;
    w.push_back(centre);
    for (double d = width; d < highest; d *= 1.5)
      for (const double x : {centre - d, centre + d})
        if (x > 0 && x < highest)
          w.push_back(x);
  }
  std::sort(w.begin(), w.end());
  w.erase(std::unique(w.begin(), w.end()), w.end());
  return w;
}
}  // namespace

std::complex<double> receptance(const StandStructure &structure, const std::complex<double> s)
{
  const Eigen::MatrixXcd dynamic = (s * s) * structure.M + s * structure.C + structure.K.cast<Complex>();
  const Eigen::VectorXcd b       = structure.b.cast<Complex>();
  return (structure.b.transpose() * dynamic.partialPivLu().solve(b))(0);
}

std::complex<double> process_stiffness(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                                       const std::complex<double> s)
{
  const Tensions t(stand, by, s);
  return (t.determinant * (by.force[0] + s * by.force[1]) + t.force) / t.determinant;
}

std::complex<double> loop_difference(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                                     const std::complex<double> s)
{
  return 1. - process_stiffness(stand, by, s) * receptance(stand.structure, s);
}

double process_damping(const ChatterStandModel &stand, const bite::LinearCoefficients &by, const double frequency)
{
  const double w = 2 * M_PI * frequency;
  return process_stiffness(stand, by, {0, w}).imag() / w;
}

NyquistCount nyquist_count(const ChatterStandModel &stand, const bite::LinearCoefficients &by,
                           const double right_of)
{
  constexpr double turn        = 0.5;  // rad, largest of one step
  const Eigen::VectorXcd poles = structure_poles(stand);
  const double rate            = std::max(tension_rate(stand, by), 1e-3 * poles.cwiseAbs().maxCoeff());
  NyquistCount count;
  count.open_loop  = int((poles.real().array() > right_of).count());
  const auto value = [&](const double w) {
    ++count.steps;
    // (1 - K_p G) times the determinant of the tensions over (s + rate)^2: one pole of the tensions is zero in the
    // sequential scheme, on the line itself.
    const Complex s{right_of, w};
    const Tensions t(stand, by, s);
    const Complex f = (t.determinant - (t.determinant * (by.force[0] + s * by.force[1]) + t.force) *
                                           receptance(stand.structure, s)) /
                      ((s + rate) * (s + rate));
    if (!std::isfinite(std::abs(f)) || f == 0.)
      throw SolverError({"chatter: Nyquist's count meets a root or a pole on its line",
                         fmt::format("at Re s = {:g} 1/s, {:g} Hz", right_of, w / (2 * M_PI)),
                         "an undamped mode, or a speed at the very limit of stability",
                         "count the roots to the right of a line slightly shifted from it", ""});
    return f;
  };
  // Far out 1 - K_p G is 1 + O(1/w), whose argument is that of its distance from 1: go on until it is small.
  double highest = 100 * poles.cwiseAbs().maxCoeff();
  while (std::abs(value(highest) - 1.) > 1e-3)
    highest *= 10;
  const std::vector<double> grid = first_grid(poles, right_of, highest);
  double angle                   = 0;
  const std::function<void(double, Complex, double, Complex, int)> walk =
      [&](const double a, const Complex fa, const double b, const Complex fb, const int depth) {
        const double step = std::arg(fb / fa);
        if (std::abs(step) < turn) {
          angle += step;
          return;
        }
        if (depth > 60)
          throw SolverError({"chatter: Nyquist's count does not resolve its line",
                             fmt::format("at Re s = {:g} 1/s, {:g} Hz", right_of, a / (2 * M_PI)),
                             "a root on the line, or a speed at the very limit of stability",
                             "count the roots to the right of a line slightly shifted from it", ""});
        const double middle = 0.5 * (a + b);
        const Complex f     = value(middle);
        walk(a, fa, middle, f, depth + 1);
        walk(middle, f, b, fb, depth + 1);
      };
  Complex last = value(grid[0]);
  for (std::size_t i = 1; i < grid.size(); ++i) {
    const Complex f = value(grid[i]);
    walk(grid[i - 1], last, grid[i], f, 0);
    last = f;
  }
  angle -= std::arg(last);  // the rest of the way to 1
  // f is real at w = 0 and 1 far out, and the lower half of the line mirrors the upper: a turn by -pi on the upper
  // half is one root to the right more than there are poles.
  count.unstable = count.open_loop - int(std::lround(angle / M_PI));
  return count;
}
}  // namespace mill::dynamics
