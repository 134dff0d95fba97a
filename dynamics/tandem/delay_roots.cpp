#include "core/base/errors.h"
#include "dynamics/tandem/delay.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

// Where the roots of a delay system are.
namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

bool same(const Complex a, const Complex b)
{
  return std::abs(a - b) <= 1e-9 * (1 + std::abs(a));
}

bool known(const std::vector<Complex> &roots, const Complex s)
{
  return std::any_of(roots.begin(), roots.end(), [&](const Complex &r) { return same(r, s); });
}

// Adds a root of the upper half plane once.
void add(std::vector<Complex> &roots, Complex s)
{
  if (std::abs(s.imag()) <= 1e-10 * (1 + std::abs(s)))
    s = s.real();
  if (s.imag() < 0)
    s = std::conj(s);
  if (!known(roots, s))
    roots.push_back(s);
}

bool inside(const Complex s, const Complex low, const Complex high)
{
  return s.real() > low.real() && s.real() < high.real() && s.imag() > low.imag() && s.imag() < high.imag();
}
}  // namespace

// False if it leaves the neighbourhood: roots of f only, not of modes that f does not know.
bool DelaySpectrum::newton(Complex &s) const
{
  const double reach = longest_ > 0 ? 1 / longest_ : 0.1 * active_.cwiseAbs().maxCoeff();
  for (int i = 0; i < 40; ++i) {
    Complex move = sample(s).newton;
    if (!std::isfinite(move.real()) || !std::isfinite(move.imag()))
      return false;
    if (std::abs(move) > reach)
      move *= reach / std::abs(move);
    s += move;
    if (std::abs(move) <= 1e-13 * (1 + std::abs(s)))
      return true;
  }
  return false;
}

// Roots near the poles: those of modes that the delayed signals hardly reach, whose basins are small.
std::vector<Complex> DelaySpectrum::starts_at_poles(const double c) const
{
  std::vector<Complex> starts;
  for (Eigen::Index j = 0; j < poles_.size(); ++j)
    if (poles_[j].imag() >= 0 && poles_[j].real() > c && std::abs(shift_[j]) * longest_ < 0.5)
      starts.push_back(poles_[j] + shift_[j]);
  return starts;
}

int DelaySpectrum::box_count(const Complex low, const Complex high) const
{
  const auto poles =
      std::count_if(poles_.begin(), poles_.end(), [&](const Complex &p) { return inside(p, low, high); });
  if (active_.size() == 0)
    return int(poles);
  const Complex corner[5] = {low, {high.real(), low.imag()}, high, {low.real(), high.imag()}, low};
  double sum              = 0;
  if (low.imag() == -high.imag())  // f(conj s) = conj f(s): half the way is enough
    sum = 2 * (turn(high.real(), high, nullptr) + turn(high, corner[3], nullptr) +
               turn(corner[3], low.real(), nullptr));
  else
    for (int i = 0; i < 4; ++i)
      sum += turn(corner[i], corner[i + 1], nullptr);
  return int(poles) + int(std::lround(sum / (2 * M_PI)));
}

