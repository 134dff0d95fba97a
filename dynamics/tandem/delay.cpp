#include "dynamics/tandem/delay.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "dynamics/chatter/chatter.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

// The characteristic function of a delay system and how often it turns along a line.
namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

constexpr int most_steps  = 200000;
constexpr int most_delays = 12;  // their matrices live on the stack

void check(const DelaySystem &s)
{
  const Eigen::Index n = s.A.rows(), m = s.delay.size();
  if (m > most_delays)
    throw InputError("delay system: " + std::to_string(m) + " delays; at most " + std::to_string(most_delays));
  if (s.A.cols() != n || s.U.rows() != n || s.W.rows() != n || s.U.cols() != m || s.W.cols() != m)
    throw InputError("delay system: " + std::to_string(n) + " states and " + std::to_string(m) +
                     " delays need U and W of that shape");
  for (const double delay : s.delay)
    if (!(delay >= 0) || !std::isfinite(delay))
      throw InputError("delay system: a delay of " + std::to_string(delay) +
                       " s; it must be finite and not below 0");
  if (!s.A.allFinite() || !s.U.allFinite() || !s.W.allFinite())
    throw InputError("delay system: a number in it is not finite");
}

using Small = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, 0, most_delays, most_delays>;

// Osborne's balancing, three sweeps: scale of each row and column that makes them alike in size.
std::array<double, most_delays> balanced_scale(const Small &L)
{
  std::array<double, most_delays> scale;
  scale.fill(1);
  for (int sweep = 0; sweep < 3; ++sweep)
    for (Eigen::Index i = 0; i < L.rows(); ++i) {
      double row = 0, column = 0;
      for (Eigen::Index j = 0; j < L.rows(); ++j)
        if (j != i) {
          row += std::abs(L(i, j)) * scale[j] / scale[i];
          column += std::abs(L(j, i)) * scale[i] / scale[j];
        }
      if (row > 0 && column > 0)
        scale[i] *= std::sqrt(row / column);
    }
  return scale;
}

// 1/s without the library's care for infinities, which takes longer than all the rest.
Complex inverse(const Complex s)
{
  return std::conj(s) / std::norm(s);
}

// Largest relative change of M over a step for which det M cannot turn by half a circle: each of its m factors
// turns by less than asin of it.
double safe_change(const Eigen::Index m)
{
  return m == 1 ? 0.9 : std::min(0.5, std::sin(M_PI / double(m + 1)));
}
}  // namespace

Eigen::MatrixXd without_delay(const DelaySystem &system)
{
  return system.A + system.U * system.W.transpose();
}

DelaySpectrum::DelaySpectrum(DelaySystem system) : system_(std::move(system))
{
  check(system_);
  const Eigen::Index n = system_.A.rows(), m = system_.delay.size();
  longest_ = m > 0 ? system_.delay.maxCoeff() : 0;
  scale_   = balance(system_.A.cwiseAbs() + system_.U.cwiseAbs() * system_.W.cwiseAbs().transpose());
  const Eigen::MatrixXd A = scale_.cwiseInverse().asDiagonal() * system_.A * scale_.asDiagonal();
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(A);
  const Eigen::MatrixXcd V = modes.eigenvectors();
  poles_                   = modes.eigenvalues();
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(V);
  const double error = (V * poles_.asDiagonal() * lu.inverse() - A).norm() / A.norm();
  if (modes.info() != Eigen::Success || !(error < 1e-7))
    throw SolverError({"tandem: the modes without delay are not distinguishable", "",
                       "two modes that coincide in frequency, damping and shape",
                       "change one of the stands by 0.1 %", ""});
  shift_ = Eigen::VectorXcd::Zero(n);
  if (m == 0)  // one stand: no signal comes late, and Eigen takes blocks of products without columns
    return;
  const Eigen::MatrixXcd left  = (scale_.asDiagonal() * system_.W).transpose() * V,
                         right = lu.solve((scale_.cwiseInverse().asDiagonal() * system_.U).cast<Complex>());
  residue_.resize(m * m, n);
  active_.resize(n);
  const double noise = 1e-15 * left.norm() * right.norm();
  Eigen::Index a     = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index k = 0; k < m; ++k)
      shift_[j] += right(j, k) * std::exp(-poles_[j] * system_.delay[k]) * left(k, j);
    const Eigen::MatrixXcd residue = left.col(j) * right.row(j);
    if (!(residue.norm() > noise))
      continue;  // a mode that no delayed signal knows: a root as it stands, and no pole of f
    residue_.col(a) = residue.reshaped();
    active_[a++]    = poles_[j];
  }
  residue_.conservativeResize(Eigen::NoChange, a);
  active_.conservativeResize(a);
  modulus_ = residue_.cwiseAbs();
}

