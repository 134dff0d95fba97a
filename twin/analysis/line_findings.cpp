#include "twin/analysis/channel_analysis.h"
#include "twin/analysis/findings.h"
#include "twin/analysis/merged_peaks.h"
#include "twin/analysis/owner.h"
#include "twin/detection/line_families.h"
#include "twin/detection/lost_samples.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double drift_of_mains = 0.004, drift_of_speed = 0.003;  // -, of the frequency
constexpr int most_written = 12;                                  // orders in one sentence

std::string orders_text(const std::vector<int> &orders)
{
  const bool whole = orders.size() > 2 && orders.back() - orders.front() + 1 == int(orders.size());
  if (whole)
    return fmt::format("{} to {}", orders.front(), orders.back());
  std::string text;
  for (std::size_t i = 0; i < orders.size() && i < std::size_t(most_written); ++i)
    text += (i ? ", " : "") + std::to_string(orders[i]);
  return orders.size() > std::size_t(most_written) ? text + fmt::format(" .. {}", orders.back()) : text;
}

std::vector<SeenLine> seen_lines(const std::vector<MergedPeak> &lines)
{
  std::vector<SeenLine> seen;
  for (const MergedPeak &one : lines) {  // a line that does not turn steadily has no sharp frequency
    const double wander = 0.05 * (1 - std::min(1.0, one.peak.coherence)) + 0.003;
    seen.push_back({one.peak.frequency, std::hypot(one.peak.deviation, wander * one.peak.resolution),
                    one.peak.amplitude * one.peak.amplitude});
  }
  return seen;
}

std::vector<KnownFundamental> known_fundamentals(const CaseModel *stand, const double speed,
                                                 const AnalysisSettings &settings)
{
  std::vector<KnownFundamental> known;
  for (const double mains : {50.0, 60.0})
    if (!settings.mains || std::abs(*settings.mains - mains) < 1)
      known.push_back({fmt::format("mains, {:.0f} Hz", mains), mains, drift_of_mains, 2});
  if (stand && speed > 0)
    for (const TurningRoll &roll : stand->rolls)
      known.push_back({"turns of the " + roll.name, speed / (M_PI * roll.diameter), drift_of_speed, 2});
  return known;
}

Finding finding_of_line(const Analysis &analysis, const MergedPeak &one)
{
  const Peak &peak             = one.peak;
  const ChannelAnalysis &where = analysis.channels[one.channel];
  Finding finding{FindingKind::line,
                  where.name,
                  peak.frequency,
                  peak.frequency - 1.96 * peak.deviation,
                  peak.frequency + 1.96 * peak.deviation,
                  peak.amplitude,
                  where.unit,
                  "",
                  {},
                  {}};
  finding.evidence.push_back(
      fmt::format("{:.0f} dB over the noise floor; {:.0f} % of its power turns steadily over the "
                  "record; bins of {:.3g} Hz",
                  peak.prominence, 100 * std::min(1.0, peak.coherence), peak.resolution));
  if (peak.coherence < 0.8 || peak.swing > 0.2)
    finding.evidence.push_back(peak.swing > 0.2 ? "its amplitude is modulated"
                                                : "its frequency moves or is modulated");
  std::string others;
  for (const MergedPeak::Place &place : one.seen)
    if (place.channel != one.channel)
      others += fmt::format("{}{} {:.3g} {}", others.empty() ? "" : ", ", analysis.channels[place.channel].name,
                            analysis.channels[place.channel].detected.candidates[place.candidate].peak.amplitude,
                            analysis.channels[place.channel].unit);
  if (!others.empty())
    finding.evidence.push_back("also in " + others + " (0-peak)");
  if (peak.frequency > where.bandwidth)
    finding.evidence.push_back(
        fmt::format("above {:.4g} Hz, the limit of the evaluated band: its amplitude is a lower "
                    "bound",
                    where.bandwidth));
  return finding;
}

// Follows the speed: it is then a line of the spectrum over the rolled length.
bool is_locked(const Analysis &analysis, const MergedPeak &one, std::string &sentence)
{
  const ChannelAnalysis &where = analysis.channels[one.channel];
  if (where.map.speed.size() == 0)
    return false;
  const auto exponent = speed_exponent(where.map, one.peak.frequency, where.map.speed.mean());
  const double width  = std::max(one.peak.width, where.map.rate / double(where.map.L));
  const Follows how   = follows_speed(exponent, speed_span(analysis), width / one.peak.frequency);
  sentence            = how == Follows::cannot_tell
                            ? std::string("fixed or locked to the speed: not distinguishable, the speed changes too little")
                            : fmt::format("{}: exponent of the speed {:.2f}", name_of(how), exponent.q);
  return how == Follows::locked;
}

