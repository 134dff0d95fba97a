#include "twin/spectra/welch.h"
#include "core/base/require.h"
#include "twin/spectra/noise_floor.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr Eigen::Index longest_default = 1 << 17;  // samples

double squares_of_window(const Eigen::Index L)
{
  return 3.0 * double(L) / 8;
}

double sinc(const double x)
{
  return std::abs(x) < 1e-9 ? 1 : std::sin(M_PI * x) / (M_PI * x);
}

// Bins to one side of k at which the density falls to half, between bins by straight lines.
double half_power(const WelchSpectrum &s, const Eigen::Index k, const Eigen::Index step)
{
  const double half = s.density[k] / 2;
  Eigen::Index i    = k;
  while (i + step > 0 && i + step < s.density.size() && s.density[i + step] > half)
    i += step;
  const Eigen::Index next = std::clamp<Eigen::Index>(i + step, 0, s.density.size() - 1);
  const double fall       = s.density[i] - s.density[next];
  return double(std::abs(i - k)) + (fall > 0 ? (s.density[i] - half) / fall : 0.5);
}
}  // namespace

double WelchSpectrum::resolution() const
{
  return rate / double(L);
}

double WelchSpectrum::enbw() const
{
  return 1.5 * rate / double(L);
}

double WelchSpectrum::dof() const
{
  return 2 * double(n) / (1 + double(n - 1) / (18 * double(n)));  // (41.5)
}

double WelchSpectrum::at(const Eigen::Index k) const
{
  return double(k) * rate / double(L);
}

std::array<double, 2> WelchSpectrum::band() const
{
  return {1 / chi_square_ratio(0.025, dof()), 1 / chi_square_ratio(0.975, dof())};
}

Eigen::Index default_segment(const Eigen::Index n)
{
  Eigen::Index L = 2;
  while (9 * L <= n)  // eight segments of 2 L
    L *= 2;
  return n < 2 ? 0 : L;
}

WelchSpectrum welch(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const double rate,
                    Eigen::Index L, Fourier &fourier)
{
  Eigen::Index all = 0, longest = 0;
  for (const Span &piece : pieces) {
    all += piece.size();
    longest = std::max(longest, piece.size());
  }
  if (L == 0) {
    L = std::min(default_segment(all), longest_default);
    while (L > longest)
      L /= 2;
  }
  WelchSpectrum result;
  result.rate = rate;
  result.L    = L;
  if (L < 2)
    return result;
  require((L & (L - 1)) == 0, "a segment of a spectrum is a power of two");
  result.density = result.scatter = Eigen::VectorXd::Zero(L / 2 + 1);
  const Eigen::ArrayXd window =
      0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(L, 0, double(L - 1)) * (2 * M_PI / double(L))).cos();
  std::vector<double> segment(std::size_t(L), 0.0);
  std::vector<std::complex<double>> lines;
  for (const Span &piece : pieces)
    for (Eigen::Index first = piece.begin; first + L <= piece.end; first += L / 2, ++result.n) {
      const auto part                               = value.segment(first, L).array();
      Eigen::Map<Eigen::ArrayXd>(segment.data(), L) = (part - part.mean()) * window;
      fourier.forward(segment, lines);
      for (Eigen::Index k = 0; k <= L / 2; ++k) {
        const double power = std::norm(lines[std::size_t(k)]);
        result.density[k] += power;
        result.scatter[k] += power * power;
      }
    }
  if (result.n == 0)
    return result;
  const Eigen::ArrayXd mean = (result.density.array() / double(result.n)).max(1e-300);
  result.scatter = (result.scatter.array() / double(result.n) / mean.square() - 1).max(0.0).sqrt().matrix().eval();
  result.density *= 2 / (rate * squares_of_window(L) * double(result.n));  // (41.4)
  result.density[0] /= 2;
  result.density[L / 2] /= 2;
  return result;
}

SpectralLine line_at(const WelchSpectrum &s, const Eigen::Index k)
{
  const auto magnitude = [&](const Eigen::Index i) {
    return std::sqrt(s.density[i] * s.rate * squares_of_window(s.L) / 2);
  };
  const double a = magnitude(k), before = magnitude(k - 1), after = magnitude(k + 1);
  const double r     = std::max(before, after) / a;
  const double size  = std::clamp((2 * r - 1) / (1 + r), 0.0, 0.5);
  const double delta = after >= before ? size : -size;
  const double width = (half_power(s, k, -1) + half_power(s, k, 1)) * s.resolution();
  return {(double(k) + delta) * s.resolution(), a * 4 / double(s.L) * (1 - delta * delta) / sinc(delta),
          a * 4 / double(s.L), width};
}

double velocity_rms(const WelchSpectrum &s, const Quantity quantity, const double low, const double high)
{
  if (quantity != Quantity::acceleration && quantity != Quantity::velocity)
    return std::numeric_limits<double>::quiet_NaN();
  double square = 0;
  bool any      = false;
  for (Eigen::Index k = 1; k < s.density.size(); ++k)
    if (const double f = s.at(k); f >= low && f <= high) {
      const double w = 2 * M_PI * f;
      square += s.density[k] * s.resolution() / (quantity == Quantity::acceleration ? w * w : 1);
      any = true;
    }
  return any ? std::sqrt(square) : std::numeric_limits<double>::quiet_NaN();
}

namespace {
// A line whose frequency moves fills a band, at whose end the floor falls too, but which is as low before the
// band.
double median_of_two_octaves_to(const std::vector<double> &level, const std::size_t i, const double step)
{
  const auto span = std::min(i, std::size_t(std::log(4.) / std::log(step)));
  std::vector<double> part(level.begin() + std::ptrdiff_t(i - span), level.begin() + std::ptrdiff_t(i + 1));
  const auto middle = part.begin() + std::ptrdiff_t(part.size() / 2);
  std::nth_element(part.begin(), middle, part.end());
  return *middle;
}
}  // namespace

double bandwidth(const WelchSpectrum &s)
{
  constexpr double fall = 1e-3, ratio = 1.2, step = 1.02;
  const double top            = s.rate / 2.56;
  const Eigen::VectorXd floor = noise_floor(s);  // a line does not move it, however strong it is
  std::vector<double> frequency, level;
  for (double f = std::max(top / 1024, 8 * s.resolution()); f < top; f *= step) {
    frequency.push_back(f);
    level.push_back(floor[std::min(Eigen::Index(f / s.resolution()), floor.size() - 2)]);
  }
  std::vector<double> highest_above(level.size() + 1, 0.0);
  for (std::size_t i = level.size(); i-- > 0;)
    highest_above[i] = std::max(highest_above[i + 1], level[i]);
  const auto apart = std::size_t(std::log(ratio) / std::log(step));
  for (std::size_t i = 0; i + apart < level.size(); ++i)
    if (const double before = std::min(level[i], median_of_two_octaves_to(level, i, step));
        highest_above[i + apart] < fall * before && before > 0) {
      std::size_t edge = i;
      while (edge + 1 < level.size() && level[edge + 1] > 0.1 * level[i])
        ++edge;
      return frequency[edge];
    }
  return top;
}
}  // namespace mill::twin
