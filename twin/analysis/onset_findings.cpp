#include "core/base/si_unit.h"
#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/onset/growth_stretch.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double least_kept       = 0.3;                   // correlation left at the second lag
constexpr double band_of_envelope = 2 * widest_half_band;  // Hz, that the low-pass lets through to one side
constexpr double enough_time      = 60;                    // s, below it an interval about zero says nothing
constexpr double usual_damping    = 0.001;                 // of critical: modes of steady machines have more
constexpr int most_alarms         = 20;
constexpr int most_lines          = 30;  // whose level over time is looked at

// The mode that a recorded force drives, if the finding is one; its decay then needs no noise to be read from.
const ForcedMode *forced_of(const Analysis &analysis, const Finding &finding)
{
  for (const ForcedMode &mode : analysis.forced.modes)
    if (mode.confirmed && mode.frequency == finding.frequency)
      return &mode;
  return nullptr;
}

// 1/s, upper end of 95 % of the growth rate that damping in H1 is.
double upper_of(const ForcedMode &mode)
{
  return -(mode.damping - 1.96 * mode.sd_damping) * 2 * M_PI * mode.frequency;
}

void add_near_instability(Analysis &analysis, const Finding &of_mode, const std::string &sentence)
{
  Finding finding{FindingKind::near_instability,
                  of_mode.channel,
                  of_mode.frequency,
                  of_mode.low,
                  of_mode.high,
                  of_mode.amplitude,
                  of_mode.unit,
                  of_mode.owner,
                  {},
                  {}};
  finding.evidence.push_back(sentence);
  analysis.findings.push_back(std::move(finding));
}

std::string sentence_of(const GrowthStretch &stretch)
{
  return fmt::format(
      "the amplitude grows at {:+.2g} 1/s (standard error {:.1g}) from {:.2f} to {:.2f} s, by a factor of {:.2g}",
      stretch.sigma, stretch.deviation, stretch.from, stretch.to, std::exp(stretch.gain));
}

// Half band of the envelope in which the mode is alone: at twice of it nothing passes, neither the next peak nor
// the image of the mode at minus its frequency.
double lonely_half_band(const Analysis &analysis, const Finding &of_mode)
{
  double half_band = std::min(widest_half_band, of_mode.frequency);
  for (const Finding &other : analysis.findings) {
    const double apart = std::abs(other.frequency - of_mode.frequency);
    if ((other.kind == FindingKind::mode || other.kind == FindingKind::resonance) &&
        apart > of_mode.high - of_mode.low)
      half_band = std::min(half_band, apart / 2);
  }
  return half_band;
}

// Nepers between the levels of the first and the last third.
double rise_of(const ComplexEnvelope &envelope)
{
  double power[3] = {}, values[3] = {}, all = 0, passed = 0;
  for (const auto &z : envelope.z)
    all += double(z.size());
  for (const auto &z : envelope.z)
    for (const std::complex<double> value : z) {
      const int third = std::min(2, int(3 * passed++ / all));
      power[third] += std::norm(value);
      ++values[third];
    }
  return 0.5 * std::log((power[2] / values[2]) / (power[0] / values[0]));
}

// A mean rate above zero is one only where the level follows it: over two thirds of the record, half of what the
// lower end of the interval asks.  Else two peaks beat in the band.
bool is_contradicted(const GrowthRate &growth, const ComplexEnvelope &envelope)
{
  return growth.lower() > 0 && !(rise_of(envelope) > 0.5 * growth.lower() * growth.duration * 2 / 3);
}

// Rate of the whole record, while the mode is calm.
void say_mean_rate(Finding &of_mode, const GrowthRate &growth, const ComplexEnvelope &envelope)
{
  if (std::isnan(growth.sigma))
    return;
  if (growth.kept < least_kept)
    of_mode.evidence.push_back(fmt::format("decays within {:.2g} s{}", filter_length_of(envelope.half_band),
                                           envelope.half_band < widest_half_band
                                               ? ", the length of a filter that shuts the next peak out"
                                               : ": far from instability"));
  else if (is_contradicted(growth, envelope))
    of_mode.evidence.push_back("growth rate not determined: more than one peak in the band of the envelope");
  else
    of_mode.evidence.push_back(
        fmt::format("growth rate {:+.2g} 1/s, 95 % between {:+.2g} and {:+.2g} 1/s, over {:.0f} s", growth.sigma,
                    growth.lower(), growth.upper(), growth.duration));
}

// The mean rate leaves open whether the mode decays: the interval holds zero, or the level rises with it, and it
// shows less damping than a steady machine has, (41.31).
bool is_undecided(const GrowthRate &growth, const ComplexEnvelope &envelope, const double frequency)
{
  const double least = std::max(near_instability_from, -usual_damping * 2 * M_PI * frequency);
  return !std::isnan(growth.sigma) && growth.kept >= least_kept && growth.tone == 0 &&
         growth.duration >= enough_time && growth.lower() > least && growth.upper() > 0 &&
         !is_contradicted(growth, envelope);
}

