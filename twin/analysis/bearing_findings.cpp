#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double shortest = 5, steady = 0.005, lowest_band = 1250;  // s, -, Hz
constexpr Eigen::Index longest = 1 << 21;                           // samples
constexpr double growth        = 1.5;  // of a score; that of one bearing moves by some 10 % from record to record

struct Stretch {
  Span span{0, 0};
  double speed = 0;  // m/s
};

// The longest part of the pieces at one speed.
Stretch steady_stretch(const CleanChannel &channel, const CleanChannel *recorded, const AnalysisSettings &settings)
{
  Stretch best;
  for (const Span &piece : channel.pieces) {
    if (!recorded) {
      if (settings.speed && piece.size() > best.span.size())
        best = {piece, *settings.speed};
      continue;
    }
    for (Eigen::Index i = piece.begin; i < piece.end;) {
      const double v   = recorded->value[i];
      Eigen::Index end = i;
      while (end < piece.end && std::abs(recorded->value[end] - v) <= steady * std::abs(v))
        ++end;
      if (v > 0 && end - i > best.span.size())
        best = {{i, end}, recorded->value.segment(i, end - i).mean()};
      i = std::max(end, i + 1);
    }
  }
  if (best.span.size() > longest)
    best.span.end = best.span.begin + longest;
  return best;
}

bool sits_at(const std::string &channel, const std::string &roll)
{
  return channel.find(roll) != std::string::npos;
}

// An indication is a fault only when it grows compared with an earlier record of the same bearing.
void compare_with_baseline(Finding &finding, const BearingScore &now, const std::optional<Baseline> &baseline)
{
  if (!baseline) {
    finding.evidence.push_back("an indication is a fault only when it grows compared with earlier "
                               "records; no baseline is named");
    return;
  }
  const auto before = baseline->score.find({now.channel, now.bearing, now.family});
  if (before == baseline->score.end()) {
    finding.evidence.push_back("the baseline " + baseline->folder +
                               " has no score of this bearing: whether it grows is not known");
    return;
  }
  const bool grows = now.score > growth * before->second;
  finding.evidence.push_back(fmt::format("score {:.1f} against {:.1f} of the baseline: {}", now.score,
                                         before->second, grows ? "it grows" : "it does not grow, no fault"));
  if (grows)
    finding.kind = FindingKind::bearing_fault;
}

// A frequency of the fault has one explanation: what else was found there names the bearing, its own source
// second.
void give_to_bearing(Analysis &analysis, const std::string &channel, const std::string &fault,
                     const double frequency, const double shaft, const double resolution)
{
  constexpr int most_harmonic = 12, of_side_bands = 6, most_side = 2;
  const auto place_of = [&](const double f) -> std::string {
    for (int h = 1; h <= most_harmonic; ++h)
      for (int j = -most_side; j <= most_side; ++j)
        if ((j == 0 || h <= of_side_bands) &&
            std::abs(f - h * frequency - j * shaft) <= std::max(2 * resolution, 0.002 * f))
          return fmt::format("{} x {}", h, fault) + (j == 0 ? "" : fmt::format(" {:+d} x {:.2f} Hz", j, shaft));
    return "";
  };
  const auto is_warning = [](const Finding &finding) {
    return finding.kind == FindingKind::near_instability || finding.kind == FindingKind::alarm;
  };
  auto &all = analysis.findings;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const Finding &finding) {
                             return is_warning(finding) && finding.channel == channel &&
                                    !place_of(finding.frequency).empty();
                           }),
            all.end());
  for (Finding &finding : all) {
    if (finding.channel != channel ||
        (finding.kind != FindingKind::mode && finding.kind != FindingKind::resonance &&
         finding.kind != FindingKind::line))
      continue;
    const std::string place = place_of(finding.frequency);
    if (place.empty())
      continue;
    finding.evidence.push_back("second: " + finding.owner);
    finding.owner = place;
    finding.kind  = FindingKind::fault_line;
  }
}