void add_family(Analysis &analysis, const std::vector<MergedPeak> &lines, const LineFamily &family)
{
  std::size_t strongest = family.members.front();
  double square         = 0;
  for (const std::size_t i : family.members) {
    square += 0.5 * lines[i].peak.amplitude * lines[i].peak.amplitude;
    if (lines[i].peak.amplitude > lines[strongest].peak.amplitude)
      strongest = i;
  }
  const MergedPeak &loudest    = lines[strongest];
  const MergedPeak &shown      = family.orders.front() == 1 ? lines[family.members.front()] : loudest;
  const ChannelAnalysis &where = analysis.channels[loudest.channel];
  Finding finding{FindingKind::family,
                  where.name,
                  family.fundamental,
                  family.fundamental - 1.96 * family.deviation,
                  family.fundamental + 1.96 * family.deviation,
                  shown.peak.amplitude,
                  where.unit,
                  "",
                  {},
                  {}};
  const std::string orders = orders_text(family.orders);
  finding.owner            = family.name.empty()
                                 ? fmt::format("harmonics {} of {:.6g} Hz", orders, family.fundamental)
                                 : fmt::format("{}: harmonics {} of {:.6g} Hz", family.name, orders, family.fundamental);
  finding.evidence.push_back(
      fmt::format("{} lines; the strongest is order {}, {:.6g} Hz with {:.3g} {} 0-peak; {:.3g} {} rms "
                  "together",
                  family.members.size(), std::lround(loudest.peak.frequency / family.fundamental),
                  loudest.peak.frequency, loudest.peak.amplitude, where.unit, std::sqrt(square), where.unit));
  finding.evidence.push_back(
      fmt::format("so many lines fit by chance with a probability of {:.1e}", family.chance));
  for (std::size_t i = 0; i < family.members.size(); ++i) {
    const MergedPeak &member = lines[family.members[i]];
    finding.members.push_back({family.orders[i], member.peak.frequency, member.peak.amplitude});
    give_fate(analysis, member, FindingKind::family,
              fmt::format("{} x {:.6g} Hz{}{}", family.orders[i], family.fundamental,
                          family.name.empty() ? "" : ", ", family.name));
  }
  analysis.findings.push_back(std::move(finding));
}

void add_side_bands(Analysis &analysis, const std::vector<MergedPeak> &lines, const SideBands &bands)
{
  const auto strongest =
      std::max_element(bands.places.begin(), bands.places.end(), [&](const auto &a, const auto &b) {
        return lines[a.line].peak.amplitude < lines[b.line].peak.amplitude;
      });
  const ChannelAnalysis &where = analysis.channels[lines[strongest->line].channel];
  int harmonics = 0, sides = 0;
  for (const auto &place : bands.places) {
    harmonics = std::max(harmonics, place.harmonic);
    sides     = std::max(sides, std::abs(place.side));
  }
  Finding finding{
      FindingKind::family, where.name, bands.carrier, bands.carrier, bands.carrier, 0, where.unit, "", {}, {}};
  finding.owner =
      fmt::format("{:.6g} Hz{} with side bands {:.5g} Hz apart", bands.carrier,
                  harmonics > 1 ? fmt::format(" and its harmonics up to {}", harmonics) : "", bands.spacing);
  finding.evidence.push_back(
      fmt::format("{} lines at h x {:.6g} Hz + j x {:.5g} Hz, |j| up to {}; the strongest is "
                  "{:.6g} Hz with {:.3g} {} 0-peak; by chance {:.1e}",
                  bands.places.size(), bands.carrier, bands.spacing, sides, lines[strongest->line].peak.frequency,
                  lines[strongest->line].peak.amplitude, where.unit, bands.chance));
  finding.evidence.push_back(
      fmt::format("the amplitude at {:.6g} Hz is modulated {:.5g} times a second", bands.carrier, bands.spacing));
  for (const auto &place : bands.places) {
    const MergedPeak &member = lines[place.line];
    finding.members.push_back(
        {place.side == 0 ? place.harmonic : 0, member.peak.frequency, member.peak.amplitude});
    if (place.harmonic == 1 && place.side == 0) {
      finding.low       = member.peak.frequency - 1.96 * member.peak.deviation;
      finding.high      = member.peak.frequency + 1.96 * member.peak.deviation;
      finding.amplitude = member.peak.amplitude;
    }
    give_fate(
        analysis, member, FindingKind::family,
        fmt::format("{} x {:.6g} Hz {:+d} x {:.5g} Hz", place.harmonic, bands.carrier, place.side, bands.spacing));
  }
  analysis.findings.push_back(std::move(finding));
}

