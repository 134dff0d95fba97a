#include "twin/modes/force_modes.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

constexpr double least_coherence       = 0.1;   // below it a channel does not follow the force
constexpr double follows               = 0.3;   // of the best third octave
constexpr double lowest                = 20;    // Hz
constexpr double least_force           = 1e-5;  // of its largest density nearby: less is leakage, not drive
constexpr double resonance_half_widths = 6;     // of a resonance, to each side of a fit
constexpr Eigen::Index few_bins        = 12;    // to each side at least
constexpr double significant = 5, mode_deviations = 6, alike = 0.9;
constexpr double beyond        = 1.5;   // H is kept so far above the highest mode that is looked for
constexpr double least_damping = 5e-4;  // below it a pole is a line

// Bins in which the force has energy.
std::vector<bool> driven_bins(const ForceResponse &response)
{
  const Eigen::Index n = response.force.size();
  std::vector<bool> driven(std::size_t(n), false);
  for (Eigen::Index k = 1; k < n; ++k) {
    const Eigen::Index from = 2 * k / 3, to = std::min(n - 1, 3 * k / 2);
    driven[std::size_t(k)] =
        response.force[k] > least_force * response.force.segment(from, to - from + 1).maxCoeff();
  }
  return driven;
}

// Impulse responses of the channels, each lag (p, 1), from H in a band and a little more.
struct ImpulseResponses {
  double rate;                         // Hz
  std::vector<Eigen::MatrixXd> value;  // [m] of lag m; [0] unused
};

// 1 inside the band, 0 at 0.4 times its lower and 1.45 times its upper edge.
double taper(const ModeBand &band, const double f, const double top)
{
  const auto fall  = [](const double x) { return 0.5 + 0.5 * std::cos(M_PI * std::clamp(x, 0.0, 1.0)); };
  const double low = 0.9 * band.low, full = std::min(1.05 * band.high, 0.85 * top);
  return fall((low - f) / (0.5 * band.low)) * fall((f - full) / (top - full));
}

ImpulseResponses impulse_responses(const ForceResponse &response, const std::vector<bool> &driven,
                                   const ModeBand &band)
{
  const Eigen::Index p = response.H.cols();
  const auto last      = std::min(Eigen::Index(1.45 * band.high / response.resolution()), response.H.rows() - 1);
  const double top     = double(last) * response.resolution();
  Eigen::MatrixXcd weighted = Eigen::MatrixXcd::Zero(last + 1, p);
  for (Eigen::Index k = 1; k <= last; ++k)
    if (driven[std::size_t(k)])
      weighted.row(k) = taper(band, double(k) * response.resolution(), top) *
                        response.H.row(k).cwiseProduct(response.coherence.row(k));
  ImpulseResponses h{2 * top, {}};
  const int n = 2 * block_rows(h.rate, band.low) - 1;
  h.value.assign(std::size_t(n + 1), Eigen::MatrixXd::Zero(p, 1));
  for (int m = 1; m <= n; ++m)
    for (Eigen::Index k = 1; k <= last; ++k) {
      const double angle = M_PI * std::fmod(double(k) * double(m) / double(last), 2.0);
      h.value[std::size_t(m)] += (weighted.row(k) * std::polar(1.0, angle)).real().transpose();
    }
  return h;
}

std::vector<IdentifiedMode> candidates_in(const ForceResponse &response, const std::vector<bool> &driven,
                                          const ModeBand &band, const double T)
{
  ImpulseResponses h    = impulse_responses(response, driven, band);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(response.H.cols());
  for (const auto &one : h.value)
    scale += one.col(0).cwiseAbs2();
  scale = scale.cwiseSqrt().cwiseMax(1e-300);
  for (auto &one : h.value)
    one = scale.cwiseInverse().asDiagonal() * one;
  return modes_of_poles(poles_of_blocks(h.value, block_rows(h.rate, band.low), scale, h.rate, band), T);
}

