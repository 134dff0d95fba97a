#include "twin/calibration/thinned_response.h"
#include <algorithm>

namespace mill::twin {
namespace {
/// Bins that are kept and how many each stands for.
void choose_bins(const BandRecord &band, const double damping, std::vector<Eigen::Index> &bins,
                 Eigen::VectorXd &stands_for)
{
  constexpr double in_a_half_width = 4, most = 16;
  const Eigen::Index k = band.angular.size();
  std::vector<double> weights;
  for (Eigen::Index b = 0; b < k;) {
    const double distance = k > 1 ? band.angular[1] - band.angular[0] : 1;
    const double wide     = damping * band.angular[b] / (in_a_half_width * distance);
    const auto number     = std::min(k - b, Eigen::Index(std::clamp(wide, 1.0, most)));
    bins.push_back(b + number / 2);
    weights.push_back(double(number));
    b += number;
  }
  stands_for = Eigen::Map<Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()));
}
}  // namespace

ThinnedResponse thinned(const MeasuredResponse &data, const double damping)
{
  ThinnedResponse thin;
  thin.data.places = data.places;
  for (const BandRecord &band : data.pieces) {
    thin.bins.emplace_back();
    thin.stands_for.emplace_back();
    choose_bins(band, damping, thin.bins.back(), thin.stands_for.back());
    BandRecord fewer = band;
    fewer.angular    = band.angular(thin.bins.back());
    if (band.force.size())
      fewer.force = band.force(thin.bins.back());
    fewer.acceleration = band.acceleration(thin.bins.back(), Eigen::all);
    thin.data.pieces.push_back(std::move(fewer));
  }
  return thin;
}

NoiseDensity thinned(const NoiseDensity &noise, const ThinnedResponse &thin)
{
  NoiseDensity fewer;
  for (std::size_t i = 0; i < noise.size(); ++i)
    fewer.push_back(thin.stands_for[i].cwiseInverse().asDiagonal() * noise[i](thin.bins[i], Eigen::all));
  return fewer;
}
}  // namespace mill::twin
