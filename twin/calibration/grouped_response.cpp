#include "twin/calibration/grouped_response.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
/// First bins of the groups, and the number of all bins.
std::vector<Eigen::Index> borders_of(const BandRecord &band, const double damping)
{
  constexpr double in_a_half_width = 8, most = 16;
  const Eigen::Index k  = band.angular.size();
  const double distance = k > 1 ? band.angular[1] - band.angular[0] : 1;
  std::vector<Eigen::Index> borders{0};
  while (borders.back() < k) {
    const double bins = damping * band.angular[borders.back()] / (in_a_half_width * distance);
    borders.push_back(std::min(k, borders.back() + Eigen::Index(std::clamp(bins, 1.0, most))));
  }
  return borders;
}

/// The narrowest relative half-width of the modes in a band.
double narrowest(const StandAt &stand, const BandRecord &band)
{
  double least = 1;
  for (Eigen::Index i = 0; i < stand.frequency.size(); ++i)
    if (band.angular.size() > 0 && stand.frequency[i] < band.angular[band.angular.size() - 1])
      least = std::min(least, stand.damping[i]);
  return least;
}
}  // namespace

GroupedResponse grouped(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                        const Eigen::VectorXd &theta, const MeasuredResponse &data, const NoiseDensity &noise)
{
  const StandAt modes                      = stand_at(stand, unknowns, theta);
  const std::vector<Eigen::MatrixXcd> left = residuals(stand, unknowns, theta, data, noise);
  const auto m                             = Eigen::Index(data.places.size());
  GroupedResponse result;
  result.data.places = data.places;
  for (std::size_t piece = 0; piece < data.pieces.size(); ++piece) {
    const BandRecord &band  = data.pieces[piece];
    const ModalColumns c    = modal_columns(modes, band, {0, band.angular.size()});
    Eigen::MatrixXcd forced = left[piece];
    for (Eigen::Index j = 0; j < m; ++j)
      forced.col(j) += c.driven.matrix() * modes.shape.row(data.places[std::size_t(j)]).transpose();
    const auto borders        = borders_of(band, narrowest(modes, band));
    const Eigen::Index groups = Eigen::Index(borders.size()) - 1;
    BandRecord fewer{band.duration, Eigen::VectorXd(groups), Eigen::VectorXcd(groups), Eigen::MatrixXcd(groups, m),
                     band.line_step};
    Eigen::MatrixXd density(groups, m);
    for (Eigen::Index g = 0; g < groups; ++g) {
      const Eigen::Index first = borders[std::size_t(g)], n = borders[std::size_t(g) + 1] - first;
      const Eigen::VectorXcd F     = band.force.segment(first, n);
      const Eigen::VectorXd weight = F.cwiseAbs2().cwiseMax(1e-300);
      const double power           = weight.sum();
      fewer.angular[g]             = weight.dot(band.angular.segment(first, n)) / power;
      fewer.force[g]               = std::sqrt(power);
      fewer.acceleration.row(g)    = F.adjoint() * forced.middleRows(first, n) / std::sqrt(power);
      density.row(g)               = weight.transpose() * noise[piece].middleRows(first, n) / power;
    }
    result.data.pieces.push_back(std::move(fewer));
    result.noise.push_back(std::move(density));
  }
  return result;
}
}  // namespace mill::twin