Complex pole_of(const double frequency, const double damping)
{
  return 2 * M_PI * frequency * Complex(-damping, std::sqrt(1 - damping * damping));
}

// Bins of a fit about one candidate.
Span reach_of(const ForceResponse &response, const IdentifiedMode &mode)
{
  const double df  = response.resolution();
  const auto width = std::max(few_bins, Eigen::Index(resonance_half_widths * mode.damping * mode.frequency / df));
  const auto k     = Eigen::Index(std::lround(mode.frequency / df));
  return {std::max<Eigen::Index>(2, k - width), std::min(response.H.rows() - 1, k + width)};
}

// Candidates whose bands overlap are fitted together.
struct Group {
  Span bins{0, 0};
  std::vector<const IdentifiedMode *> modes;
};
std::vector<Group> groups_of(const ForceResponse &response, const std::vector<IdentifiedMode> &candidates)
{
  std::vector<Group> groups;
  for (const IdentifiedMode &mode : candidates) {
    const Span reach = reach_of(response, mode);
    if (!groups.empty() && reach.begin <= groups.back().bins.end)
      groups.back().bins.end = std::max(groups.back().bins.end, reach.end);
    else
      groups.push_back({reach, {}});
    groups.back().modes.push_back(&mode);
  }
  return groups;
}

bool stands_out(const FittedPole &pole)
{
  Eigen::Index largest = 0;
  pole.residue.cwiseAbs().maxCoeff(&largest);
  return std::abs(pole.residue[largest]) > significant * pole.sd_residue[largest];
}

bool agree(const FittedPole &half, const FittedPole &whole)
{
  return stands_out(half) &&
         std::abs(half.frequency - whole.frequency) <=
             mode_deviations * std::hypot(half.sd_frequency, whole.sd_frequency) &&
         std::abs(half.damping - whole.damping) <=
             mode_deviations * std::hypot(half.sd_damping, whole.sd_damping) &&
         modal_assurance(half.residue, whole.residue) >= alike;
}

ForcedMode mode_of_pole(const ForceResponse &response, const FittedPole &pole, const int orders)
{
  Eigen::Index largest = 0;
  pole.residue.cwiseAbs().maxCoeff(&largest);
  const Complex unit = pole.residue[largest];
  const auto k       = std::clamp<Eigen::Index>(std::lround(pole.frequency / response.resolution()), 0,
                                          response.coherence.rows() - 1);
  return {pole.frequency,
          pole.sd_frequency,
          pole.damping,
          pole.sd_damping,
          pole.residue / unit,
          pole.sd_residue / std::abs(unit),
          response.coherence(k, largest),
          orders,
          false,
          pole};
}

// Mean over the third octave and the channel in which it is largest.
double best_mean_coherence(const ForceResponse &response, const std::vector<bool> &driven)
{
  constexpr double third = 1.26;
  double best            = 0;
  for (double f = lowest; f < double(response.H.rows() - 1) * response.resolution(); f *= third) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(response.H.cols());
    const auto first    = Eigen::Index(std::ceil(f / response.resolution())),
               last     = std::min(Eigen::Index(third * f / response.resolution()), response.H.rows() - 1);
    for (Eigen::Index k = first; k <= last; ++k)
      if (driven[std::size_t(k)])
        sum += response.coherence.row(k).transpose();
    if (last >= first + 8)
      best = std::max(best, sum.maxCoeff() / double(last - first + 1));
  }
  return best;
}

