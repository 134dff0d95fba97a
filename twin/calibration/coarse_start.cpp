#include "twin/calibration/coarse_start.h"
#include "twin/calibration/fit.h"
#include "twin/calibration/windowed_fit.h"
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
/// Samples, a power of two, whose bins are nearest to `bin` Hz.
Eigen::Index length_of_bin(const double bin, const double rate)
{
  return Eigen::Index(1) << std::max(3, int(std::lround(std::log2(rate / bin))));
}

/// A stiffness or mass whose nearest minimum is often a false one; damping moves no resonance.
bool is_wide(const Unknown &unknown)
{
  return unknown.prior_sd > 0.15 && !moves_damping(unknown);  // ln
}

/// Draws of the unknowns from their priors, spread evenly (a Sobol sequence through the normal quantile).
std::vector<Eigen::VectorXd> spread_draws(const std::vector<Unknown> &unknowns, const int number)
{
  const boost::math::normal normal;
  boost::random::sobol sequence(unknowns.size());
  const double range = double(boost::random::sobol::max()) + 1;
  sequence.discard(unknowns.size());  // its first point is the medians
  std::vector<Eigen::VectorXd> draws(std::size_t(number), Eigen::VectorXd(Eigen::Index(unknowns.size())));
  for (Eigen::VectorXd &draw : draws)
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const double u        = (double(sequence()) + 0.5) / range;
      draw[Eigen::Index(i)] = unknowns[i].prior + unknowns[i].prior_sd * boost::math::quantile(normal, u);
    }
  return draws;
}

/// Where widened resonances agree best in their logarithms: many draws are ranked, the first ones descend, and
/// those that end lowest descend in squares.  (44.8a)
std::vector<Eigen::VectorXd> spread_minima(const WindowedFit &fit)
{
  constexpr int drawn = 1000, first = 24, kept = 6;
  struct Start {
    Eigen::VectorXd theta;
    double cost;
  };
  const auto lower = [](const Start &a, const Start &b) { return a.cost < b.cost; };
  std::vector<Start> starts;
  for (Eigen::VectorXd &theta : spread_draws(fit.unknowns, drawn)) {
    const double cost = fit.logarithms(theta, Wanted::cost).residual;
    starts.push_back({std::move(theta), cost});
  }
  std::sort(starts.begin(), starts.end(), lower);
  starts.resize(first);
  const Objective logarithms = [&](const Eigen::VectorXd &theta, const Wanted wanted) {
    return fit.logarithms(theta, wanted);
  };
  for (Start &start : starts) {
    const Descent end = descend(logarithms, fit.unknowns, start.theta, 40, 1e-2);
    start             = {end.theta, end.likelihood.cost};
  }
  std::sort(starts.begin(), starts.end(), lower);
  starts.resize(kept);
  std::vector<Eigen::VectorXd> minima;
  for (const Start &start : starts)
    minima.push_back(start.theta);
  return minima;
}

/// The lowest of the minima that are reached from `theta` and from steps along each unknown with a wide prior:
/// with errors of half of a stiffness the nearest minimum is often a false one.
Eigen::VectorXd lowest_minimum(const Objective &cost, const std::vector<Unknown> &unknowns,
                               const Eigen::VectorXd &theta)
{
  constexpr double reach = 2, step = 0.5;  // prior sd
  Descent best = descend(cost, unknowns, theta, 60, 1e-3);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown &unknown = unknowns[i];
    if (!is_wide(unknown))
      continue;
    const Eigen::VectorXd from = best.theta;
    for (double s = -reach; s <= reach; s += step) {
      Eigen::VectorXd start  = from;
      start[Eigen::Index(i)] = unknown.prior + s * unknown.prior_sd;
      Descent other          = descend(cost, unknowns, start, 30, 1e-2);
      if (other.likelihood.cost < best.likelihood.cost)
        best = std::move(other);
    }
  }
  return best.theta;
}
}  // namespace

double CrossSpectra::averages() const
{
  return n > 0 ? double(n) / (1 + double(n - 1) / (18 * double(n))) : 0;
}

