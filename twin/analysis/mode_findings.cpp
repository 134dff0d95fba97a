#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/analysis/owner.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double scatter_over_law = 2;     // of identified modes
constexpr double least_damping    = 5e-4;  // below it a pole is a line of something that turns or of the mains

// Hz, where the density of the force falls by 10 dB within 5 %; NaN: nowhere.
std::vector<double> force_edges(const Analysis &analysis)
{
  std::vector<double> edges;
  for (const ChannelAnalysis &channel : analysis.channels) {
    if (channel.quantity != Quantity::force || channel.name == "load_cell" || channel.spectrum.n == 0)
      continue;
    const WelchSpectrum &s = channel.spectrum;
    const auto mean        = [&](const double low, const double high) {
      const auto first = Eigen::Index(low / s.resolution()), last = Eigen::Index(high / s.resolution());
      return last > first && last < s.density.size() ? s.density.segment(first, last - first).mean() : 0.0;
    };
    double best = 10, at = 0;
    for (double f = 20; f * 1.08 < s.rate / 2; f *= 1.005) {
      const double fall = mean(0.95 * f, 0.995 * f) / std::max(1e-300, mean(1.005 * f, 1.05 * f));
      if (fall > best) {
        best = fall;
        at   = f;
      } else if (at > 0 && f > 1.1 * at) {
        edges.push_back(at);
        best = 10;
        at   = 0;
      }
    }
    if (at > 0)
      edges.push_back(at);
  }
  return edges;
}

std::string loudest(const Analysis &analysis, const IdentifiedMode &mode)
{
  Eigen::Index largest = 0;
  mode.shape.cwiseAbs().maxCoeff(&largest);
  return analysis.mode_channels[std::size_t(largest)];
}

// 0-peak of a narrow band about a mode: root 2 times its rms.
double amplitude_of(const ChannelAnalysis &channel, const IdentifiedMode &mode)
{
  const WelchSpectrum &s = channel.spectrum;
  const double half      = std::max(mode.damping * mode.frequency, 2 * s.resolution());
  double area            = 0;
  for (Eigen::Index k = 1; k < s.density.size(); ++k)
    if (std::abs(s.at(k) - mode.frequency) <= half)
      area += s.density[k] * s.resolution();
  return std::sqrt(2 * area);
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

void add_mode_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand)
{
  std::vector<const CleanChannel *> channels;
  double highest = 1000;
  for (const CleanChannel &channel : record.channels)
    if ((channel.quantity == Quantity::acceleration || channel.quantity == Quantity::velocity) &&
        channel.n_used() > 0) {
      channels.push_back(&channel);
      analysis.mode_channels.push_back(channel.name);
      highest = std::min(highest, channel_of_name(analysis, channel.name).bandwidth);
    }
  if (channels.empty()) {
    analysis.notes.push_back("no channel is an acceleration or a velocity: modes were not looked for");
    return;
  }
  // channels in other units would make shapes without meaning
  const std::string unit = channels.front()->unit;
  if (std::any_of(channels.begin(), channels.end(), [&](const auto *c) { return c->unit != unit; })) {
    analysis.notes.push_back(
        "accelerations and velocities stand side by side: shapes of modes take those of the first "
        "unit alone");
    channels.erase(
        std::remove_if(channels.begin(), channels.end(), [&](const auto *c) { return c->unit != unit; }),
        channels.end());
    analysis.mode_channels.clear();
    for (const auto *channel : channels)
      analysis.mode_channels.push_back(channel->name);
  }
  constexpr double shortest = 10;  // s
  if (record.duration() < shortest) {
    analysis.notes.push_back(fmt::format(
        "the record is {:.3g} s long; modes need {} s, half of it for confirmation", record.duration(), shortest));
    return;
  }
  analysis.modes   = find_modes(channels, record.rate, highest, 2);
  const auto edges = force_edges(analysis);
  for (const IdentifiedMode &mode : analysis.modes.modes) {
    if (!mode.confirmed || mode.damping < least_damping)
      continue;
    const double sd = scatter_over_law * mode.law_frequency;
    const auto edge = std::find_if(edges.begin(), edges.end(),
                                   [&](const double f) { return std::abs(f / mode.frequency - 1) < 0.02; });
    Finding finding{"mode",
                    loudest(analysis, mode),
                    mode.frequency,
                    mode.frequency - 1.96 * sd,
                    mode.frequency + 1.96 * sd,
                    0,
                    unit,
                    "",
                    {}};
    finding.amplitude = amplitude_of(channel_of_name(analysis, finding.channel), mode);
    finding.evidence.push_back(
        fmt::format("both halves of the record show it, {} of 15 model orders", mode.orders));
    finding.evidence.push_back(fmt::format(
        "damping {:.2f} % of critical, standard deviation {:.2f} % by the law, about twice that in fact",
        100 * mode.damping, 100 * mode.law_damping));
    if (edge != edges.end()) {
      finding.kind  = "edge";
      finding.owner = "edge of the force band";
      finding.evidence.push_back(
          fmt::format("the density of the force falls by 10 dB within 5 % at {:.4g} Hz", *edge));
    } else if (!stand)
      finding.owner = "no case was named";
    else
      finding.owner =
          owner_among_modes({mode.frequency, sd / mode.frequency, mode.shape, analysis.mode_channels}, *stand)
              .sentence;
    analysis.findings.push_back(std::move(finding));
  }
}
}  // namespace mill::twin
