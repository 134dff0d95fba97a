#include "twin/analysis/owner.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double farthest = 3, apart = 1, least_assurance = 0.7;  // standard deviations, -

// Shape of a mode of the case at the channels that are places of it; empty with fewer than three.
double assurance(const Seen &seen, const CaseModel &stand, const Eigen::Index mode)
{
  std::vector<std::complex<double>> measured, computed;
  for (std::size_t c = 0; c < seen.channels.size() && Eigen::Index(c) < seen.shape.size(); ++c)
    for (std::size_t p = 0; p < stand.places.size(); ++p)
      if (stand.places[p] == seen.channels[c]) {
        measured.push_back(seen.shape[Eigen::Index(c)]);
        computed.emplace_back(stand.shape(Eigen::Index(p), mode), 0);
      }
  if (measured.size() < 3)
    return std::numeric_limits<double>::quiet_NaN();
  const auto n = Eigen::Index(measured.size());
  return modal_assurance(Eigen::Map<const Eigen::VectorXcd>(measured.data(), n),
                         Eigen::Map<const Eigen::VectorXcd>(computed.data(), n));
}

std::string described(const CaseModel &stand, const Eigen::Index mode)
{
  Eigen::Index spring = 0, mass = 0;
  const double strain  = stand.strain_share.row(mode).maxCoeff(&spring);
  const double kinetic = stand.kinetic_share.row(mode).maxCoeff(&mass);
  return fmt::format("mode {} of the case ({:.4g} Hz): spring {} {:.0f} %, mass {} {:.0f} %", mode + 1,
                     stand.frequency[mode], stand.springs[std::size_t(spring)], 100 * strain,
                     stand.places[std::size_t(mass)], 100 * kinetic);
}
}  // namespace

Owner owner_among_modes(const Seen &seen, const CaseModel &stand)
{
  struct Candidate {
    Eigen::Index mode;
    double distance;
  };
  std::vector<Candidate> candidates;
  for (Eigen::Index i = 0; i < stand.frequency.size(); ++i) {
    const double of_case =
        0.5 * stand.strain_share.row(i).transpose().cwiseProduct(stand.spring_error).norm();  // (42.7)
    const double distance =
        std::abs(std::log(seen.frequency / stand.frequency[i])) / std::hypot(seen.deviation, of_case);
    const double mac = assurance(seen, stand, i);
    if (distance < farthest && (std::isnan(mac) || mac > least_assurance))
      candidates.push_back({i, distance});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const auto &a, const auto &b) { return a.distance < b.distance; });
  if (candidates.empty())
    return {"no mode of the case", -1, 0};
  std::string text =
      described(stand, candidates[0].mode) + fmt::format(", {:.1f} sd away", candidates[0].distance);
  if (candidates.size() == 1 || candidates[1].distance - candidates[0].distance > apart)
    return {text, int(candidates[0].mode), candidates[0].distance};
  text = "ambiguous: " + text;
  for (std::size_t i = 1; i < candidates.size(); ++i)
    text +=
        "; or " + described(stand, candidates[i].mode) + fmt::format(", {:.1f} sd away", candidates[i].distance);
  return {text, -1, candidates[0].distance};
}

std::string turning_owner(const double frequency, const double reach, const std::vector<TurningRoll> &rolls,
                          const double speed, const bool line)
{
  constexpr int most_orders = 5;
  for (const TurningRoll &roll : rolls) {
    const double turn = speed / (M_PI * roll.diameter), order = frequency / turn;
    const double whole = std::round(order);
    if (std::isfinite(turn) && whole >= 1 && whole <= most_orders &&
        std::abs(frequency - whole * turn) <= reach + 0.002 * frequency)
      return fmt::format("{} turn{} of the {} ({:.3f} Hz each)", whole, whole == 1 ? "" : "s", roll.name, turn);
  }
  const double mains = std::round(frequency / 50);
  if (line && mains >= 1 && mains <= 20 && std::abs(frequency - 50 * mains) <= reach + 0.002 * frequency)
    return mains == 1 ? "mains, 50 Hz" : fmt::format("mains, {} x 50 Hz", mains);
  return "";
}
}  // namespace mill::twin
