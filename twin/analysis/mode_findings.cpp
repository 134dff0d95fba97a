#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/analysis/owner.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double scatter_over_law = 2;     // of modes identified without the force
constexpr double least_damping    = 5e-4;  // below it a pole is a line of something that turns or of the mains
constexpr double shortest_record  = 10;    // s, of a record

std::string loudest(const Analysis &analysis, const Eigen::VectorXcd &shape)
{
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return analysis.mode_channels[std::size_t(largest)];
}

// 0-peak of a narrow band about a mode: root 2 times its rms.
double amplitude_of(const ChannelAnalysis &channel, const double frequency, const double damping)
{
  const WelchSpectrum &s = channel.spectrum;
  const double half      = std::max(damping * frequency, 2 * s.resolution());
  double area            = 0;
  for (Eigen::Index k = 1; k < s.density.size(); ++k)
    if (std::abs(s.at(k) - frequency) <= half)
      area += s.density[k] * s.resolution();
  return std::sqrt(2 * area);
}

// Whether the spectrum of a channel, its lines taken out, shows anything at a pole: a ghost of lines has nothing
// there.
bool is_in_a_spectrum(const Analysis &analysis, const double frequency, const double damping)
{
  constexpr double least_over_floor = 1.6;  // -, 2 dB
  for (const std::string &name : analysis.mode_channels) {
    const ChannelAnalysis &seen = channel_of_name(analysis, name);
    const double df = seen.spectrum.resolution(), half = std::max(damping * frequency, 2 * df);
    double sum = 0, floor = 0;
    for (auto k = std::max<Eigen::Index>(1, Eigen::Index((frequency - half) / df));
         k < seen.spectrum.density.size() && double(k) * df <= frequency + half; ++k) {
      sum += seen.detected.without_lines[k];
      floor += seen.detected.floor[k];
    }
    if (sum > least_over_floor * floor)
      return true;
  }
  return false;
}

// Accelerations, or velocities where there are none; the highest frequency that all of them hold.
std::vector<const CleanChannel *> channels_for_modes(Analysis &analysis, const CleanRecord &record,
                                                     double &highest)
{
  std::vector<const CleanChannel *> channels;
  for (const CleanChannel &channel : record.channels)
    if ((channel.quantity == Quantity::acceleration || channel.quantity == Quantity::velocity) &&
        channel.n_used() > 0 && channel_of_name(analysis, channel.name).spectrum.n > 0)
      channels.push_back(&channel);
  if (channels.empty()) {
    analysis.notes.emplace_back(NoteId::modes_not_searched, "", "no channel is an acceleration or a velocity",
                                "modes were not looked for");
    return channels;
  }
  // channels in other units would make shapes without meaning
  const std::string unit  = channels.front()->unit;
  const auto of_other     = [&](const auto *channel) { return channel->unit != unit; };
  const auto others_begin = std::remove_if(channels.begin(), channels.end(), of_other);
  if (others_begin != channels.end())
    analysis.notes.emplace_back(NoteId::mixed_units, "", "the record holds accelerations and velocities",
                                "shapes of modes use those of the first unit alone");
  channels.erase(others_begin, channels.end());
  for (const CleanChannel *channel : channels) {
    analysis.mode_channels.push_back(channel->name);
    highest = std::min(highest, channel_of_name(analysis, channel->name).bandwidth);
  }
  return channels;
}

// The recorded force: by its name, else the only one that is not a load cell.
const CleanChannel *recorded_force(const Analysis &analysis, const CleanRecord &record)
{
  const CleanChannel *only = nullptr;
  for (std::size_t i = 0; i < analysis.channels.size(); ++i) {
    if (!is_force(analysis.channels[i]) || record.channels[i].n_used() == 0)
      continue;
    if (is_driving_force(record.channels[i].name))
      return &record.channels[i];
    if (only)
      return nullptr;
    only = &record.channels[i];
  }
  return only;
}

