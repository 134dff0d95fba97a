// Lines and resonances over a robust noise floor, each with one fate.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/analysis/analysis.h"
#include "twin/analysis/analysis_files.h"
#include "twin/detection/frames.h"
#include "twin/detection/spectral_peaks.h"
#include "twin/detection/without_lines.h"
#include "twin/spectra/noise_floor.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace mill;
using namespace mill::twin;

namespace {
struct Tone {
  double frequency, amplitude;
};

Eigen::VectorXd tones(const std::vector<Tone> &lines, const double noise, const std::uint64_t seed,
                      const double rate, const double seconds)
{
  const auto n      = Eigen::Index(rate * seconds);
  Eigen::VectorXd x = noise * synthetic::normals(seed, n);
  for (const Tone &line : lines)
    for (Eigen::Index k = 0; k < n; ++k)
      x[k] +=
          line.amplitude * std::sin(2 * M_PI * std::fmod(line.frequency * double(k) / rate, 1.0) + line.frequency);
  return x;
}

RawChannel acceleration(const std::string &name, const Eigen::VectorXd &x)
{
  return {name, name, "m/s2", Quantity::acceleration, true, {}, x};
}

Analysis analysis_of(const std::vector<Eigen::VectorXd> &channels, const double rate)
{
  RawRecord raw;
  raw.file = "record.csv";
  raw.rate = rate;
  for (std::size_t c = 0; c < channels.size(); ++c)
    raw.channels.push_back(acceleration("sensor_" + std::to_string(c + 1), channels[c]));
  return analyse(clean_record(std::move(raw)), nullptr, {}, {});
}

const Finding *line_at_frequency(const Analysis &analysis, const double f, const double within)
{
  for (const Finding &finding : analysis.findings)
    if (finding.kind == FindingKind::line && std::abs(finding.frequency - f) <= within)
      return &finding;
  return nullptr;
}

WelchSpectrum spectrum_of_all(const Eigen::VectorXd &x, const double rate)
{
  Fourier fourier;
  return welch(x, {{0, x.size()}}, rate, 0, fourier);
}
}  // namespace

TEST(NoiseFloor, IsTheDensityOfWhiteNoise)
{
  const double rate           = 2000;
  const WelchSpectrum s       = spectrum_of_all(synthetic::normals(3, 80000), rate);
  const Eigen::VectorXd floor = noise_floor(s);
  EXPECT_TRUE(near(floor.segment(200, s.L / 2 - 400).mean(), 2 / rate,
                   within(0.04, "a quantile of some hundred bins with 15 degrees of freedom each")));
}

TEST(NoiseFloor, IsNotRaisedByAStrongLineNorByAFamily)
{
  const double rate = 2000;
  std::vector<Tone> lines{{18.2, 300}};
  for (int h = 1; h <= 30; ++h)
    lines.push_back({29.93 * h, 10.0});
  const WelchSpectrum s       = spectrum_of_all(tones(lines, 1, 5, rate, 20), rate);
  const Eigen::VectorXd floor = noise_floor(s);
  for (const double f : {25.0, 100.0, 400.0, 800.0})
    EXPECT_LT(10 * std::log10(floor[Eigen::Index(f / s.resolution())] * rate / 2), 2)
        << f << " Hz, dB over the noise";
  EXPECT_TRUE(near(bandwidth(s), rate / 2.56,
                   within_absolute(1, "a line of 300 times the noise does not limit the band")));
}

TEST(NoiseFloor, QuantilesOfChiSquare)
{
  // tables of chi-square: 3.841 (1, 5 %), 18.307 (10, 5 %), 31.264 (11, 0.1 %)
  EXPECT_TRUE(near(chi_square_ratio(0.05, 1), 3.841459, within(1e-6, "seven digits of the table")));
  EXPECT_TRUE(near(10 * chi_square_ratio(0.05, 10), 18.307038, within(1e-6, "seven digits of the table")));
  EXPECT_TRUE(near(11 * chi_square_ratio(0.001, 11), 31.264134, within(1e-6, "seven digits of the table")));
}