// Completes `found` (roots of the upper half plane) in a box.
void DelaySpectrum::search_box(const Complex low, const Complex high, std::vector<Complex> &roots,
                               const int depth) const
{
  int wanted = 0;
  try {
    wanted = box_count(low, high);
  } catch (const SolverError &) {  // an edge through a root: a box a little larger
    if (depth > 60)
      throw;
    const Complex more = 1e-3 * (high - low);
    search_box(low - (low.imag() == -high.imag() ? Complex(more.real(), more.imag()) : more), high + more, roots,
               depth + 20);
    return;
  }
  const auto have = [&] {
    int n = 0;
    for (const Complex &r : roots)
      n += int(inside(r, low, high)) + int(r.imag() > 0 && inside(std::conj(r), low, high));
    return n;
  };
  if (have() >= wanted)
    return;
  for (int i = 1; i < 8 && have() < wanted; i += 2)
    for (int j = 1; j < 8 && have() < wanted; j += 2) {
      Complex s(low.real() + (high - low).real() * i / 8, low.imag() + (high - low).imag() * j / 8);
      if (newton(s) && inside(s, low, high))
        add(roots, s);
    }
  for (const Complex &pole : poles_)
    if (have() < wanted && inside(pole, low, high))
      try {
        if (const Complex s = polished(pole).value; inside(s, low, high))
          add(roots, s);
      } catch (const SolverError &) {
      }
  if (have() >= wanted)
    return;
  const double size = std::abs(high - low);
  if (size < 1e-6 * (1 + std::abs(low)) || depth > 60) {
    const auto one = std::find_if(roots.begin(), roots.end(), [&](const Complex &r) {
      return inside(r, low, high) || inside(std::conj(r), low, high);
    });
    if (one == roots.end())
      throw SolverError({"tandem: " + std::to_string(wanted) + " roots near " + std::to_string(low.real()) +
                             " + " + std::to_string(low.imag()) + " i 1/s could not be found",
                         "", "stands that are exactly alike", "change one of the stands by 0.1 %", ""});
    while (have() < wanted)  // a multiple root
      roots.push_back(Complex(*one));
    return;
  }
  const Complex span = high - low;
  if (span.imag() > 4 * span.real() || (span.imag() > span.real() && low.imag() != -high.imag())) {
    const double position = low.imag() == -high.imag() ? 0.377 * high.imag() : low.imag() + 0.4871 * span.imag();
    if (low.imag() == -high.imag())
      search_box({low.real(), -position}, {high.real(), position}, roots, depth + 1);
    else
      search_box(low, {high.real(), position}, roots, depth + 1);
    search_box({low.real(), position}, high, roots, depth + 1);
  } else {
    const double position = low.real() + 0.4871 * span.real();
    search_box(low, {position, high.imag()}, roots, depth + 1);
    search_box({position, low.imag()}, high, roots, depth + 1);
  }
}

std::vector<Complex> DelaySpectrum::roots(const double c, const double limit) const
{
  std::vector<Complex> roots;
  if (active_.size() == 0) {
    for (const Complex &pole : poles_)
      if (pole.imag() >= 0)
        roots.push_back(pole);
  } else {
    const double spacing        = longest_ > 0 ? 1 / longest_ : INFINITY;
    std::vector<Complex> starts = starts_at_poles(c);
    double line = c, first = c;
    int wanted                  = -1;
    const double rightmost_pole = poles_.real().maxCoeff();
    const auto settle           = [&] {
      for (Complex s : starts)
        if (newton(s))
          add(roots, s);
      starts.clear();
    };
    for (int lines = 0;; ++lines) {
      int beyond = 0;
      try {
        beyond = line_count(line, &starts);
      } catch (const SolverError &) {  // a root on the line: take the first line further left
        if (lines > 500)
          throw;
        line += (wanted < 0 ? -1e-5 : 1e-5) * (1 + std::abs(line));
        continue;
      }
      if (wanted < 0) {
        wanted = beyond;
        first  = line;
      }
      settle();
      if (beyond == 0)
        break;
      line += std::isfinite(spacing) ? spacing : std::max(1., rightmost_pole - line + 1);
    }
    int have = 0;
    for (const Complex &s : roots)
      have += s.real() > first ? (s.imag() > 0 ? 2 : 1) : 0;
    if (have != wanted)
      search_box({first, -limit}, {line, limit}, roots, 0);
  }
  std::vector<Complex> all;
  for (const Complex &s : roots)
    if (s.real() > c && s.imag() <= limit) {
      all.push_back(s);
      if (s.imag() > 0)
        all.push_back(std::conj(s));
    }
  std::stable_sort(all.begin(), all.end(), [](const Complex &a, const Complex &b) { return a.real() > b.real(); });
  return all;
}

