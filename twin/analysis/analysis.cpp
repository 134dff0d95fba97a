#include "twin/analysis/analysis.h"
#include "core/process/parallel.h"
#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/detection/without_lines.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
// Speed on every sample of the grid; where it was not recorded the nearest value before.
Eigen::VectorXd whole_speed(const CleanRecord &record, Analysis &analysis)
{
  const CleanChannel *channel = recorded_speed(record, "speed");
  if (!channel)
    channel = recorded_speed(record, "exit_speed");
  if (!channel)
    return {};
  Eigen::VectorXd speed = channel->value;
  Eigen::Index filled   = 0;
  for (Eigen::Index i = 0; i < speed.size(); ++i)
    if (std::isnan(speed[i])) {
      speed[i] = i > 0 ? speed[i - 1] : speed[channel->pieces.front().begin];
      ++filled;
    }
  if (filled > 0)
    analysis.notes.push_back(Warning{WarningId::record_gap, "speed",
                                     fmt::format("{} missing samples were taken as the value before", filled)});
  const double still = speed.maxCoeff() / 20;
  if (!(still > 0)) {
    analysis.notes.emplace_back(NoteId::speed_not_usable, "", "the speed is never above zero",
                                "what follows it is not evaluated");
    return {};
  }
  analysis.highest_speed = speed.maxCoeff();
  analysis.lowest_speed  = analysis.highest_speed;
  for (const double v : speed)
    if (v > still)
      analysis.lowest_speed = std::min(analysis.lowest_speed, v);
  return speed;
}

void note_faults(Analysis &analysis, const CleanRecord &record)
{
  for (const CleanChannel &channel : record.channels) {
    if (channel.clipped > 0)
      analysis.notes.emplace_back(
          NoteId::clipped, channel.name,
          fmt::format("{} samples ({:.2g} %) are at a clip level; its peak is a lower bound and its spectrum has "
                      "harmonics that the mill did not make",
                      channel.clipped, 100 * channel.clipped_share));
    if (channel.n_used() == 0)
      analysis.notes.emplace_back(NoteId::record_left_out, channel.name, "no sample is left after cleaning");
  }
}
// Vibrations from which lines were taken off; those without lines are not copied.
std::vector<CleanChannel> channels_without_lines(const Analysis &analysis, const CleanRecord &record)
{
  std::vector<CleanChannel> channels;
  for (std::size_t c = 0; c < record.channels.size(); ++c) {
    if (!is_vibration(record.channels[c].quantity))
      continue;
    std::vector<double> frequencies;
    for (const SpectralCandidate &one : analysis.channels[c].detected.candidates)
      if (one.fate == FindingKind::line &&
          !(analysis.channels[c].map.speed.size() > 0 && speed_span(analysis) > 0.02 && one.peak.coherence < 0.5))
        frequencies.push_back(one.peak.frequency);
    if (frequencies.empty())
      continue;
    CleanChannel &channel = channels.emplace_back(record.channels[c]);
    channel.value         = without_lines(channel, record.rate, frequencies);
  }
  return channels;
}

// Levels of unlike bands are not compared.
void note_unlike_bands(Analysis &analysis, const AnalysisSettings &settings, const double rate)
{
  if (!settings.baseline)
    return;
  for (const ChannelAnalysis &seen : analysis.channels)
    if (std::isfinite(seen.velocity_rms) && settings.baseline->velocity_rms.count(seen.name) > 0 &&
        !std::isfinite(velocity_before(*settings.baseline, seen.name, rate)))
      analysis.notes.emplace_back(
          NoteId::band_limited, seen.name,
          fmt::format("the rms velocity is that of {:g} to {:.4g} Hz, and the baseline {} does not have it for "
                      "this band",
                      velocity_band(rate).low, velocity_band(rate).high, settings.baseline->folder),
          "the two are not compared", "take a baseline of the same sampling rate");
}

// A limit of the evaluated band with its cause.
void note_limits(Analysis &analysis)
{
  for (const ChannelAnalysis &seen : analysis.channels)
    if (seen.spectrum.n > 0 && is_vibration(seen.quantity) && seen.bandwidth < 0.99 * seen.spectrum.rate / 2.56)
      analysis.notes.emplace_back(
          NoteId::band_limited, seen.name,
          fmt::format(
              "the noise floor falls by more than 30 dB at {:.4g} Hz and stays there, as after a filter or "
              "above the range of a sensor",
              seen.bandwidth),
          "modes and levels are evaluated below this limit; lines above it are reported with a lower bound of "
          "their amplitude");
}
}  // namespace

const CleanChannel *recorded_speed(const CleanRecord &record, const std::string &name)
{
  const CleanChannel *channel = record.find(name);
  return channel && channel->quantity == Quantity::speed && !channel->pieces.empty() ? channel : nullptr;
}

Analysis analyse(const CleanRecord &record, const CaseModel *stand, const AnalysisSettings &settings,
                 const Progress &progress)
{
  Analysis analysis;
  const Eigen::VectorXd speed = whole_speed(record, analysis);
  const auto n                = long(record.channels.size());
  analysis.channels.resize(std::size_t(n));
  std::atomic<int> done{0};
  progress.at("spectra", 0);
  share_tasks(n, settings.threads, [&](const long i) {
    analysis.channels[std::size_t(i)] =
        analyse_channel(record.channels[std::size_t(i)], record.rate, speed, settings.bands);
    progress.at("spectra", double(++done) / double(n));
  });
  note_faults(analysis, record);
  if (stand)
    analysis.notes.insert(analysis.notes.end(), stand->notes.begin(), stand->notes.end());
  const bool steady      = speed.size() > 0 && speed_span(analysis) < 0.02;
  const double one_speed = steady                                ? speed.mean()
                           : settings.speed && speed.size() == 0 ? *settings.speed
                                                                 : std::nan("");
  progress.at("modes", 0);
  const std::vector<CleanChannel> line_free = channels_without_lines(analysis, record);
  add_mode_findings(analysis, record, line_free, stand, settings);
  progress.at("findings", 0);
  add_line_findings(analysis, record, stand, one_speed, settings);
  add_locked_findings(analysis, stand);
  add_resonance_findings(analysis, stand, one_speed);
  add_onset_findings(analysis, record, line_free, settings);
  progress.at("findings", 0.5);
  add_bearing_findings(analysis, record, stand, settings);
  add_severity_findings(analysis, settings);
  name_bands(analysis, settings);
  add_accounts(analysis);
  note_limits(analysis);
  note_unlike_bands(analysis, settings, record.rate);
  if (speed.size() == 0)
    analysis.notes.emplace_back(NoteId::speed_not_usable, "", "no speed was recorded",
                                "what is fixed and what follows the speed is not distinguishable");
  progress.at("findings", 1);
  return analysis;
}
}  // namespace mill::twin