// A low line 60 dB over the floor, two lines above it: all three are found, and the band has no limit.
TEST(SpectralPeaks, AStrongLowLineHidesNothing)
{
  const double rate   = 2000;
  const auto analysis = analysis_of({tones({{18.2, 3}, {151.7, 0.3}, {431, 0.2}}, 0.05, 11, rate, 9)}, rate);
  for (const Tone &line : std::vector<Tone>{{18.2, 3}, {151.7, 0.3}, {431, 0.2}}) {
    const Finding *finding = line_at_frequency(analysis, line.frequency, 1.0 / 9);
    ASSERT_TRUE(finding) << line.frequency;
    EXPECT_TRUE(near(finding->amplitude, line.amplitude, within(0.05, "three deviations of the weakest line")));
  }
  EXPECT_EQ(analysis.findings.size(), 3u);
  EXPECT_TRUE(near(analysis.channels[0].account.largest, 18.2,
                   within_absolute(0.02, "hertz; a fifth of a bin of 0.11 Hz")));
  for (const Note &note : analysis.notes)
    EXPECT_FALSE(note.is(NoteId::band_limited)) << text_of(note);
}

// Sixty records of one tone in white noise.
TEST(SpectralPeaksLong, AToneIsFoundInEveryRecord)
{
  int true_lines = 0, others = 0;
  for (const double seconds : {10.0, 20.0, 30.0})
    for (const int channels : {1, 3})
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const double f =
            40 + 760 * synthetic::uniforms(seed + std::uint64_t(100 * seconds) + std::uint64_t(channels), 1)[0];
        std::vector<Eigen::VectorXd> x;
        for (int c = 0; c < channels; ++c)
          x.push_back(tones({{f, 1}}, 0.1, 7 * seed + std::uint64_t(c), 2000, seconds));
        const auto analysis = analysis_of(x, 2000);
        true_lines += line_at_frequency(analysis, f, 1 / seconds) != nullptr;
        others += int(analysis.findings.size()) - 1;
      }
  EXPECT_EQ(true_lines, 60);
  EXPECT_EQ(others, 0);
}

// The threshold depends on the number of bins: in 100 channels of noise a tenth of a false line is expected, and
// the same tone is found above it.
TEST(SpectralPeaks, NoiseAloneHasNoCandidate)
{
  int candidates = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Eigen::VectorXd x = synthetic::normals(seed, 20000);
    const WelchSpectrum s   = spectrum_of_all(x, 2000);
    candidates += int(spectral_peaks(x, {{0, x.size()}}, s, 5, 980).candidates.size());
  }
  EXPECT_LE(candidates, 2) << "probability of three and more: 2e-4";
  const auto analysis = analysis_of({synthetic::normals(4, 20000)}, 2000);
  EXPECT_TRUE(analysis.channels[0].account.only_noise());
  EXPECT_GE(analysis.channels[0].account.floor, 0.95);
}

// Four million samples are missing between two pieces: minutes went into pairs of frequencies that only the gap
// tells apart.
TEST(SpectralPeaks, TwoLinesThatBeatAreFoundNextToALongGap)
{
  constexpr double rate    = 1000;
  constexpr Eigen::Index L = 2048, behind = Eigen::Index(1) << 22;
  const std::vector<Span> two = {{0, 16 * L}, {behind, behind + 4 * L}};
  Eigen::VectorXd x           = Eigen::VectorXd::Zero(two.back().end);
  const Tone first{100, 1}, second{100.3, 0.7};  // 0.6 bins apart
  for (const Span &piece : two)
    for (Eigen::Index k = piece.begin; k < piece.end; ++k)
      for (const Tone &line : {first, second})
        x[k] += line.amplitude * std::sin(2 * M_PI * std::fmod(line.frequency * double(k) / rate, 1.0));
  Fourier fourier;
  const WelchSpectrum s  = welch(x, two, rate, L, fourier);
  const Eigen::Index bin = std::llround(100.1 / s.resolution());
  const auto pair        = line_pair(x, two, s, bin, 1e6);
  ASSERT_TRUE(pair);
  const auto expect_line = [&](const LinePair::Line &line, const Tone &tone) {
    EXPECT_TRUE(near(line.frequency, tone.frequency,
                     within_absolute(3e-4, "a hundredth of a turn over the 31 s of the first piece")));
    EXPECT_TRUE(near(line.amplitude, tone.amplitude,
                     within(1e-3, "a hundredth of a turn changes the overlap of the two by less")));
  };
  expect_line(pair->lines[0], first);
  expect_line(pair->lines[1], second);
}