// A comb of one recorder; its strongest line stays a line.
std::vector<std::size_t> add_lost_samples(Analysis &analysis, const CleanRecord &record,
                                          const std::vector<MergedPeak> &lines, const std::vector<SeenLine> &seen)
{
  for (std::size_t c = 0; c < record.channels.size(); ++c) {
    std::vector<SeenLine> of_channel;
    std::vector<std::size_t> number;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].channel == c) {
        of_channel.push_back(seen[i]);
        number.push_back(i);
      }
    const auto lost = lost_samples(record.channels[c], record.rate, of_channel);
    if (!lost)
      continue;
    const std::string sentence = fmt::format(
        "samples are lost at the borders of blocks of {} samples: comb of {:.2f} Hz", lost->block, lost->spacing);
    const ChannelAnalysis &where = analysis.channels[c];
    Finding finding{FindingKind::lost_samples,
                    where.name,
                    lost->strongest,
                    lost->strongest,
                    lost->strongest,
                    0,
                    where.unit,
                    sentence,
                    {},
                    {}};
    finding.evidence.push_back(
        fmt::format("{} lines {:.2f} Hz apart, which is {:g} samples per second over {}; the second "
                    "difference at the border has {:.2g} times the mean square of that elsewhere",
                    lost->members.size(), lost->spacing, record.rate, lost->block, lost->step));
    finding.evidence.push_back(
        "the lines of the comb are made by the recorder; the frequency of the machine is not the one "
        "of the strongest line when samples are missing; check the transfer of the recorder");
    std::vector<std::size_t> members;
    for (const std::size_t m : lost->members) {
      const MergedPeak &one = lines[number[m]];
      members.push_back(number[m]);
      finding.members.push_back({0, one.peak.frequency, one.peak.amplitude});
      finding.amplitude = std::max(finding.amplitude, one.peak.amplitude);
      give_fate(analysis, one, FindingKind::lost_samples, sentence);
    }
    std::sort(finding.members.begin(), finding.members.end(),
              [](const auto &a, const auto &b) { return a.frequency < b.frequency; });
    analysis.findings.push_back(std::move(finding));
    return members;
  }
  return {};
}

void add_single_line(Analysis &analysis, const MergedPeak &one, const std::string &source,
                     const std::string &follows, const CaseModel *stand, const double speed)
{
  Finding finding = finding_of_line(analysis, one);
  finding.owner   = source;
  if (!follows.empty())
    finding.evidence.push_back(follows);
  if (speed_span(analysis) < 0.02 && speed > 0)
    finding.evidence.push_back(spacing_sentence(finding.frequency, speed, stand));
  give_fate(analysis, one, FindingKind::line, finding.evidence.front());
  analysis.findings.push_back(std::move(finding));
}
}  // namespace

void add_line_findings(Analysis &analysis, const CleanRecord &record, const CaseModel *stand, const double speed,
                       const AnalysisSettings &settings)
{
  std::vector<MergedPeak> lines;
  std::vector<std::string> follows;
  for (MergedPeak &one : merged_peaks(analysis)) {
    if (!one.peak.line)
      continue;
    std::string sentence;
    if (is_locked(analysis, one, sentence)) {
      give_fate(analysis, one, FindingKind::locked, sentence + "; it is a line over the rolled length");
      continue;
    }
    if (is_unresolved_mode(analysis, one.peak)) {
      give_fate(analysis, one, FindingKind::mode,
                "the bins are too wide to separate it from the mode at this frequency");
      continue;
    }
    lines.push_back(std::move(one));
    follows.push_back(std::move(sentence));
  }
  const std::vector<SeenLine> seen = seen_lines(lines);
  std::vector<std::size_t> comb    = add_lost_samples(analysis, record, lines, seen);
  std::vector<bool> taken(lines.size(), false);
  for (const std::size_t i : comb)
    taken[i] = true;
  std::vector<std::size_t> rest;
  std::vector<SeenLine> of_rest;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!taken[i]) {
      rest.push_back(i);
      of_rest.push_back(seen[i]);
    }
  LinesInFamilies in_families = lines_in_families(of_rest, known_fundamentals(stand, speed, settings));
  for (LineFamily &family : in_families.families) {
    for (std::size_t &member : family.members) {
      member        = rest[member];
      taken[member] = true;
    }
    add_family(analysis, lines, family);
  }
  for (SideBands &bands : in_families.side_bands) {
    for (auto &place : bands.places) {
      place.line        = rest[place.line];
      taken[place.line] = true;
    }
    add_side_bands(analysis, lines, bands);
  }
  if (!comb.empty()) {  // lines are sorted: the first of a comb is its strongest
    Finding finding = finding_of_line(analysis, lines[comb.front()]);
    finding.owner   = "strongest line of the comb that lost samples make";
    analysis.findings.push_back(std::move(finding));
  }
  std::vector<double> free_lines;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!taken[i])
      free_lines.push_back(lines[i].peak.frequency);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!taken[i]) {
      const Peak &peak   = lines[i].peak;
      const double reach = std::max(4 * seen[i].deviation, 0.05 * peak.resolution);
      const TurningPeak turning{peak.frequency, reach, true, reach};
      const std::string source = turning_owner(turning, stand, speed, free_lines, record.rate, settings.mains);
      add_single_line(analysis, lines[i], source.empty() ? "source not identified" : source, follows[i], stand,
                      speed);
    }
}
}  // namespace mill::twin
