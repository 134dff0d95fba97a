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
                             const double frequency)
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
    for (Eigen::Index first = piece.begin; first + L <= piece.end; first += L / 2) {
      const auto part   = value.segment(first, L);
      const double mean = part.mean();
      const double turn = -2 * M_PI * std::fmod(frequency / s.rate * (double(first) + double(L) / 2), 1.0);
      frames.z.push_back(std::complex<double>(part.dot(real) - mean * sum_real, part.dot(imag) - mean * sum_imag) *
                         std::polar(1.0, turn));
      frames.time.push_back((double(first) + double(L) / 2) / s.rate);
    }
  return frames;
}

double power_at(const FrameValues &frames, const double away)
{
  std::complex<double> sum = 0;
  for (std::size_t m = 0; m < frames.z.size(); ++m)
    sum += frames.z[m] * std::polar(1.0, -2 * M_PI * away * frames.time[m]);
  return std::norm(sum);
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
  const FrameValues frames = values_of_frames(value, pieces, s, start);
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
  // Cramer and Rao for a line in white noise: ratio of the line to the noise in one segment, n/1.2 of them apart
  const double T = std::max(frames.time.back() - frames.time.front(), double(s.L) / s.rate);
  test.deviation = std::sqrt(6 / (std::max(ratio - 1, 0.1) * std::max(1.0, n / 1.2))) / (2 * M_PI * T);
  return test;
}
}  // namespace mill::twin
