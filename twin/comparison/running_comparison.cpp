#include "twin/comparison/running_comparison.h"
#include "twin/comparison/cross_spectra.h"
#include "twin/spectra/fourier.h"
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace mill::twin {
namespace {
using Complex                      = std::complex<double>;
constexpr double compared_delays   = 0.05;  // s, of delays
constexpr std::size_t seconds_kept = 10;    // of the coherence
constexpr Eigen::Index most_bins   = 1024;
constexpr double display_mean      = 0.5;  // s, time constant of the spectra for the eye

// Sums of one signal over a second.
struct RunningLevel {
  double sum = 0, squares = 0, low = 0, high = 0;
  Eigen::Index n = 0;
  void take(const double x)
  {
    if (!std::isfinite(x))
      return;
    low  = n ? std::min(low, x) : x;
    high = n ? std::max(high, x) : x;
    sum += x;
    squares += x * x;
    ++n;
  }
  Level level() const
  {
    Level l;
    if (n == 0)
      return l;
    l.offset = sum / double(n);
    l.rms    = std::sqrt(std::max(0.0, squares / double(n) - l.offset * l.offset));
    l.peak   = std::max(high - l.offset, l.offset - low);
    l.crest  = l.rms > 0 ? l.peak / l.rms : 0;
    return l;
  }
};

// What is summed of one place.
struct PlaceSums {
  RunningLevel measured, simulated;
  CrossSums second, known;
  std::deque<CrossSums> kept;     // of the last seconds
  Eigen::ArrayXd seen_x, seen_y;  // for the eye
  double seen = 0;                // weight so far
  explicit PlaceSums(const Eigen::Index bins) : second(bins), known(bins) {}
};

Eigen::Index segment_of(const double rate)
{
  return Eigen::Index(1) << int(std::ceil(std::log2(std::max(64.0, 0.4 * rate))));
}
}  // namespace

struct RunningComparison::State {
  double rate;
  Eigen::Index L, second;  // samples of a segment, of a second
  Eigen::ArrayXd window;
  Eigen::MatrixXd x, y;  // (L, places) the last samples
  Eigen::Index filled  = 0;
  std::int64_t next    = -1;  // number of the sample that comes next; -1: any
  std::int64_t quarter = -1;  // of a second, the last one reported
  std::vector<PlaceSums> places;
  Fourier fourier;
  std::vector<Complex> pair, lines;

  State(const double rate_, const Eigen::Index n)
      : rate(rate_), L(segment_of(rate_)), second(std::max<Eigen::Index>(1, Eigen::Index(std::lround(rate_)))),
        window(0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(L, 0, double(L - 1)) * (2 * M_PI / double(L))).cos()),
        x(L, n), y(L, n), places(std::size_t(n), PlaceSums(L / 2 + 1)), pair(static_cast<std::size_t>(L))
  {
  }

  void restart()
  {
    filled = 0;
    next   = -1;
    for (PlaceSums &p : places)
      p = PlaceSums(L / 2 + 1);
  }

  // One segment of one place: both signals in one complex transform.
  void add_segment(PlaceSums &p, const Eigen::Index column)
  {
    const auto a = x.col(column).array(), b = y.col(column).array();
    const double mean_a = a.mean(), mean_b = b.mean();
    if (!std::isfinite(mean_a) || !std::isfinite(mean_b))
      return;
    for (Eigen::Index i = 0; i < L; ++i)
      pair[std::size_t(i)] = {window[i] * (a[i] - mean_a), window[i] * (b[i] - mean_b)};
    fourier.forward(pair, lines);
    const double kept = p.seen > 0 ? std::exp(-double(L / 2) / rate / display_mean) : 0;
    p.seen            = kept * p.seen + 1;
    if (p.seen_x.size() == 0) {
      p.seen_x.setZero(std::min(L / 2 + 1, most_bins));
      p.seen_y = p.seen_x;
    }
    for (Eigen::Index k = 0; k <= L / 2; ++k) {
      const Complex plus = lines[std::size_t(k)], minus = std::conj(lines[std::size_t(k ? L - k : 0)]);
      const Complex X = 0.5 * (plus + minus), apart = plus - minus, Y(0.5 * apart.imag(), -0.5 * apart.real());
      const double xx = std::norm(X), yy = std::norm(Y);
      p.second.xx[k] += xx;
      p.second.yy[k] += yy;
      p.second.xy[k] +=
          Complex(X.real() * Y.real() + X.imag() * Y.imag(), X.imag() * Y.real() - X.real() * Y.imag());
      if (k < p.seen_x.size()) {
        p.seen_x[k] = kept * p.seen_x[k] + xx;
        p.seen_y[k] = kept * p.seen_y[k] + yy;
      }
    }
    p.second.n += 1;
  }

  PlaceSecond close_second(PlaceSums &p, const Eigen::Index column)
  {
    PlaceSecond row{};
    row.place     = column;
    row.measured  = p.measured.level();
    row.simulated = p.simulated.level();
    row.ratio     = row.measured.rms > 0 && row.simulated.rms > 0
                        ? 20 * std::log10(row.measured.rms / row.simulated.rms)
                        : std::numeric_limits<double>::quiet_NaN();
    row.missing   = 1 - double(p.measured.n) / double(second);
    p.kept.push_back(p.second);
    if (p.kept.size() > seconds_kept)
      p.kept.pop_front();
    p.known.clear();
    for (const CrossSums &one : p.kept)
      p.known.add(one);
    const double duration = p.second.n > 0 ? double(L / 2) * (p.second.n + 1) / rate : 0;
    row.delay             = delay_of(p.second, p.known, rate, duration, compared_delays, fourier);
    row.bands             = incoherent_shares(p.known, rate);
    p.second.clear();
    p.measured = p.simulated = {};
    return row;
  }

  void add_second(News &news)
  {
    std::vector<PlaceSecond> rows;
    for (std::size_t i = 0; i < places.size(); ++i) {
      PlaceSums &p = places[i];
      if (2 * p.measured.n >= second)
        rows.push_back(close_second(p, Eigen::Index(i)));
      else {
        p.measured = p.simulated = {};
        p.second.clear();
      }
    }
    if (rows.empty())
      return;
    news.time.push_back(double(next) / rate);
    news.seconds.push_back(std::move(rows));
  }

  void show_spectra(News &news)
  {
    const double to_density = 2 / (rate * 3.0 * double(L) / 8);  // theory.md (41.4)
    news.spectra.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const PlaceSums &p = places[i]; p.seen > 0)
        news.spectra.push_back({Eigen::Index(i), rate / double(L),
                                (p.seen_x * (to_density / p.seen)).cast<float>().matrix(),
                                (p.seen_y * (to_density / p.seen)).cast<float>().matrix()});
    news.spectra_time = double(next) / rate;
  }
};