void look_at(Analysis &analysis, const CleanRecord &record, const CleanChannel &channel,
             const TurningBearing &bearing, const Stretch &stretch, const std::optional<Baseline> &baseline,
             Fourier &fourier)
{
  const Eigen::Index n = quick_length(stretch.span.size());
  const auto spectrum =
      envelope_spectrum(channel.value.segment(stretch.span.begin, n), record.rate, 0, 0, fourier);
  const double shaft = stretch.speed / (M_PI * bearing.roll_diameter);
  for (const FaultLines &lines : fault_lines(spectrum, bearing, shaft)) {
    analysis.bearings.push_back({channel.name, bearing.name, bearing.roll, lines.family, lines.frequency,
                                 lines.slip, lines.score, stretch.speed, spectrum.low, spectrum.high,
                                 spectrum.kurtosis});
    if (!lines.indicated())
      continue;
    const double f = lines.frequency * (1 + lines.slip);
    Finding finding{FindingKind::bearing,
                    channel.name,
                    f,
                    f - spectrum.resolution,
                    f + spectrum.resolution,
                    std::nan(""),
                    "",
                    fmt::format("{} of bearing {} at the {}: {}", lines.family, bearing.name, bearing.roll,
                                lines.strong() ? "strong" : "indicated"),
                    {}};
    finding.evidence.push_back(fmt::format(
        "score {:.1f} (5 indicated, 20 strong); harmonics {:.1f}, {:.1f}, {:.1f}, {:.1f} "
        "over their neighbourhood, slip {:.2f} %",
        lines.score, lines.ratio[0], lines.ratio[1], lines.ratio[2], lines.ratio[3], 100 * lines.slip));
    finding.evidence.push_back(
        fmt::format("squared envelope of {:.0f} .. {:.0f} Hz, kurtosis {:.2f}, {:.0f} s at {:.4g} m/s",
                    spectrum.low, spectrum.high, spectrum.kurtosis, double(n) / record.rate, stretch.speed));
    give_to_bearing(analysis, channel.name, fmt::format("{} of bearing {}", lines.family, bearing.name), f, shaft,
                    channel_of_name(analysis, channel.name).spectrum.resolution());
    compare_with_baseline(finding, analysis.bearings.back(), baseline);
    analysis.findings.push_back(std::move(finding));
  }
}
}  // namespace

void add_bearing_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand,
                          const AnalysisSettings &settings)
{
  if (!stand || stand->bearings.empty())
    return;
  const CleanChannel *recorded = recorded_speed(record, "speed");
  if (!recorded && !settings.speed) {
    const CleanChannel *other = record.find("speed");
    analysis.notes.emplace_back(
        NoteId::bearing_not_computed, "bearings",
        !other ? "not computed, the record has no channel 'speed'"
               : fmt::format("not computed, the channel 'speed' is not a speed in a unit of length over time{}",
                             other->unit.empty() ? "" : ", its unit is " + other->unit),
        "", "give --speed \"4 m/s\"");
    return;
  }
  Fourier fourier;
  for (const CleanChannel &channel : record.channels) {
    if (!is_vibration(channel.quantity))
      continue;
    const ChannelAnalysis &seen = channel_of_name(analysis, channel.name);
    for (const TurningBearing &bearing : stand->bearings) {
      if (!sits_at(channel.name, bearing.roll))
        continue;
      if (!std::isfinite(bearing.cage)) {
        analysis.notes.emplace_back(NoteId::bearing_not_computed, "bearing " + bearing.name,
                                    "not computed, its pitch or roller diameter is missing");
        continue;
      }
      const Stretch stretch = steady_stretch(channel, recorded, settings);
      if (double(stretch.span.size()) < shortest * record.rate)
        analysis.notes.emplace_back(
            NoteId::bearing_not_computed, channel.name,
            fmt::format("bearing {} not computed, no {} s at one speed", bearing.name, shortest));
      else if (seen.bandwidth < 1.15 * lowest_band)
        analysis.notes.emplace_back(
            NoteId::bearing_not_computed, channel.name,
            fmt::format("bearing {} not computed, the record ends at {:.0f} Hz and impacts ring above {:.0f} Hz",
                        bearing.name, seen.bandwidth, lowest_band));
      else
        look_at(analysis, record, channel, bearing, stretch, settings.baseline, fourier);
    }
  }
}
}  // namespace mill::twin