DelaySpectrum::Sample DelaySpectrum::sample_of_one(const Complex s) const
{
  Complex g0 = 0, g1 = 0, g2 = 0;
  double rest = 0, nearest = INFINITY;
  for (Eigen::Index j = 0; j < active_.size(); ++j) {
    const Complex d = s - active_[j], r = inverse(d), a = residue_(0, j) * r, b = a * r;
    const double square = std::norm(r);
    g0 += a;
    g1 += b;
    g2 += b * r;
    rest += modulus_(0, j) * square * square;
    nearest = std::min(nearest, std::norm(d));
  }
  const double delay = system_.delay[0];
  const Complex late = std::exp(-s * delay);
  Sample point;
  point.f           = 1. - late * g0;
  point.newton      = -point.f / (late * (delay * g0 + g1));
  point.nearest     = std::sqrt(nearest);
  const double size = std::abs(late / point.f);
  point.term        = {size * std::abs(g0), size * std::abs(g1), size * std::abs(g2), size * rest};
  return point;
}

DelaySpectrum::Sample DelaySpectrum::sample(const Complex s) const
{
  const Eigen::Index m = system_.delay.size(), a = active_.size();
  if (m == 1)
    return sample_of_one(s);
  Eigen::MatrixXcd powers(a, 3);
  Eigen::VectorXd fourth(a);
  double nearest = INFINITY;
  for (Eigen::Index j = 0; j < a; ++j) {
    const Complex d = s - active_[j], r = inverse(d);
    powers(j, 0) = r;
    powers(j, 1) = r * r;
    powers(j, 2) = powers(j, 1) * r;
    fourth[j]    = std::norm(r) * std::norm(r);
    nearest      = std::min(nearest, std::norm(d));
  }
  const Eigen::MatrixXcd G   = residue_ * powers;
  const Eigen::VectorXd rest = modulus_ * fourth;
  Small late                 = Small::Zero(m, m);
  for (Eigen::Index k = 0; k < m; ++k)
    late(k, k) = std::exp(-s * system_.delay[k]);
  const auto part = [&](const Eigen::Index p) -> Small { return late * G.col(p).reshaped(m, m); };
  const Small L   = part(0);
  const Eigen::PartialPivLU<Small> lu(Small::Identity(m, m) - L);
  const Small back = lu.inverse();
  Sample point;
  point.f       = lu.determinant();
  point.nearest = std::sqrt(nearest);
  point.newton  = -1. / (back * (system_.delay.cast<Complex>().asDiagonal() * L + part(1))).trace();
  // det M does not change if rows and columns are scaled against each other: in a scale in which the loop
  // from stand to stand is balanced the norms say most about it.
  const std::array<double, most_delays> scale = balanced_scale(L);
  const auto norm                             = [&](const auto &matrix) {
    double sum = 0;
    for (Eigen::Index k = 0; k < m; ++k)
      for (Eigen::Index l = 0; l < m; ++l)
        sum += std::norm(matrix(k, l)) * std::pow(scale[l] / scale[k], 2);
    return std::sqrt(sum);
  };
  for (Eigen::Index p = 0; p < 3; ++p)
    point.term[p] = norm((back * part(p)).eval());
  point.term[3] = norm((back.cwiseAbs() * late.cwiseAbs() * rest.reshaped(m, m)).eval());
  return point;
}

// Longest step over which M changes by less than safe_change of itself.  With G the undelayed loop, G(s + x) -
// G(s) is three terms of its series and a remainder, which a sum of moduli bounds as long as x stays below half
// the distance to the nearest pole; the delay turns G by at most |x| delay, and never by more than 2.
double DelaySpectrum::step(const Sample &point, const double leftward) const
{
  const double wanted = safe_change(system_.delay.size());
  double x            = 0.5 * point.nearest;
  if (longest_ > 0 && leftward > 0)
    x = std::min(x, 0.25 / longest_);
  const double louder = leftward > 0 ? std::exp(0.25) : 1.;  // exp(-x delay) on the way
  for (;; x *= 0.7) {
    const double loop = x * (point.term[1] + x * (point.term[2] + x * point.term[3] / (1 - x / point.nearest)));
    const double late = std::min(2., x * longest_) * louder;
    if (louder * loop + late * (point.term[0] + loop) <= wanted || !(x > 1e-300))
      return x;
  }
}

