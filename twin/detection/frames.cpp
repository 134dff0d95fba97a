#include "twin/detection/frames.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
struct FrameValues {
  std::vector<std::complex<double>> z;
  std::vector<double> time;  // s, of the middle of each segment
};

FrameValues values_of_frames(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const WelchSpectrum &s,
                             const double frequency, const Eigen::Index hop)
{
  const Eigen::Index L = s.L;
  Eigen::VectorXd real(L), imag(L);
  for (Eigen::Index i = 0; i < L; ++i) {
    const double window = 0.5 - 0.5 * std::cos(2 * M_PI * double(i) / double(L));
    const double phase  = 2 * M_PI * std::fmod(frequency / s.rate * (double(i) - double(L) / 2), 1.0);
    real[i]             = window * std::cos(phase);
    imag[i]             = -window * std::sin(phase);
  }
  FrameValues frames;
  const double sum_real = real.sum(), sum_imag = imag.sum();
  for (const Span &piece : pieces)
    for (Eigen::Index first = piece.begin; first + L <= piece.end; first += hop) {
      const auto part   = value.segment(first, L);
      const double mean = part.mean();
      const double turn = -2 * M_PI * std::fmod(frequency / s.rate * (double(first) + double(L) / 2), 1.0);
      frames.z.push_back(std::complex<double>(part.dot(real) - mean * sum_real, part.dot(imag) - mean * sum_imag) *
                         std::polar(1.0, turn));
      frames.time.push_back((double(first) + double(L) / 2) / s.rate);
    }
  return frames;
}

std::complex<double> sum_turned_back(const FrameValues &frames, const double away)
{
  std::complex<double> sum = 0;
  for (std::size_t m = 0; m < frames.z.size(); ++m)
    sum += frames.z[m] * std::polar(1.0, -2 * M_PI * away * frames.time[m]);
  return sum;
}

double power_at(const FrameValues &frames, const double away)
{
  return std::norm(sum_turned_back(frames, away));
}

// Hz from the frequency of the frames, within `reach`, at which they add up best.
double best_turn(const FrameValues &frames, const double reach)
{
  const double T = std::max(frames.time.back() - frames.time.front(), 1 / reach);
  double best = 0, highest = -1;
  const double step = std::min(0.2 / T, reach / 2);
  for (double away = -reach; away <= reach; away += step)
    if (const double power = power_at(frames, away); power > highest) {
      highest = power;
      best    = away;
    }
  for (double fine = step / 2; fine > 1e-4 / T; fine /= 2)
    for (const double sign : {-1.0, 1.0})
      if (const double power = power_at(frames, best + sign * fine); power > highest) {
        highest = power;
        best += sign * fine;
      }
  return best;
}
// Sum of a turn of one frequency against that of another, over the times of the segments.
std::complex<double> overlap_of(const FrameValues &frames, const double difference)
{
  std::complex<double> sum = 0;
  for (const double time : frames.time)
    sum += std::polar(1.0, 2 * M_PI * difference * time);
  return sum;
}

// Two steady turns that explain the segments together, by least squares.
struct TwoTurns {
  double first = 0, second = 0;     // Hz from the frequency of the frames
  std::complex<double> one, other;  // their values
  double power   = 0;               // of the segments that they explain, sum of |z|^2
  double overlap = 0;               // -, of the two over the times of the segments, below 1
};

TwoTurns explained_by(const FrameValues &frames, const double first, const double second)
{
  const auto a = sum_turned_back(frames, first), b = sum_turned_back(frames, second),
             g   = overlap_of(frames, second - first);
  const double n = double(frames.z.size()), determinant = n * n - std::norm(g);
  TwoTurns turns{first, second, {}, {}, 0, std::abs(g) / n};
  if (determinant < 0.05 * n * n)  // nearly one turn: its beat is longer than the record
    return turns;
  turns.one   = (n * a - g * b) / determinant;
  turns.other = (n * b - std::conj(g) * a) / determinant;
  turns.power = (std::conj(a) * turns.one + std::conj(b) * turns.other).real();
  return turns;
}

// Of few segments every pair of a grid is tried; of many the best partner of the best single turn, and from that
// the best partner again.
TwoTurns best_two_turns(const FrameValues &frames, const double reach)
{
  constexpr std::size_t few = 128;
  constexpr int rounds      = 6;
  const double T = frames.time.back() - frames.time.front(), step = 0.4 / T;
  TwoTurns best;
  const auto take = [&](const double first, const double second) {
    if (const TwoTurns turns = explained_by(frames, first, second); turns.power > best.power)
      best = turns;
  };
  if (frames.z.size() <= few)
    for (double first = -reach; first <= reach; first += step)
      for (double second = first + step; second <= reach; second += step)
        take(first, second);
  for (double kept = best_turn(frames, reach), before = -1; best.power > before * (1 + 1e-9); kept = best.second) {
    before = best.power;
    for (double other = -reach; other <= reach; other += step)
      take(kept, other);
    for (double fine = step / 2; fine > 1e-3 / T; fine /= 2)
      for (int round = 0; round < rounds; ++round)
        for (const auto &[da, db] : {std::pair{fine, 0.}, {-fine, 0.}, {0., fine}, {0., -fine}})
          take(best.first + da, best.second + db);
  }
  if (best.first > best.second) {
    std::swap(best.first, best.second);
    std::swap(best.one, best.other);
  }
  return best;
}

