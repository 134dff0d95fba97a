#include "twin/calibration/coarse_start.h"
#include "twin/calibration/fit.h"
#include "twin/calibration/hann_window.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
/// H1 of one length of segment with its variance.
struct Estimate {
  Eigen::Index first = 0;    ///< bin
  double bin         = 0;    ///< rad/s
  Eigen::MatrixXcd H;        ///< (k, m) 1/kg
  Eigen::MatrixXd variance;  ///< (k, m) 1/kg^2
};

Estimate h1_of(const CrossSpectra &s, const double low, const double high)
{
  const double df          = s.rate / double(s.L);
  const Eigen::Index first = std::max<Eigen::Index>(2, Eigen::Index(std::ceil(low / df))),
                     last  = std::min<Eigen::Index>(s.L / 2 - 1, Eigen::Index(std::floor(high / df)));
  const Eigen::Index k = std::max<Eigen::Index>(0, last - first + 1), m = s.response.cols();
  Estimate e{first, 2 * M_PI * df, Eigen::MatrixXcd(k, m), Eigen::MatrixXd(k, m)};
  for (Eigen::Index b = 0; b < k; ++b)
    for (Eigen::Index j = 0; j < m; ++j) {
      const double FF = std::max(s.force[first + b], 1e-300), YY = s.response(first + b, j);
      const auto FY = s.cross(first + b, j);
      e.H(b, j)     = FY / FF;
      // what one force does not explain, never less than 1e-6 of it: rounding is not a measurement
      const double left = std::max(YY - std::norm(FY) / FF, 1e-6 * YY);
      e.variance(b, j)  = std::max(left / (FF * std::max(1.0, s.averages() - 1)), 1e-300);
    }
  return e;
}

Likelihood windowed_cost(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                         const Eigen::VectorXd &theta, const Estimate &e, const BandRecord &fine,
                         const Eigen::VectorXd &weights, const std::vector<Eigen::Index> &places)
{
  const StandAt at     = stand_at(stand, unknowns, theta);
  const Eigen::Index p = theta.size(), k = e.H.rows(), n = at.frequency.size();
  const Block whole{0, fine.angular.size()};
  ModalColumns c = modal_columns(at, fine, whole);
  add_derivatives(c, at, unknowns, fine, whole, Eigen::VectorXd::Zero(2 * n));
  Likelihood sum;
  sum.slope       = Eigen::VectorXd::Zero(p);
  sum.information = Eigen::MatrixXd::Zero(p, p);
  for (std::size_t j = 0; j < places.size(); ++j) {
    const Eigen::VectorXd shape = at.shape.row(places[j]).transpose();
    const Eigen::ArrayXd w      = e.variance.col(Eigen::Index(j)).array().rsqrt();
    Eigen::VectorXcd r          = e.H.col(Eigen::Index(j)) - seen_through(c.driven.matrix() * shape, weights, k);
    r.array() *= w;
    Eigen::MatrixXcd J(k, p);
    for (Eigen::Index q = 0; q < p; ++q) {
      J.col(q) = seen_through(c.derivative[std::size_t(q)].matrix() * shape, weights, k);
      J.col(q).array() *= w;
    }
    sum.residual += r.squaredNorm();
    sum.slope -= 2 * (J.adjoint() * r).real();
    sum.information += 2 * (J.adjoint() * J).real();
  }
  sum.cost = sum.residual;
  add_prior(sum, unknowns, theta);
  return sum;
}

/// The lowest of the minima that are reached from `theta` and from steps along each unknown with a wide prior:
/// with errors of half of a stiffness the nearest minimum is often a false one.
Eigen::VectorXd lowest_minimum(const Objective &cost, const std::vector<Unknown> &unknowns,
                               const Eigen::VectorXd &theta)
{
  constexpr double wide = 0.15, reach = 2, step = 0.5;  // ln; prior sd
  Descent best = descend(cost, unknowns, theta, 60, 1e-3);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Unknown &unknown = unknowns[i];
    if (!(unknown.prior_sd > wide) || unknown.name.compare(0, 4, "zeta") == 0)
      continue;
    const Eigen::VectorXd from = best.theta;
    for (double s = -reach; s <= reach; s += step) {
      Eigen::VectorXd start  = from;
      start[Eigen::Index(i)] = unknown.prior + s * unknown.prior_sd;
      Descent other          = descend(cost, unknowns, start, 30, 1e-2);
      if (other.at.cost < best.at.cost)
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
  Eigen::VectorXd theta(Eigen::Index(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    theta[Eigen::Index(i)] = unknowns[i].prior;
  const Eigen::VectorXd weights        = hann_weights();
  constexpr Eigen::Index search_length = 1 << 12;  // 5 Hz at 20 kHz: resonances are still wide
  for (Eigen::Index L = 1 << 11; L <= 1 << 15; L *= 2) {
    const CrossSpectra s = cross_spectra(pieces, rate, L);
    if (s.n < 4)  // fewer say no coherence
      break;
    const Estimate e = h1_of(s, low, high);
    if (e.H.rows() < 4)
      continue;
    const BandRecord fine = fine_grid(e.bin, e.first, e.H.rows());
    const Objective cost  = [&](const Eigen::VectorXd &at, Wanted) {
      return windowed_cost(stand, unknowns, at, e, fine, weights, places);
    };
    theta = L == search_length ? lowest_minimum(cost, unknowns, theta)
                               : descend(cost, unknowns, theta, 60, 1e-3).theta;
  }
  return theta;
}
}  // namespace mill::twin
