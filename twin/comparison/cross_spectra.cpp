#include "twin/comparison/cross_spectra.h"
#include "twin/comparison/running_comparison.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace mill::twin {
namespace {
using Complex            = std::complex<double>;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Autocorrelation of a periodic Hann window at a lag of x window lengths, 1 at x = 0.
double hann_correlation(const double x)
{
  const double u = std::abs(x), a = 2 * M_PI * u;
  return (1 - u) * (2 + std::cos(a)) / 3 + std::sin(a) / (2 * M_PI);
}

// R(tau) = Re sum xy exp(i w tau) over the bins above zero, with its first two derivatives.
std::array<double, 3> correlation_at(const Eigen::ArrayXcd &xy, const double step, const double tau)
{
  std::array<double, 3> R{};
  const Complex turn = std::polar(1.0, step * tau);
  Complex phase      = turn;
  // products by hand: those of std::complex look after infinities at ten times the price
  const auto turned = [&] {
    return Complex(phase.real() * turn.real() - phase.imag() * turn.imag(),
                   phase.real() * turn.imag() + phase.imag() * turn.real());
  };
  for (Eigen::Index k = 1; k < xy.size(); ++k, phase = turned()) {
    const double w    = step * double(k);
    const double real = xy[k].real() * phase.real() - xy[k].imag() * phase.imag(),
                 imag = xy[k].real() * phase.imag() + xy[k].imag() * phase.real();
    R[0] += real;
    R[1] -= w * imag;
    R[2] -= w * w * real;
  }
  return R;
}

struct Extremum {
  Eigen::Index lag = 0;          // samples
  double height = 0, rival = 0;  // with the sign of the correlation; the next highest of its sign
};

// Highest |R| within the lags, and the next maximum of the same sign.  Of maxima as high as each other within a
// hundredth (a signal of one line) the one that is not upside down and of the least delay is taken.
Extremum highest(const std::vector<Complex> &R, const Eigen::Index reach, const Eigen::Index L)
{
  constexpr double alike = 0.99;
  std::vector<double> correlation(std::size_t(2 * reach + 1));
  for (Eigen::Index lag = -reach; lag <= reach; ++lag)
    correlation[std::size_t(lag + reach)] =
        R[std::size_t(lag < 0 ? lag + L : lag)].real() / hann_correlation(double(lag) / double(L));
  const auto [low, high] = std::minmax_element(correlation.begin(), correlation.end());
  const double sign = *high >= alike * -*low ? 1 : -1, top = std::max(sign * *low, sign * *high);
  std::vector<Eigen::Index> maxima;
  for (Eigen::Index lag = -reach; lag <= reach; ++lag) {
    const auto i = std::size_t(lag + reach);
    if ((i == 0 || sign * correlation[i] >= sign * correlation[i - 1]) &&
        (i + 1 == correlation.size() || sign * correlation[i] > sign * correlation[i + 1]))
      maxima.push_back(lag);
  }
  Extremum extremum;
  for (const Eigen::Index lag : maxima)
    if (sign * correlation[std::size_t(lag + reach)] >= alike * top &&
        (extremum.height == 0 || std::abs(lag) < std::abs(extremum.lag)))
      extremum = {lag, correlation[std::size_t(lag + reach)], 0};
  for (const Eigen::Index lag : maxima)
    if (lag != extremum.lag)
      extremum.rival = std::max(extremum.rival, sign * correlation[std::size_t(lag + reach)]);
  return extremum;
}

// (50.3): Knapp and Carter's variance of the delay for a correlation without weights.
double delay_sd(const CrossSums &known, const double step, const double duration)
{
  const double nd = independent_segments(known.n);
  if (!(nd > 2))
    return unknown;
  double noise = 0, bend = 0;
  for (Eigen::Index k = 1; k < known.xx.size(); ++k) {
    const double w2 = std::pow(step * double(k), 2), product = known.xx[k] * known.yy[k];
    const double raw = product > 0 ? 1 - std::norm(known.xy[k]) / product : 0;
    noise += w2 * product * std::clamp(raw * nd / (nd - 1), 0.0, 1.0);
    bend += w2 * std::abs(known.xy[k]);
  }
  const double df = step / (2 * M_PI);
  return bend > 0 ? std::sqrt(noise / (2 * duration * df)) / bend : unknown;
}
}  // namespace

