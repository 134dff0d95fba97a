#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/analysis/merged_peaks.h"
#include "twin/analysis/owner.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
// The modes of both kinds that were confirmed.
template <class Test> bool any_confirmed(const Analysis &analysis, const Test &is_it)
{
  const auto confirmed_and = [&](const auto &mode) { return mode.confirmed && is_it(mode); };
  const auto &forced       = analysis.forced.modes;
  const auto &alone        = analysis.modes.modes;
  return std::any_of(forced.begin(), forced.end(), confirmed_and) ||
         std::any_of(alone.begin(), alone.end(), confirmed_and);
}

// The finding that explains a resonance: a confirmed mode, or an edge of the force band.
const Finding *known_as(const Analysis &analysis, const Peak &peak)
{
  for (const Finding &finding : analysis.findings)
    if ((finding.kind == FindingKind::mode || finding.kind == FindingKind::edge) &&
        std::abs(finding.frequency - peak.frequency) <=
            std::max({peak.width, 0.01 * peak.frequency, finding.high - finding.low, 2 * peak.resolution}))
      return &finding;
  return nullptr;
}
// A line that is locked to the speed is smeared over its interval while the speed changes.
const Finding *smeared_line(const Analysis &analysis, const Peak &peak)
{
  constexpr double wider = 1.2;  // -, than the interval
  if (speed_span(analysis) < 0.02)
    return nullptr;
  for (const Finding &finding : analysis.findings)
    if (finding.kind == FindingKind::locked && peak.frequency >= finding.low && peak.frequency <= finding.high &&
        peak.width <= wider * (finding.high - finding.low))
      return &finding;
  return nullptr;
}
}  // namespace

bool is_unresolved_mode(const Analysis &analysis, const Peak &peak)
{
  constexpr double certain = 0.9, calm = 0.15,
                   fades = 6;  // -, -, decays of the mode in the segments of the spectrum
  return any_confirmed(analysis, [&](const auto &mode) {
    const double wide = 2 * mode.damping * mode.frequency;
    const bool faded  = M_PI * wide * 4.5 / peak.resolution > fades;
    return std::abs(mode.frequency - peak.frequency) <= peak.width && wide < 3 * peak.resolution &&
           !(faded && peak.coherence > certain && peak.swing < calm);
  });
}

std::string spacing_sentence(const double frequency, const double speed, const CaseModel *stand)
{
  const MarkSpacing marks = mark_spacing(frequency, speed, stand ? stand->rolls : std::vector<TurningRoll>{});
  std::string text = fmt::format("at {:.4g} m/s marks would be {:.4g} mm apart", speed, 1e3 * marks.spacing);
  for (const auto &waves : marks.rolls)
    text += fmt::format("; {:.2f} waves per turn of the {}, whole at {:.4g} and {:.4g} Hz", waves.waves,
                        waves.roll, waves.below, waves.above);
  return text;
}