void find_forced_modes(Analysis &analysis, const CleanRecord &record,
                       const std::vector<const CleanChannel *> &channels, const double highest,
                       const AnalysisSettings &settings)
{
  const CleanChannel *force = recorded_force(analysis, record);
  if (!force)
    return;
  analysis.forced = forced_modes(channels, *force, record.rate, highest, analysis.modes.modes, settings.threads);
  if (analysis.forced.response.n == 0)
    analysis.notes.emplace_back(NoteId::force_not_usable, "",
                                "the force was recorded, but no piece of it is long enough for a response to it");
  else if (analysis.forced.best_coherence < 0.3)
    analysis.notes.emplace_back(
        NoteId::force_not_usable, "",
        fmt::format("{} was recorded, but no channel follows it (coherence {:.2f} in the best third octave)",
                    force->name, analysis.forced.best_coherence),
        "modes are those of the response alone", "see whether both come from one clock (--align)");
}

// The delay of two clocks: stated, and taken out where that was asked.
void find_delay(Analysis &analysis, const CleanRecord &record, const CleanChannel &of_modes,
                const AnalysisSettings &settings)
{
  analysis.delay = force_delay(analysis.forced.modes, of_modes.quantity == Quantity::acceleration ? 2 : 1);
  const ForceDelay &delay = analysis.delay;
  const bool matters      = std::abs(delay.seconds) > std::max(3 * delay.deviation, 0.5 / record.rate);
  if (!delay.identified || !matters) {
    if (settings.align)
      analysis.notes.emplace_back(NoteId::delay_not_determined, "--align",
                                  delay.identified
                                      ? "no delay between force and vibrations is seen"
                                      : "the record does not determine the delay between force and vibrations",
                                  "", delay.identified ? "" : "at least two modes must follow the force");
    return;
  }
  if (settings.align)
    align(analysis.forced.response, delay.seconds);
  analysis.notes.emplace_back(
      NoteId::clock_delay, "",
      fmt::format("the vibrations come {:.3f} ms {} than the force drives them (standard deviation {:.3f} ms)",
                  1e3 * std::abs(delay.seconds), delay.seconds > 0 ? "later" : "earlier", 1e3 * delay.deviation),
      "", settings.align ? "this was taken out of H1" : "--align takes it out of H1");
}

Finding finding_of(const Analysis &analysis, const double frequency, const double sd, const double damping,
                   const Eigen::VectorXcd &shape)
{
  Finding finding{FindingKind::mode,
                  loudest(analysis, shape),
                  frequency,
                  frequency - 1.96 * sd,
                  frequency + 1.96 * sd,
                  0,
                  "",
                  "source not identified: no case was named",
                  {}};
  const ChannelAnalysis &channel = channel_of_name(analysis, finding.channel);
  finding.unit                   = channel.unit;
  finding.amplitude              = amplitude_of(channel, frequency, damping);
  return finding;
}

bool is_same(const ForcedMode &forced, const IdentifiedMode &mode)
{
  const double apart = std::abs(forced.frequency - mode.frequency);
  return apart <= std::max(0.01 * forced.frequency, 6 * mode.law_frequency) &&
         (mode.shape.size() < 3 || modal_assurance(forced.shape, mode.shape) > 0.8);
}

void add_forced(Analysis &analysis, const CaseModel *stand)
{
  for (const ForcedMode &mode : analysis.forced.modes) {
    if (!mode.confirmed)
      continue;
    Finding finding = finding_of(analysis, mode.frequency, mode.sd_frequency, mode.damping, mode.shape);
    finding.evidence.push_back(
        fmt::format("response to the recorded force (H1), both halves of the record; coherence {:.3f} at the mode",
                    mode.coherence));
    finding.evidence.push_back(fmt::format("damping {:.3f} % of critical, 95 % between {:.3f} and {:.3f} %",
                                           100 * mode.damping, 100 * (mode.damping - 1.96 * mode.sd_damping),
                                           100 * (mode.damping + 1.96 * mode.sd_damping)));
    for (const IdentifiedMode &alone : analysis.modes.modes)
      if (is_same(mode, alone))
        finding.evidence.push_back(fmt::format("the response alone gives {:.2f} Hz (standard error at least "
                                               "{:.2g}) and {:.2f} % (at least {:.2g} %){}",
                                               alone.frequency, alone.law_frequency, 100 * alone.damping,
                                               100 * alone.law_damping,
                                               alone.confirmed ? "" : ", not confirmed by both halves"));
    if (stand)
      finding.owner =
          owner_among_modes(
              {mode.frequency, mode.sd_frequency / mode.frequency, mode.shape, analysis.mode_channels}, *stand)
              .sentence;
    analysis.findings.push_back(std::move(finding));
  }
}

