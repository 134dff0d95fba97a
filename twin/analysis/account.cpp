#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double of_floor = 1.5, farthest = 2;  // -, where the flank of a resonance ends; at an octave at most

bool is_mode_fate(const FindingKind fate)
{
  return fate == FindingKind::mode || fate == FindingKind::resonance || fate == FindingKind::edge;
}

bool is_family_fate(const FindingKind fate)
{
  return fate == FindingKind::family || fate == FindingKind::lost_samples;
}

// Bins of a resonance: within its width, and farther while the density stays above the floor.
void mark_resonance(std::vector<bool> &of_mode, const ChannelAnalysis &seen, const Peak &peak)
{
  const Eigen::VectorXd &density = seen.detected.without_lines, &floor = seen.detected.floor;
  const auto centre =
                 std::clamp<Eigen::Index>(std::lround(peak.frequency / peak.resolution), 1, density.size() - 2),
             half   = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(peak.width / peak.resolution)));
  const auto smooth = [&](const Eigen::Index k) {
    const Eigen::Index first = std::max<Eigen::Index>(1, k - 2), last = std::min(k + 2, density.size() - 2);
    return density.segment(first, last - first + 1).mean();
  };
  for (const Eigen::Index step : {-1, 1})
    for (Eigen::Index k = centre; k >= 1 && k < density.size() - 1; k += step) {
      if (std::abs(k - centre) > half &&
          (smooth(k) < of_floor * floor[k] || double(k) > farthest * double(centre) ||
           double(k) < double(centre) / farthest))
        break;
      of_mode[std::size_t(k)] = true;
    }
}

// Which lines a bin belongs to: the nearest.
const SpectralCandidate *nearest_line(const ChannelAnalysis &seen, const double frequency)
{
  const SpectralCandidate *nearest = nullptr;
  for (const SpectralCandidate &one : seen.detected.candidates)
    if (one.peak.line &&
        (!nearest || std::abs(one.peak.frequency - frequency) < std::abs(nearest->peak.frequency - frequency)))
      nearest = &one;
  return nearest;
}

void add_shares(Account &account, const ChannelAnalysis &seen)
{
  const SpectralPeaks &detected = seen.detected;
  const WelchSpectrum &s        = seen.spectrum;
  std::vector<bool> of_mode(std::size_t(s.density.size()), false);
  for (const SpectralCandidate &one : detected.candidates)
    if (!one.peak.line && (is_mode_fate(one.fate) || one.fate == FindingKind::part_of_resonance))
      mark_resonance(of_mode, seen, one.peak);
  double area = 0;
  for (Eigen::Index k = 1; k < s.density.size(); ++k) {
    area += s.density[k];
    const double rest = detected.without_lines[k], line = s.density[k] - rest;
    if (line > 0)
      if (const SpectralCandidate *of = nearest_line(seen, s.at(k)))
        (is_family_fate(of->fate) ? account.families
         : is_mode_fate(of->fate) ? account.modes
                                  : account.lines) += line;
    const double noise = std::min(rest, (of_mode[std::size_t(k)] ? 1 : detected.threshold) * detected.floor[k]);
    account.floor += noise;
    if (of_mode[std::size_t(k)])
      account.modes += rest - noise;
  }
  // the mean of squares of the samples is what is accounted for; what the spectrum lacks of it is not explained
  const double whole = std::max(area, seen.variance / s.resolution());
  for (double *share : {&account.lines, &account.families, &account.modes, &account.floor})
    *share = whole > 0 ? *share / whole : 0;
  account.unexplained = std::max(0.0, 1 - account.lines - account.families - account.modes - account.floor);
}