// The most segments in a row that a long gap does not part, all of them where gaps take less than half of the
// time: over a long gap many pairs of frequencies explain the segments equally well, and to try them all takes
// time with its square.
FrameValues without_long_gaps(FrameValues &&frames, const double hop)
{
  constexpr double longest = 2;  // times what segments without gaps take
  const std::size_t n      = frames.z.size();
  for (std::size_t m = n; m > 1; --m)
    for (std::size_t first = 0; first + m <= n; ++first)
      if (frames.time[first + m - 1] - frames.time[first] <= longest * double(m) * hop) {
        const auto begin = std::ptrdiff_t(first), end = std::ptrdiff_t(first + m);
        return {{frames.z.begin() + begin, frames.z.begin() + end},
                {frames.time.begin() + begin, frames.time.begin() + end}};
      }
  return std::move(frames);
}

// Share that two free turns hardly ever explain of a mode, which fades: simulated, 150 draws each of modes that
// are 0.3 to 2 bins wide, in 8, 12, 16 and 24 segments: at most 0.97, 0.945, 0.915 and 0.84.
double least_explained(const double segments)
{
  return 1 - 0.07 * std::clamp((segments - 4) / 12, 0.0, 1.0);
}

// Cramer and Rao for a line in white noise, Hz; ratio of the line and its noise in one segment; of n segments that
// overlap by half n/1.2 are independent.
double deviation_of_line(const FrameValues &frames, const WelchSpectrum &s, const double ratio, const double n)
{
  const double T = std::max(frames.time.back() - frames.time.front(), double(s.L) / s.rate);
  return std::sqrt(6 / (std::max(ratio - 1, 0.1) * std::max(1.0, n / 1.2))) / (2 * M_PI * T);
}
}  // namespace

bool FrameTest::steady() const
{
  if (n < 4)
    return true;  // too few segments to see it fade
  constexpr double coherent = 0.8, calm = 0.3, very_coherent = 0.88, very_calm = 0.12;
  if (coherence > coherent && swing < calm + allowance)
    return true;
  return n >= 12 &&
         (coherence > very_coherent || swing < very_calm + allowance);  // modulated in amplitude, or in frequency
}

FrameTest frame_test(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const WelchSpectrum &s,
                     const Eigen::Index k, const double ratio)
{
  const double start       = line_at(s, k).frequency;
  const FrameValues frames = values_of_frames(value, pieces, s, start, s.L / 2);
  FrameTest test;
  test.n         = Eigen::Index(frames.z.size());
  test.frequency = start;
  if (test.n == 0)
    return test;
  double sum = 0, squares = 0;
  for (const auto &z : frames.z) {
    sum += std::norm(z);
    squares += std::norm(z) * std::norm(z);
  }
  const double n = double(test.n), mean = sum / n;
  const double away = best_turn(frames, 0.7 * s.resolution());
  test.frequency    = start + away;
  const double line = std::max(ratio - 1, 1e-9) / std::max(ratio, 1.0);  // share of the line, noise taken off
  test.coherence    = mean > 0 ? std::min(1.0, power_at(frames, away) / (n * sum) / line) : 0;
  test.swing        = mean > 0 ? squares / n / (mean * mean) - 1 - (2 * ratio - 1) / (ratio * ratio) : 0;
  test.allowance    = 2 * (2 * ratio - 1) / (ratio * ratio) / std::sqrt(n);
  test.deviation    = deviation_of_line(frames, s, ratio, n);
  return test;
}

namespace {
// Hz, between the two lines of a peak.
double centre_of_power(const WelchSpectrum &s, const Eigen::Index k)
{
  const Eigen::Index first = std::max<Eigen::Index>(1, k - 2), last = std::min(s.density.size() - 1, k + 2);
  double sum = 0, moment = 0;
  for (Eigen::Index i = first; i <= last; ++i) {
    sum += s.density[i];
    moment += s.density[i] * s.at(i);
  }
  return moment / sum;
}
}  // namespace

std::optional<LinePair> line_pair(const Eigen::VectorXd &value, const std::vector<Span> &pieces,
                                  const WelchSpectrum &s, const Eigen::Index k, const double ratio)
{
  // Segments a quarter of their length apart see turns of less than two bins to either side as they are; of half
  // of them the deviation and what modes may explain are known.
  constexpr std::size_t fewest = 15;
  constexpr double clear       = 100;  // noise takes no more than a hundredth of the power
  constexpr double wide        = 1.5;  // bins, where the window still leaves a sixth
  const double start           = centre_of_power(s, k);
  const FrameValues frames =
      without_long_gaps(values_of_frames(value, pieces, s, start, s.L / 4), double(s.L / 4) / s.rate);
  if (frames.z.size() < fewest || ratio < clear)
    return std::nullopt;
  double sum = 0;
  for (const auto &z : frames.z)
    sum += std::norm(z);
  const double halves  = 0.5 * double(frames.z.size() + 1);
  const TwoTurns turns = best_two_turns(frames, wide * s.resolution());
  LinePair pair;
  pair.coherence = turns.power / sum;
  if (turns.power == 0 || pair.coherence < least_explained(halves))
    return std::nullopt;
  const double mean = sum / double(frames.z.size()), overlap = std::sqrt(1 - turns.overlap * turns.overlap);
  const auto line = [&](const double away, const double size) {
    const double bins = away / s.resolution(), x = M_PI * bins;
    const double gain = std::abs(x) < 1e-6                 ? 1
                        : std::abs(bins * bins - 1) < 1e-6 ? 0.5
                                                           : std::sin(x) / x / (1 - bins * bins);  // Hann
    return LinePair::Line{start + away, 4 * size / (double(s.L) * std::abs(gain)),
                          deviation_of_line(frames, s, ratio * size * size / mean, halves) / overlap};
  };
  pair.lines = {line(turns.first, std::abs(turns.one)), line(turns.second, std::abs(turns.other))};
  return pair;
}
}  // namespace mill::twin