void add_coherence(Finding &finding, const Analysis &analysis)
{
  const ForceResponse &response = analysis.forced.response;
  if (response.n == 0)
    return;
  const auto k = Eigen::Index(std::lround(finding.frequency / response.resolution()));
  if (k < response.coherence.rows())
    finding.evidence.push_back(
        fmt::format("the response to the recorded force does not confirm it, coherence {:.2f} there",
                    response.coherence.row(k).maxCoeff()));
}

void add_of_response_alone(Analysis &analysis, const CaseModel *stand)
{
  for (const IdentifiedMode &mode : analysis.modes.modes) {
    const auto &forced = analysis.forced.modes;
    const bool edge    = is_edge(analysis.force_edges, mode.frequency, mode.damping);
    if ((!mode.confirmed && !edge) || mode.damping < least_damping ||
        (!edge && !is_in_a_spectrum(analysis, mode.frequency, mode.damping)) ||
        std::any_of(forced.begin(), forced.end(),
                    [&](const ForcedMode &other) { return other.confirmed && is_same(other, mode); }))
      continue;
    const double sd = scatter_over_law * mode.law_frequency;
    Finding finding = finding_of(analysis, mode.frequency, sd, mode.damping, mode.shape);
    finding.evidence.push_back(fmt::format("{} of the record show it, {} of 15 model orders",
                                           mode.confirmed ? "both halves" : "not both halves", mode.orders));
    finding.evidence.push_back(
        fmt::format("damping {:.2f} % of critical, standard error at least {:.2f} %, about twice that in practice",
                    100 * mode.damping, 100 * mode.law_damping));
    if (edge) {
      finding.kind  = FindingKind::edge;
      finding.owner = "edge of the force band";
      finding.evidence.push_back("the density of the force changes by 10 dB within 5 % there");
    } else {
      add_coherence(finding, analysis);
      if (stand)
        finding.owner =
            owner_among_modes({mode.frequency, sd / mode.frequency, mode.shape, analysis.mode_channels}, *stand)
                .sentence;
    }
    analysis.findings.push_back(std::move(finding));
  }
}
}  // namespace

const ChannelAnalysis &channel_of_name(const Analysis &analysis, const std::string &name)
{
  for (const ChannelAnalysis &channel : analysis.channels)
    if (channel.name == name)
      return channel;
  return analysis.channels.front();
}

double speed_span(const Analysis &analysis)
{
  return std::isnan(analysis.lowest_speed) ? 0 : analysis.highest_speed / analysis.lowest_speed - 1;
}

const CleanChannel *line_free_channel(const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                                      const std::string &name)
{
  for (const CleanChannel &channel : line_free)
    if (channel.name == name)
      return &channel;
  return record.find(name);
}

void add_mode_findings(Analysis &analysis, const CleanRecord &record, const std::vector<CleanChannel> &line_free,
                       const CaseModel *stand, const AnalysisSettings &settings)
{
  double highest      = 1000;
  const auto channels = channels_for_modes(analysis, record, highest);
  if (channels.empty())
    return;
  if (record.duration() < shortest_record) {
    analysis.notes.emplace_back(NoteId::modes_not_searched, "",
                                fmt::format("the record is {:.3g} s long", record.duration()), "",
                                fmt::format("modes need {} s, half of it for confirmation", shortest_record));
    return;
  }
  analysis.force_edges = force_edges(analysis);
  std::vector<const CleanChannel *> without;
  for (const CleanChannel *channel : channels)
    without.push_back(line_free_channel(record, line_free, channel->name));
  analysis.modes = find_modes(without, record.rate, highest, settings.threads);
  find_forced_modes(analysis, record, channels, highest, settings);
  if (analysis.forced.response.n > 0)
    find_delay(analysis, record, *channels.front(), settings);
  add_forced(analysis, stand);
  add_of_response_alone(analysis, stand);
  std::stable_sort(analysis.findings.begin(), analysis.findings.end(),
                   [](const Finding &a, const Finding &b) { return a.frequency < b.frequency; });
}
}  // namespace mill::twin
