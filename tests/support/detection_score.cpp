#include "tests/support/detection_score.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace detection_score {
namespace {
using random_record::Content;
using namespace mill::twin;
using mill::FindingKind;

constexpr double counted_line = 12;  // dB
constexpr double few_decays   = 12;  // a mode that decays less often in the record cannot be separated from a line
constexpr double reach_of_beat = 170;  // bins: modulation of the generator beats with 40 bins, four side bands

std::vector<double> reported_lines(const Analysis &analysis)
{
  std::vector<double> reported;
  for (const Finding &finding : analysis.findings)
    if (finding.kind == FindingKind::line || finding.kind == FindingKind::family) {
      if (finding.members.empty())
        reported.push_back(finding.frequency);
      for (const FamilyMember &member : finding.members)
        reported.push_back(member.frequency);
    }
  return reported;
}

bool is_true_line(const Content &content, const double frequency, const double bin)
{
  if (content.impacts > 0)
    return true;  // harmonics of impacts are lines where these are regular
  if (content.growth > 0 && std::abs(frequency - content.growth_frequency) < 10 * bin + 2)
    return true;
  return std::any_of(content.lines.begin(), content.lines.end(),
                     [&](const auto &line) {
                       return std::abs(frequency - line.frequency) < (line.modulated ? reach_of_beat : 2) * bin;
                     }) ||
         std::any_of(content.modes.begin(), content.modes.end(), [&](const auto &mode) {
           return mode.decays < few_decays && std::abs(frequency - mode.frequency) < 3 * bin;
         });
}

// Why each channel has a line there.
std::string reasons_at(const Analysis &analysis, const double f)
{
  std::string all;
  for (const ChannelAnalysis &channel : analysis.channels)
    for (const SpectralCandidate &one : channel.detected.candidates)
      if (std::abs(one.peak.frequency - f) < one.peak.resolution)
        all += fmt::format("; {} {:.5g} Hz {:.3g}: {}", word_of(one.fate), one.peak.frequency, one.peak.amplitude,
                           one.reason);
  return all;
}

void score_lines(Score &score, const Content &content, const Analysis &analysis, const double bin,
                 const std::string &name)
{
  const std::vector<double> reported = reported_lines(analysis);
  for (const auto &line : content.lines) {
    if (line.decibel < counted_line)
      continue;
    ++score.lines;
    if (std::any_of(reported.begin(), reported.end(),
                    [&](const double f) { return std::abs(f - line.frequency) < bin; }))
      ++score.lines_found;
    else
      score.missed +=
          fmt::format("{}: line of {:.2f} Hz, {:.1f} dB not found\n", name, line.frequency, line.decibel);
  }
  for (const double f : reported)
    if (!is_true_line(content, f, bin)) {
      ++score.false_lines;
      score.missed += fmt::format("{}: line of {:.2f} Hz is false{}\n", name, f, reasons_at(analysis, f));
    }
}

void score_modes(Score &score, const Content &content, const Analysis &analysis, const double bin, const double T,
                 const std::string &name)
{
  for (const auto &mode : content.modes) {
    const bool next_to_line = std::any_of(content.lines.begin(), content.lines.end(), [&](const auto &line) {
      return std::abs(line.frequency - mode.frequency) < 6 * bin;
    });
    if (next_to_line)
      continue;
    const double half  = mode.damping * mode.frequency,
                 reach = std::max({3 * bin, 2 * half, 4 * std::sqrt(half / (2 * M_PI * T))});
    ++score.modes;
    if (std::any_of(analysis.findings.begin(), analysis.findings.end(), [&](const Finding &finding) {
          return std::abs(finding.frequency - mode.frequency) < reach &&
                 (finding.kind == FindingKind::mode || finding.kind == FindingKind::resonance ||
                  (finding.kind == FindingKind::line && mode.decays < few_decays));
        }))
      ++score.modes_found;
    else
      score.missed += fmt::format("{}: mode of {:.2f} Hz, damping {:.2g} %, {:.0f} dB not found\n", name,
                                  mode.frequency, 100 * mode.damping, mode.decibel);
  }
  for (const Finding &finding : analysis.findings) {
    if (finding.kind != FindingKind::mode && finding.kind != FindingKind::resonance)
      continue;
    const double f = finding.frequency;
    const bool is_true =
        content.impacts > 0 || (content.growth > 0 && std::abs(f - content.growth_frequency) < 25) ||
        std::any_of(content.modes.begin(), content.modes.end(),
                    [&](const auto &mode) {
                      return std::abs(f - mode.frequency) < std::max(4 * bin, 6 * mode.damping * mode.frequency);
                    }) ||
        std::any_of(content.lines.begin(), content.lines.end(),
                    [&](const auto &line) { return std::abs(f - line.frequency) < 2 * bin; });
    if (!is_true) {
      ++score.false_modes;
      score.missed += fmt::format("{}: {} of {:.2f} Hz, {:.3g} {}, is false: {}\n", name, word_of(finding.kind), f,
                                  finding.amplitude, finding.unit, fmt::join(finding.evidence, "; "));
    }
  }
}

void score_growth(Score &score, const Content &content, const Analysis &analysis, const double bin,
                  const std::string &name)
{
  if (content.growth > 0) {
    ++score.growing;
    const bool detected =
        std::any_of(analysis.findings.begin(), analysis.findings.end(), [&](const Finding &finding) {
          return std::abs(finding.frequency - content.growth_frequency) < 5 + 2 * bin &&
                 std::any_of(finding.evidence.begin(), finding.evidence.end(), [](const std::string &sentence) {
                   return sentence.find("grows at +") != std::string::npos;
                 });
        });
    score.growth_found += detected;
    if (detected)
      return;
    score.missed += fmt::format("{}: growth of {:+.2f} 1/s at {:.1f} Hz not found, {:.1f} to {:.1f} s\n", name,
                                content.growth, content.growth_frequency, content.growth_from, content.growth_to);
    for (const Finding &finding : analysis.findings)  // what it was taken for
      if (std::abs(finding.frequency - content.growth_frequency) < 25)
        score.missed += fmt::format("  {} at {:.2f} Hz: {}\n", word_of(finding.kind), finding.frequency,
                                    fmt::join(finding.evidence, "; "));
    return;
  }
  ++score.calm;
  for (const Finding &finding : analysis.findings)
    if (finding.kind == FindingKind::near_instability || finding.kind == FindingKind::alarm) {
      ++score.false_growth;
      score.missed += fmt::format("{}: {} at {:.2f} Hz is false: {}\n", name, word_of(finding.kind),
                                  finding.frequency, finding.evidence.front());
      break;
    }
}
}  // namespace

