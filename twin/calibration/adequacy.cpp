#include "twin/calibration/adequacy.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
/// Share of the energy between two frequencies that is not coherent with the force, unbiased: an average of n
/// transforms calls 1/n of pure noise coherent.
double incoherent_share(const CrossSpectra &s, const Eigen::Index sensor, const double low, const double high)
{
  const double df = s.rate / double(s.L);
  double left = 0, all = 0;
  for (auto b = Eigen::Index(std::ceil(low / df)); b < high / df && b < s.force.size(); ++b) {
    const double YY = s.response(b, sensor), FF = s.force[b];
    all += YY;
    left += YY - (FF > 0 ? std::norm(s.cross(b, sensor)) / FF : 0);
  }
  const double n = s.averages();
  return all > 0 && n > 1.5 ? left / all * n / (n - 1) : 1;
}

Eigen::Index segment_of(const std::vector<ForcedSamples> &pieces)
{
  Eigen::Index samples = 0, longest = 0;
  for (const ForcedSamples &piece : pieces) {
    samples += piece.force.size();
    longest = std::max(longest, piece.force.size());
  }
  return segment_for(samples, longest);
}
}  // namespace

std::vector<ThirdOctave> third_octaves(const double low, const double high)
{
  const double half = std::pow(2.0, 1.0 / 6);
  std::vector<ThirdOctave> thirds;
  for (int third = -20; third <= 10; ++third) {
    const double centre = 1000 * std::pow(2.0, third / 3.0);
    const ThirdOctave part{centre, std::max(low, centre / half), std::min(high, centre * half)};
    if (part.to > part.from)
      thirds.push_back(part);
  }
  return thirds;
}

Eigen::Index segment_for(const Eigen::Index samples, const Eigen::Index longest_piece)
{
  Eigen::Index L = 1 << 16;
  while (L > 256 && (L > longest_piece || samples < 9 * L / 2))
    L /= 2;
  return L;
}

std::vector<BandResidual> band_residuals(const MeasuredResponse &data,
                                         const std::vector<Eigen::MatrixXcd> &residual,
                                         const std::vector<ForcedSamples> &pieces, const double rate,
                                         const double low, const double high, const double model_error)
{
  const CrossSpectra spectra = cross_spectra(pieces, rate, segment_of(pieces));
  std::vector<BandResidual> bands;
  const auto m        = Eigen::Index(data.places.size());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(m);
  for (const BandRecord &band : data.pieces)
    all += band.acceleration.colwise().squaredNorm().transpose() / band.duration;
  for (const auto &[centre, from, to] : third_octaves(low, high)) {
    for (Eigen::Index j = 0; j < m; ++j) {
      BandResidual r{centre, j, 0, 0, 0, 0, 0, 0, false};
      double energy = 0, left = 0;
      for (std::size_t p = 0; p < data.pieces.size(); ++p) {
        const BandRecord &band = data.pieces[p];
        for (Eigen::Index b = 0; b < band.angular.size(); ++b) {
          const double f = band.angular[b] / (2 * M_PI);
          if (f < from || f >= to)
            continue;
          ++r.bins;
          energy += std::norm(band.acceleration(b, j)) / band.duration;
          left += std::norm(residual[p](b, j)) / band.duration;
        }
      }
      if (r.bins < 16)  // fewer bins allow no statement
        continue;
      r.energy   = energy / std::max(all[j], 1e-300);
      r.left     = left / std::max(energy, 1e-300);
      r.floor    = incoherent_share(spectra, j, from, to);
      r.ratio    = r.left / std::max(r.floor + model_error * model_error, 1e-300);
      r.limit    = 1.05 + 4 / std::sqrt(double(r.bins));
      r.decisive = r.floor < 0.9 && r.energy >= least_energy;
      bands.push_back(r);
    }
  }
  return bands;
}

WrongBands wrong_bands(const std::vector<BandResidual> &bands)
{
  WrongBands wrong;
  for (const BandResidual &band : bands)
    if (band.wrong()) {
      ++wrong.count;
      if (!wrong.worst || band.ratio / band.limit > wrong.worst->ratio / wrong.worst->limit)
        wrong.worst = &band;
    }
  return wrong;
}
}  // namespace mill::twin
