#include "twin/calibration/output_only_adequacy.h"
#include "twin/calibration/fit.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double limit_at_least = 1.05, limit_scatter = 4;
constexpr double level_bands_an_octave = 12;
constexpr double clear_force           = 10;  // largest eigenvalue over the mean of the others

double limit_of(const Eigen::Index bins)
{
  return limit_at_least + limit_scatter / std::sqrt(double(bins));
}

/// What one force leaves of spectral matrices over the root of the noise, and whether there is one force.
struct OneForce {
  double left = 0, energy = 0;  // (m - 1 lowest eigenvalues, all), summed over the bins
  Eigen::Index bins = 0;
};

OneForce one_force(const SpectralMatrices &s, const BandRecord &band, const Eigen::MatrixXd &noise,
                   const double from, const double to)
{
  const double df = s.rate / double(s.L);
  OneForce sum;
  for (auto b = Eigen::Index(std::ceil(from / df)); b < to / df && b < Eigen::Index(s.density.size()); ++b) {
    const double *w = band.angular.data(), w_b = 2 * M_PI * df * double(b);
    const auto row =
        std::min<Eigen::Index>(std::lower_bound(w, w + band.angular.size(), w_b) - w, band.angular.size() - 1);
    const Eigen::VectorXd scale = noise.row(row).transpose().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXcd even = scale.asDiagonal() * s.density[std::size_t(b)] * scale.asDiagonal();
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(even, Eigen::EigenvaluesOnly).eigenvalues();
    sum.left += values.head(values.size() - 1).sum();
    sum.energy += values.sum();
    ++sum.bins;
  }
  return sum;
}

SpectralMatrices long_averages(const std::vector<ForcedSamples> &pieces, const double rate)
{
  Eigen::Index samples = 0, longest = 0;
  for (const ForcedSamples &piece : pieces) {
    samples += piece.acceleration.rows();
    longest = std::max(longest, piece.acceleration.rows());
  }
  return spectral_matrices(pieces, rate, segment_for(samples, longest));
}

/// Energy of two kinds in a band of the whole record.
struct WholeBand {
  double left = 0, energy = 0;
  Eigen::Index bins = 0;
};

WholeBand whole_band(const OutputOnly &record, const std::vector<SeenForce> &seen, const NoiseDensity &noise,
                     const double from, const double to)
{
  WholeBand sum;
  for (std::size_t p = 0; p < seen.size(); ++p) {
    const BandRecord &band = record.data.pieces[p];
    for (Eigen::Index b = 0; b < band.angular.size(); ++b) {
      const double f = band.angular[b] / (2 * M_PI);
      if (f < from || f >= to)
        continue;
      const Eigen::ArrayXd N   = noise[p].row(b).transpose().array();
      const Eigen::VectorXcd h = seen[p].response.row(b).transpose(), r = seen[p].left.row(b).transpose(),
                             y         = r + h * seen[p].force[b];
      const std::complex<double> along = ((h.conjugate().array() * y.array()) / N).sum();
      const double size = (h.cwiseAbs2().array() / N).sum(), all = (y.cwiseAbs2().array() / N).sum();
      sum.left += all - std::norm(along) / std::max(size, 1e-300);
      sum.energy += all;
      ++sum.bins;
    }
  }
  return sum;
}
}  // namespace

double LevelBand::excess() const
{
  return std::max(ratio, 1 / std::max(ratio, 1e-300)) / limit;
}

std::vector<BandResidual> direction_residuals(const OutputOnly &record, const std::vector<SeenForce> &seen,
                                              const NoiseDensity &noise, const std::vector<ForcedSamples> &pieces,
                                              const double rate, const double low, const double high,
                                              const double model_error)
{
  std::vector<BandResidual> bands;
  const auto m = double(record.data.places.size());
  if (m < 2)
    return bands;
  const SpectralMatrices spectra = long_averages(pieces, rate);
  const double n                 = spectra.averages();
  double all                     = 0;
  for (const ThirdOctave &third : third_octaves(low, high)) {
    const WholeBand whole = whole_band(record, seen, noise, third.from, third.to);
    const OneForce one    = one_force(spectra, record.data.pieces.front(), noise.front(), third.from, third.to);
    if (whole.bins < 16 || one.bins == 0 || !(n > 1.5))  // fewer bins allow no statement
      continue;
    BandResidual r{third.centre, -1, whole.bins, whole.energy, 0, 0, 0, 0, false};
    all += whole.energy;
    r.left  = whole.left / (double(whole.bins) * (m - 1));
    r.floor = one.left / (double(one.bins) * (m - 1)) * n / (n - 1);
    // the model error is a share of the level, in the unit of `left`: noise of one sensor
    const double model = model_error * model_error * whole.energy / (double(whole.bins) * (m - 1));
    r.ratio            = r.left / std::max(r.floor + model, 1e-300);
    r.limit            = limit_of(whole.bins);
    r.decisive         = (one.energy - one.left) > clear_force * one.left / (m - 1);
    bands.push_back(r);
  }
  for (BandResidual &r : bands) {
    r.energy /= std::max(all, 1e-300);
    r.decisive = r.decisive && r.energy >= least_energy;
  }
  return bands;
}

std::vector<LevelBand> level_bands(const OutputOnly &record, const std::vector<SeenForce> &seen, const double low,
                                   const double high, const double model_error)
{
  const auto n = Eigen::Index(std::ceil(level_bands_an_octave * std::log2(high / low)));
  std::vector<LevelBand> bands;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n), clear = sum, energy = sum;
  Eigen::VectorXi bins = Eigen::VectorXi::Zero(n);
  for (std::size_t p = 0; p < seen.size(); ++p) {
    const BandRecord &band = record.data.pieces[p];
    for (Eigen::Index b = 0; b < band.angular.size(); ++b) {
      const double f = band.angular[b] / (2 * M_PI);
      const auto i = std::clamp<Eigen::Index>(Eigen::Index(level_bands_an_octave * std::log2(f / low)), 0, n - 1);
      // |F|^2 of the mean over its expectation S_F (1 - g), an exponential variable of mean 1
      const double share = 1 - seen[p].variance[b] / seen[p].density[b];
      sum[i] += std::norm(seen[p].force[b]) / std::max(seen[p].density[b] * share, 1e-300);
      clear[i] += share;
      energy[i] += band.acceleration.row(b).squaredNorm() / band.duration;
      ++bins[i];
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (bins[i] < 16)
      continue;
    const double count = bins[i], share = energy[i] / std::max(energy.sum(), 1e-300);
    bands.push_back({low * std::exp2((double(i) + 0.5) / level_bands_an_octave), bins[i], sum[i] / count,
                     limit_of(bins[i]) * (1 + model_error) * (1 + model_error), share,
                     clear[i] > 0.5 * count && share >= least_energy});
  }
  return bands;
}

double output_only_misfit(const OutputOnly &record, const Eigen::VectorXd &theta, const NoiseDensity &noise,
                          const double low, const double high)
{
  const auto m = double(record.data.places.size());
  if (m > 1) {
    OutputOnly any = record;
    any.force.level *= 1e12;  // the force may be anything
    const double left = output_only_likelihood(any, theta, noise, Wanted::cost).residual;
    return left / (number_of_values(record.data) * (m - 1) / m);
  }
  double sum = 0, count = 0;
  for (const LevelBand &band : level_bands(record, seen_force(record, theta, noise), low, high))
    if (band.decisive) {
      sum += 2 * double(band.bins) * (band.ratio - 1 - std::log(band.ratio));
      ++count;
    }
  return count > 0 ? sum / count : 0;
}
}  // namespace mill::twin