// Candidates of all bands and those of the response alone, each once.
std::vector<IdentifiedMode> all_candidates(const ForceResponse &response, const std::vector<bool> &driven,
                                           const double highest, const double T,
                                           const std::vector<IdentifiedMode> &of_response)
{
  std::vector<IdentifiedMode> candidates, tried;
  for (const ModeBand &band : mode_bands(highest))
    for (IdentifiedMode &mode : candidates_in(response, driven, band, T))
      tried.push_back(std::move(mode));
  tried.insert(tried.end(), of_response.begin(), of_response.end());
  for (const IdentifiedMode &mode : tried) {
    const auto k     = std::min(Eigen::Index(mode.frequency / response.resolution()), response.H.rows() - 1);
    const bool known = std::any_of(candidates.begin(), candidates.end(), [&](const IdentifiedMode &other) {
      return std::abs(other.frequency / mode.frequency - 1) < 0.015 &&
             (mode.shape.size() < 3 || modal_assurance(other.shape, mode.shape) > 0.8);
    });
    if (!known && mode.frequency < highest && driven[std::size_t(k)])
      candidates.push_back(mode);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
  return candidates;
}

void fit_group(ForcedModes &modes, const Group &group, const std::vector<ForceResponse> &halves_of_it)
{
  std::vector<Complex> start;
  for (const IdentifiedMode *mode : group.modes)
    start.push_back(pole_of(mode->frequency, mode->damping));
  const auto whole = fit_response(modes.response, start, group.bins.begin, group.bins.end);
  std::vector<std::vector<FittedPole>> of_halves;
  std::vector<Complex> poles;
  for (const FittedPole &pole : whole)
    poles.push_back(pole.lambda);
  for (const ForceResponse &half : halves_of_it)
    of_halves.push_back(fit_response(half, poles, group.bins.begin, group.bins.end));
  for (std::size_t r = 0; r < whole.size(); ++r) {
    if (!stands_out(whole[r]) || whole[r].damping < least_damping)
      continue;
    ForcedMode mode = mode_of_pole(modes.response, whole[r], group.modes[r]->orders);
    mode.confirmed  = mode.coherence > least_coherence &&
                     std::all_of(of_halves.begin(), of_halves.end(),
                                 [&](const auto &half) { return r < half.size() && agree(half[r], whole[r]); });
    modes.modes.push_back(std::move(mode));
  }
}
}  // namespace

void drop_backgrounds(std::vector<ForcedMode> &modes)
{
  constexpr double broader = 5;
  for (ForcedMode &broad : modes)
    if (resonance_half_widths * broad.damping > 1 ||
        std::any_of(modes.begin(), modes.end(), [&](const ForcedMode &sharp) {
          return sharp.confirmed && broader * sharp.damping < broad.damping &&
                 std::abs(sharp.frequency - broad.frequency) < broad.damping * broad.frequency;
        }))
      broad.confirmed = false;
}

ForcedModes forced_modes(const std::vector<const CleanChannel *> &channels, const CleanChannel &force,
                         const double rate, const double highest, const std::vector<IdentifiedMode> &of_response,
                         const int threads)
{
  ForcedModes modes;
  std::vector<const CleanChannel *> all = channels;
  all.push_back(&force);
  const DecimatedRecord record = decimated(all, rate, highest);
  Fourier fourier;
  modes.response = force_response(record, beyond * highest, 0, fourier);
  if (modes.response.n == 0)
    return modes;
  const auto driven    = driven_bins(modes.response);
  modes.best_coherence = best_mean_coherence(modes.response, driven);
  if (modes.best_coherence < follows)
    return modes;
  const auto parts = halves(record);
  std::vector<ForceResponse> of_halves(parts.size());
  share_tasks(long(parts.size()), threads, [&](const long i) {
    Fourier fourier_of_thread;
    of_halves[std::size_t(i)] =
        force_response(parts[std::size_t(i)], beyond * highest, modes.response.L, fourier_of_thread);
  });
  if (std::any_of(of_halves.begin(), of_halves.end(), [](const auto &half) { return half.n == 0; }))
    return modes;
  const auto candidates = all_candidates(modes.response, driven, highest, record.duration(), of_response);
  for (const Group &group : groups_of(modes.response, candidates))
    fit_group(modes, group, of_halves);
  std::sort(modes.modes.begin(), modes.modes.end(),
            [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
  drop_backgrounds(modes.modes);
  return modes;
}
}  // namespace mill::twin
