#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double least_kept = 0.3;  // correlation left at the second lag
constexpr int most_alarms   = 20;

const CleanChannel *clean_of(const CleanRecord &record, const std::string &name)
{
  return record.find(name);
}

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

void add_growth(Analysis &analysis, Finding &of_mode, const ComplexEnvelope &envelope)
{
  const GrowthRate growth = growth_rate(envelope);
  if (std::isnan(growth.sigma))
    return;
  if (growth.kept < least_kept) {
    of_mode.evidence.push_back("decays within 40 ms: far from instability");
    return;
  }
  of_mode.evidence.push_back(
      fmt::format("growth rate {:.2f} 1/s, law {:.2f} (a lower bound of the standard deviation), "
                  "95 % below {:.2f} 1/s",
                  growth.sigma, growth.law, growth.upper()));
  if (!growth.near_instability())
    return;
  if (const ForcedMode *forced = forced_of(analysis, of_mode);
      forced && upper_of(*forced) < near_instability_from) {
    of_mode.evidence.push_back(fmt::format("the response to the recorded force knows better: growth rate {:.2f} "
                                           "1/s, 95 % below {:.2f} 1/s, no warning",
                                           -forced->damping * 2 * M_PI * forced->frequency, upper_of(*forced)));
    return;
  }
  Finding finding{"near instability", of_mode.channel, of_mode.frequency, of_mode.low, of_mode.high,
                  of_mode.amplitude,  of_mode.unit,    of_mode.owner,     {}};
  finding.evidence.push_back(
      fmt::format("growth rate {:.2f} 1/s with an upper end of {:.2f}, above -0.5 1/s, over {:.0f} s",
                  growth.sigma, growth.upper(), growth.duration));
  analysis.findings.push_back(std::move(finding));
}

void add_alarms(Analysis &analysis, const Finding &of_mode, const ComplexEnvelope &envelope,
                const AnalysisSettings &settings)
{
  AlarmSettings rule;
  if (of_mode.unit == "m/s2")
    rule.limit = settings.limit;
  int n = 0;
  for (const Alarm &alarm : alarms(envelope, rule)) {
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

void add_onset_findings(Analysis &analysis, const CleanRecord &record, const AnalysisSettings &settings)
{
  const std::size_t n = analysis.findings.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string kind      = analysis.findings[i].kind;
    const CleanChannel *channel = clean_of(record, analysis.findings[i].channel);
    if ((kind != "mode" && kind != "resonance") || !channel || 2.56 * analysis.findings[i].frequency > record.rate)
      continue;
    const ComplexEnvelope envelope =
        complex_envelope(channel->value, channel->pieces, record.rate, analysis.findings[i].frequency);
    Finding of_mode = analysis.findings[i];
    add_growth(analysis, of_mode, envelope);
    analysis.findings[i] = of_mode;
    add_alarms(analysis, of_mode, envelope, settings);
  }
}
}  // namespace mill::twin