CrossSpectra cross_spectra(const std::vector<ForcedSamples> &pieces, const double rate, const Eigen::Index L)
{
  CrossSpectra s{L, 0, rate, {}, {}, {}};
  const Eigen::Index half = L / 2 + 1, m = pieces.empty() ? 0 : pieces.front().acceleration.cols();
  s.force    = Eigen::VectorXd::Zero(half);
  s.response = Eigen::MatrixXd::Zero(half, m);
  s.cross    = Eigen::MatrixXcd::Zero(half, m);
  Fourier fourier;
  std::vector<double> x(std::size_t(L), 0.0);
  std::vector<std::complex<double>> F, Y;
  const auto transform = [&](const auto &column, const Eigen::Index from, auto &X) {
    const double mean = column.segment(from, L).mean();
    for (Eigen::Index i = 0; i < L; ++i)
      x[std::size_t(i)] = (column[from + i] - mean) * 0.5 * (1 - std::cos(2 * M_PI * double(i) / double(L)));
    fourier.forward(x, X);
  };
  for (const ForcedSamples &piece : pieces)
    for (Eigen::Index from = 0; from + L <= piece.force.size(); from += L / 2, ++s.n) {
      transform(piece.force, from, F);
      for (Eigen::Index b = 0; b < half; ++b)
        s.force[b] += std::norm(F[std::size_t(b)]);
      for (Eigen::Index j = 0; j < m; ++j) {
        transform(piece.acceleration.col(j), from, Y);
        for (Eigen::Index b = 0; b < half; ++b) {
          s.response(b, j) += std::norm(Y[std::size_t(b)]);
          s.cross(b, j) += std::conj(F[std::size_t(b)]) * Y[std::size_t(b)];
        }
      }
    }
  const double scale = s.n > 0 ? 2 / (rate * 0.375 * double(L) * double(s.n)) : 0;
  s.force *= scale;
  s.response *= scale;
  s.cross *= scale;
  return s;
}

Eigen::VectorXd coarse_start(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                             const std::vector<ForcedSamples> &pieces, const std::vector<Eigen::Index> &places,
                             const double rate, const double low, const double high)
{
  Eigen::VectorXd prior(Eigen::Index(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    prior[Eigen::Index(i)] = unknowns[i].prior;
  std::vector<Eigen::VectorXd> candidates{prior};
  // Bins from some 10 Hz down to 0.6 Hz at any rate.
  const Eigen::Index widest = length_of_bin(10, rate);
  for (Eigen::Index L = widest; L <= 16 * widest; L *= 2) {
    const CrossSpectra s = cross_spectra(pieces, rate, L);
    if (s.n < 4)  // fewer say no coherence
      break;
    const AveragedResponse measured = averaged_response(s, low, high);
    if (measured.H.rows() < 4)
      continue;
    const WindowedFit fit = windowed_fit(stand, unknowns, places, measured);
    if (L == widest && std::any_of(unknowns.begin(), unknowns.end(), is_wide))
      for (Eigen::VectorXd &theta : spread_minima(fit))
        candidates.push_back(std::move(theta));
    const Objective squares = [&](const Eigen::VectorXd &theta, const Wanted wanted) {
      return fit.squares(theta, wanted);
    };
    std::vector<Descent> ends;
    for (const Eigen::VectorXd &theta : candidates)
      ends.push_back(descend(squares, unknowns, theta, 60, 1e-3));
    std::sort(ends.begin(), ends.end(),
              [](const Descent &a, const Descent &b) { return a.likelihood.cost < b.likelihood.cost; });
    // half of them go on: what is far behind in wide bins is not the lowest in narrow ones
    candidates.clear();
    for (std::size_t i = 0; i < std::max<std::size_t>(1, ends.size() / 2); ++i)
      candidates.push_back(ends[i].theta);
    if (L == 2 * widest)  // resonances are still wide at 5 Hz
      candidates = {lowest_minimum(squares, unknowns, candidates.front())};
  }
  return candidates.front();
}
}  // namespace mill::twin
