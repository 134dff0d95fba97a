#include "twin/calibration/clock_delay.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double longest_clock_delay = 0.05;  // s

/// Response of the stand at bins of H1, unit force.  (k, m)
Eigen::MatrixXcd response_at(const StandAt &trial, const Eigen::VectorXd &angular,
                             const std::vector<Eigen::Index> &places)
{
  BandRecord bins;
  bins.angular         = angular;
  bins.force           = Eigen::VectorXcd::Ones(angular.size());
  const ModalColumns c = modal_columns(trial, bins, {0, angular.size()});
  Eigen::MatrixXcd H(angular.size(), Eigen::Index(places.size()));
  for (std::size_t j = 0; j < places.size(); ++j)
    H.col(Eigen::Index(j)) = c.driven.matrix() * trial.shape.row(places[j]).transpose();
  return H;
}

struct PhaseDelay {
  double seconds = 0, agreement = -1;
};

/// Delay at which H1 has the phases of the stand.  (44.17)
PhaseDelay best_of_phases(const StandAt &trial, const std::vector<Eigen::Index> &places,
                          const std::vector<ForcedSamples> &pieces, const double rate, const double low,
                          const double high)
{
  Eigen::Index L = 1 << 13;
  CrossSpectra s = cross_spectra(pieces, rate, L);
  for (; s.n < 4 && L > 512; s = cross_spectra(pieces, rate, L))
    L /= 2;
  const double bin = 2 * M_PI * rate / double(L);
  const auto first = Eigen::Index(std::ceil(2 * M_PI * low / bin)),
             last  = std::min<Eigen::Index>(L / 2, Eigen::Index(std::floor(2 * M_PI * high / bin)));
  if (s.n == 0 || last <= first)
    return {};
  const Eigen::Index k          = last - first + 1;
  const Eigen::VectorXd angular = bin * Eigen::VectorXd::LinSpaced(k, double(first), double(last));
  // Each bin of each sensor counts by what is coherent in it, not by its size: one resonance would decide.
  const Eigen::ArrayXXcd both =
      response_at(trial, angular, places).conjugate().array() * s.cross.middleRows(first, k).array();
  const Eigen::ArrayXXd coherence =
      s.cross.middleRows(first, k).cwiseAbs2().array() /
      (s.response.middleRows(first, k).array().colwise() * s.force.segment(first, k).array()).max(1e-300);
  const Eigen::ArrayXcd phase = (both / both.abs().max(1e-300) * coherence).rowwise().sum();
  PhaseDelay best;
  for (double tau = -longest_clock_delay; tau <= longest_clock_delay; tau += 0.05 / high) {
    const double agreement =
        (phase * (Eigen::ArrayXcd(angular.array() * std::complex<double>(0, tau))).exp()).real().sum();
    if (agreement > best.agreement)
      best = {tau, agreement};
  }
  return best;
}
}  // namespace

bool ClockDelay::significant() const
{
  return std::abs(seconds) > std::max(3 * deviation, 0.1 * limit);
}

bool ClockDelay::too_large() const
{
  return significant() && std::abs(seconds) > limit;
}

std::string ClockDelay::words(const double rate) const
{
  return fmt::format(
      "the accelerations are {:.3g} samples ({:.3g} ms) {} than the force, uncertain by {:.2g} samples: "
      "two clocks, or a filter in one of the amplifiers; up to {:.3g} ms are allowed, --align fits the "
      "delay as one more unknown",
      std::abs(seconds) * rate, 1e3 * std::abs(seconds), seconds > 0 ? "later" : "earlier", deviation * rate,
      1e3 * limit);
}

ClockDelay clock_delay(const FittedStand &stand, const Fit &fit, const MeasuredResponse &data,
                       const std::vector<ForcedSamples> &pieces, const double rate, const double low,
                       const double high, const FitSettings &settings)
{
  std::vector<Unknown> unknowns = fit.unknowns;
  const auto last               = Eigen::Index(unknowns.size());
  unknowns.push_back({delay_name, longest_clock_delay, 0});
  Eigen::VectorXd start(last + 1), prior(last);
  for (Eigen::Index i = 0; i < last; ++i)
    prior[i] = unknowns[std::size_t(i)].prior;
  // A large delay has spoilt the fit: dampings run away, and with them the phases of the stand.  Not those of the
  // case.
  double highest = -1;
  start << fit.estimate, 0.0;  // kept where the pieces are too short for an H1
  for (const Eigen::VectorXd &theta : {fit.estimate, prior}) {
    const PhaseDelay delay =
        best_of_phases(stand_at(stand, fit.unknowns, theta), data.places, pieces, rate, low, high);
    if (delay.agreement > highest)
      start << theta, delay.seconds;
    highest = std::max(highest, delay.agreement);
  }
  FitSettings once     = settings;
  once.renewals        = 1;
  const Fit with_delay = fitted(stand, unknowns, start, data, once);
  return {with_delay.estimate[last], with_delay.sd()[last], 1 / (20 * high)};
}
}  // namespace mill::twin
