#include "twin/calibration/output_only_start.h"
#include "twin/calibration/fit.h"
#include "twin/calibration/hann_window.h"
#include "twin/calibration/modal_columns.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
/// Bins of a band of spectral matrices with the noise of each sensor.
struct Averages {
  Eigen::Index first = 0;                ///< bin
  double bin = 0, count = 0;             ///< rad/s; independent averages
  std::vector<Eigen::MatrixXcd> matrix;  ///< (k) (m, m)
  Eigen::MatrixXd noise;                 ///< (k, m) what a sensor shows and the others do not
};

/// What sensor j shows that no sum of the others does: 1/(S^-1)_jj.  One sensor alone: the lowest nearby.
Eigen::MatrixXd own_share(const std::vector<Eigen::MatrixXcd> &matrix)
{
  const auto k = Eigen::Index(matrix.size()), m = matrix.empty() ? 0 : matrix.front().rows();
  Eigen::MatrixXd share(k, m);
  for (Eigen::Index b = 0; b < k; ++b) {
    const Eigen::MatrixXcd &S      = matrix[std::size_t(b)];
    const Eigen::VectorXd diagonal = S.diagonal().real().cwiseMax(1e-300);
    if (m == 1) {
      share(b, 0) = diagonal[0];
      for (Eigen::Index i = std::max<Eigen::Index>(0, b - 24); i < std::min(k, b + 25); ++i)
        share(b, 0) = std::min(share(b, 0), matrix[std::size_t(i)](0, 0).real());
      continue;
    }
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    Eigen::MatrixXcd even       = scale.asDiagonal() * S * scale.asDiagonal();
    even.diagonal().array() += 1e-6;  // rounding is not a measurement
    share.row(b) = even.inverse().diagonal().real().cwiseInverse().cwiseProduct(diagonal).transpose();
  }
  return share;
}

Averages averages_of(const SpectralMatrices &s, const double low, const double high)
{
  const double df          = s.rate / double(s.L);
  const Eigen::Index first = std::max<Eigen::Index>(2, Eigen::Index(std::ceil(low / df))),
                     last  = std::min<Eigen::Index>(s.L / 2 - 1, Eigen::Index(std::floor(high / df)));
  Averages a;
  a.first = first;
  a.bin   = 2 * M_PI * df;
  a.count = s.averages();
  for (Eigen::Index b = first; b <= last; ++b)
    a.matrix.push_back(s.density[std::size_t(b)]);
  a.noise = own_share(a.matrix);
  return a;
}

/// h h' of one newton seen through the window, and its slopes.
struct SeenMatrices {
  std::vector<Eigen::MatrixXcd> value;               // (k) (m, m)
  std::vector<std::vector<Eigen::MatrixXcd>> slope;  // (p) (k) (m, m)
};

/// Re-ordered products of columns: sum over both orders where they differ.
std::vector<Eigen::MatrixXcd> products_seen(const Eigen::MatrixXcd &a, const Eigen::MatrixXcd &b,
                                            const Eigen::VectorXd &weights, const Eigen::Index k)
{
  const Eigen::Index m = a.cols();
  std::vector<Eigen::MatrixXcd> seen(std::size_t(k), Eigen::MatrixXcd(m, m));
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::VectorXcd entry = seen_through(a.col(i).cwiseProduct(b.col(j).conjugate()), weights, k);
      for (Eigen::Index q = 0; q < k; ++q)
        seen[std::size_t(q)](i, j) = entry[q];
    }
  return seen;
}

SeenMatrices seen_matrices(const OutputOnly &record, const Eigen::VectorXd &theta, const Averages &a,
                           const BandRecord &fine)
{
  const StandAt trial = stand_at(record.stand, record.unknowns, theta);
  const Block whole{0, fine.angular.size()};
  ModalColumns c = modal_columns(trial, fine, whole);
  add_derivatives(c, trial, record.unknowns, fine, whole, Eigen::VectorXd::Zero(2 * trial.frequency.size()));
  Eigen::MatrixXd sees(trial.shape.cols(), Eigen::Index(record.data.places.size()));
  for (std::size_t j = 0; j < record.data.places.size(); ++j)
    sees.col(Eigen::Index(j)) = trial.shape.row(record.data.places[j]).transpose();
  const auto k                  = Eigen::Index(a.matrix.size());
  const Eigen::VectorXd weights = hann_weights();
  const Eigen::MatrixXcd h      = c.driven.matrix() * sees;
  SeenMatrices seen{products_seen(h, h, weights, k), {}};
  for (const Eigen::ArrayXXcd &modal : c.derivative) {
    seen.slope.push_back(products_seen(modal.matrix() * sees, h, weights, k));
    for (Eigen::MatrixXcd &S : seen.slope.back())
      S += S.adjoint().eval();
  }
  return seen;
}