namespace {
void add_resonance(Analysis &analysis, const MergedPeak &one, const CaseModel *stand, const double speed)
{
  const Peak &peak             = one.peak;
  const ChannelAnalysis &where = analysis.channels[one.channel];
  const double span            = speed_span(analysis);
  const double sd              = peak.deviation;
  Finding finding{FindingKind::resonance,
                  where.name,
                  peak.frequency,
                  peak.frequency - 1.96 * sd,
                  peak.frequency + 1.96 * sd,
                  peak.amplitude,
                  where.unit,
                  "",
                  {},
                  {}};
  finding.evidence.push_back(
      fmt::format("{:.0f} dB over the noise floor, {:.3g} Hz wide ({:.2g} % of critical if it is one "
                  "mode), bins of {:.3g} Hz",
                  peak.prominence, peak.width, 50 * peak.width / peak.frequency, peak.resolution));
  if (where.map.speed.size() > 0) {
    const auto exponent = speed_exponent(where.map, peak.frequency, where.map.speed.mean());
    const Follows how =
        follows_speed(exponent, span, std::max(peak.width, where.map.rate / double(where.map.L)) / peak.frequency);
    if (how == Follows::locked) {
      give_fate(analysis, one, FindingKind::locked, "it is a line over the rolled length");
      return;
    }
    finding.evidence.push_back(
        how == Follows::cannot_tell
            ? std::string("fixed or locked to the speed: not distinguishable, the speed changes too little")
            : fmt::format("{}: exponent of the speed {:.2f}", name_of(how), exponent.q));
  }
  if (stand && speed > 0)
    finding.owner = turning_owner({peak.frequency, 2 * peak.resolution, false, 4 * sd}, stand, speed, {}, 0, {});
  if (finding.owner.empty() && is_edge(analysis.force_edges, peak.frequency)) {
    finding.kind  = FindingKind::edge;
    finding.owner = "edge of the force band";
  }
  if (finding.owner.empty() && stand)
    finding.owner = owner_among_modes({peak.frequency, sd / peak.frequency, {}, {where.name}}, *stand).sentence;
  if (finding.owner.empty())
    finding.owner = "source not identified";
  if (span < 0.02 && speed > 0)
    finding.evidence.push_back(spacing_sentence(peak.frequency, speed, stand));
  give_fate(analysis, one, finding.kind, finding.evidence.front());
  analysis.findings.push_back(std::move(finding));
}
}  // namespace

void add_resonance_findings(Analysis &analysis, const CaseModel *stand, const double speed)
{
  for (const MergedPeak &one : merged_peaks(analysis)) {
    if (one.peak.line)
      continue;
    if (const Finding *known = known_as(analysis, one.peak))
      give_fate(analysis, one, known->kind,
                fmt::format("{} at {:.2f} Hz", word_of(known->kind), known->frequency));
    else if (const Finding *locked = smeared_line(analysis, one.peak))
      give_fate(
          analysis, one, FindingKind::locked,
          fmt::format("smeared between {:.4g} and {:.4g} Hz while the speed changes", locked->low, locked->high));
    else
      add_resonance(analysis, one, stand, speed);
  }
}

void add_locked_findings(Analysis &analysis, const CaseModel *stand)
{
  const double span = speed_span(analysis);
  std::vector<std::pair<double, std::size_t>> waves;  // 1/m, index of the finding
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
      const auto known = std::find_if(waves.begin(), waves.end(), [&](const auto &f) {
        return std::abs(f.first - peak.frequency) < 2 * peak.resolution;
      });
      if (known != waves.end()) {
        analysis.findings[known->second].evidence.push_back(
            fmt::format("{} shows it too, {:.3g} {} 0-peak", channel.name, peak.amplitude, channel.unit));
        continue;
      }
      Finding finding{FindingKind::locked,
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
      waves.push_back({peak.frequency, analysis.findings.size()});
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
    // What a record does not reach can only add to the level.
    const VelocityBand band = velocity_band(channel.spectrum.rate);
    const char *or_higher   = !band.complete && zone < settings.severity.size() ? " or higher" : "";
    Finding finding{FindingKind::severity,
                    channel.name,
                    std::nan(""),
                    std::nan(""),
                    std::nan(""),
                    std::nan(""),
                    "m/s",
                    fmt::format("zone {}{} of the zones that were given", char('A' + zone), or_higher),
                    {}};
    finding.evidence.push_back(fmt::format("{:.3g} mm/s rms, {:g} .. {:.4g} Hz{}", 1e3 * channel.velocity_rms,
                                           band.low, band.high, band.complete ? "" : ", where the record ends"));
    if (settings.baseline)
      if (const double before = velocity_before(*settings.baseline, channel.name, channel.spectrum.rate);
          std::isfinite(before))
        finding.evidence.push_back(fmt::format("{:+.0f} % against the baseline {}",
                                               100 * (channel.velocity_rms / before - 1),
                                               settings.baseline->folder));
    analysis.findings.push_back(std::move(finding));
  }
}
}  // namespace mill::twin
