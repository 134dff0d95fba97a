#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/analysis/owner.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
struct Loudest {
  Peak peak;
  const ChannelAnalysis *channel;
};

// Peaks of all vibrations, one for each frequency: where it stands out most.
std::vector<Loudest> merged_peaks(const Analysis &analysis)
{
  std::vector<Loudest> all;
  for (const ChannelAnalysis &channel : analysis.channels)
    if (is_vibration(channel.quantity))
      for (const Peak &peak : channel.peaks)
        all.push_back({peak, &channel});
  std::sort(all.begin(), all.end(),
            [](const auto &a, const auto &b) { return a.peak.prominence > b.peak.prominence; });
  std::vector<Loudest> kept;
  for (const Loudest &one : all)
    if (std::none_of(kept.begin(), kept.end(), [&](const Loudest &other) {
          return std::abs(other.peak.frequency - one.peak.frequency) <=
                 std::max({one.peak.width, other.peak.width, 2 * one.peak.resolution, 2 * other.peak.resolution});
        }))
      kept.push_back(one);
  return kept;
}

// A line where bins are too wide to tell it from a confirmed mode.
bool is_unresolved_mode(const Analysis &analysis, const Peak &peak)
{
  const auto is_it = [&](const auto &mode) {
    return mode.confirmed && std::abs(mode.frequency - peak.frequency) <= peak.width &&
           2 * mode.damping * mode.frequency < 3 * peak.resolution;
  };
  const auto &forced = analysis.forced.modes;
  const auto &alone  = analysis.modes.modes;
  return std::any_of(forced.begin(), forced.end(), is_it) || std::any_of(alone.begin(), alone.end(), is_it);
}

// A confirmed mode, or the edge of the force band, explains it.
bool is_known(const Analysis &analysis, const Peak &peak)
{
  if (peak.line && is_unresolved_mode(analysis, peak))
    return true;
  return std::any_of(analysis.findings.begin(), analysis.findings.end(), [&](const Finding &finding) {
    return !peak.line && std::abs(finding.frequency - peak.frequency) <=
                             std::max({peak.width, 0.01 * peak.frequency, finding.high - finding.low});
  });
}

void say_spacing(Finding &finding, const CaseModel *stand, const double speed)
{
  if (!(speed > 0))
    return;
  const MarkSpacing marks =
      mark_spacing(finding.frequency, speed, stand ? stand->rolls : std::vector<TurningRoll>{});
  std::string text = fmt::format("at {:.4g} m/s marks would be {:.4g} mm apart", speed, 1e3 * marks.spacing);
  for (const auto &waves : marks.rolls)
    text += fmt::format("; {:.2f} waves per turn of the {}, whole at {:.4g} and {:.4g} Hz", waves.waves,
                        waves.roll, waves.below, waves.above);
  finding.evidence.push_back(text);
}
}  // namespace

void add_peak_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand, const double speed)
{
  const double span = speed_span(analysis);
  const auto all    = merged_peaks(analysis);
  std::vector<double> lines;
  for (const auto &one : all)
    if (one.peak.line)
      lines.push_back(one.peak.frequency);
  for (const auto &[peak, channel] : all) {
    if (is_known(analysis, peak))
      continue;
    const double sd = peak.line ? 0.1 * peak.resolution : 0.25 * peak.width;
    Finding finding{peak.line ? "line" : "resonance",
                    channel->name,
                    peak.frequency,
                    peak.frequency - 1.96 * sd,
                    peak.frequency + 1.96 * sd,
                    peak.amplitude,
                    channel->unit,
                    "",
                    {}};
    finding.evidence.push_back(
        fmt::format("{:.0f} dB over the median of its 120 neighbours, {:.3g} Hz wide at bins of "
                    "{:.3g} Hz",
                    peak.prominence, peak.width, peak.resolution));
    if (channel->map.speed.size() > 0) {
      const double v      = channel->map.speed.mean();
      const auto exponent = speed_exponent(channel->map, peak.frequency, v);
      const Follows how   = follows_speed(
            exponent, span, std::max(peak.width, channel->map.rate / double(channel->map.L)) / peak.frequency);
      if (how == Follows::locked)
        continue;  // stands in the spectrum over the rolled length
      finding.evidence.push_back(
          how == Follows::cannot_tell
              ? std::string("fixed or locked to the speed: cannot tell, the speeds span too little")
              : fmt::format("{}: exponent of the speed {:.2f}", name_of(how), exponent.q));
    }
    finding.owner =
        turning_owner({peak.frequency, 2 * peak.resolution, peak.line}, stand, speed, lines, record.rate);
    if (finding.owner.empty() && !peak.line && is_edge(analysis.force_edges, peak.frequency)) {
      finding.kind  = "edge";
      finding.owner = "edge of the force band";
    }
    if (finding.owner.empty() && stand)
      finding.owner = owner_among_modes({peak.frequency, sd / peak.frequency, {}, {}}, *stand).sentence;
    if (finding.owner.empty())
      finding.owner = "no case was named";
    if (span < 0.02)
      say_spacing(finding, stand, speed);
    analysis.findings.push_back(std::move(finding));
  }
}