// Two motors that turn 0.1 to 0.3 Hz apart make one peak that beats: 0.4 to 1.2 bins of these records of 20 s.
TEST(SpectralPeaks, TwoLinesThatBeatAreTwoLines)
{
  std::uint64_t seed = 1;
  for (const double apart : {0.1, 0.2, 0.3})
    for (const double second : {1.0, 0.6}) {
      const Analysis analysis =
          analysis_of({tones({{100.07, 1}, {100.07 + apart, second}}, 0.1, seed++, 2000, 20)}, 2000);
      int lines = 0;
      for (const Finding &one : analysis.findings)
        lines += one.kind == FindingKind::line;
      EXPECT_EQ(lines, 2) << apart << " Hz apart, " << second;
      for (const auto &[frequency, amplitude] : {std::pair{100.07, 1.0}, {100.07 + apart, second}}) {
        const Finding *line = line_at_frequency(analysis, frequency, 0.01);
        ASSERT_TRUE(line) << apart << " Hz apart, " << second;
        EXPECT_TRUE(
            near(line->amplitude, amplitude, within(0.05, "0.1 of noise, and the window's form between bins")));
      }
    }
}

// A resonance that noise drives comes and goes from segment to segment; a line does not.
TEST(SpectralPeaks, AModeIsNoLineAndALineIsNoMode)
{
  int lines = 0, resonances = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto noise = synthetic::normals(seed, 60000);
    const auto mode =
        synthetic::modal_response(Eigen::VectorXd::Constant(1, 93), Eigen::VectorXd::Ones(1), 0.004, noise, 3000);
    const Eigen::VectorXd x = mode.col(0) - noise + 0.05 * synthetic::normals(seed + 50, 60000);
    const WelchSpectrum s   = spectrum_of_all(x, 3000);
    for (const auto &one : spectral_peaks(x, {{0, x.size()}}, s, 40, 200).candidates) {
      lines += one.fate == FindingKind::line;
      resonances += one.fate == FindingKind::resonance;
    }
  }
  EXPECT_LE(lines, 1) << "of twenty records";
  EXPECT_GE(resonances, 20);
}

TEST(WithoutLines, LeavesTheNoise)
{
  CleanChannel channel;
  channel.value           = tones({{70, 5}, {71.5, 3}, {300, 1}}, 0, 1, 1000, 10);
  channel.pieces          = {{0, channel.value.size()}};
  const double before     = channel.value.norm();
  const Eigen::VectorXd x = without_lines(channel, 1000, {70, 71.5, 300});
  EXPECT_LT(x.norm(), 1e-3 * before) << "lines that are 15 bins apart do not take part in each other";
}

// Shares are 100 % and every candidate has one fate, whatever the record holds.
TEST(Account, EveryShareAndEveryCandidateIsThere)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double rate   = 1000 * double(1 + seed % 4);
    const auto noise    = synthetic::normals(seed + 300, Eigen::Index(6 * rate));
    const auto mode     = synthetic::modal_response(Eigen::VectorXd::Constant(1, 60.0 + 5.0 * double(seed)),
                                                    Eigen::VectorXd::Ones(1), 0.02, noise, rate);
    Eigen::VectorXd x   = tones({{31.3, 2}, {200.1, 0.5}}, 0.3, seed, rate, 6) + mode.col(0) - noise;
    const auto analysis = analysis_of({x}, rate);
    const Account &a    = analysis.channels[0].account;
    EXPECT_TRUE(near(a.lines + a.families + a.modes + a.floor + a.unexplained, 1, within(1e-3, "asked for")));
    EXPECT_GT(a.lines, 0.1) << seed;
    EXPECT_FALSE(a.source.empty());
    for (const CandidateFate &one : analysis.candidates)
      EXPECT_FALSE(one.reason.empty()) << one.frequency;
    EXPECT_NE(candidates_csv(analysis).find("fate,reason"), std::string::npos);
  }
}
