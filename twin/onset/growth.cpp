#include "twin/onset/growth.h"
#include "twin/onset/onset_watch.h"
#include "twin/spectra/fourier.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

constexpr double lag_reach = 0.7, longest = 2, shortest_sigma = 0.35;  // -, s, 1/s
constexpr double scatter_over_law = 1.6;                               // -

// First lag beyond the length of the low-pass: below it are noise and filter.
int first_lag_of(const ComplexEnvelope &envelope)
{
  return std::max(2, int(std::ceil(filter_length_of(envelope.half_band) * envelope.rate - 1e-9)));
}

// Sum of z(k + lag) z(k)* over the same k for every lag, so that growth and decay have their sign.
Complex correlation(const ComplexEnvelope &envelope, const Eigen::Index lag, const Eigen::Index longest_lag)
{
  Complex sum = 0;
  for (const auto &z : envelope.z)
    if (const Eigen::Index n = z.size() - longest_lag; n > 0)
      sum += z.head(n).dot(z.segment(lag, n));  // the first factor is conjugated
  return sum;
}

// lambda of one step from the lags first .. last.
Complex step_factor(const std::vector<Complex> &R, const int first, const int last)
{
  Complex sum   = 0;
  double weight = 0;
  for (int m = first; m <= last && m + 1 < int(R.size()); ++m) {
    sum += R[std::size_t(m + 1)] * std::conj(R[std::size_t(m)]);
    weight += std::norm(R[std::size_t(m)]);
  }
  return weight > 0 ? sum / weight : 0;
}

// Growth rate of an envelope, of a mode or of a tone.
GrowthRate growth_of_all(const ComplexEnvelope &envelope)
{
  GrowthRate growth;
  for (const auto &z : envelope.z)
    growth.duration += double(z.size()) / envelope.rate;
  const int most = int(longest * envelope.rate), first = first_lag_of(envelope);
  std::vector<Complex> R;
  for (int m = 0; m <= most + 1; ++m)
    R.push_back(correlation(envelope, m, most + 1));
  if (!(std::abs(R[0]) > 0) || growth.duration < 4 * longest || first >= most)
    return growth;
  growth.kept  = std::abs(R[std::size_t(first)]) / std::abs(R[0]);
  double sigma = -1 / longest;
  for (int i = 0; i < 8; ++i) {  // the reach of the lags follows the rate that they give
    const int last =
        std::clamp(int(lag_reach / std::max(std::abs(sigma), shortest_sigma) * envelope.rate), first + 1, most);
    const Complex lambda = step_factor(R, first, last);
    if (!(std::abs(lambda) > 0))
      return growth;
    sigma            = envelope.rate * std::log(std::abs(lambda));
    growth.frequency = envelope.frequency + std::arg(lambda) * envelope.rate / (2 * M_PI);
  }
  growth.sigma = sigma;
  growth.law   = std::sqrt(std::abs(sigma) / growth.duration);
  return growth;
}

// The strongest line of a piece: exp(2 pi i f k) with its amplitude, and whether it is the same in both halves.
struct Line {
  Eigen::VectorXcd value;
  double square = 0;  // mean
  bool steady   = false;
};

Eigen::VectorXcd turn(const double cycles, const Eigen::Index n)
{
  Eigen::VectorXcd z(n);
  const Complex step = std::polar(1.0, 2 * M_PI * cycles);
  Complex now        = 1;
  for (Eigen::Index k = 0; k < n; ++k, now *= step)
    z[k] = now;
  return z;
}

Line strongest_line(const Eigen::VectorXcd &z)
{
  constexpr double agree = 0.3;  // -, of the amplitudes of both halves
  const Eigen::Index n   = z.size();
  std::vector<Complex> x(std::size_t(2 * n)), X;  // twice as long with zeros: bins half as far apart
  std::copy(z.begin(), z.end(), x.begin());
  Fourier().forward(x, X);
  const auto highest = std::max_element(
      X.begin(), X.end(), [](const Complex &p, const Complex &q) { return std::norm(p) < std::norm(q); });
  double cycles    = double(highest - X.begin()) / double(2 * n);
  double step      = 1 / double(4 * n);
  const auto power = [&](const double f) { return std::norm(turn(f, n).dot(z)); };
  for (int i = 0; i < 8; ++i, step /= 2) {  // parabola through three points around the highest
    const double low = power(cycles - step), mid = power(cycles), high = power(cycles + step);
    const double bend = low - 2 * mid + high;
    cycles += bend < 0 ? step * std::clamp(0.5 * (low - high) / bend, -1.0, 1.0) : 0;
  }
  Line line;
  const Eigen::VectorXcd e = turn(cycles, n);
  const Eigen::Index half  = n / 2;
  const Complex amplitude  = e.dot(z) / double(n);
  const Complex first      = e.head(half).dot(z.head(half)) / double(half),
                second     = e.tail(n - half).dot(z.tail(n - half)) / double(n - half);
  line.value               = amplitude * e;
  line.square              = std::norm(amplitude);
  line.steady              = std::abs(first - second) < agree * std::abs(amplitude);
  return line;
}
}  // namespace

bool GrowthRate::near_instability() const
{
  return upper() > near_instability_from;
}

double GrowthRate::upper() const
{
  return sigma + 1.96 * scatter_over_law * law;
}

double GrowthRate::lower() const
{
  return sigma - 1.96 * scatter_over_law * law;
}

// (41.18): a line that is far stronger than the strongest that noise makes of the mode left behind.
GrowthRate growth_rate(const ComplexEnvelope &envelope)
{
  constexpr int most_tones      = 2;
  constexpr double beyond_noise = 10;  // times the mean square of a line: noise exceeds it once in exp(10)
  GrowthRate plain              = growth_of_all(envelope);
  if (!plain.near_instability() || envelope.z.size() != 1)
    return plain;
  const double all = envelope.z[0].squaredNorm() / double(envelope.z[0].size());
  double taken = 0, weakest = all;
  ComplexEnvelope rest = envelope;
  for (int i = 0; i < most_tones; ++i) {
    const Line line = strongest_line(rest.z[0]);
    if (!line.steady)
      break;
    rest.z[0] -= line.value;
    taken += line.square;
    weakest           = std::min(weakest, line.square);
    GrowthRate growth = growth_of_all(rest);
    if (!(weakest > beyond_noise * 2 * (all - taken) / (std::abs(growth.sigma) * growth.duration)))
      continue;
    growth.tone = taken / all;
    return growth;
  }
  return plain;
}

std::vector<Alarm> alarms(const ComplexEnvelope &envelope, const AlarmSettings &settings)
{
  std::vector<Alarm> result;
  for (std::size_t p = 0; p < envelope.z.size(); ++p) {
    OnsetWatch watch(envelope.frequency, envelope.rate, settings);
    for (Eigen::Index k = 0; k < envelope.z[p].size(); ++k)
      if (const auto alarm = watch.take(envelope.start[p] + double(k) / envelope.rate, envelope.z[p][k]))
        result.push_back(*alarm);
  }
  return result;
}

double longest_lead(const double limit, const double threshold_level, const double sigma)
{
  return std::log(limit / threshold_level) / sigma;
}
}  // namespace mill::twin
