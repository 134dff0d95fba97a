#include "app/twin/analyse/analysis_lines.h"
#include "core/base/visible_text.h"
#include "twin/analysis/channel_analysis.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr std::size_t most_lines = 25, most_channels = 8, most_notes = 5;

// Hz with the decimals that the standard error allows.
std::string frequency_text(const double frequency, const double standard_error)
{
  const double digits = standard_error > 0 ? std::ceil(-std::log10(standard_error)) : 2;
  return fmt::format("{:.{}f} Hz", frequency, int(std::clamp(digits, 0.0, 3.0)));
}

std::string channel_line(const twin::ChannelAnalysis &seen)
{
  const twin::Account &account = seen.account;
  const std::string unit       = visible(seen.unit, true);
  std::string text             = fmt::format("{}: rms {:.4g} {}", visible(seen.name, true), seen.rms, unit);
  if (std::isfinite(seen.velocity_rms)) {
    const twin::VelocityBand band = twin::velocity_band(seen.spectrum.rate);
    text += fmt::format(" ({:.3g} mm/s{})", 1e3 * seen.velocity_rms,
                        band.complete ? "" : fmt::format(" up to {:.4g} Hz", band.high));
  }
  if (std::isfinite(account.largest))
    return text + fmt::format("; largest peak {}, {:.3g} {} 0-peak, {:.0f} dB over the floor: {}",
                              frequency_text(account.largest, 0.1 * seen.spectrum.resolution()), account.amplitude,
                              unit, account.over_floor, visible(account.source, true));
  if (seen.spectrum.n == 0)
    return text + "; too short for a spectrum";
  if (account.only_noise())
    return text + fmt::format("; nothing stands out of the noise, which has {:.1f} % of the variance",
                              100 * account.floor);
  return text + fmt::format("; no peak above the threshold; {:.1f} % of the variance is not explained",
                            100 * account.unexplained);
}

int urgency(const twin::Finding &finding)
{
  if (is_urgent(finding.kind))
    return 0;
  if (finding.kind == FindingKind::lost_samples || finding.kind == FindingKind::bearing ||
      finding.kind == FindingKind::severity)
    return 1;
  return finding.kind == FindingKind::resonance ? 3 : 2;
}

std::string finding_line(const twin::Finding &finding)
{
  const bool has_frequency = std::isfinite(finding.frequency);
  return fmt::format("{:<17} {:>11}  {:<20} {}", word_of(finding.kind),
                     has_frequency ? frequency_text(finding.frequency, (finding.high - finding.low) / 3.92) : "",
                     visible(finding.channel, true), visible(finding.owner, true));
}

// The first `most`, and how many are not shown.
void add_some(std::vector<std::string> &lines, const std::vector<std::string> &all, const std::size_t most,
              const std::string &rest)
{
  const std::size_t shown = all.size() <= most ? all.size() : most - 1;
  lines.insert(lines.end(), all.begin(), all.begin() + std::ptrdiff_t(shown));
  if (shown < all.size())
    lines.push_back(fmt::format("{} more {}", all.size() - shown, rest));
}
}  // namespace

std::vector<std::string> analysis_lines(const twin::Analysis &analysis, const std::string &folder)
{
  std::vector<std::string> channels, findings, notes, lines;
  for (const twin::ChannelAnalysis &seen : analysis.channels)
    channels.push_back(channel_line(seen));
  std::vector<const twin::Finding *> sorted;
  for (const twin::Finding &finding : analysis.findings)
    sorted.push_back(&finding);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto *a, const auto *b) { return urgency(*a) < urgency(*b); });
  for (const twin::Finding *finding : sorted)
    findings.push_back(finding_line(*finding));
  for (const std::string &note : texts_of(analysis.notes))
    notes.push_back("note: " + visible(note, true));
  add_some(lines, channels, most_channels, "channels: " + folder + "/report.html");
  const std::size_t of_notes = std::min(notes.size(), most_notes);
  add_some(lines, findings, most_lines - 1 - lines.size() - of_notes, "findings: " + folder + "/candidates.csv");
  add_some(lines, notes, most_notes, "notes: " + folder + "/report.html");
  lines.push_back("report: " + folder + "/report.html");
  return lines;
}
}  // namespace mill
