#include "twin/calibration/predicted_modes.h"
#include "twin/calibration/calibration_parts.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double determined_within = 0.005;  // ln of a frequency, to each side: what is asked of a calibration
constexpr double worth_a_name      = 0.3;    // of the largest contribution to a deviation

std::vector<std::string> largest_parts(const std::vector<Unknown> &unknowns, const Eigen::ArrayXd &part)
{
  std::vector<Eigen::Index> order;
  for (Eigen::Index p = 0; p < part.size(); ++p)
    if (part[p] > worth_a_name * part.maxCoeff())
      order.push_back(p);
  std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return part[a] > part[b]; });
  std::vector<std::string> names;
  for (const Eigen::Index p : order)
    names.push_back(unknowns[std::size_t(p)].name);
  return names;
}
}  // namespace

std::vector<PredictedMode> predicted_modes(const FittedStand &stand, const ScannedFit &scan,
                                           const Eigen::VectorXd &kept, const double highest)
{
  const std::vector<Unknown> &unknowns = scan.best.unknowns;
  const auto frequency_at              = [&](const Eigen::VectorXd &theta) {
    return Eigen::ArrayXd(stand_at(stand, unknowns, theta.head(kept.size())).frequency / (2 * M_PI));
  };
  const StandAt joint         = stand_at(stand, unknowns, scan.best.estimate);
  const Eigen::MatrixXd slope = frequency_slopes(joint);
  const Eigen::ArrayXd sd =
      (slope * scan.best.covariance * slope.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::ArrayXd centre = joint.frequency / (2 * M_PI), value = frequency_at(kept),
                       before = frequency_at(Eigen::VectorXd::Zero(kept.size()));
  Eigen::ArrayXd low = (centre * (-1.96 * sd).exp()).min(value), high = (centre * (1.96 * sd).exp()).max(value);
  const auto cover = [&](const Eigen::VectorXd &theta) {
    const Eigen::ArrayXd there = frequency_at(theta);
    low                        = low.min(there);
    high                       = high.max(there);
  };
  for (const Eigen::VectorXd &end : scan.ends)
    cover(end);
  for (const Basin &basin : scan.basins)
    if (basin.deviance < other_basin)
      cover(basin.unknowns);
  for (const ModeScan &mode : scan.modes)
    for (std::size_t k = 0; mode.has_several_places() && k < mode.theta.size(); ++k)
      if (mode.deviance[Eigen::Index(k)] < mode.allowed) {
        const double there = frequency_at(mode.theta[k])[mode.mode];
        low[mode.mode]     = std::min(low[mode.mode], there);
        high[mode.mode]    = std::max(high[mode.mode], there);
      }
  std::vector<PredictedMode> modes;
  for (Eigen::Index i = 0; i < value.size() && centre[i] < highest; ++i) {
    PredictedMode mode{before[i], value[i], low[i], high[i], {}};
    if (std::log(std::max(mode.high / mode.frequency, mode.frequency / mode.low)) > determined_within)
      mode.rests_on =
          largest_parts(unknowns, slope.row(i).transpose().array().abs() * scan.best.sd().array().eval());
    modes.push_back(std::move(mode));
  }
  return modes;
}

std::vector<std::string> open_mode_words(const std::vector<PredictedMode> &modes)
{
  std::vector<std::string> all;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const PredictedMode &mode = modes[i];
    if (mode.determined())
      continue;
    std::string names;
    for (const std::string &name : mode.rests_on)
      names += (names.empty() ? "" : ", ") + name;
    all.push_back(fmt::format("mode {}, {:.4g} Hz ({:.3g} .. {:.3g} Hz), is not determined by these records; it "
                              "depends on {}",
                              i + 1, mode.frequency, mode.low, mode.high, names));
  }
  return all;
}
}  // namespace mill::twin