void Score::add(const Score &other)
{
  records += other.records;
  lines += other.lines;
  lines_found += other.lines_found;
  false_lines += other.false_lines;
  modes += other.modes;
  modes_found += other.modes_found;
  false_modes += other.false_modes;
  calm += other.calm;
  false_growth += other.false_growth;
  growing += other.growing;
  growth_found += other.growth_found;
  account_error = std::max(account_error, other.account_error);
  fateless += other.fateless;
  missed += other.missed;
}

std::string Score::table() const
{
  const auto row = [](const char *what, const long part, const long all) {
    return fmt::format("| {} | {} of {} | {:.2f} % |\n", what, part, all,
                       all > 0 ? 100.0 * double(part) / double(all) : 0.0);
  };
  return row("lines of 12 dB and more found", lines_found, lines) +
         row("false lines over records", false_lines, records) +
         row("modes of 20 dB and more found", modes_found, modes) +
         row("false modes over records", false_modes, records) +
         row("records without growth that warn", false_growth, calm) +
         row("records with growth, found with its sign", growth_found, growing) +
         fmt::format("| largest error of the account | {:.1e} | |\n", account_error);
}

Score score_of(const std::uint64_t seed, const random_record::Wish &wish)
{
  auto record             = random_record::make(seed, wish);
  const Content content   = record.content;
  const std::string name  = fmt::format("seed {}", seed);
  const CleanRecord clean = clean_record(std::move(record.raw));
  const Analysis analysis = analyse(clean, nullptr, {}, {});
  const double bin        = analysis.channels.front().spectrum.resolution();
  Score score;
  score.records = 1;
  score_lines(score, content, analysis, bin, name);
  score_modes(score, content, analysis, bin, clean.duration(), name);
  score_growth(score, content, analysis, bin, name);
  for (const ChannelAnalysis &seen : analysis.channels) {
    const Account &a = seen.account;
    score.account_error =
        std::max(score.account_error, std::abs(a.lines + a.families + a.modes + a.floor + a.unexplained - 1));
  }
  for (const CandidateFate &one : analysis.candidates)
    score.fateless += one.reason.empty();
  return score;
}
}  // namespace detection_score