RunningComparison::RunningComparison(const double rate, const Eigen::Index places)
    : state(std::make_unique<State>(rate, places))
{
}
RunningComparison::~RunningComparison()                             = default;
RunningComparison::RunningComparison(RunningComparison &&) noexcept = default;

void RunningComparison::restart()
{
  state->restart();
}

Eigen::Index RunningComparison::segment() const
{
  return state->L;
}

RunningComparison::News RunningComparison::take(const std::int64_t first, const Eigen::MatrixXd &measured,
                                                const Eigen::MatrixXd &simulated)
{
  News news;
  State &s = *state;
  if (s.next >= 0 && s.next != first)
    s.restart();
  s.next = first;
  for (Eigen::Index done = 0; done < measured.rows();) {
    // up to the end of the segment or of the second, whichever comes first
    const Eigen::Index to_second  = s.second - Eigen::Index(s.next % s.second);
    const Eigen::Index now        = std::min({measured.rows() - done, s.L - s.filled, to_second});
    s.x.middleRows(s.filled, now) = measured.middleRows(done, now);
    s.y.middleRows(s.filled, now) = simulated.middleRows(done, now);
    for (std::size_t i = 0; i < s.places.size(); ++i)
      for (Eigen::Index k = done; k < done + now; ++k) {
        s.places[i].measured.take(measured(k, Eigen::Index(i)));
        s.places[i].simulated.take(simulated(k, Eigen::Index(i)));
      }
    s.filled += now;
    s.next += now;
    done += now;
    if (s.filled == s.L) {
      for (std::size_t i = 0; i < s.places.size(); ++i)
        s.add_segment(s.places[i], Eigen::Index(i));
      s.x.topRows(s.L / 2) = s.x.bottomRows(s.L / 2).eval();
      s.y.topRows(s.L / 2) = s.y.bottomRows(s.L / 2).eval();
      s.filled             = s.L / 2;
    }
    if (s.next % s.second == 0)
      s.add_second(news);
    if (const std::int64_t quarter = 4 * s.next / s.second; quarter != s.quarter) {
      s.quarter = quarter;
      s.show_spectra(news);
    }
  }
  return news;
}
}  // namespace mill::twin
