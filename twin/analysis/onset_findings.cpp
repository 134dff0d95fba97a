#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/onset/growth_stretch.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double least_kept       = 0.3;  // correlation left at the second lag
constexpr double band_of_envelope = 40;   // Hz, that the low-pass lets through to one side
constexpr double enough_time      = 60;   // s, below it an interval about zero says nothing
constexpr int most_alarms         = 20;

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
  Finding finding{"near instability", of_mode.channel, of_mode.frequency, of_mode.low, of_mode.high,
                  of_mode.amplitude,  of_mode.unit,    of_mode.owner,     {},          {}};
  finding.evidence.push_back(sentence);
  analysis.findings.push_back(std::move(finding));
}

std::string sentence_of(const GrowthStretch &stretch)
{
  return fmt::format(
      "the amplitude grows at {:+.2g} 1/s (standard error {:.1g}) from {:.2f} to {:.2f} s, by a factor of {:.2g}",
      stretch.sigma, stretch.deviation, stretch.from, stretch.to, std::exp(stretch.gain));
}

// Rate of the whole record, while the mode is calm.
void say_mean_rate(Finding &of_mode, const GrowthRate &growth)
{
  if (std::isnan(growth.sigma))
    return;
  of_mode.evidence.push_back(
      growth.kept < least_kept
          ? std::string("decays within 0.1 s: far from instability")
          : fmt::format("growth rate {:+.2g} 1/s, 95 % between {:+.2g} and {:+.2g} 1/s, over {:.0f} s",
                        growth.sigma, growth.lower(), growth.upper(), growth.duration));
}

// Growth that is seen over time, or a mean rate that cannot be separated from zero, (41.31).
void add_growth(Analysis &analysis, Finding &of_mode, const ComplexEnvelope &envelope,
                const std::optional<GrowthStretch> &stretch)
{
  const GrowthRate growth = growth_rate(envelope);
  say_mean_rate(of_mode, growth);
  if (stretch) {
    of_mode.evidence.push_back(sentence_of(*stretch));
    add_near_instability(analysis, of_mode, sentence_of(*stretch));
    return;
  }
  const bool undecided = !std::isnan(growth.sigma) && growth.kept >= least_kept && growth.tone == 0 &&
                         growth.duration >= enough_time && growth.lower() > near_instability_from &&
                         growth.upper() > 0;
  if (!undecided)
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
      fmt::format("growth rate {:+.2g} 1/s, 95 % between {:+.2g} and {:+.2g} 1/s: not separable from zero "
                  "over {:.0f} s",
                  growth.sigma, growth.lower(), growth.upper(), growth.duration));
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
  if (of_mode.unit == "m/s2")
    rule.limit = settings.limit;
  int n = 0;
  for (const Alarm &alarm : alarms(envelope, rule)) {
    if (!is_of_growth(alarm, stretch))
      continue;
    if (++n > most_alarms) {
      analysis.notes.push_back(
          fmt::format("more than {} alarms at {:.4g} Hz; the first are listed", most_alarms, of_mode.frequency));
      break;
    }
    Finding finding{"alarm",     of_mode.channel, of_mode.frequency, of_mode.low, of_mode.high,
                    alarm.level, of_mode.unit,    of_mode.owner,     {}};
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
}  // namespace

void add_onset_findings(Analysis &analysis, const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                        const AnalysisSettings &settings)
{
  const std::size_t n = analysis.findings.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string kind      = analysis.findings[i].kind;
    const CleanChannel *channel = line_free_channel(record, line_free, analysis.findings[i].channel);
    if ((kind != "mode" && kind != "resonance") || !channel ||
        analysis.findings[i].frequency + band_of_envelope > record.rate / 2)
      continue;
    const ComplexEnvelope envelope =
        complex_envelope(channel->value, channel->pieces, record.rate, analysis.findings[i].frequency);
    const auto stretch = growth_stretch(envelope);
    Finding of_mode    = analysis.findings[i];
    add_growth(analysis, of_mode, envelope, stretch);
    analysis.findings[i] = of_mode;
    add_alarms(analysis, of_mode, envelope, stretch, settings);
  }
}
}  // namespace mill::twin