// Change of arg f from one point to another on a straight line, rad.  `starts` takes where Newton's method would
// go from the points that are nearest to a root.
double DelaySpectrum::turn(const Complex from, const Complex to, std::vector<Complex> *starts) const
{
  const double length     = std::abs(to - from);
  const Complex direction = (to - from) / length;
  const double leftward   = std::max(0., -direction.real());
  Sample point            = sample(from);
  double gone = 0, sum = 0;
  Complex s = from;
  for (int steps = 0; gone < length; ++steps) {
    const double x = step(point, leftward);
    if (!(x > 1e-15 * std::abs(s)) || steps > most_steps)
      throw SolverError({"tandem: the roots right of a line cannot be counted",
                         steps > most_steps ? "after " + std::to_string(most_steps) + " steps" : "",
                         "a root or a pole on the line itself", "count from a line a little to the left or right",
                         ""});
    gone              = std::min(length, gone + x);
    s                 = gone < length ? from + gone * direction : to;
    const Sample next = sample(s);
    sum += std::arg(next.f / point.f);
    const double distance = std::abs(next.newton);
    if (starts && distance * longest_ < 2 &&
        (starts->empty() || std::abs(s + next.newton - starts->back()) > 0.2 * distance))
      starts->push_back(s + next.newton);
    point = next;
  }
  return sum;
}

// Above it, on Re s = c and to the right of it, the loop is so weak that f stays near one and has no zero, rad/s.
double DelaySpectrum::height(const double c) const
{
  const Eigen::Index m = system_.delay.size();
  double loudest = 0, end = 1;
  for (const double delay : system_.delay)
    loudest = std::max(loudest, std::exp(-c * delay));
  for (const Complex &pole : active_)
    end = std::max(end, 1.01 * std::abs(pole));
  const auto loop = [&] {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(m, m);
    for (Eigen::Index j = 0; j < active_.size(); ++j)
      sum += modulus_.col(j).reshaped(m, m) /
             std::hypot(std::max(0., c - active_[j].real()), end - std::abs(active_[j].imag()));
    return loudest * sum.norm();
  };
  while (!(loop() < safe_change(m)))
    end *= 1.5;
  return end;
}

int DelaySpectrum::line_count(const double c, std::vector<Complex> *starts) const
{
  const auto poles = std::count_if(poles_.begin(), poles_.end(), [&](const Complex &p) { return p.real() > c; });
  if (active_.size() == 0)
    return int(poles);
  const double end  = height(c);
  const double half = turn({c, 0}, {c, end}, starts) - std::arg(sample({c, end}).f);
  // Up the line with the roots on the right: they are encircled clockwise, poles the other way.
  return int(poles) - int(std::lround(2 * half / (2 * M_PI)));
}

int DelaySpectrum::roots_right_of(const double c) const
{
  return line_count(c, nullptr);
}

double DelaySpectrum::loop_gain() const
{
  const Eigen::Index m = system_.delay.size();
  if (active_.size() == 0)
    return 0;
  const auto gain = [&](const double w) {
    const Eigen::MatrixXd G =
        (residue_ * (Complex(0, w) - active_.array()).inverse().matrix()).reshaped(m, m).cwiseAbs();
    Eigen::VectorXd x = Eigen::VectorXd::Ones(m);
    double radius     = G(0, 0);
    for (int i = 0; m > 1 && i < 200; ++i) {      // of a matrix without negative entries: power iteration, shifted
      const double shift      = 0.1 * G.trace();  // so that a cycle does not keep it going
      const Eigen::VectorXd y = G * x + shift * x;
      const double next       = y.norm() / x.norm() - shift;
      x                       = y / std::max(y.norm(), 1e-300);
      if (std::abs(next - radius) < 1e-12 * next)
        break;
      radius = next;
    }
    return radius;
  };
  // Resonances are where the poles are: a grid that is fine there.
  std::vector<double> grid{0};
  for (const Complex &pole : active_)
    if (pole.imag() >= 0)
      for (int i = -15; i <= 15; ++i)
        grid.push_back(std::abs(pole.imag() + std::abs(pole.real()) * std::sinh(0.25 * i)));
  std::sort(grid.begin(), grid.end());
  std::vector<double> at_grid;
  for (const double w : grid)
    at_grid.push_back(gain(w));
  double best        = *std::max_element(at_grid.begin(), at_grid.end());
  const double rough = best;
  for (std::size_t i = 0; i < grid.size(); ++i) {  // every peak that may be the highest
    const std::size_t left = i > 0 ? i - 1 : 0, right = std::min(i + 1, grid.size() - 1);
    if (at_grid[i] < 0.7 * rough || at_grid[i] < at_grid[left] || at_grid[i] < at_grid[right])
      continue;
    best =
        std::max(best, -minimum_between(grid[left], grid[right], [&](const double w) { return -gain(w); }).value);
  }
  return best;
}
}  // namespace mill::dynamics