void add_locked_findings(Analysis &analysis, const CaseModel *stand)
{
  const double span = speed_span(analysis);
  std::vector<std::pair<double, std::size_t>> found;  // 1/m, index of the finding
  for (const ChannelAnalysis &channel : analysis.channels) {
    if (channel.length.n == 0 || channel.map.speed.size() == 0)
      continue;
    const double v = channel.map.speed.mean();
    for (const Peak &peak : peaks(channel.length, 2 * channel.length.resolution(), channel.length.rate / 2.56)) {
      if (peak.frequency * analysis.highest_speed > channel.bandwidth || !peak.line)
        continue;
      const auto exponent = speed_exponent(channel.map, peak.frequency * v, v);
      const double width =
          std::max(peak.width / peak.frequency, channel.map.rate / double(channel.map.L) / (peak.frequency * v));
      if (follows_speed(exponent, span, width) != Follows::locked)
        continue;
      const auto known = std::find_if(found.begin(), found.end(), [&](const auto &f) {
        return std::abs(f.first - peak.frequency) < 2 * peak.resolution;
      });
      if (known != found.end()) {
        analysis.findings[known->second].evidence.push_back(
            fmt::format("{} shows it too, {:.3g} {} 0-peak", channel.name, peak.amplitude, channel.unit));
        continue;
      }
      Finding finding{"locked to the speed",
                      channel.name,
                      peak.frequency * v,
                      peak.frequency * analysis.lowest_speed,
                      peak.frequency * analysis.highest_speed,
                      peak.amplitude,
                      channel.unit,
                      "no roll of the case has whole waves",
                      {}};
      finding.evidence.push_back(
          fmt::format("{:.5g} per metre of rolled length, marks {:.4g} mm apart; exponent of the "
                      "speed {:.2f}; {:.0f} dB over its neighbours",
                      peak.frequency, 1e3 / peak.frequency, exponent.q, peak.prominence));
      finding.evidence.push_back(
          fmt::format("the frequency is that at {:.4g} m/s, the interval that of {:.4g} .. {:.4g} m/s", v,
                      analysis.lowest_speed, analysis.highest_speed));
      if (!stand)
        finding.owner = "no case was named";
      else
        for (const TurningRoll &roll : stand->rolls) {
          const double waves = M_PI * roll.diameter * peak.frequency,
                       reach = M_PI * roll.diameter * 0.3 * peak.resolution;
          finding.evidence.push_back(fmt::format("{:.3f} waves per turn of the {}", waves, roll.name));
          if (std::abs(waves - std::round(waves)) <= std::min(0.1, reach) && std::round(waves) >= 1)
            finding.owner = fmt::format(
                "{:.0f} waves per turn of the {}: marks on that roll, or {:.0f} of something per turn of it",
                waves, roll.name, waves);
        }
      found.push_back({peak.frequency, analysis.findings.size()});
      analysis.findings.push_back(std::move(finding));
    }
  }
}

void name_bands(Analysis &analysis, const AnalysisSettings &settings)
{
  for (Finding &finding : analysis.findings)
    for (const ChatterBand &band : settings.bands)
      if (finding.frequency >= band.low && finding.frequency <= band.high) {
        std::string name = band.name;
        std::replace(name.begin(), name.end(), '_', ' ');
        finding.evidence.push_back(
            fmt::format("in the band of {} chatter, {:g} to {:g} Hz", name, band.low, band.high));
      }
}

void add_severity_findings(Analysis &analysis, const AnalysisSettings &settings)
{
  if (settings.severity.empty())
    return;
  for (const ChannelAnalysis &channel : analysis.channels) {
    if (!std::isfinite(channel.velocity_rms))
      continue;
    std::size_t zone = 0;
    while (zone < settings.severity.size() && channel.velocity_rms > settings.severity[zone])
      ++zone;
    Finding finding{"severity",
                    channel.name,
                    std::nan(""),
                    std::nan(""),
                    std::nan(""),
                    std::nan(""),
                    "m/s",
                    fmt::format("zone {} of the zones that were given", char('A' + zone)),
                    {}};
    finding.evidence.push_back(fmt::format("{:.3g} mm/s rms, 10 .. 1000 Hz", 1e3 * channel.velocity_rms));
    if (settings.baseline)
      if (const auto before = settings.baseline->velocity_rms.find(channel.name);
          before != settings.baseline->velocity_rms.end() && before->second > 0)
        finding.evidence.push_back(fmt::format("{:+.0f} % against the baseline {}",
                                               100 * (channel.velocity_rms / before->second - 1),
                                               settings.baseline->folder));
    analysis.findings.push_back(std::move(finding));
  }
}
}  // namespace mill::twin