// Growth that is seen over time, or a mean rate that cannot be separated from zero, (41.31).
void add_growth(Analysis &analysis, Finding &of_mode, const ComplexEnvelope &lonely,
                const std::optional<GrowthStretch> &stretch)
{
  const GrowthRate growth = growth_rate(lonely);
  say_mean_rate(of_mode, growth, lonely);
  if (stretch) {
    of_mode.evidence.push_back(sentence_of(*stretch));
    add_near_instability(analysis, of_mode, sentence_of(*stretch));
    return;
  }
  if (!is_undecided(growth, lonely, of_mode.frequency))
    return;
  if (const ForcedMode *forced = forced_of(analysis, of_mode);
      forced && upper_of(*forced) < near_instability_from) {
    of_mode.evidence.push_back(
        fmt::format("the response to the recorded force is more accurate: growth rate {:.2f} 1/s, "
                    "95 % below {:.2f} 1/s, no warning",
                    -forced->damping * 2 * M_PI * forced->frequency, upper_of(*forced)));
    return;
  }
  add_near_instability(
      analysis, of_mode,
      fmt::format("growth rate {:+.2g} 1/s, 95 % between {:+.2g} and {:+.2g} 1/s: {} zero over {:.0f} s",
                  growth.sigma, growth.lower(), growth.upper(),
                  growth.lower() > 0 ? "above" : "not separable from", growth.duration));
}

// A level that jumps, as from one impact to the next, is not growth: five baselines are left behind in the time of
// the filter.  An alarm belongs to a stretch that grows.
bool is_of_growth(const Alarm &alarm, const std::optional<GrowthStretch> &stretch)
{
  constexpr double after = 0.5;  // s
  return stretch && alarm.time >= stretch->from && alarm.time <= stretch->to + after;
}

void add_alarms(Analysis &analysis, const Finding &of_mode, const ComplexEnvelope &envelope,
                const std::optional<GrowthStretch> &stretch, const AnalysisSettings &settings)
{
  AlarmSettings rule;
  if (is_in(of_mode.unit, SiUnit::acceleration))
    rule.limit = settings.limit;
  int n = 0;
  for (const Alarm &alarm : alarms(envelope, rule)) {
    if (!is_of_growth(alarm, stretch))
      continue;
    if (++n > most_alarms) {
      analysis.notes.emplace_back(
          NoteId::list_cut, "",
          fmt::format("more than {} alarms at {:.4g} Hz; the first are listed", most_alarms, of_mode.frequency));
      break;
    }
    Finding finding{FindingKind::alarm, of_mode.channel, of_mode.frequency, of_mode.low, of_mode.high,
                    alarm.level,        of_mode.unit,    of_mode.owner,     {}};
    finding.evidence.push_back(
        fmt::format("at {:.2f} s: {:.3g} is {:.1f} times the baseline of {:.3g}, growing at {:.2f} 1/s",
                    alarm.time, alarm.level, alarm.level / alarm.baseline, alarm.baseline, alarm.sigma));
    if (rule.limit && alarm.sigma > 0)
      finding.evidence.push_back(fmt::format(
          "{:.2f} s to the limit of {:.3g}; no such alarm leads it by more than {:.2f} s "
          "at this growth",
          alarm.to_limit, *rule.limit, longest_lead(*rule.limit, rule.threshold * alarm.baseline, alarm.sigma)));
    analysis.findings.push_back(std::move(finding));
  }
}
double median_level(const ComplexEnvelope &envelope)
{
  std::vector<double> level;
  for (const auto &z : envelope.z)
    for (const std::complex<double> value : z)
      level.push_back(std::abs(value));
  if (level.empty())
    return 0;
  const auto middle = level.begin() + std::ptrdiff_t(level.size() / 2);
  std::nth_element(level.begin(), middle, level.end());
  return *middle;
}

// A vibration that grows out of a steady one for a few seconds of minutes is a line of the whole record.  What
// follows a start of the mill, or is modulated, does not leave its usual level so far behind.
void add_growth_of_line(Analysis &analysis, Finding &line, const CleanChannel &channel, const double rate,
                        const AnalysisSettings &settings)
{
  constexpr double far           = 3;
  const ComplexEnvelope envelope = complex_envelope(channel.value, channel.pieces, rate, line.frequency);
  const auto stretch             = growth_stretch(envelope);
  if (!stretch || stretch->level < far * median_level(envelope))
    return;
  line.evidence.push_back(sentence_of(*stretch));
  add_near_instability(analysis, line, sentence_of(*stretch));
  add_alarms(analysis, line, envelope, stretch, settings);
}
}  // namespace

void add_onset_findings(Analysis &analysis, const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                        const AnalysisSettings &settings)
{
  const std::size_t n = analysis.findings.size();
  int lines_seen      = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const FindingKind kind = analysis.findings[i].kind;
    const bool within_band = analysis.findings[i].frequency + band_of_envelope <= record.rate / 2;
    if (const CleanChannel *whole = record.find(analysis.findings[i].channel);
        kind == FindingKind::line && whole && is_vibration(whole->quantity) && within_band &&
        lines_seen++ < most_lines) {
      Finding line = analysis.findings[i];
      add_growth_of_line(analysis, line, *whole, record.rate, settings);
      analysis.findings[i] = line;
      continue;
    }
    const CleanChannel *channel = line_free_channel(record, line_free, analysis.findings[i].channel);
    if ((kind != FindingKind::mode && kind != FindingKind::resonance) || !channel || !within_band)
      continue;
    const ComplexEnvelope envelope =
        complex_envelope(channel->value, channel->pieces, record.rate, analysis.findings[i].frequency);
    const auto stretch     = growth_stretch(envelope);
    Finding of_mode        = analysis.findings[i];
    const double half_band = lonely_half_band(analysis, of_mode);
    add_growth(analysis, of_mode,
               half_band < widest_half_band
                   ? complex_envelope(channel->value, channel->pieces, record.rate, of_mode.frequency, half_band)
                   : envelope,
               stretch);
    analysis.findings[i] = of_mode;
    add_alarms(analysis, of_mode, envelope, stretch, settings);
  }
}
}  // namespace mill::twin