CrossSums::CrossSums(const Eigen::Index bins) : xx(bins), yy(bins), xy(bins)
{
  clear();
}

void CrossSums::clear()
{
  xx.setZero();
  yy.setZero();
  xy.setZero();
  n = 0;
}

void CrossSums::add(const CrossSums &other)
{
  xx += other.xx;
  yy += other.yy;
  xy += other.xy;
  n += other.n;
}

double independent_segments(const double n)
{
  return n > 0 ? n / (1 + (n - 1) / (18 * n)) : 0;
}

Delay delay_of(const CrossSums &now, const CrossSums &known, const double rate, const double duration,
               const double reach, Fourier &fourier)
{
  const Eigen::Index bins = now.xx.size(), L = 2 * (bins - 1);
  Delay delay{unknown, unknown, unknown, unknown};
  const double x = now.xx.sum(), y = now.yy.sum();
  if (!(x > 0) || !(y > 0))
    return delay;
  std::vector<Complex> lines(std::size_t(L), 0.0), R;
  for (Eigen::Index k = 1; k < bins; ++k)
    lines[std::size_t(k)] = now.xy[k];  // the other half is not needed: the real part is taken
  fourier.inverse(lines, R);
  const auto most     = std::min<Eigen::Index>(L / 4, Eigen::Index(std::lround(reach * rate)));
  const Extremum peak = highest(R, most, L);
  const double step   = 2 * M_PI * rate / double(L);
  double tau          = double(peak.lag) / rate;
  for (int i = 0; i < 4; ++i) {  // Newton's method from the highest sample on the sum itself
    const auto R3     = correlation_at(now.xy, step, tau);
    const double move = -R3[1] / R3[2];
    if (!(R3[0] * R3[2] < 0) || !(std::abs(move) < 1 / rate))
      break;
    tau += move;
  }
  delay.value       = tau;
  delay.correlation = correlation_at(now.xy, step, tau)[0] / std::sqrt(x * y);
  delay.rival       = peak.rival / std::abs(peak.height);
  delay.sd          = delay_sd(known, step, duration);
  return delay;
}

std::vector<IncoherentShare> incoherent_shares(const CrossSums &sums, const double rate)
{
  std::vector<IncoherentShare> bands;
  const double L = 2 * double(sums.xx.size() - 1), df = rate / L, top = rate / 2.56;
  const double nd = independent_segments(sums.n), all = sums.xx.tail(sums.xx.size() - 1).sum();
  for (int m = int(std::ceil(10 * std::log10(3 * df / 1000 / 0.23))); true; ++m) {
    const double centre = 1000 * std::pow(10., m / 10.);
    IncoherentShare band{centre, centre * std::pow(10., -0.05), centre * std::pow(10., 0.05), unknown, 0};
    if (band.high > top)
      return bands;
    const auto from = Eigen::Index(std::ceil(band.low / df)), to = Eigen::Index(std::ceil(band.high / df));
    double rest = 0, energy = 0;
    for (Eigen::Index k = from; k < to; ++k) {
      energy += sums.xx[k];
      rest += sums.xx[k] - (sums.yy[k] > 0 ? std::norm(sums.xy[k]) / sums.yy[k] : 0);
    }
    if (nd > 8 && energy > 0)
      band.share = std::clamp(rest / energy * nd / (nd - 1), 0.0, 1.0);  // (50.4)
    band.energy = all > 0 ? energy / all : 0;
    bands.push_back(band);
  }
}
}  // namespace mill::twin