std::string source_of(const Analysis &analysis, const SpectralCandidate &candidate)
{
  const double f = candidate.peak.frequency;
  for (const Finding &finding : analysis.findings) {
    const bool agrees =
        std::abs(finding.frequency - f) <= std::max(2 * candidate.peak.resolution, 0.5 * candidate.peak.width);
    const bool in = std::any_of(finding.members.begin(), finding.members.end(), [&](const FamilyMember &member) {
      return std::abs(member.frequency - f) <= 2 * candidate.peak.resolution;
    });
    if ((agrees && finding.members.empty()) || in)
      return finding.owner.rfind("source not", 0) == 0 ? finding.owner
                                                       : std::string(word_of(finding.kind)) + ", " + finding.owner;
  }
  return std::string(word_of(candidate.fate)) + ", source not identified";
}

void add_largest(Account &account, const Analysis &analysis, const ChannelAnalysis &seen)
{
  const SpectralCandidate *largest = nullptr;
  for (const SpectralCandidate &one : seen.detected.candidates)
    if (one.fate != FindingKind::side_lobe && one.fate != FindingKind::skirt &&
        (!largest || one.peak.amplitude > largest->peak.amplitude))
      largest = &one;
  const WelchSpectrum &s = seen.spectrum;
  const auto below       = std::min(s.density.size() - 1, Eigen::Index(seen.lowest / s.resolution()));
  Eigen::Index k         = 0;
  const double slow      = below > 1 ? s.density.segment(1, below - 1).maxCoeff(&k) : 0;
  ++k;
  const bool is_slow =
      slow > seen.detected.threshold * seen.detected.floor[k] &&
      (!largest || slow * 1.5 * s.resolution() > 0.5 * largest->peak.amplitude * largest->peak.amplitude);
  if (is_slow) {
    account.largest    = s.at(k);
    account.amplitude  = std::sqrt(2 * slow * 1.5 * s.resolution());
    account.over_floor = 10 * std::log10(slow / seen.detected.floor[k]);
    account.source =
        fmt::format("source not identified: below {:.3g} Hz the record is too short for lines", seen.lowest);
  } else if (largest) {
    account.largest    = largest->peak.frequency;
    account.amplitude  = largest->peak.amplitude;
    account.over_floor = largest->peak.prominence;
    account.source     = source_of(analysis, *largest);
  }
}

void list_candidates(Analysis &analysis, const ChannelAnalysis &seen)
{
  for (const SpectralCandidate &one : seen.detected.candidates)
    analysis.candidates.push_back(
        {seen.name, one.peak.frequency, one.peak.amplitude, seen.unit, one.peak.prominence, one.fate, one.reason});
}

void list_modes(Analysis &analysis)
{
  const double none = std::nan("");
  for (const IdentifiedMode &mode : analysis.modes.modes) {
    const auto is_it = [&](const Finding &finding) {
      return (finding.kind == FindingKind::mode || finding.kind == FindingKind::edge) &&
             std::abs(finding.frequency - mode.frequency) <=
                 std::max(0.01 * mode.frequency, 3 * mode.law_frequency);
    };
    const auto finding = std::find_if(analysis.findings.begin(), analysis.findings.end(), is_it);
    FindingKind fate   = FindingKind::unconfirmed_pole;
    std::string reason = "not both halves of the record show it";
    if (finding != analysis.findings.end()) {
      fate   = finding->kind;
      reason = fmt::format("{} of 15 model orders; finding at {:.2f} Hz", mode.orders, finding->frequency);
    } else if (mode.confirmed) {
      fate   = FindingKind::pole_of_line;
      reason = "its damping cannot be separated from zero";
    }
    analysis.candidates.push_back(
        {analysis.mode_channels.empty() ? "" : "subspace", mode.frequency, none, "", none, fate, reason});
  }
}
}  // namespace

bool Account::only_noise() const
{
  return floor >= 0.95 && std::isnan(largest);
}

void add_accounts(Analysis &analysis)
{
  for (ChannelAnalysis &seen : analysis.channels) {
    if (seen.spectrum.n == 0)
      continue;
    add_shares(seen.account, seen);
    add_largest(seen.account, analysis, seen);
    list_candidates(analysis, seen);
  }
  list_modes(analysis);
}
}  // namespace mill::twin