Complex DelaySpectrum::rightmost(const std::vector<Complex> &near) const
{
  if (active_.size() == 0)
    return *std::max_element(poles_.begin(), poles_.end(), [](const Complex &a, const Complex &b) {
      return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
  std::vector<Complex> all_roots, starts = starts_at_poles(-INFINITY);
  starts.insert(starts.end(), near.begin(), near.end());
  const auto best = [&] {
    for (Complex s : starts)
      if (newton(s))
        add(all_roots, s);
    starts.clear();
    Complex right(-INFINITY, 0);
    for (const Complex &r : all_roots)
      if (r.real() > right.real())
        right = r;
    return right;
  };
  // Lines from the right, until a root is right of one or as near as the next line would be.
  const double spacing = longest_ > 0 ? 1 / longest_ : 1.;
  Complex right        = best();
  for (double c = std::max(poles_.real().maxCoeff() + 0.1 * spacing, -spacing); right.real() < c - spacing;
       c -= spacing) {
    int beyond = 1;
    try {
      beyond = line_count(c, &starts);
    } catch (const SolverError &) {
      c += 0.999 * spacing;
    }
    right = best();
    if (beyond > 0 && std::isfinite(right.real()))
      break;
  }
  double margin = 0;
  for (int tries = 0; tries < 10; ++tries) {
    margin     = (1e-8 + 1e-10 * std::abs(right)) * (1 + 0.37 * tries);
    int beyond = 1;
    try {
      beyond = line_count(right.real() + margin, &starts);
    } catch (const SolverError &) {
      continue;  // a root on the line: a little further right
    }
    if (beyond == 0)
      return polished(right).value;
    const Complex better = best();
    if (!(better.real() > right.real() + margin))
      break;
    right = better;
  }
  for (double c = right.real() + margin;; c -= spacing) {
    const auto all = roots(c, height(c));
    if (!all.empty())
      return polished(all[0].imag() < 0 ? std::conj(all[0]) : all[0]).value;
  }
}

DelayRoot DelaySpectrum::polished(const Complex start) const
{
  const Eigen::Index n = system_.A.rows();
  const Eigen::MatrixXcd A =
      (scale_.cwiseInverse().asDiagonal() * system_.A * scale_.asDiagonal()).cast<Complex>();
  const Eigen::MatrixXcd U  = (scale_.cwiseInverse().asDiagonal() * system_.U).cast<Complex>(),
                         Wt = (scale_.asDiagonal() * system_.W).transpose().cast<Complex>();
  const auto late           = [&](const Complex s) -> Eigen::VectorXcd {
    return (-s * system_.delay.cast<Complex>().array()).exp().matrix();
  };
  const auto bracket = [&](const Complex s) -> Eigen::MatrixXcd {
    Eigen::MatrixXcd T = -A - U * late(s).asDiagonal() * Wt;
    T.diagonal().array() += s;
    return T;
  };
  // Start of the shape by two inverse iterations slightly shifted from the root.
  Complex s = start * (1 + 1e-10) + 1e-10;
  Eigen::VectorXcd z(n);
  for (Eigen::Index i = 0; i < n; ++i)
    z[i] = Complex(1 + 0.3 * std::sin(double(i)), 0.2 * std::cos(2. * double(i)));
  const Eigen::PartialPivLU<Eigen::MatrixXcd> shifted(bracket(s));
  for (int i = 0; i < 2; ++i)
    z = shifted.solve(z).normalized();
  const Eigen::RowVectorXcd fix = z.adjoint();
  s                             = start;
  for (int i = 0; i < 20; ++i) {
    Eigen::MatrixXcd J(n + 1, n + 1);
    Eigen::VectorXcd r(n + 1);
    const Eigen::MatrixXcd T = bracket(s);
    const Eigen::VectorXcd slope =
        z + U * (system_.delay.cast<Complex>().cwiseProduct(late(s))).asDiagonal() * (Wt * z);
    J << T, slope, fix, Complex(0);
    r << T * z, (fix * z).value() - Complex(1);
    const Eigen::VectorXcd move = J.partialPivLu().solve(-r);
    z += move.head(n);
    s += move[n];
    if (!std::isfinite(s.real()) || std::abs(s - start) > 1e-3 * (1 + std::abs(start)))
      break;
    if (std::abs(move[n]) <= 1e-14 * (1 + std::abs(s)) || i == 19) {
      if (std::abs(move[n]) > 1e-10 * (1 + std::abs(s)))
        break;
      const Eigen::MatrixXcd end = bracket(s);
      DelayRoot root;
      root.value    = s;
      root.residual = (end * z).norm() / (z.norm() * (std::abs(s) + A.norm() + U.norm() * Wt.norm()));
      Eigen::Index largest;
      z.cwiseAbs().maxCoeff(&largest);
      root.shape = scale_.asDiagonal() * (z / z[largest]);
      return root;
    }
  }
  throw SolverError({"tandem: Newton's method for a root did not settle from " + std::to_string(start.real()) +
                         " + " + std::to_string(start.imag()) + " i 1/s",
                     "", "two roots that nearly coincide", "start nearer to one of them", ""});
}
}  // namespace mill::dynamics