/// Wishart: count (ln det S + tr S^-1 measured).  (44.14)
Likelihood wishart_cost(const OutputOnly &record, const Eigen::VectorXd &theta, const Averages &a,
                        const BandRecord &fine)
{
  const auto p = Eigen::Index(record.unknowns.size()), q = record.force.knots.size();
  const SeenMatrices seen = seen_matrices(record, theta.head(p), a, fine);
  Likelihood sum;
  sum.slope       = Eigen::VectorXd::Zero(p + q);
  sum.information = Eigen::MatrixXd::Zero(p + q, p + q);
  std::vector<Eigen::MatrixXcd> changed(std::size_t(p) + 2);
  std::vector<Eigen::Index> index(std::size_t(p) + 2);
  for (std::size_t b = 0; b < a.matrix.size(); ++b) {
    const double f                = a.bin * double(a.first + Eigen::Index(b)) / (2 * M_PI),
                 S_F              = density(record.force, theta.tail(q), f);
    const BetweenKnots between    = between_knots(record.force, f);
    const Eigen::MatrixXcd driven = S_F * seen.value[b];
    Eigen::MatrixXcd S            = driven;
    S.diagonal() += a.noise.row(Eigen::Index(b)).transpose().cast<std::complex<double>>();
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(S);
    const Eigen::MatrixXcd inverse = lu.inverse(), solved = inverse * a.matrix[b];
    sum.residual += a.count * (std::log(std::abs(lu.determinant())) + solved.trace().real());
    for (Eigen::Index i = 0; i < p + 2; ++i) {
      const double share      = i < p ? S_F : i == p ? 1 - between.share : between.share;
      index[std::size_t(i)]   = i < p ? i : p + between.below + (i - p);
      changed[std::size_t(i)] = inverse * (share * (i < p ? seen.slope[std::size_t(i)][b] : driven));
    }
    for (std::size_t i = 0; i < changed.size(); ++i) {
      sum.slope[index[i]] += a.count * (changed[i].trace() - (changed[i] * solved).trace()).real();
      for (std::size_t j = 0; j < changed.size(); ++j)
        sum.information(index[i], index[j]) +=
            a.count * changed[i].cwiseProduct(changed[j].transpose()).sum().real();
    }
  }
  sum.cost = sum.residual;
  add_prior(sum, record.all_unknowns(), theta);
  return sum;
}

/// Density that makes what the case answers as large as what was measured, on the mean of the logarithms.
double first_level(const OutputOnly &record, const Averages &a, const BandRecord &fine)
{
  Eigen::VectorXd prior(Eigen::Index(record.unknowns.size()));
  for (Eigen::Index i = 0; i < prior.size(); ++i)
    prior[i] = record.unknowns[std::size_t(i)].prior;
  const SeenMatrices seen = seen_matrices(record, prior, a, fine);
  double sum              = 0;
  for (std::size_t b = 0; b < a.matrix.size(); ++b)
    sum += std::log(std::max(a.matrix[b].trace().real(), 1e-300) / std::max(seen.value[b].trace().real(), 1e-300));
  return std::exp(sum / double(std::max<std::size_t>(1, a.matrix.size())));
}
}  // namespace

double SpectralMatrices::averages() const
{
  return CrossSpectra{L, n, rate, {}, {}, {}}.averages();
}

SpectralMatrices spectral_matrices(const std::vector<ForcedSamples> &pieces, const double rate,
                                   const Eigen::Index L)
{
  SpectralMatrices s{L, 0, rate, {}};
  const Eigen::Index half = L / 2 + 1, m = pieces.empty() ? 0 : pieces.front().acceleration.cols();
  s.density.assign(std::size_t(half), Eigen::MatrixXcd::Zero(m, m));
  const Eigen::ArrayXd window = Eigen::ArrayXd::NullaryExpr(
      L, [&](const Eigen::Index i) { return 0.5 - 0.5 * std::cos(2 * M_PI * double(i) / double(L)); });
  Fourier fourier;
  std::vector<double> x(std::size_t(L), 0.0);
  std::vector<std::complex<double>> lines;
  Eigen::MatrixXcd Y(m, half);
  for (const ForcedSamples &piece : pieces)
    for (Eigen::Index from = 0; from + L <= piece.acceleration.rows(); from += L / 2, ++s.n) {
      for (Eigen::Index j = 0; j < m; ++j) {
        const auto part                         = piece.acceleration.col(j).segment(from, L).array();
        Eigen::Map<Eigen::ArrayXd>(x.data(), L) = (part - part.mean()) * window;
        fourier.forward(x, lines);
        Y.row(j) = Eigen::Map<const Eigen::RowVectorXcd>(lines.data(), half);
      }
      for (Eigen::Index b = 0; b < half; ++b)
        s.density[std::size_t(b)].noalias() += Y.col(b) * Y.col(b).adjoint();
    }
  const double scale = s.n > 0 ? 2 / (rate * 0.375 * double(L) * double(s.n)) : 0;
  for (Eigen::MatrixXcd &S : s.density)
    S *= scale;
  return s;
}

Eigen::VectorXd output_only_start(OutputOnly &record, const std::vector<ForcedSamples> &pieces, const double rate,
                                  const double low, const double high)
{
  const auto unknowns = record.all_unknowns();
  Eigen::VectorXd theta(Eigen::Index(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    theta[Eigen::Index(i)] = unknowns[i].prior;
  bool first = true;
  for (Eigen::Index L = 1 << 11; L <= 1 << 15; L *= 2) {
    const SpectralMatrices s = spectral_matrices(pieces, rate, L);
    if (s.n < 4)  // fewer say no coherence
      break;
    const Averages a = averages_of(s, low, high);
    if (a.matrix.size() < 4)
      continue;
    const BandRecord fine = fine_grid(a.bin, a.first, Eigen::Index(a.matrix.size()));
    if (first)
      record.force.level = first_level(record, a, fine);
    first = false;
    theta = descend([&](const Eigen::VectorXd &tried, Wanted) { return wishart_cost(record, tried, a, fine); },
                    unknowns, theta, 60, 1e-3)
                .theta;
  }
  return theta;
}
}  // namespace mill::twin
